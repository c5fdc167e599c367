// SurfaceMesh::build: from arrays to a mesh, or to the first error in them.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/sort_unique.hpp"
#include "base/text.hpp"
#include "mesh/exact_range.hpp"
#include "mesh/input_check.hpp"
#include "mesh/mesh_editor.hpp"
#include "mesh/shared_steps.hpp"
#include "mesh/twins.hpp"
#include "temper/surfaces.hpp"

namespace temper::surfaces {
namespace {

constexpr ExactRange kCoordinates = kCoordinatesInSpace, kWeights = kCoordinates.squared();

using Sides = std::vector<EdgeBuckets::Side>;

/// The same arrays for the checks of meshes. The points are in space, which is what a sphere of any radius says there.
MeshInput as_mesh_input(const SurfaceInput& in) {
  MeshInput input;
  input.sphere_points = in.points;
  input.weights = in.weights;
  input.triangles = in.triangles;
  input.constrained_edges = in.constrained_edges;
  input.regions = in.regions;
  input.fixed_vertices = in.fixed_vertices;
  input.names = in.names;
  input.space = Space::sphere(1);
  return input;
}

VertexId id(std::int32_t i) { return VertexId(static_cast<std::size_t>(i)); }

}  // namespace

/// The steps of SurfaceMesh::build, in order. Each returns an error or nothing.
class SurfaceBuilder {
 public:
  explicit SurfaceBuilder(const SurfaceInput& input)
      : in_(as_mesh_input(input)), input_(in_), names_(input_.names), mesh_(result_.mesh.mesh_) {}

  Expected<BuiltSurface> build() {
    using Step = std::optional<InputError> (SurfaceBuilder::*)();
    constexpr Step kSteps[] = {&SurfaceBuilder::check_sizes,  &SurfaceBuilder::add_vertices,
                               &SurfaceBuilder::add_corners,  &SurfaceBuilder::check_unused,
                               &SurfaceBuilder::find_sides,   &SurfaceBuilder::orient,
                               &SurfaceBuilder::check_stars,  &SurfaceBuilder::constrain_edges,
                               &SurfaceBuilder::fix_vertices, &SurfaceBuilder::count_coincident};
    for (const Step step : kSteps) {
      if (auto error = (this->*step)()) return *std::move(error);
    }
    return std::move(result_);
  }

 private:
  std::optional<InputError> check_sizes() {
    if (auto error = temper::check_sizes(input_)) return error;
    mesh_ = MeshEditor::blank(Space(), input_.n_points(), in_.triangles.size());
    result_.mesh.z_.resize(input_.n_points());
    return std::nullopt;
  }

  std::optional<InputError> add_vertices() {
    for (std::size_t i = 0; i < input_.n_points(); ++i) {
      const Vec3 p = input_.place(i);
      const double w = input_.weight(i);
      const auto at = [&] { return names_.point(i) + " has coordinates " + input_.place_text(i); };
      const auto weight = [&] { return names_.point(i) + " has weight " + to_text(w); };
      if (!is_finite(p)) return input_.point_error(ErrorCode::not_finite, i, at() + ", expected finite numbers");
      if (!kCoordinates.allows(p.x) || !kCoordinates.allows(p.y) || !kCoordinates.allows(p.z))
        return input_.point_error(ErrorCode::out_of_scale, i, at() + "; " + kCoordinates.text());
      if (!std::isfinite(w))
        return input_.point_error(ErrorCode::not_finite, i, weight() + ", expected a finite number");
      if (!kWeights.allows(w)) return input_.point_error(ErrorCode::out_of_scale, i, weight() + "; " + kWeights.text());
      mesh_.set_point(VertexId(i), {p.x, p.y, w});
      result_.mesh.z_[VertexId(i)] = p.z;
    }
    return std::nullopt;
  }

  std::optional<InputError> add_corners() {
    for (std::size_t t = 0; t < in_.triangles.size(); ++t) {
      const auto& corners = in_.triangles[t];
      for (const std::int32_t i : corners) {
        if (input_.is_point(i)) continue;
        return input_.triangle_error(ErrorCode::index_out_of_range, t,
                                     names_.triangle(t) + " uses point index " + std::to_string(i) +
                                         ", but there are " + quantity(input_.n_points(), "points"));
      }
      for (std::size_t k = 0; k < 3; ++k) MeshEditor(mesh_).set_corner(HalfedgeId(3 * t + k), id(corners[k]));
      const auto [a, b, c] = corners;
      const SurfaceMesh& surface = result_.mesh;
      if (!is_flat(surface.position(id(a)), surface.position(id(b)), surface.position(id(c)))) continue;
      const auto name = [&](std::int32_t i) { return names_.point(static_cast<std::size_t>(i)); };
      return input_.triangle_error(ErrorCode::zero_area, t,
                                   names_.triangle(t) + " has zero area: its corners " + name(a) + ", " + name(b) +
                                       " and " + name(c) + " are collinear");
    }
    for (std::size_t t = 0; t < in_.regions.size(); ++t) mesh_.set_region(TriangleId(t), in_.regions[t]);
    return std::nullopt;
  }

  std::optional<InputError> check_unused() {
    std::vector<std::uint8_t> used(mesh_.n_vertices(), 0);
    for (const HalfedgeId h : mesh_.halfedges()) used[mesh_.origin(h).index] = 1;
    const auto unused = std::find(used.begin(), used.end(), 0);
    if (unused == used.end()) return std::nullopt;
    const auto i = static_cast<std::size_t>(unused - used.begin());
    return input_.point_error(ErrorCode::unused_point, i, names_.point(i) + " belongs to no triangle");
  }

  [[nodiscard]] std::string edge_name(HalfedgeId h) const {
    return "the edge from " + names_.point(mesh_.origin(h).index) + " to " + names_.point(mesh_.target(h).index);
  }

  /// Pairs the sides of each edge, whatever their directions.
  std::optional<InputError> find_sides() {
    across_.assign(mesh_.n_halfedges(), HalfedgeId());
    const EdgeBuckets buckets(mesh_, mesh_.vertices());
    Sides sides;
    for (const VertexId v : mesh_.vertices()) {
      buckets.collect(v, sides);
      for (std::size_t i = 0, j = 0; i < sides.size(); i = j) {
        while (j < sides.size() && sides[j].greater == sides[i].greater) ++j;
        const HalfedgeId g = sides[i].halfedge, h = sides[j - 1].halfedge;
        if (j - i > 2) {
          const std::size_t s = Mesh::triangle(g).index, t = Mesh::triangle(h).index;
          return input_.triangle_error(ErrorCode::non_manifold_edge, t,
                                       edge_name(g) + " belongs to " + std::to_string(j - i) + " triangles (" +
                                           names_.triangle(s) + " and " + names_.triangle(t) +
                                           " among them); expected at most 2. Next: give a sheet of the surface its "
                                           "own copies of the two points");
        }
        if (j - i == 2) across_[g] = h, across_[h] = g;
      }
    }
    return std::nullopt;
  }

  /// Gives the triangles of each component the orientation of most of them.
  std::optional<InputError> orient() {
    enum : std::uint8_t { kUnseen, kKept, kReversed };
    IdVector<TriangleId, std::uint8_t> state(mesh_.n_triangles(), kUnseen);
    for (const TriangleId start : mesh_.triangles()) {
      if (state[start] != kUnseen) continue;
      ++result_.components;
      std::vector<TriangleId> component = {start};
      state[start] = kKept;
      for (std::size_t i = 0; i < component.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
          const HalfedgeId h = Mesh::halfedge(component[i], k), other = across_[h];
          if (!other.valid()) continue;
          const bool fits = mesh_.origin(h) == mesh_.target(other), is_kept = state[component[i]] == kKept;
          const std::uint8_t wanted = fits == is_kept ? kKept : kReversed;
          const TriangleId t = Mesh::triangle(other);
          if (state[t] == kUnseen) {
            state[t] = wanted;
            component.push_back(t);
          } else if (state[t] != wanted) {
            return input_.triangle_error(
                ErrorCode::unsupported, t.index,
                "the surface has no orientation, like a Möbius strip: " + names_.triangle(t.index) + " and " +
                    names_.triangle(component[i].index) + " disagree at " + edge_name(h) +
                    "; expected a surface with two sides. Next: cut it along an edge loop");
          }
        }
      }
      reverse(component, state, kReversed);
    }
    find_twins(mesh_, nullptr);
    MeshEditor(mesh_).repair_outgoing();
    return std::nullopt;
  }

  /// Reverses the smaller part of a component.
  void reverse(const std::vector<TriangleId>& component, const IdVector<TriangleId, std::uint8_t>& state,
               std::uint8_t reversed) {
    const auto is_reversed = [&](TriangleId t) { return state[t] == reversed; };
    const auto n = static_cast<std::size_t>(std::count_if(component.begin(), component.end(), is_reversed));
    const bool others = 2 * n > component.size();
    result_.reversed_triangles += others ? component.size() - n : n;
    for (const TriangleId t : component) {
      if (is_reversed(t) == others) continue;
      const auto [a, b, c] = mesh_.corners(t);
      MeshEditor(mesh_).set_corner(Mesh::halfedge(t, 1), c);
      MeshEditor(mesh_).set_corner(Mesh::halfedge(t, 2), b);
    }
  }

  std::optional<InputError> check_stars() {
    std::vector<std::uint32_t> missing(mesh_.n_vertices(), 0);
    for (const HalfedgeId h : mesh_.halfedges()) ++missing[mesh_.origin(h).index];
    for (const VertexId v : mesh_.vertices()) {
      for ([[maybe_unused]] const HalfedgeId h : mesh_.star(v)) --missing[v.index];
      if (missing[v.index] == 0) continue;
      return input_.point_error(
          ErrorCode::non_manifold_vertex, v.index,
          "the surface touches itself at " + names_.point(v.index) +
              ": its triangles are not one fan around it. Next: give each fan its own copy of the point");
    }
    return std::nullopt;
  }

  std::optional<InputError> constrain_edges() { return temper::constrain_edges(mesh_, input_); }
  std::optional<InputError> fix_vertices() { return temper::fix_vertices(mesh_, input_); }

  std::optional<InputError> count_coincident() {
    std::vector<std::array<double, 3>> places;
    for (const Vec3 p : in_.sphere_points) places.push_back({p.x, p.y, p.z});
    const std::size_t n = places.size();
    sort_unique(places);
    result_.coincident_points = n - places.size();
    return std::nullopt;
  }

  MeshInput in_;
  NamedInput input_;
  const InputNames& names_;
  BuiltSurface result_;
  Mesh& mesh_;
  IdVector<HalfedgeId, HalfedgeId> across_;  ///< The other side of each edge
};

Expected<BuiltSurface> SurfaceMesh::build(const SurfaceInput& input) { return SurfaceBuilder(input).build(); }

}  // namespace temper::surfaces
