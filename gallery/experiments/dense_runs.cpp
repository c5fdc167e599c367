#include "experiments/dense_runs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/closeness.hpp"
#include "experiments/sparse_runs.hpp"
#include "temper/energy.hpp"
#include "temper/generate.hpp"
#include "temper/geometry.hpp"

namespace temper::gallery {
namespace {

bool contains(const Mesh& mesh, Vec2 p) {
  const auto triangles = mesh.triangles();
  return std::any_of(triangles.begin(), triangles.end(), [&](TriangleId t) {
    const auto v = mesh.corners(t);
    for (std::size_t i = 0; i < 3; ++i) {
      if (orient2d(mesh.position(v[i]), mesh.position(v[(i + 1) % 3]), p) == Sign::negative) return false;
    }
    return true;
  });
}

double distance_to_boundary(const Mesh& mesh, Vec2 p) {
  double least = std::numeric_limits<double>::infinity();
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_boundary(h)) continue;
    const Vec2 a = mesh.position(mesh.origin(h)), along = mesh.position(mesh.target(h)) - a;
    const double t = std::clamp(dot(p - a, along) / squared_length(along), 0.0, 1.0);
    least = std::min(least, length(p - (a + t * along)));
  }
  return least;
}

}  // namespace

const Mesh& dense_horseshoe() {
  static const Mesh mesh = [] {
    auto made = horseshoe();
    return made ? *std::move(made) : Mesh();
  }();
  return mesh;
}

OptimizeOptions dense_options(std::string_view energy, const VertexOrder& order) {
  OptimizeOptions o = paper_method();
  o.energy = energy;
  o.h0 = shift_beyond(dense_horseshoe());
  o.removal = Removal::none;
  o.collapse_from.reset();
  o.outer = 1;
  o.order = order.order;
  o.seed = order.seed;
  return o;
}

OptimizeOptions dense_positions(std::string_view energy, const VertexOrder& order) {
  OptimizeOptions o = dense_options(energy, order);
  o.unknowns = Unknowns::positions;
  o.inversion = Inversion::refuse;
  return o;
}

const Moment& before_flips(const Recording& recording) {
  const auto found = recording.all(Snapshot::Moment::before_flips);
  return found.empty() ? recording.moments.back() : *found.back();
}

double dense_energy(const Mesh& mesh, std::string_view energy) {
  EnergyModel model;
  if (const auto info = find_energy(energy)) model.kind = info->kind, model.boundary = info->boundary;
  model.gamma = {kPaperGamma, LengthScale::absolute};
  model.h0 = shift_beyond(dense_horseshoe());
  return total_energy(mesh, model);
}

std::string dense_picture(const Mesh& mesh, const std::string& title, const std::string& footer, double weight_scale,
                          double width) {
  MeshPicture picture;
  picture.title = title;
  picture.footer = footer;
  picture.box = {{-2.4, -0.4}, {2.4, 4.4}};
  picture.width = width;
  picture.weight_scale = weight_scale;
  picture.marks = closeness_marks(mesh);
  return mesh_picture_svg(mesh, picture);
}

Difference difference(const Mesh& a, const Mesh& b) {
  Difference d;
  double sum = 0, interior = 0;
  for (const VertexId v : a.vertices()) {
    const double moved = length(a.position(v) - b.position(v));
    d.largest_move = std::max(d.largest_move, moved);
    d.largest_weight = std::max(d.largest_weight, std::abs(a.weight(v) - b.weight(v)));
    if (a.is_boundary(v)) continue;
    sum += moved;
    interior += 1;
  }
  d.mean_move = sum / interior;
  return d;
}

OutsideCenters centers_outside_domain(const Mesh& mesh) {
  OutsideCenters outside;
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    const Vec2 center = orthocenter(mesh.point(a), mesh.point(b), mesh.point(c));
    if (contains(mesh, center)) continue;
    ++outside.count;
    outside.distance += distance_to_boundary(mesh, center);
  }
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_boundary(h)) continue;
    const double height =
        signed_height(mesh.point(mesh.origin(h)), mesh.point(mesh.target(h)), mesh.point(mesh.opposite(h)));
    if (!(height < 0)) continue;
    ++outside.across;
    outside.across_distance -= height;
  }
  return outside;
}

}  // namespace temper::gallery
