// Mesh::build: from arrays to a mesh, or to the first error in them.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "base/box.hpp"
#include "base/sum.hpp"
#include "base/text.hpp"
#include "mesh/blocks.hpp"
#include "mesh/boundary_sweep.hpp"
#include "mesh/exact_range.hpp"
#include "mesh/mesh_editor.hpp"
#include "mesh/predicates.hpp"
#include "mesh/stoppable_build.hpp"
#include "mesh/twins.hpp"
#include "temper/mesh.hpp"

namespace temper {
namespace {

// Within these bounds nothing over- or underflows in the exact predicates (geometry.hpp), in the user's units and after
// scaling to an extent of about 1, whatever the other coordinates are. They are far beyond any unit of length.
constexpr double kLargestCoordinate = 1e60;
constexpr double kSmallestCoordinate = 1e-60;  // absolute, and relative to the largest coordinate
constexpr double kSmallestExtent = 1e-60;
constexpr double kLargestWeight = 1e120;    // absolute, and relative to the extent squared
constexpr double kSmallestWeight = 1e-120;  // absolute, and relative to the largest coordinate squared

bool is_finite(Vec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

// Points of the sphere may be off its radius by this part of it: the precision of coordinates with seven digits.
constexpr double kOffRadius = 1e-6;

}  // namespace

/// The steps of Mesh::build, in order. Each returns an error or nothing.
class MeshBuilder {
 public:
  MeshBuilder(const MeshInput& input, const std::function<bool()>& stop)
      : in_(input),
        names_(input.names != nullptr ? *input.names : default_),
        stoppable_(input.executor, stop),
        executor_(stop ? &stoppable_ : input.executor) {}

  Expected<BuiltMesh> build() {
    using Step = std::optional<InputError> (MeshBuilder::*)();
    constexpr Step kSteps[] = {&MeshBuilder::check_sizes,     &MeshBuilder::add_vertices, &MeshBuilder::check_scale,
                               &MeshBuilder::add_triangles,   &MeshBuilder::check_unused, &MeshBuilder::embed,
                               &MeshBuilder::constrain_edges, &MeshBuilder::fix_vertices};
    for (const Step step : kSteps) {
      auto error = (this->*step)();
      if (stoppable_.asked_to_stop()) return InputError{ErrorCode::stopped, "", "the mesh was stopped before its end"};
      if (error) return *std::move(error);
    }
    return BuiltMesh{std::move(mesh_), reversed_};
  }

 private:
  InputError point_error(ErrorCode code, std::size_t i, const std::string& message) const {
    return {code, names_.point_where(i), message};
  }
  InputError triangle_error(ErrorCode code, std::size_t t, const std::string& message) const {
    return {code, names_.triangle_where(t), message};
  }

  std::optional<InputError> check_sizes() {
    const std::size_t n = n_points(), m = in_.triangles.size();
    if (n == 0) return InputError{ErrorCode::empty_input, {}, "the mesh has no points"};
    if (m == 0) return InputError{ErrorCode::empty_input, {}, "the mesh has no triangles"};
    if (!in_.weights.empty() && in_.weights.size() != n) {
      return InputError{ErrorCode::size_mismatch,
                        {},
                        quantity(in_.weights.size(), "weights") + " given for " + quantity(n, "points")};
    }
    if (!in_.regions.empty() && in_.regions.size() != m) {
      return InputError{ErrorCode::size_mismatch,
                        {},
                        quantity(in_.regions.size(), "regions") + " given for " + quantity(m, "triangles")};
    }
    return std::nullopt;
  }

  std::optional<InputError> add_vertices() {
    mesh_.space_ = in_.space;
    mesh_.vertices_.resize(n_points());
    const auto wrong = first_index(n_points(), executor_, [&](std::size_t i) {
      const double w = in_.weights.empty() ? 0.0 : in_.weights[i];
      if (!is_finite(place(i)) || !std::isfinite(w)) return true;
      mesh_.set_point(VertexId(i), on_sphere() ? mesh_.space_.vertex_at(in_.sphere_points[i], w)
                                               : WeightedPoint{in_.points[i].x, in_.points[i].y, w});
      return false;
    });
    if (!wrong) return std::nullopt;
    const std::size_t i = *wrong;
    if (!is_finite(place(i))) {
      return point_error(ErrorCode::not_finite, i,
                         names_.point(i) + " has coordinates " + place_text(i) + ", expected finite numbers");
    }
    return point_error(ErrorCode::not_finite, i,
                       names_.point(i) + " has weight " + to_text(in_.weights[i]) + ", expected a finite number");
  }

  std::optional<InputError> check_periods() const {
    const Vec2 period = in_.space.period();
    for (const double length : {period.x, period.y}) {
      if (length == 0 || ExactRange{kSmallestExtent, kLargestCoordinate}.allows(length)) continue;
      return InputError{ErrorCode::out_of_scale,
                        {},
                        "the plane has period " + to_text(length) + ", expected one from " + to_text(kSmallestExtent) +
                            " to " + to_text(kLargestCoordinate)};
    }
    return std::nullopt;
  }

  [[nodiscard]] bool on_sphere() const { return in_.space.dimension() == 3; }
  [[nodiscard]] std::size_t n_points() const { return on_sphere() ? in_.sphere_points.size() : in_.points.size(); }
  [[nodiscard]] Vec3 place(std::size_t i) const {
    return on_sphere() ? in_.sphere_points[i] : Vec3{in_.points[i].x, in_.points[i].y, 0};
  }
  [[nodiscard]] std::string place_text(std::size_t i) const {
    return on_sphere() ? coordinates(in_.sphere_points[i]) : coordinates(in_.points[i]);
  }

  std::optional<InputError> check_sphere() {
    const double radius = in_.space.radius(), lightest = -radius * radius;
    if (!ExactRange{kSmallestExtent, kLargestCoordinate}.allows(radius)) {
      return InputError{ErrorCode::out_of_scale,
                        {},
                        "the sphere has radius " + to_text(radius) + ", expected one from " + to_text(kSmallestExtent) +
                            " to " + to_text(kLargestCoordinate)};
    }
    for (std::size_t i = 0; i < n_points(); ++i) {
      const double distance = length(in_.sphere_points[i]), w = in_.weights.empty() ? 0.0 : in_.weights[i];
      if (!(std::abs(distance - radius) <= kOffRadius * radius)) {
        return point_error(ErrorCode::not_on_sphere, i,
                           names_.point(i) + " is at " + place_text(i) + ", " + to_text(distance) +
                               " from the center of the sphere; expected its radius, " + to_text(radius) +
                               ", to one part in a million");
      }
      if (!(w > lightest)) {
        return point_error(ErrorCode::out_of_scale, i,
                           names_.point(i) + " has weight " + to_text(w) + "; expected more than " + to_text(lightest) +
                               ", minus the square of the radius");
      }
    }
    // Rounded zeros of a longitude or latitude would cost exact arithmetic too many bits.
    for (std::size_t i = 0; i < n_points(); ++i) {
      WeightedPoint p = mesh_.point(VertexId(i));
      for (double* x : {&p.x, &p.y, &p.w}) *x = std::abs(*x) < kSmallestCoordinate * radius ? 0 : *x;
      mesh_.set_point(VertexId(i), p);
    }
    return std::nullopt;
  }

  std::optional<InputError> check_scale() {
    if (on_sphere()) return check_sphere();
    if (auto error = check_periods()) return error;
    if (auto error = check_coordinates({kSmallestCoordinate, kLargestCoordinate})) return error;
    Box box;
    double largest = 0;
    for (const Vec2 p : in_.points) {
      box.add(p);
      largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
    }
    const double extent = box.longer_side();
    if (extent == 0) return std::nullopt;  // the zero areas will be named
    if (extent < kSmallestExtent) {
      return InputError{ErrorCode::out_of_scale,
                        {},
                        "the points lie within " + to_text(extent) + "; expected an extent of at least " +
                            to_text(kSmallestExtent) + ", which exact arithmetic needs"};
    }
    const double large = std::max(1.0, largest);
    if (auto error = check_coordinates({kSmallestCoordinate * large, kLargestCoordinate})) return error;
    if (auto error = check_weights({kSmallestWeight * large * large, kLargestWeight * std::min(1.0, extent * extent)}))
      return error;
    if (!in_.space.is_periodic()) return std::nullopt;
    for (const VertexId v : mesh_.vertices()) mesh_.set_point(v, in_.space.in_domain(mesh_.point(v)));
    return std::nullopt;
  }

  std::optional<InputError> check_coordinates(ExactRange range) const {
    for (std::size_t i = 0; i < in_.points.size(); ++i) {
      const Vec2 p = in_.points[i];
      if (range.allows(p.x) && range.allows(p.y)) continue;
      return point_error(ErrorCode::out_of_scale, i,
                         names_.point(i) + " has coordinates " + coordinates(p) + "; " + range.text());
    }
    return std::nullopt;
  }

  std::optional<InputError> check_weights(ExactRange range) const {
    for (std::size_t i = 0; i < in_.weights.size(); ++i) {
      if (range.allows(in_.weights[i])) continue;
      return point_error(ErrorCode::out_of_scale, i,
                         names_.point(i) + " has weight " + to_text(in_.weights[i]) + "; " + range.text());
    }
    return std::nullopt;
  }

  std::optional<InputError> add_triangles() {
    const std::size_t m = in_.triangles.size();
    mesh_.corners_.resize(3 * m);
    mesh_.twins_.resize(3 * m);
    const auto wrong = first_index(m, executor_, [&](std::size_t t) { return !add_triangle(t); });
    if (wrong) return wrong_triangle(*wrong);
    const auto is_reversed = [&](std::size_t t) {
      return mesh_.origin(HalfedgeId(3 * t + 1)) != id(in_.triangles[t][1]) ? 1.0 : 0.0;
    };
    reversed_ = static_cast<std::size_t>(blockwise_sum(m, executor_, is_reversed));
    for (std::size_t t = 0; t < in_.regions.size(); ++t) mesh_.set_region(TriangleId(t), in_.regions[t]);
    return std::nullopt;
  }

  /// Adds a triangle. False when it cannot be one.
  bool add_triangle(std::size_t t) {
    auto corners = in_.triangles[t];
    for (const std::int32_t i : corners) {
      if (!is_point(i)) return false;
    }
    const Sign sign = inlined::orientation(mesh_, id(corners[0]), id(corners[1]), id(corners[2]));
    if (sign == Sign::negative) std::swap(corners[1], corners[2]);
    for (std::size_t k = 0; k < 3; ++k) mesh_.corners_[HalfedgeId(3 * t + k)] = id(corners[k]);
    return sign != Sign::zero;
  }

  InputError wrong_triangle(std::size_t t) const {
    for (const std::int32_t i : in_.triangles[t]) {
      if (is_point(i)) continue;
      return triangle_error(ErrorCode::index_out_of_range, t,
                            names_.triangle(t) + " uses point index " + std::to_string(i) + ", but there are " +
                                quantity(n_points(), "points"));
    }
    if (const std::string wide = why_wide(in_.triangles[t]); !wide.empty()) {
      return triangle_error(ErrorCode::overlap, t, names_.triangle(t) + wide);
    }
    return triangle_error(ErrorCode::zero_area, t,
                          names_.triangle(t) + " has zero area: " + why_flat(in_.triangles[t]));
  }

  [[nodiscard]] bool is_point(std::int32_t i) const { return i >= 0 && static_cast<std::size_t>(i) < n_points(); }

  std::optional<InputError> check_unused() {
    for (const HalfedgeId h : mesh_.halfedges()) MeshEditor(mesh_).set_outgoing(mesh_.origin(h), h);
    for (const VertexId v : mesh_.vertices()) {
      if (!mesh_.outgoing(v).valid()) {
        return point_error(ErrorCode::unused_point, v.index, names_.point(v.index) + " belongs to no triangle");
      }
    }
    return std::nullopt;
  }

  /// Checks that the mesh is embedded in the plane. If edges are manifold, stars whole and no spot is covered twice, no
  /// two points are at the same place: each would be in the star of the other. So duplicate points are looked for only
  /// when one of these conditions fails, as the likely reason.
  std::optional<InputError> embed() {
    auto error = link_twins();
    if (!error && !stoppable_.asked_to_stop()) error = check_stars();
    if (!error && !stoppable_.asked_to_stop()) error = check_embedding();
    if (!error || stoppable_.asked_to_stop()) return std::nullopt;
    auto duplicate = find_duplicate();
    return duplicate ? std::move(duplicate) : std::move(error);
  }

  std::optional<InputError> find_duplicate() const {
    std::vector<std::uint32_t> order(n_points());
    std::iota(order.begin(), order.end(), 0u);
    const auto at = [&](std::uint32_t i) { return as_vector(in_.space.in_domain(as_point(place(i)))); };
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
      const Vec3 p = at(a), q = at(b);
      if (p.x != q.x) return p.x < q.x;
      if (p.y != q.y) return p.y < q.y;
      return p.z != q.z ? p.z < q.z : a < b;
    };
    std::sort(order.begin(), order.end(), before);
    for (std::size_t i = 1; i < order.size(); ++i) {
      const std::uint32_t a = order[i - 1], b = order[i];
      if (at(a) == at(b)) {
        return point_error(ErrorCode::duplicate_point, b,
                           names_.point(a) + " and " + names_.point(b) + " are both at " + place_text(b) +
                               "; expected distinct points");
      }
    }
    return std::nullopt;
  }

  /// Halfedges by their lesser vertex, matched within each small bucket.
  std::optional<InputError> link_twins() {
    const EdgeBuckets buckets(mesh_, mesh_.vertices());
    const auto wrong = first_index_by(mesh_.n_vertices(), executor_, [&] {
      return [&, sides = Sides()](std::size_t v) mutable {
        buckets.collect(VertexId(v), sides);
        return !match(sides);
      };
    });
    if (!wrong) return std::nullopt;
    Sides sides;
    buckets.collect(VertexId(*wrong), sides);
    return wrong_edge(sides);
  }

  using Sides = std::vector<EdgeBuckets::Side>;

  /// Links the edges of a lesser vertex. False when one has more than two sides, or two equal ones.
  bool match(const Sides& sides) {
    if (wrong_edge(sides)) return false;
    for (std::size_t i = 0; i < sides.size();) {
      const bool pair = i + 1 < sides.size() && sides[i].greater == sides[i + 1].greater;
      MeshEditor(mesh_).link(sides[i].halfedge, pair ? sides[i + 1].halfedge : HalfedgeId());
      i += pair ? 2 : 1;
    }
    return true;
  }

  std::optional<InputError> wrong_edge(const Sides& edges) const {
    for (std::size_t i = 0, j = 0; i < edges.size(); i = j) {
      while (j < edges.size() && edges[j].greater == edges[i].greater) ++j;
      const HalfedgeId g = edges[i].halfedge, h = edges[j - 1].halfedge;
      if (j - i > 2) return edge_error(ErrorCode::non_manifold_edge, g, h, j - i);
      if (j - i == 2 && mesh_.origin(g) == mesh_.origin(h)) return edge_error(ErrorCode::overlap, g, h, 2);
    }
    return std::nullopt;
  }

  InputError edge_error(ErrorCode code, HalfedgeId g, HalfedgeId h, std::size_t count) const {
    const std::size_t s = Mesh::triangle(g).index, t = Mesh::triangle(h).index;
    const std::string edge =
        "the edge from " + names_.point(mesh_.origin(g).index) + " to " + names_.point(mesh_.target(g).index);
    if (code == ErrorCode::overlap) {
      return triangle_error(code, t,
                            names_.triangle(s) + " and " + names_.triangle(t) + " lie on the same side of " + edge);
    }
    return triangle_error(code, t,
                          edge + " belongs to " + std::to_string(count) + " triangles (" + names_.triangle(s) +
                              " and " + names_.triangle(t) + " among them); expected at most 2");
  }

  std::optional<InputError> check_stars() {
    for (const HalfedgeId h : mesh_.halfedges()) {
      if (mesh_.is_boundary(h)) MeshEditor(mesh_).set_outgoing(mesh_.origin(h), h);
    }
    // A star holds at most the triangles at its vertex. So if all stars together hold all corners, each is whole.
    const auto size = [&](std::size_t v) {
      double count = 0;
      for ([[maybe_unused]] const HalfedgeId h : mesh_.star(VertexId(v))) ++count;
      return count;
    };
    const double together = blockwise_sum(mesh_.n_vertices(), executor_, size);
    if (together == static_cast<double>(mesh_.n_halfedges())) return std::nullopt;
    std::vector<std::uint32_t> missing(mesh_.n_vertices(), 0);
    for (const HalfedgeId h : mesh_.halfedges()) ++missing[mesh_.origin(h).index];
    for (const VertexId v : mesh_.vertices()) {
      for ([[maybe_unused]] const HalfedgeId h : mesh_.star(v)) --missing[v.index];
      if (missing[v.index] != 0) {
        std::string message = edges_on_each_other(mesh_, v, names_);
        if (message.empty()) {
          message = "the mesh touches itself at " + names_.point(v.index) + ": its triangles are not one fan around it";
        }
        return point_error(ErrorCode::non_manifold_vertex, v.index, message);
      }
    }
    return std::nullopt;
  }

  std::optional<InputError> check_embedding() {
    const auto overlap = find_overlap(mesh_, names_, executor_);
    if (!overlap) return std::nullopt;
    return triangle_error(ErrorCode::overlap, overlap->triangle.index, overlap->message);
  }

  std::optional<InputError> constrain_edges() {
    for (const auto& [a, b] : in_.constrained_edges) {
      for (const std::int32_t i : {a, b}) {
        if (!is_point(i)) {
          return InputError{ErrorCode::index_out_of_range,
                            {},
                            "a constrained edge uses point index " + std::to_string(i) + ", but there are " +
                                quantity(n_points(), "points")};
        }
      }
      HalfedgeId h = mesh_.find_halfedge(id(a), id(b));
      if (!h.valid()) h = mesh_.find_halfedge(id(b), id(a));
      if (!h.valid()) {
        return point_error(ErrorCode::missing_edge, static_cast<std::size_t>(a),
                           "the constrained edge from " + names_.point(static_cast<std::size_t>(a)) + " to " +
                               names_.point(static_cast<std::size_t>(b)) + " is no edge of the mesh");
      }
      mesh_.set_constrained(h, true);
    }
    if (mesh_.regions_.all_zero()) return std::nullopt;
    for (const HalfedgeId h : mesh_.halfedges()) {
      const HalfedgeId other = mesh_.twin(h);
      if (other.valid() && mesh_.region(Mesh::triangle(h)) != mesh_.region(Mesh::triangle(other))) {
        mesh_.set_constrained(h, true);
      }
    }
    return std::nullopt;
  }

  std::optional<InputError> fix_vertices() {
    for (const std::int32_t i : in_.fixed_vertices) {
      if (!is_point(i)) {
        return InputError{
            ErrorCode::index_out_of_range,
            {},
            "a fixed vertex has index " + std::to_string(i) + ", but there are " + quantity(n_points(), "points")};
      }
      mesh_.set_fixed(id(i), true);
    }
    return std::nullopt;
  }

  static VertexId id(std::int32_t i) { return VertexId(static_cast<std::size_t>(i)); }

  /// A message on the width of a triangle in the periodic plane; empty if it is narrow enough.
  std::string why_wide(const std::array<std::int32_t, 3>& c) const {
    const auto [p, q, r] = mesh_.points(id(c[0]), id(c[1]), id(c[2]));
    if (in_.space.are_near(p, q) && in_.space.are_near(q, r) && in_.space.are_near(r, p)) return {};
    const auto name = [&](std::int32_t i) { return names_.point(static_cast<std::size_t>(i)); };
    return " does not fit into half a period: expected the shortest ways between its corners " + name(c[0]) + ", " +
           name(c[1]) + " and " + name(c[2]) + " to be its edges; more points around the period make that so";
  }

  std::string why_flat(const std::array<std::int32_t, 3>& c) const {
    const auto name = [&](std::int32_t i) { return names_.point(static_cast<std::size_t>(i)); };
    if (c[0] == c[1] || c[0] == c[2]) return "it uses " + name(c[0]) + " more than once";
    if (c[1] == c[2]) return "it uses " + name(c[1]) + " more than once";
    return "its corners " + name(c[0]) + ", " + name(c[1]) + " and " + name(c[2]) +
           (on_sphere() ? " are on one great circle" : " are collinear");
  }

  const MeshInput& in_;
  InputNames default_;
  const InputNames& names_;
  StoppableExecutor stoppable_;
  Executor* executor_;
  Mesh mesh_;
  std::size_t reversed_ = 0;
};

Expected<BuiltMesh> Mesh::build(const MeshInput& input) { return build_or_stop(input, {}); }

Expected<BuiltMesh> build_or_stop(const MeshInput& input, const std::function<bool()>& stop) {
  return MeshBuilder(input, stop).build();
}

}  // namespace temper
