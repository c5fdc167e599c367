// Incremental Delaunay triangulation of points around the sphere: the hull of all points.
//
// It begins with a tetrahedron of four helper points around the center. So the mesh is closed at all times, and every
// point is in a triangle, on an edge or at a vertex of it. The helpers are removed at the end, except those without
// which half of the sphere would be empty.
#include <algorithm>

#include "base/text.hpp"
#include "generate/triangulation.hpp"
#include "temper/generate.hpp"
#include "temper/topology.hpp"
#include "topology/locate.hpp"

namespace temper {
namespace {

constexpr std::size_t kHelpers = 4;

std::string place(Vec3 p) { return "(" + to_text(p.x) + ", " + to_text(p.y) + ", " + to_text(p.z) + ")"; }

class SphereInserter {
 public:
  SphereInserter(Mesh tetrahedron, std::size_t n_points) : result_{std::move(tetrahedron), {}, {}} {
    for (std::size_t k = 0; k < kHelpers; ++k) result_.number.push_back(static_cast<std::uint32_t>(n_points + k));
    result_.vertex.resize(n_points);
  }

  /// Inserts point i, or returns the vertex at its place.
  std::optional<VertexId> insert(std::uint32_t i, Vec3 p) {
    const Location at = locate(result_.mesh, as_point(p), last_);
    if (at.kind == Location::Kind::at_vertex) return vertex_at(at.triangle, p);
    const VertexId v = at.kind == Location::Kind::on_edge ? split_edge(result_.mesh, at.edge, as_point(p))
                                                          : insert_in_triangle(result_.mesh, at.triangle, as_point(p));
    result_.number.push_back(i);
    result_.vertex[i] = v;
    lawson_.clear();
    for (const HalfedgeId h : result_.mesh.star(v)) lawson_.push(Mesh::next(h));
    make_regular();
    last_ = Mesh::triangle(result_.mesh.outgoing(v));
    return std::nullopt;
  }

  /// Helpers that stay are numbered after the points.
  void remove_helpers() {
    for (std::size_t k = 0; k < kHelpers; ++k) {
      lawson_.clear();
      if (flip_spokes_away(VertexId(k))) {
        plan_ = plan_removal(result_.mesh, VertexId(k), std::move(plan_));
        if (plan_.status == RemovalStatus::possible) {
          remove_vertex(result_.mesh, plan_);
          lawson_.push_removal(result_.mesh, plan_);
        }
      }
      make_regular();
    }
    const Compaction kept = result_.mesh.compact();
    const std::vector<std::uint32_t> numbers = std::move(result_.number);
    const std::size_t n = result_.vertex.size();
    auto next = static_cast<std::uint32_t>(n);
    result_.number.clear();
    for (const VertexId v : result_.mesh.vertices()) {
      const std::uint32_t number = numbers[kept.vertices[v].index];
      result_.number.push_back(number < n ? number : next++);
      if (number < n) result_.vertex[number] = v;
    }
  }

  [[nodiscard]] std::uint32_t number(VertexId v) const { return result_.number[v.index]; }
  generate::Triangulation take() { return std::move(result_); }

 private:
  void make_regular() { lawson_.run(result_.mesh, IgnoreFlips(), Lawson::kNoCap, result_.conflict_test()); }

  /// A removal costs the cube of the number of spokes, and points that leave half of the sphere empty all face a
  /// helper. So many spokes are flipped away first; Lawson restores what stays. Returns false if no flip is possible,
  /// but there are still many: then the helper is needed.
  bool flip_spokes_away(VertexId v) {
    constexpr std::size_t kMany = 64;
    Mesh& mesh = result_.mesh;
    for (bool flipped = true; flipped;) {
      flipped = false;
      std::size_t n = 0;
      for ([[maybe_unused]] const HalfedgeId h : mesh.star(v)) ++n;
      if (n <= kMany) return true;
      HalfedgeId spoke = mesh.outgoing(v);
      for (std::size_t i = 0; i < n; ++i) {
        const HalfedgeId next = mesh.rotate(spoke);  // its triangle is not one of the quad
        if (can_flip(mesh, spoke) == FlipStatus::possible) {
          const HalfedgeId edge = flip(mesh, spoke), other = mesh.twin(edge);
          for (const HalfedgeId h : {edge, Mesh::next(edge), Mesh::prev(edge), Mesh::next(other), Mesh::prev(other)}) {
            lawson_.push(h);
          }
          flipped = true;
        }
        spoke = next;
      }
    }
    return false;
  }

  /// The corner of t that has the direction of p.
  [[nodiscard]] VertexId vertex_at(TriangleId t, Vec3 p) const {
    const auto corners = result_.mesh.corners(t);
    VertexId nearest = corners[0];
    const auto nearness = [&](VertexId v) {
      const Vec3 q = result_.mesh.weighted_vector(v);
      return dot(p, q) / length(q);
    };
    for (const VertexId v : corners) nearest = nearness(v) > nearness(nearest) ? v : nearest;
    return nearest;
  }

  generate::Triangulation result_;
  Lawson lawson_;
  RemovalPlan plan_;
  TriangleId last_{0};
};

/// Four directions around the center that no file has.
Expected<Mesh> helpers(double radius) {
  std::vector<Vec3> points;
  for (const Vec3 p :
       {Vec3{0.5772156649, 0.5641895835, 0.5907027563}, Vec3{-0.5641895835, -0.5907027563, 0.5772156649},
        Vec3{-0.5907027563, 0.5772156649, -0.5641895835}, Vec3{0.5641895835, -0.5772156649, -0.5907027563}}) {
    points.push_back(radius / length(p) * p);
  }
  const std::vector<std::array<std::int32_t, 3>> triangles = {{0, 1, 3}, {0, 2, 1}, {0, 3, 2}, {1, 2, 3}};
  MeshInput input;
  input.space = Space::sphere(radius);
  input.sphere_points = points;
  input.triangles = triangles;
  auto built = Mesh::build(input);
  if (!built) return built.error();
  return std::move(built->mesh);
}

}  // namespace

Expected<generate::Triangulation> generate::triangulate_sphere(std::span<const Vec3> points, double radius,
                                                               const std::function<bool()>& stop) {
  auto tetrahedron = helpers(radius);
  if (!tetrahedron) return tetrahedron.error();
  SphereInserter inserter(*std::move(tetrahedron), points.size());
  for (const std::uint32_t i : insertion_order(points)) {
    if (stop && stop()) return stopped_error();
    if (const auto there = inserter.insert(i, points[i])) {
      const auto [low, high] = std::minmax({inserter.number(*there), i});
      return InputError{ErrorCode::duplicate_point, "",
                        "points " + std::to_string(low) + " and " + std::to_string(high) +
                            " are both in the direction " + place(points[i])};
    }
  }
  inserter.remove_helpers();
  return inserter.take();
}

Expected<Mesh> spherical_delaunay(std::span<const Vec3> points, double radius) {
  std::vector<Vec3> places;
  places.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double distance = length(points[i]);
    if (!(distance > 0) || !std::isfinite(distance)) {
      return InputError{
          ErrorCode::not_on_sphere, "",
          "point " + std::to_string(i) + " at " + place(points[i]) + " has no direction from the center of the sphere"};
    }
    places.push_back(radius / distance * points[i]);
  }
  auto triangulation = generate::triangulate_sphere(places, radius);
  if (!triangulation) return triangulation.error();
  if (triangulation->number.size() > points.size()) {
    return InputError{ErrorCode::zero_area, "",
                      "the points leave half of the sphere empty; expected them all around it"};
  }
  return generate::in_input_order(*std::move(triangulation));
}

}  // namespace temper
