// Mesh::build: from arrays to a mesh, or to the first error in them.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "base/sum.hpp"
#include "base/text.hpp"
#include "mesh/blocks.hpp"
#include "mesh/boundary_sweep.hpp"
#include "mesh/exact_range.hpp"
#include "mesh/input_check.hpp"
#include "mesh/mesh_editor.hpp"
#include "mesh/predicates.hpp"
#include "mesh/shared_steps.hpp"
#include "mesh/stoppable_build.hpp"
#include "mesh/twins.hpp"
#include "temper/mesh.hpp"

namespace temper {
namespace {

using Sides = std::vector<EdgeBuckets::Side>;

InputError edge_error(const Mesh& mesh, const NamedInput& input, ErrorCode code, std::array<HalfedgeId, 2> sides,
                      std::size_t count) {
  const auto [g, h] = sides;
  const std::size_t s = Mesh::triangle(g).index, t = Mesh::triangle(h).index;
  const std::string edge =
      "the edge from " + input.names.point(mesh.origin(g).index) + " to " + input.names.point(mesh.target(g).index);
  if (code == ErrorCode::overlap) {
    return input.triangle_error(
        code, t, input.names.triangle(s) + " and " + input.names.triangle(t) + " lie on the same side of " + edge);
  }
  return input.triangle_error(code, t,
                              edge + " belongs to " + std::to_string(count) + " triangles (" + input.names.triangle(s) +
                                  " and " + input.names.triangle(t) + " among them); expected at most 2");
}

std::optional<InputError> wrong_edge(const Mesh& mesh, const NamedInput& input, const Sides& edges) {
  for (std::size_t i = 0, j = 0; i < edges.size(); i = j) {
    while (j < edges.size() && edges[j].greater == edges[i].greater) ++j;
    const HalfedgeId g = edges[i].halfedge, h = edges[j - 1].halfedge;
    if (j - i > 2) return edge_error(mesh, input, ErrorCode::non_manifold_edge, {g, h}, j - i);
    if (j - i == 2 && mesh.origin(g) == mesh.origin(h)) return edge_error(mesh, input, ErrorCode::overlap, {g, h}, 2);
  }
  return std::nullopt;
}

std::string why_flat(const NamedInput& input, const std::array<std::int32_t, 3>& c) {
  const auto name = [&](std::int32_t i) { return input.names.point(static_cast<std::size_t>(i)); };
  if (c[0] == c[1] || c[0] == c[2]) return "it uses " + name(c[0]) + " more than once";
  if (c[1] == c[2]) return "it uses " + name(c[1]) + " more than once";
  return "its corners " + name(c[0]) + ", " + name(c[1]) + " and " + name(c[2]) +
         (input.on_sphere() ? " are on one great circle" : " are collinear");
}

VertexId id_of(std::int32_t i) { return VertexId(static_cast<std::size_t>(i)); }

}  // namespace

std::optional<InputError> constrain_edges(Mesh& mesh, const NamedInput& input) {
  for (const auto& [a, b] : input.in.constrained_edges) {
    for (const std::int32_t i : {a, b}) {
      if (!input.is_point(i)) {
        return InputError{ErrorCode::index_out_of_range,
                          {},
                          "a constrained edge uses point index " + std::to_string(i) + ", but there are " +
                              quantity(input.n_points(), "points")};
      }
    }
    HalfedgeId h = mesh.find_halfedge(id_of(a), id_of(b));
    if (!h.valid()) h = mesh.find_halfedge(id_of(b), id_of(a));
    if (!h.valid()) {
      return input.point_error(ErrorCode::missing_edge, static_cast<std::size_t>(a),
                               "the constrained edge from " + input.names.point(static_cast<std::size_t>(a)) + " to " +
                                   input.names.point(static_cast<std::size_t>(b)) + " is no edge of the mesh");
    }
    mesh.set_constrained(h, true);
  }
  if (input.in.regions.empty()) return std::nullopt;
  for (const HalfedgeId h : mesh.halfedges()) {
    const HalfedgeId other = mesh.twin(h);
    if (other.valid() && mesh.region(Mesh::triangle(h)) != mesh.region(Mesh::triangle(other))) {
      mesh.set_constrained(h, true);
    }
  }
  return std::nullopt;
}

std::optional<InputError> fix_vertices(Mesh& mesh, const NamedInput& input) {
  for (const std::int32_t i : input.in.fixed_vertices) {
    if (!input.is_point(i)) {
      return InputError{
          ErrorCode::index_out_of_range,
          {},
          "a fixed vertex has index " + std::to_string(i) + ", but there are " + quantity(input.n_points(), "points")};
    }
    mesh.set_fixed(id_of(i), true);
  }
  return std::nullopt;
}

/// The steps of Mesh::build, in order. Each returns an error or nothing.
class MeshBuilder {
 public:
  MeshBuilder(const MeshInput& input, const std::function<bool()>& stop)
      : in_(input),
        input_(input),
        names_(input_.names),
        stoppable_(input.executor, stop),
        executor_(stop ? &stoppable_ : input.executor) {}

  Expected<BuiltMesh> build() {
    using Step = std::optional<InputError> (MeshBuilder::*)();
    constexpr Step kSteps[] = {&MeshBuilder::check_sizes,     &MeshBuilder::add_vertices, &MeshBuilder::settle_scale,
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
  std::optional<InputError> check_sizes() { return temper::check_sizes(input_); }

  std::optional<InputError> add_vertices() {
    mesh_.space_ = in_.space;
    mesh_.vertices_.resize(input_.n_points());
    const auto wrong = first_index(input_.n_points(), executor_, [&](std::size_t i) {
      const double w = input_.weight(i);
      if (!is_finite(input_.place(i)) || !std::isfinite(w)) return true;
      mesh_.set_point(VertexId(i), input_.on_sphere() ? mesh_.space_.vertex_at(in_.sphere_points[i], w)
                                                      : WeightedPoint{in_.points[i].x, in_.points[i].y, w});
      return false;
    });
    if (!wrong) return std::nullopt;
    const std::size_t i = *wrong;
    if (!is_finite(input_.place(i))) {
      return input_.point_error(
          ErrorCode::not_finite, i,
          names_.point(i) + " has coordinates " + input_.place_text(i) + ", expected finite numbers");
    }
    return input_.point_error(
        ErrorCode::not_finite, i,
        names_.point(i) + " has weight " + to_text(in_.weights[i]) + ", expected a finite number");
  }

  /// Checks the scale. Then rounds zeros of the sphere, and moves points into the domain of a periodic plane.
  std::optional<InputError> settle_scale() {
    if (auto error = check_scale(input_)) return error;
    if (input_.on_sphere()) {
      // Rounded zeros of a longitude or latitude would cost exact arithmetic too many bits.
      const double least = kSmallestCoordinate * in_.space.radius();
      for (const VertexId v : mesh_.vertices()) {
        WeightedPoint p = mesh_.point(v);
        for (double* x : {&p.x, &p.y, &p.w}) *x = std::abs(*x) < least ? 0 : *x;
        mesh_.set_point(v, p);
      }
    } else if (in_.space.is_periodic()) {
      for (const VertexId v : mesh_.vertices()) mesh_.set_point(v, in_.space.in_domain(mesh_.point(v)));
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
      if (!input_.is_point(i)) return false;
    }
    const Sign sign = inlined::orientation(mesh_, id(corners[0]), id(corners[1]), id(corners[2]));
    if (sign == Sign::negative) std::swap(corners[1], corners[2]);
    for (std::size_t k = 0; k < 3; ++k) mesh_.corners_[HalfedgeId(3 * t + k)] = id(corners[k]);
    return sign != Sign::zero;
  }

  InputError wrong_triangle(std::size_t t) const {
    for (const std::int32_t i : in_.triangles[t]) {
      if (input_.is_point(i)) continue;
      return input_.triangle_error(ErrorCode::index_out_of_range, t,
                                   names_.triangle(t) + " uses point index " + std::to_string(i) + ", but there are " +
                                       quantity(input_.n_points(), "points"));
    }
    if (const std::string wide = why_wide(in_.triangles[t]); !wide.empty()) {
      return input_.triangle_error(ErrorCode::overlap, t, names_.triangle(t) + wide);
    }
    return input_.triangle_error(ErrorCode::zero_area, t,
                                 names_.triangle(t) + " has zero area: " + why_flat(input_, in_.triangles[t]));
  }

  std::optional<InputError> check_unused() {
    for (const HalfedgeId h : mesh_.halfedges()) MeshEditor(mesh_).set_outgoing(mesh_.origin(h), h);
    for (const VertexId v : mesh_.vertices()) {
      if (!mesh_.outgoing(v).valid()) {
        return input_.point_error(ErrorCode::unused_point, v.index, names_.point(v.index) + " belongs to no triangle");
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
    auto duplicate = find_duplicate(input_);
    return duplicate ? std::move(duplicate) : std::move(error);
  }

  /// Halfedges by their lesser vertex, matched within each small bucket.
  std::optional<InputError> link_twins() {
    std::optional<InputError> wrong;
    for (std::size_t i = 0; i < EdgeBuckets::kSlices && !wrong; ++i) wrong = link_twins(EdgeBuckets::slice(mesh_, i));
    return wrong;
  }
  std::optional<InputError> link_twins(IdRange<VertexId> lesser) {
    const EdgeBuckets buckets(mesh_, lesser);
    const std::size_t first = (*lesser.begin()).index;
    const auto wrong = first_index_by(lesser.size(), executor_, [&] {
      return [&, sides = Sides()](std::size_t i) mutable {
        buckets.collect(VertexId(first + i), sides);
        return !match(sides);
      };
    });
    if (!wrong) return std::nullopt;
    Sides sides;
    buckets.collect(VertexId(first + *wrong), sides);
    return wrong_edge(mesh_, input_, sides);
  }

  /// Links the edges of a lesser vertex. False when one has more than two sides, or two equal ones.
  bool match(const Sides& sides) {
    if (wrong_edge(mesh_, input_, sides)) return false;
    for (std::size_t i = 0; i < sides.size();) {
      const bool pair = i + 1 < sides.size() && sides[i].greater == sides[i + 1].greater;
      MeshEditor(mesh_).link(sides[i].halfedge, pair ? sides[i + 1].halfedge : HalfedgeId());
      i += pair ? 2 : 1;
    }
    return true;
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
        return input_.point_error(ErrorCode::non_manifold_vertex, v.index, message);
      }
    }
    return std::nullopt;
  }

  std::optional<InputError> check_embedding() {
    const auto overlap = find_overlap(mesh_, names_, executor_);
    if (!overlap) return std::nullopt;
    return input_.triangle_error(ErrorCode::overlap, overlap->triangle.index, overlap->message);
  }

  std::optional<InputError> constrain_edges() { return temper::constrain_edges(mesh_, input_); }
  std::optional<InputError> fix_vertices() { return temper::fix_vertices(mesh_, input_); }

  static VertexId id(std::int32_t i) { return VertexId(static_cast<std::size_t>(i)); }

  /// A message on the width of a triangle in the periodic plane; empty if it is narrow enough.
  std::string why_wide(const std::array<std::int32_t, 3>& c) const {
    const auto [p, q, r] = mesh_.points(id(c[0]), id(c[1]), id(c[2]));
    if (in_.space.are_near(p, q) && in_.space.are_near(q, r) && in_.space.are_near(r, p)) return {};
    const auto name = [&](std::int32_t i) { return names_.point(static_cast<std::size_t>(i)); };
    return " does not fit into half a period: expected the shortest ways between its corners " + name(c[0]) + ", " +
           name(c[1]) + " and " + name(c[2]) + " to be its edges; more points around the period make that so";
  }

  const MeshInput& in_;
  NamedInput input_;
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
