// Sweeps, and what they are compared with, in turn: whatever slows the machine down for a while slows all of them.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <memory>
#include <vector>

#include "child.hpp"
#include "energy/patch.hpp"
#include "measure.hpp"
#include "star_lanes.hpp"
#include "step_parts.hpp"
#include "sweeps.hpp"
#include "temper/mesh.hpp"

namespace temper::bench {
namespace {

/// The stars of a mesh in the order in which sweeps come to them, packed.
class PackedStars {
 public:
  explicit PackedStars(const Mesh& mesh);
  ~PackedStars();
  PackedStars(const PackedStars&) = delete;
  PackedStars& operator=(const PackedStars&) = delete;

  /// Value, gradient and Hessian of E_BP of every star, and nothing else, in the fastest instruction set.
  /// The triangles of a star are the lanes; returns the sum of the values.
  [[nodiscard]] double by_triangles() const;
  /// The same with a star in each lane, alike stars together as in sweeps.
  [[nodiscard]] double by_stars() const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

/// a[i] = b[i] + s c[i], over so many bytes as a sweep reads or writes at the least: those of the mesh.
class Triad {
 public:
  explicit Triad(const Mesh& mesh);
  void run();
  /// Bytes of a mesh, a vertex.
  static constexpr double kBytes = 80;

 private:
  std::vector<double> a_, b_, c_;
};

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

constexpr double kSeconds = 4;  // of rounds that are more than asked for
constexpr int kMostRounds = 20;
// Beyond this, sweeps alone: what they are compared with does not depend on the size, or takes too long or too much.
constexpr std::size_t kMostCompared = 1000000;
constexpr std::size_t kMostGolden = 100000, kLeastGolden = 10000;
constexpr double kShortest = 0.02;  // seconds of a loop that is timed

/// The least of all rounds.
void note(double& least, double value) { least = std::fmin(least, value); }

double ns(double seconds, std::size_t vertices, int times) {
  return 1e9 * seconds / (static_cast<double>(vertices) * times);
}

double sweep_ns(const Mesh& mesh, const OptimizeOptions& options, int sweeps) {
  const TimedRun run = timed_sweeps(mesh, options, sweeps);
  return ns(run.cpu_between(0, static_cast<std::size_t>(sweeps)), mesh.n_vertices(), sweeps);
}

/// The time per vertex of sweeps of the accuracy objective, from a mesh whose triangles are well-centered: some for the
/// energy may come first.
double accuracy_sweep_ns(const Mesh& mesh, int sweeps) {
  OptimizeOptions options;
  options.objective = Objective::accuracy;
  options.accuracy.tolerance = 0;
  options.accuracy.sweeps = sweeps + 2;  // the last leaves no mark, nor does what is before the first after others
  Mesh copy = mesh;
  const TimedRun run = timed_run(copy, options);
  const auto is_first = [](const Mark& mark) { return mark.last.objective == Objective::accuracy; };
  const auto first = std::find_if(run.marks.begin(), run.marks.end(), is_first);
  if (run.marks.end() - first <= sweeps) fail("accuracy sweeps ended early");
  const auto at = static_cast<std::size_t>(first - run.marks.begin());
  return ns(run.cpu_between(at, at + static_cast<std::size_t>(sweeps)), mesh.n_vertices(), sweeps);
}

/// The time per vertex of a loop over all vertices, run as often as the clock needs.
double loop_ns(std::size_t vertices, const std::function<void()>& loop) {
  const double start = cpu_seconds();
  double seconds = 0;
  int times = 0;
  for (; seconds < kShortest; ++times, seconds = cpu_seconds() - start) loop();
  return ns(seconds, vertices, times);
}

class Comparison {
 public:
  Comparison(const Mesh& settled, const Mesh& mesh, const Options& options)
      : mesh_(mesh), options_(options), stars_(settled), triad_(settled) {}

  void measure(SweepCosts& costs) {
    const std::size_t n = mesh_.n_vertices();
    note(costs.by_triangles, loop_ns(n, [this] { keep(stars_.by_triangles()); }));
    note(costs.by_stars, loop_ns(n, [this] { keep(stars_.by_stars()); }));
    note(costs.triad, loop_ns(n, [this] { triad_.run(); }));
    note(costs.alternating, sweep_ns(mesh_, sweeps_only(Solver::alternating), options_.sweeps));
    const bool golden = n >= kLeastGolden && n <= kMostGolden;
    if (!golden) return;
    note(costs.golden, sweep_ns(mesh_, sweeps_only(Solver::golden), options_.golden_sweeps));
    note(costs.paper, sweep_ns(mesh_, paper_sweeps(), options_.golden_sweeps));
  }

 private:
  void keep(double value) { kept_ = kept_ + value; }

  const Mesh& mesh_;
  const Options& options_;
  PackedStars stars_;
  Triad triad_;
  volatile double kept_ = 0;  // so that no loop can be left out
};

}  // namespace

SweepCosts measure_sweeps(std::size_t vertices, const Options& options) {
  SweepCosts costs;
  const Mesh mesh = mesh_of_random_points(vertices);
  const Mesh settled = well_centered_mesh(mesh);
  std::optional<Comparison> comparison;
  if (vertices <= kMostCompared && !options.sweeps_alone) comparison.emplace(settled, mesh, options);
  const double start = cpu_seconds();
  for (int round = 0; round < kMostRounds && (round < options.rounds || cpu_seconds() - start < kSeconds); ++round) {
    note(costs.newton, sweep_ns(mesh, sweeps_only(), options.sweeps));
    note(costs.settled, sweep_ns(settled, sweeps_only(), options.sweeps));
    note(costs.accuracy, accuracy_sweep_ns(settled, options.sweeps));
    if (comparison) comparison->measure(costs);
  }
  return costs;
}

}  // namespace temper::bench
