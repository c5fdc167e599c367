#include "tets/optimize/seam_slide.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "tets/energy/star.hpp"
#include "tets/optimize/mobility.hpp"

namespace temper::tets {
namespace {

// γ of the sweeps, as a run has them from its middle to its end.
constexpr std::array kGammas = {0.3, 0.1, 0.03, 0.01};
constexpr int kSweeps = 3;  // for each γ
// Differences of places for derivatives, over the least edge: E has about ten digits there.
constexpr double kDifference = 1e-4;
// The longest step, over the least edge.
constexpr double kLongest = 0.3;
constexpr int kHalvings = 6;
constexpr std::size_t kStepsBetweenQuestions = 256;

/// A vertex of an interface that may slide.
struct Slider {
  struct Copy {
    VertexId vertex;
    const Metric* metric;
    std::vector<LinkFace<double>> link;  ///< at present
  };
  std::vector<Copy> copies;
  std::array<Vec3, 2> along;  ///< unit vectors at right angles; the second one is 0 on a line
};

class SeamSlide {
 public:
  SeamSlide(MetricMesh& pieces, const TetMesh& whole, const OptimizeOptions& options) : pieces_(pieces) {
    IdVector<VertexId, std::uint32_t> n_copies(pieces.mesh.n_vertices(), 0);
    for (const VertexId v : pieces.mesh.vertices()) ++n_copies[pieces.first_copy(v)];
    const IdVector<VertexId, Mobility> mobility = mobilities(whole, options);
    IdVector<VertexId, std::int32_t> number(pieces.mesh.n_vertices(), -1);
    VertexId of_whole(0);  // the vertices of the whole mesh are the first copies, in their order
    for (const VertexId v : pieces.mesh.vertices()) {
      if (pieces.first_copy(v) != v) continue;
      const Mobility& m = mobility[of_whole];
      of_whole = VertexId(of_whole.index + 1);
      if (n_copies[v] < 2 || !m.slides()) continue;
      number[v] = static_cast<std::int32_t>(sliders_.size());
      sliders_.push_back({{}, directions(m)});
    }
    for (const VertexId v : pieces.mesh.vertices()) {
      const std::int32_t n = number[pieces.first_copy(v)];
      if (n >= 0)
        sliders_[static_cast<std::size_t>(n)].copies.push_back({v, &pieces.metric(pieces.mesh.incident(v)), {}});
    }
  }

  bool run(const std::function<bool()>& must_stop) {
    bool moved = false;
    for (const double gamma : kGammas) {
      for (int i = 0; i < kSweeps; ++i) {
        for (std::size_t k = 0; k < sliders_.size(); ++k) {
          if (k % kStepsBetweenQuestions == 0 && must_stop()) return moved;
          moved = step(sliders_[k], gamma) || moved;
        }
      }
    }
    return moved;
  }

 private:
  static std::array<Vec3, 2> directions(const Mobility& m) {
    if (m.dimensions == 1) return {m.direction, Vec3{}};
    const Vec3 n = m.direction;
    const Vec3 other = std::abs(n.x) <= std::abs(n.y) && std::abs(n.x) <= std::abs(n.z) ? Vec3{1, 0, 0}
                       : std::abs(n.y) <= std::abs(n.z)                                 ? Vec3{0, 1, 0}
                                                                                        : Vec3{0, 0, 1};
    const Vec3 first = cross(n, other), unit = (1 / length(first)) * first;
    return {unit, cross(n, unit)};
  }

  [[nodiscard]] double energy(const Slider& slider, Vec3 at, double gamma) const {
    double sum = 0;
    for (const Slider::Copy& copy : slider.copies) {
      const Vec3 p = copy.metric->to_metric(at);
      sum += star_energy(copy.link, {p.x, p.y, p.z, pieces_.mesh.weight(copy.vertex)}, gamma);
    }
    return sum;
  }
  void move_to(const Slider& slider, Vec3 at) {
    for (const Slider::Copy& copy : slider.copies) {
      const Vec3 p = copy.metric->to_metric(at);
      pieces_.mesh.set_point(copy.vertex, {p.x, p.y, p.z, pieces_.mesh.weight(copy.vertex)});
    }
  }

  /// A step of Newton's method, or against the gradient where the energy is not convex. It is halved until the energy
  /// falls. Derivatives come from differences.
  bool step(Slider& slider, double gamma) {
    const double edge = gather(slider), d = kDifference * edge;
    const Slider::Copy& first = slider.copies.front();
    const Vec3 x = first.metric->from_metric(pieces_.mesh.position(first.vertex));
    const auto place = [&](double a, double b) { return x + a * slider.along[0] + b * slider.along[1]; };
    const auto at = [&](double a, double b) { return energy(slider, place(a, b), gamma); };
    const bool is_line = slider.along[1] == Vec3{};
    const double here = at(0, 0), left = at(-d, 0), right = at(d, 0), below = at(0, -d), above = at(0, d);
    const double ga = (right - left) / (2 * d), gb = (above - below) / (2 * d);
    const double aa = (right - 2 * here + left) / (d * d);
    const double bb = is_line ? 1 : (above - 2 * here + below) / (d * d);
    const double ab = is_line ? 0 : (at(d, d) - right - above + here) / (d * d);
    const double determinant = aa * bb - ab * ab, longest = kLongest * edge;
    const bool is_convex = aa > 0 && determinant > 0;
    const double a = is_convex ? (ab * gb - bb * ga) / determinant : -ga;
    const double b = is_convex ? (ab * ga - aa * gb) / determinant : -gb;
    const double size = std::hypot(a, b);
    if (!std::isfinite(size) || size == 0) return false;
    double part = is_convex ? std::min(1.0, longest / size) : longest / size;
    for (int i = 0; i < kHalvings; ++i, part *= 0.5) {
      if (!(at(part * a, part * b) < here)) continue;
      move_to(slider, place(part * a, part * b));
      return true;
    }
    return false;
  }
  /// Gathers the links, and returns the least length of an edge, in the space of the file.
  double gather(Slider& slider) {
    const TetMesh& mesh = pieces_.mesh;
    double least = std::numeric_limits<double>::infinity();
    for (Slider::Copy& copy : slider.copies) {
      collect_link(mesh, copy.vertex, halffaces_);
      copy.link.clear();
      for (const HalffaceId h : halffaces_) {
        copy.link.push_back(link_face(mesh, h));
        for (const VertexId v : mesh.vertices(h))
          least = std::min(least, length(copy.metric->from_metric(mesh.position(v) - mesh.position(copy.vertex))));
      }
    }
    return least;
  }

  MetricMesh& pieces_;
  std::vector<Slider> sliders_;
  std::vector<HalffaceId> halffaces_;
};

}  // namespace

bool slide_seams(MetricMesh& pieces, const TetMesh& whole, const OptimizeOptions& options,
                 const std::function<bool()>& must_stop) {
  return SeamSlide(pieces, whole, options).run(must_stop);
}

}  // namespace temper::tets
