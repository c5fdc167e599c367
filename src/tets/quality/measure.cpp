#include "tets/quality/measure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/loops.hpp"
#include "quality/measure.hpp"
#include "tets/geometry/formulas.hpp"
#include "tets/mesh/tables.hpp"

namespace temper::tets {

bool TetMeasure::orthocenter_inside() const {
  return std::all_of(h_sign.begin(), h_sign.end(), [](Sign s) { return s == Sign::positive; });
}

double TetMeasure::margin() const { return *std::min_element(h_over_l.begin(), h_over_l.end()); }

FacePoints points_of(const TetMesh& mesh, HalffaceId h) {
  const auto [a, b, c] = mesh.vertices(h);
  return {mesh.point(a), mesh.point(b), mesh.point(c)};
}

double area(const FacePoints& face) {
  const auto [a, b, c] = face;
  return 0.5 * length(cross(b.position() - a.position(), c.position() - a.position()));
}

double length_of_area(double area) { return std::sqrt(4 / std::numbers::sqrt3 * area); }

double largest_dihedral_cosine(const TetMesh& mesh, TetId t) {
  const auto at = [&](VertexId v) {
    const Vec3 p = mesh.position(v);
    return Vector<double>{p.x, p.y, p.z};
  };
  const auto& [p, q, r, s] = mesh.corners(t);
  return largest_dihedral_cosine(at(p), at(q), at(r), at(s));
}

double largest_dihedral_cosine(const TetMesh& mesh, Executor* executor) {
  IdVector<TetId, double> of(mesh.n_tetrahedra());
  for_each_index(of.size(), executor, [&](std::size_t t) { of[TetId(t)] = largest_dihedral_cosine(mesh, TetId(t)); });
  return *std::max_element(of.begin(), of.end());
}

TetMeasure measure_tetrahedron(const std::array<WeightedPoint, 4>& p) {
  std::array<Vec3, 4> at;
  for (std::size_t k = 0; k < 4; ++k) at[k] = p[k].position();
  TetMeasure m;
  m.orientation = orientation(at[0], at[1], at[2], at[3]);
  m.volume = six_volumes(at[0], at[1], at[2], at[3]) / 6;
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [i, j, k, l] = kEdgeCorners[e];
    m.dihedral_deg[e] = 180 / std::numbers::pi *
                        dihedral_angle(at[std::size_t(i)], at[std::size_t(j)], at[std::size_t(k)], at[std::size_t(l)]);
  }
  m.h_sign.fill(Sign::negative);
  m.h.fill(-std::numeric_limits<double>::infinity());
  m.h_over_l = m.h;
  if (m.orientation != Sign::positive) return m;
  const Vec3 center = orthocenter(p[0], p[1], p[2], p[3]);
  for (std::size_t f = 0; f < 4; ++f) {
    const auto [i, j, k] = TetMesh::kFaceCorners[f];
    const auto &a = p[std::size_t(i)], &b = p[std::size_t(j)], &c = p[std::size_t(k)];
    const Vec3 normal = cross(b.position() - a.position(), c.position() - a.position());
    const double twice_area = length(normal);
    m.h_sign[f] = signed_height_sign(a, b, c, p[f]);
    m.h[f] = m.h_sign[f] == Sign::zero ? 0 : dot(normal, center - a.position()) / twice_area;
    m.h_over_l[f] = m.h[f] / length_of_area(twice_area / 2);
  }
  return m;
}

TetrahedronQuality tetrahedron_quality(const std::array<WeightedPoint, 4>& corners) {
  const TetMeasure m = measure_tetrahedron(corners);
  return {m.orthocenter_inside(), m.margin(), *std::min_element(m.dihedral_deg.begin(), m.dihedral_deg.end())};
}

bool is_crossed(const FacePoints& face) {
  const auto& [a, b, c] = face;
  return signed_height_sign(a, b, c) == Sign::positive && signed_height_sign(b, c, a) == Sign::positive &&
         signed_height_sign(c, a, b) == Sign::positive;
}

bool is_crossed(const WeightedPoint& p, const WeightedPoint& q) {
  return dual_crossing_sign(p, q) == Sign::positive && dual_crossing_sign(q, p) == Sign::positive;
}

bool has_all_crossed(const TetMesh& mesh, TetId t) {
  const std::array<WeightedPoint, 4> p = mesh.points(t);
  const bool edges = std::all_of(kEdgeCorners.begin(), kEdgeCorners.end(), [&](const auto& corners) {
    return is_crossed(p[std::size_t(corners[0])], p[std::size_t(corners[1])]);
  });
  if (!edges) return false;
  for (int f = 0; f < 4; ++f) {
    if (!is_crossed(points_of(mesh, TetMesh::halfface(t, f)))) return false;
  }
  return true;
}

namespace {

/// One tetrahedron, while the sentence about it is made.
struct Subject {
  const TetMesh& mesh;
  TetId t;
  TetMeasure m;

  [[nodiscard]] std::string number(int corner) const {
    return std::to_string(mesh.corners(t)[std::size_t(corner)].index);
  }
  [[nodiscard]] std::string face(std::size_t f) const {
    const auto [a, b, c] = TetMesh::kFaceCorners[f];
    const bool boundary = mesh.is_boundary(TetMesh::halfface(t, static_cast<int>(f)));
    return (boundary ? "boundary face " : "face ") + number(a) + "-" + number(b) + "-" + number(c);
  }
  [[nodiscard]] std::string edge(std::size_t e) const {
    return "edge " + number(kEdgeCorners[e][0]) + "-" + number(kEdgeCorners[e][1]);
  }
  [[nodiscard]] std::string largest_dihedral() const {
    const auto e = std::max_element(m.dihedral_deg.begin(), m.dihedral_deg.end()) - m.dihedral_deg.begin();
    return "dihedral angle of " + degrees(m.dihedral_deg[std::size_t(e)]) + " at " + edge(std::size_t(e));
  }
  [[nodiscard]] std::size_t least_face() const {
    return static_cast<std::size_t>(std::min_element(m.h_over_l.begin(), m.h_over_l.end()) - m.h_over_l.begin());
  }
};

std::string why_not_crossed(const Subject& s) {
  for (std::size_t f = 0; f < 4; ++f) {
    if (!is_crossed(points_of(s.mesh, TetMesh::halfface(s.t, static_cast<int>(f)))))
      return "; " + s.face(f) + " does not contain its orthocenter";
  }
  const auto p = s.mesh.points(s.t);
  for (std::size_t e = 0; e < 6; ++e) {
    if (!is_crossed(p[std::size_t(kEdgeCorners[e][0])], p[std::size_t(kEdgeCorners[e][1])]))
      return "; " + s.edge(e) + " is not crossed by its dual face";
  }
  return {};
}

std::string explain(const Subject& s, bool all_on_boundary) {
  if (s.m.orientation == Sign::negative) return "inverted: its volume is negative";
  if (s.m.orientation == Sign::zero) return "flat: its corners are in one plane";
  const std::size_t f = s.least_face();
  const std::string height = s.face(f) + ": h/ℓ = " + rounded(s.m.h_over_l[f]) + ", " + s.largest_dihedral();
  if (s.m.orthocenter_inside()) return "well-centered; least height over " + height + why_not_crossed(s);
  std::string why = (s.m.h_sign[f] == Sign::zero ? "orthocenter on " : "orthocenter outside across ") + height;
  if (all_on_boundary)
    why += "; all its corners are on the boundary, so only weights, flips and new vertices can change it";
  return why;
}

}  // namespace

WorstTet describe(const TetMesh& mesh, TetId t, const IdVector<VertexId, std::uint8_t>& on_boundary) {
  const Subject s{mesh, t, measure_tetrahedron(mesh.points(t))};
  WorstTet worst;
  worst.tetrahedron = t;
  worst.vertices = mesh.corners(t);
  for (const VertexId v : worst.vertices) worst.at = worst.at + 0.25 * mesh.position(v);
  worst.h_over_l = s.m.margin();
  worst.dihedral_deg = *std::max_element(s.m.dihedral_deg.begin(), s.m.dihedral_deg.end());
  worst.why = explain(
      s, std::all_of(worst.vertices.begin(), worst.vertices.end(), [&](VertexId v) { return on_boundary[v] != 0; }));
  return worst;
}

}  // namespace temper::tets
