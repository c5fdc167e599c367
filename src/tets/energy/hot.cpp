#include "tets/energy/hot.hpp"

#include "base/sum.hpp"
#include "tets/energy/sloped.hpp"

namespace temper::tets {

HotFace::HotFace(const WeightedPoint& q, const WeightedPoint& r, const WeightedPoint& s)
    : link(link_face<double>(q, r, s)), weight{q.w, r.w, s.w}, length2(dot(link.normal, link.normal)) {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& e = link.edges[i];
    const double dw = weight[i] - weight[(i + 1) % 3];
    lambda[i] = 0.25 * e.length2 + 0.75 * dw * dw / e.length2;
    along[i] = 0.5 * (e.length2 + dw);
    kites += lambda[i] * dot(link.normal, e.plane);
  }
  to_center = link.center - 0.25 * (link.edges[1].from + link.edges[2].from);
}

void HotStar::gather(const TetMesh& mesh, std::span<const HalffaceId> link) {
  faces_.clear();
  for (const HalffaceId h : link) {
    const auto [q, r, s] = mesh.vertices(h);
    faces_.emplace_back(mesh.point(q), mesh.point(r), mesh.point(s));
  }
}

double HotStar::value(const HotEnergy& energy, const WeightedPoint& p) const {
  double sum = 0;
  for (const HotFace& face : faces_)
    sum += hot_energy(energy, face, Vector<double>{p.x, p.y, p.z} - face.link.origin, p.w);
  return sum;
}

PointDerivatives<double> HotStar::derivatives(const HotEnergy& energy, const WeightedPoint& p) const {
  using Number = SlopedOf<Sloped>;
  const auto unknown = [](double x, std::size_t i) { return Number(Sloped(x, i), i); };
  const Number w = unknown(p.w, 3);
  Number sum;
  for (const HotFace& face : faces_) {
    const Vector<double> u = Vector<double>{p.x, p.y, p.z} - face.link.origin;
    sum = sum + hot_energy<Number>(energy, face, {unknown(u.x, 0), unknown(u.y, 1), unknown(u.z, 2)}, w);
  }
  const auto& [x, y, z, by_w] = sum.slope;
  return {sum.value.value,
          sum.value.gradient(),
          {x.slope[0], x.slope[1], x.slope[2], x.slope[3], y.slope[1], y.slope[2], y.slope[3], z.slope[2], z.slope[3],
           by_w.slope[3]}};
}

double hot_energy(const TetMesh& mesh, const HotEnergy& energy, Executor* executor) {
  return blockwise_sum(mesh.n_tetrahedra(), executor, [&](std::size_t i) {
    const auto [p, q, r, s] = mesh.points(TetId(i));
    const HotFace face(q, s, r);
    return hot_energy(energy, face, Vector<double>{p.x, p.y, p.z} - face.link.origin, p.w);
  });
}

}  // namespace temper::tets
