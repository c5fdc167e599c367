#include <array>
#include <atomic>
#include <cmath>
#include <string>
#include <utility>

#include "base/assert.hpp"
#include "base/text.hpp"
#include "geometry/predicates_inline.hpp"
#include "mesh/blocks.hpp"
#include "mesh/erased.hpp"
#include "size/box_tree.hpp"
#include "temper/size.hpp"

namespace temper {
namespace {

// Triangles that a walk may cross before the tree is asked: a vertex step crosses one or two, and a walk that circles
// (in meshes that are not Delaunay some do) must end.
constexpr int kLongestWalk = 32;

/// Walks towards p, to the triangle that has it; invalid when the walk leaves the mesh.
TriangleId walk(const Mesh& mesh, Vec2 p, TriangleId from) {
  TriangleId t = from;
  HalfedgeId entered;
  for (int steps = 0; steps < kLongestWalk; ++steps) {
    HalfedgeId exit;
    for (int k = 0; k < 3 && !exit.valid(); ++k) {
      const HalfedgeId h = Mesh::halfedge(t, k);
      if (h == entered) continue;  // p is on this side of it
      const Vec2 a = mesh.position(mesh.origin(h)), b = mesh.position(mesh.target(h));
      if (inlined::orient2d(a, b, p) == Sign::negative) exit = h;
    }
    if (!exit.valid()) return t;
    entered = mesh.twin(exit);
    if (!entered.valid()) return {};  // the domain need not be convex: p may be inside all the same
    t = Mesh::triangle(entered);
  }
  return {};
}

}  // namespace

struct SizeField::Data {
  Mesh own;          // empty when the field looks at a mesh of the caller's
  const Mesh* mesh;  // own, or the caller's
  IdVector<VertexId, double> sizes;
  mutable std::atomic<const BoxTree*> made_tree = nullptr;

  Data(Mesh copy, IdVector<VertexId, double> values) : own(std::move(copy)), mesh(&own), sizes(std::move(values)) {}
  Data(const Mesh* seen, IdVector<VertexId, double> values) : mesh(seen), sizes(std::move(values)) {}
  Data(const Data&) = delete;
  Data& operator=(const Data&) = delete;
  ~Data() { delete made_tree.load(); }

  [[nodiscard]] const BoxTree& tree() const;

  [[nodiscard]] double on_edge(HalfedgeId h, double along) const;
  [[nodiscard]] double on_edge(HalfedgeId h, Vec2 p) const;
  [[nodiscard]] double inside(TriangleId t, Vec2 p) const;
};

/// Made when it is first asked: where every point has a good hint it never is, and it takes its time and memory.
/// Threads that ask at once make one each, all alike, and the first one stays.
const BoxTree& SizeField::Data::tree() const {
  const BoxTree* there = made_tree.load(std::memory_order_acquire);
  if (there != nullptr) return *there;
  const auto* mine = new BoxTree(*mesh);
  if (made_tree.compare_exchange_strong(there, mine, std::memory_order_acq_rel)) return *mine;
  delete mine;
  return *there;
}

double SizeField::Data::on_edge(HalfedgeId h, double along) const {
  const double a = sizes[mesh->origin(h)], b = sizes[mesh->target(h)];
  return along == 1 ? b : a + along * (b - a);
}

/// Both triangles of an edge must say the same of a point on it: its lower vertex comes first.
double SizeField::Data::on_edge(HalfedgeId h, Vec2 p) const {
  VertexId a = mesh->origin(h), b = mesh->target(h);
  if (b < a) std::swap(a, b);
  const Vec2 ab = mesh->position(b) - mesh->position(a);
  const double along = dot(p - mesh->position(a), ab) / squared_length(ab);
  return sizes[a] + along * (sizes[b] - sizes[a]);
}

/// Linear between the corners; p is in t or on its boundary.
double SizeField::Data::inside(TriangleId t, Vec2 p) const {
  for (const VertexId v : mesh->corners(t)) {
    if (p == mesh->position(v)) return sizes[v];
  }
  std::array<double, 3> part;  // of corner k + 2: the area across from it
  double value = 0, area = 0;
  for (int k = 0; k < 3; ++k) {
    const HalfedgeId h = Mesh::halfedge(t, k);
    const Vec2 a = mesh->position(mesh->origin(h)), b = mesh->position(mesh->target(h));
    part[static_cast<std::size_t>(k)] = cross(a - p, b - p);
    // Far more than rounding makes of a zero: what is not this near needs no exact test.
    const bool near_edge = std::abs(cross(a - p, b - p)) <= 0x1p-40 * squared_length(b - a);
    if (near_edge && inlined::orient2d(a, b, p) == Sign::zero) return on_edge(h, p);
    value += part[static_cast<std::size_t>(k)] * sizes[mesh->opposite(h)];
    area += part[static_cast<std::size_t>(k)];
  }
  return value / area;
}

Expected<SizeField> SizeField::from_values(const Mesh& mesh, std::span<const double> sizes, const InputNames* names) {
  const InputNames numbers_from_0;
  const InputNames& say = names != nullptr ? *names : numbers_from_0;
  if (sizes.size() != mesh.n_vertices()) {
    return InputError{ErrorCode::size_mismatch,
                      {},
                      "the size field has " + std::to_string(sizes.size()) + " sizes; expected one for each of the " +
                          std::to_string(mesh.n_vertices()) + " vertices"};
  }
  IdVector<VertexId, double> values(mesh.n_vertices());
  for (const VertexId v : mesh.vertices()) {
    const double size = sizes[v.index];
    if (!(size > 0) || !std::isfinite(size)) {
      return InputError{std::isfinite(size) ? ErrorCode::invalid_option : ErrorCode::not_finite,
                        say.point_where(v.index),
                        say.point(v.index) + " has size " + to_text(size) + "; expected a finite, positive length"};
    }
    values[v] = size;
  }
  return SizeField(std::make_shared<const Data>(mesh, std::move(values)));
}

SizeField::Sample SizeField::at(Vec2 p, TriangleId hint) const {
  const Mesh& mesh = *data_->mesh;
  if (hint.valid()) {
    const TriangleId t = walk(mesh, p, hint);
    if (t.valid()) return {data_->inside(t, p), t, false};
  }
  const NearestPoint found = data_->tree().nearest(mesh, p);
  if (found.distance2 == 0) return {data_->inside(found.triangle, p), found.triangle, false};
  return {data_->on_edge(found.edge, found.along), found.triangle, true};
}

const Mesh& SizeField::mesh() const { return *data_->mesh; }
double SizeField::at(VertexId v) const { return data_->sizes[v]; }

namespace {

IdVector<VertexId, double> local_sizes(const Mesh& mesh, Executor* executor) {
  TEMPER_ASSERT_SLOW(!has_erased_triangles(mesh));
  IdVector<VertexId, double> sizes(mesh.n_vertices());
  for_each_index(mesh.n_vertices(), executor,
                 [&](std::size_t i) { sizes[VertexId(i)] = local_size(mesh, VertexId(i)); });
  return sizes;
}

}  // namespace

SizeField input_size_field(const Mesh& mesh) {
  return SizeField(std::make_shared<const SizeField::Data>(mesh, local_sizes(mesh, nullptr)));
}

SizeField input_size_field_of(const Mesh& mesh, Executor* executor) {
  return SizeField(std::make_shared<const SizeField::Data>(&mesh, local_sizes(mesh, executor)));
}

}  // namespace temper
