#include "experiments/dense_runs.hpp"

#include <algorithm>
#include <cmath>

#include "experiments/closeness.hpp"
#include "experiments/domain.hpp"
#include "experiments/energies.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/energy.hpp"

namespace temper::gallery {

OptimizeOptions dense_options(std::string_view energy, const VertexOrder& order) {
  OptimizeOptions o = *options_for("paper");
  o.energy = find_energy(energy)->kind;
  if (energy_info(o.energy).barrier) o.paper.inversion = Inversion::refuse;
  o.paper.h0 = shift_beyond(dense_horseshoe());
  o.paper.removal = Removal::none;
  o.paper.collapse_from.reset();
  o.paper.outer = 1;
  visit_in(order, o);
  return o;
}

OptimizeOptions dense_positions(std::string_view energy, const VertexOrder& order) {
  OptimizeOptions o = dense_options(energy, order);
  o.unknowns = Unknowns::positions;
  o.paper.inversion = Inversion::refuse;
  return o;
}

const Moment& before_flips(const Recording& recording) {
  const auto found = recording.all(Snapshot::Moment::before_flips);
  return found.empty() ? recording.moments.back() : *found.back();
}

double dense_energy(const Mesh& mesh, std::string_view energy) {
  return total_energy(mesh, model_of(energy, dense_horseshoe()));
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
    const Vec2 center = orthocenter_of(mesh, t);
    if (is_in_domain(mesh, center)) continue;
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
