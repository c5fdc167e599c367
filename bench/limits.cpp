#include "limits.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

#include "energy/patch.hpp"
#include "star_lanes.hpp"
#include "step_parts.hpp"

namespace temper::bench {
namespace {

EdgeFormula sharpest_barrier() {
  EnergyModel model;
  model.kind = EnergyKind::BP;
  model.gamma = {0.003, LengthScale::relative};
  return edge_formula(model);
}

/// One star among the packed ones.
struct Star {
  WeightedPoint p;
  std::size_t first = 0, triangles = 0;
};

/// Eight stars among the packed ones.
struct Eight {
  StarLanes stars;  // whose link is not yet known
  std::size_t first = 0;
};

Eight pack(const Mesh& mesh, const std::array<VertexId, kLanes>& vertices, std::vector<LanePoints>& link) {
  StarBatch batch;
  for (std::size_t lane = 0; lane < kLanes; ++lane) fill_lane(mesh, vertices[lane], lane, batch);
  Eight eight{{batch.p, {}, batch.most_triangles, nullptr}, link.size()};
  std::copy(std::begin(batch.triangles), std::end(batch.triangles), eight.stars.triangles);
  link.insert(link.end(), batch.link, batch.link + batch.most_triangles + 1);
  return eight;
}

}  // namespace

struct PackedStars::Data {
  std::vector<Star> stars;
  std::vector<double> x, y, w;  // of all links, one after the other
  std::vector<Eight> eights;
  std::vector<LanePoints> link;
};

PackedStars::PackedStars(const Mesh& mesh) : data_(std::make_unique<Data>()) {
  const Mesh ordered = hilbert_ordered(mesh).mesh;
  Patch patch;
  for (const VertexId v : ordered.vertices()) {
    gather_patch(ordered, v, false, patch);
    data_->stars.push_back({ordered.point(v), data_->x.size(), patch.size()});
    for (std::size_t i = 0; i <= patch.size(); ++i) {
      data_->x.push_back(patch.x[i]);
      data_->y.push_back(patch.y[i]);
      data_->w.push_back(patch.w[i]);
    }
  }
  // Kernels read whole packs.
  for (auto* array : {&data_->x, &data_->y, &data_->w}) array->resize(array->size() + 2 * kLanes);
  for (const auto& vertices : alike_vertices(ordered)) data_->eights.push_back(pack(ordered, vertices, data_->link));
  for (Eight& e : data_->eights) e.stars.link = data_->link.data() + e.first;
}

PackedStars::~PackedStars() = default;

double PackedStars::by_triangles() const {
  const EdgeFormula formula = sharpest_barrier();
  const auto derivatives = star_kernels(Space()).barrier_derivatives;
  std::array<double, kStarSums> sums{};
  double total = 0;
  for (const Star& s : data_->stars) {
    const LinkArrays link{data_->x.data() + s.first, data_->y.data() + s.first, data_->w.data() + s.first, s.triangles};
    if (derivatives(formula, link, s.p, sums.data())) total += sums[0];
  }
  return total;
}

double PackedStars::by_stars() const {
  const EdgeFormula formula = sharpest_barrier();
  const auto star_sums = step_parts().star_sums;
  Lane sums[kStarSums];
  Lane total{};
  for (const Eight& e : data_->eights) {
    star_sums(formula, e.stars, sums);
    for (std::size_t lane = 0; lane < kLanes; ++lane) total[lane] += sums[0][lane];
  }
  double sum = 0;
  for (const double x : total) sum += x;
  return sum;
}

Triad::Triad(const Mesh& mesh) {
  const auto size = static_cast<std::size_t>(kBytes * static_cast<double>(mesh.n_vertices()) / (3 * sizeof(double)));
  a_.assign(size, 0), b_.assign(size, 1), c_.assign(size, 2);
}

void Triad::run() {
  const double scale = b_.front();
  for (std::size_t i = 0; i < a_.size(); ++i) a_[i] = b_[i] + scale * c_[i];
  b_.front() = a_.back() > 0 ? 1 : 0;  // so that no run can be left out
}

}  // namespace temper::bench
