// The operators: faces and edges in the order of their vertices, then everything that belongs to a face or a
// tetrahedron. ★1 and ★0 are sums over faces and edges.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/assert.hpp"
#include "base/median.hpp"
#include "dec/coefficient.hpp"
#include "temper/tets/operators.hpp"
#include "tets/dec/accurate.hpp"
#include "tets/dec/factors.hpp"
#include "tets/mesh/tables.hpp"

namespace temper::tets {
namespace {

using Triangle = std::array<WeightedPoint, 3>;

/// The edges of a face as rows of d1: the lower vertex, the higher one, the third, and the sign.
constexpr std::array<std::array<int, 4>, 3> kFaceEdges = {{{0, 1, 2, 1}, {0, 2, 1, -1}, {1, 2, 0, 1}}};

class DecBuilder {
 public:
  explicit DecBuilder(const TetMesh& mesh) : mesh_(mesh) {}
  DecComplex build();

 private:
  void tetrahedra();
  void edges();
  void faces();
  void add_face(const std::array<VertexId, 3>& vertices, std::span<const FaceBuckets::Side> sides);
  [[nodiscard]] double star2(const Triangle& face, double squared_area, const DecFace& f, const WeightedPoint& behind,
                             const WeightedPoint& ahead) const;
  void incidence();
  [[nodiscard]] EdgeId edge(VertexId from, VertexId to) const;

  const TetMesh& mesh_;
  IdVector<VertexId, std::size_t> first_edge_;  // of each lower vertex; one more at the end
  DecComplex c_;
};

/// Adds stars of edges and of vertices. `ratios` are (signed dual lengths of faces)/(areas): ★2, or those with a
/// coefficient. Let K = 4 k ℓ A; then k h / 2 / ℓ = K (h/A) / (8 ℓ²).
void add_stars(const TetMesh& mesh, const DecComplex& c, const IdVector<FaceId, double>& ratios,
               IdVector<EdgeId, double>& star1, IdVector<VertexId, double>& star0) {
  star1.assign(c.edges.size(), 0.0);
  star0.assign(mesh.n_vertices(), 0.0);
  for (std::size_t f = 0; f < c.faces.size(); ++f) {
    const auto& v = c.faces[FaceId(f)].vertices;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [i, j, other, sign] = kFaceEdges[k];
      const EdgeId e(static_cast<std::size_t>(c.d1.columns[3 * f + k]));
      const double numerator = accurate::height_numerator(mesh.point(v[std::size_t(i)]), mesh.point(v[std::size_t(j)]),
                                                          mesh.point(v[std::size_t(other)]));
      star1[e] += 0.125 * (numerator / c.edges[e].length) * ratios[FaceId(f)] / c.edges[e].length;
    }
  }
  for (std::size_t i = 0; i < c.edges.size(); ++i) {
    const DecEdge& edge = c.edges[EdgeId(i)];
    const double third = star1[EdgeId(i)] * edge.length / 3;
    star0[edge.from] += third * edge.crossing;
    star0[edge.to] += third * (edge.length - edge.crossing);
  }
}

DecComplex DecBuilder::build() {
  tetrahedra();
  edges();
  faces();
  incidence();
  add_stars(mesh_, c_, c_.star2, c_.star1, c_.star0);
  for (std::size_t e = 0; e < c_.edges.size(); ++e)
    c_.edges[EdgeId(e)].dual_area = c_.star1[EdgeId(e)] * c_.edges[EdgeId(e)].length;
  return std::move(c_);
}

void DecBuilder::tetrahedra() {
  c_.volumes.reserve(mesh_.n_tetrahedra());
  c_.star3.reserve(mesh_.n_tetrahedra());
  c_.orthocenters.reserve(mesh_.n_tetrahedra());
  for (const TetId t : mesh_.tetrahedra()) {
    const auto [p, q, r, s] = mesh_.points(t);
    c_.volumes.push_back(accurate::six_volumes(p, q, r, s) / 6);
    c_.star3.push_back(1 / c_.volumes[t]);
    c_.orthocenters.push_back(orthocenter(p, q, r, s));
  }
}

void DecBuilder::edges() {
  const EdgeTable table(mesh_, nullptr);
  c_.edges.reserve(table.n_edges());
  first_edge_.reserve(mesh_.n_vertices() + 1);
  for (const VertexId from : mesh_.vertices()) {
    first_edge_.push_back(c_.edges.size());
    for (const VertexId to : table.greater(from)) {
      const WeightedPoint p = mesh_.point(from), q = mesh_.point(to);
      const Vec3 along = q.position() - p.position();
      const double l2 = squared_length(along);
      const double lower = accurate::doubled_crossing(p, q), upper = accurate::doubled_crossing(q, p);
      DecEdge edge;
      edge.from = from, edge.to = to;
      edge.length = std::sqrt(l2);
      edge.crossing = 0.5 * lower / edge.length;
      // From the nearer end: then the relative error of the distance from there is small.
      edge.midpoint = std::abs(lower) <= std::abs(upper) ? p.position() + (0.5 * lower / l2) * along
                                                         : q.position() - (0.5 * upper / l2) * along;
      c_.edges.push_back(edge);
    }
  }
  first_edge_.push_back(c_.edges.size());
}

EdgeId DecBuilder::edge(VertexId from, VertexId to) const {
  const auto begin = c_.edges.begin() + static_cast<std::ptrdiff_t>(first_edge_[from]);
  const auto end = c_.edges.begin() + static_cast<std::ptrdiff_t>(first_edge_[VertexId(from.index + 1)]);
  const auto found = std::lower_bound(begin, end, to, [](const DecEdge& e, VertexId v) { return e.to < v; });
  return EdgeId(static_cast<std::size_t>(found - c_.edges.begin()));
}

void DecBuilder::faces() {
  const FaceBuckets buckets(mesh_);
  const std::size_t n = mesh_.n_faces();
  TEMPER_ASSERT(n < std::size_t{1} << 31);
  c_.faces.reserve(n);
  c_.star2.reserve(n);
  c_.transmissibility.reserve(n);
  std::vector<FaceBuckets::Side> sides;
  for (const VertexId least : mesh_.vertices()) {
    buckets.collect(least, sides);
    for (std::size_t i = 0; i < sides.size();) {
      const std::size_t n_sides = i + 1 < sides.size() && sides[i].same_face(sides[i + 1]) ? 2 : 1;
      add_face({least, sides[i].middle, sides[i].greatest}, std::span(sides).subspan(i, n_sides));
      i += n_sides;
    }
  }
}

/// The normal of pqr points to the opposite corner of a halfface with vertices p, q, r in this order, or turned.
bool is_ahead(const std::array<VertexId, 3>& ascending, const std::array<VertexId, 3>& halfface) {
  const auto at = std::find(halfface.begin(), halfface.end(), ascending[0]) - halfface.begin();
  return halfface[static_cast<std::size_t>((at + 1) % 3)] == ascending[1];
}

void DecBuilder::add_face(const std::array<VertexId, 3>& vertices, std::span<const FaceBuckets::Side> sides) {
  const Triangle face = {mesh_.point(vertices[0]), mesh_.point(vertices[1]), mesh_.point(vertices[2])};
  const auto& [p, q, r] = face;
  const double squared_area = accurate::squared_doubled_area(p, q, r);
  DecFace f;
  f.vertices = vertices;
  f.area = 0.5 * std::sqrt(squared_area);
  f.orthocenter = orthocenter(p, q, r);
  WeightedPoint behind, ahead;
  for (const FaceBuckets::Side& side : sides) {
    const bool in_front = is_ahead(vertices, mesh_.vertices(side.halfface));
    const TetId t = TetMesh::tetrahedron(side.halfface);
    const WeightedPoint apex = mesh_.point(mesh_.opposite(side.halfface));
    const double numerator =
        in_front ? accurate::height_numerator(p, q, r, apex) : accurate::height_numerator(p, r, q, apex);
    (in_front ? f.ahead : f.behind) = t;
    (in_front ? ahead : behind) = apex;
    (in_front ? f.ahead_height : f.behind_height) = numerator / (24 * c_.volumes[t]) / f.area;
  }
  const double ratio = star2(face, squared_area, f, behind, ahead);
  f.dual_length = ratio * f.area;
  c_.faces.push_back(f);
  c_.star2.push_back(ratio);
  c_.transmissibility.push_back(ratio == 0 ? std::numeric_limits<double>::infinity() : 1 / ratio);
}

/// Let D be the power polynomial of pqr, the corner ahead and the one behind. Moving along the dual line from the
/// orthocenter ahead to the one behind changes the power of the corner behind, less that of p, from −D / 6V_ahead to
/// 0, at the rate 6V_behind / A. So (h_behind + h_ahead) / A = −D / (6V_ahead 6V_behind): accurate when the heights
/// cancel, and 0 for cospherical points.
double DecBuilder::star2(const Triangle& face, double squared_area, const DecFace& f, const WeightedPoint& behind,
                         const WeightedPoint& ahead) const {
  const auto& [p, q, r] = face;
  if (!f.behind.valid()) return accurate::height_numerator(p, q, r, ahead) / (6 * c_.volumes[f.ahead]) / squared_area;
  if (!f.ahead.valid()) return accurate::height_numerator(p, r, q, behind) / (6 * c_.volumes[f.behind]) / squared_area;
  // 0 − D rather than −D: a tie is +0.
  return (0 - accurate::power_polynomial(p, q, r, ahead, behind)) / (6 * c_.volumes[f.ahead]) /
         (6 * c_.volumes[f.behind]);
}

/// A matrix of rows with `width` entries each. `entry` gives column and sign of an entry.
template <class Entry>
IncidenceMatrix incidence_of(std::size_t n_rows, std::size_t n_columns, std::size_t width, const Entry& entry) {
  IncidenceMatrix matrix = {n_columns, std::vector<std::int64_t>(n_rows + 1), {}, {}};
  matrix.columns.reserve(width * n_rows);
  matrix.signs.reserve(width * n_rows);
  for (std::size_t row = 0; row < n_rows; ++row) {
    for (std::size_t k = 0; k < width; ++k) {
      const std::pair<std::size_t, int> at = entry(row, k);
      matrix.columns.push_back(static_cast<std::int32_t>(at.first));
      matrix.signs.push_back(static_cast<std::int8_t>(at.second));
    }
    matrix.starts[row + 1] = static_cast<std::int64_t>(width * (row + 1));
  }
  return matrix;
}

void DecBuilder::incidence() {
  using Entry = std::pair<std::size_t, int>;
  const std::size_t n_edges = c_.edges.size(), n_faces = c_.faces.size(), n_tetrahedra = mesh_.n_tetrahedra();
  c_.d0 = incidence_of(n_edges, mesh_.n_vertices(), 2, [&](std::size_t e, std::size_t k) {
    const DecEdge& edge = c_.edges[EdgeId(e)];
    return k == 0 ? Entry(edge.from.index, -1) : Entry(edge.to.index, 1);
  });
  // The edges of ascending vertices p, q, r are pq, pr, qr in this order.
  c_.d1 = incidence_of(n_faces, n_edges, 3, [&](std::size_t f, std::size_t k) {
    const DecFace& face = c_.faces[FaceId(f)];
    const auto [from, to, other, sign] = kFaceEdges[k];
    const EdgeId e = edge(face.vertices[std::size_t(from)], face.vertices[std::size_t(to)]);
    if (face.is_boundary()) c_.edges[e].is_boundary = true;
    return Entry(e.index, sign);
  });
  std::vector<std::array<Entry, 4>> of_tetrahedra(n_tetrahedra);
  std::vector<std::uint8_t> found(n_tetrahedra, 0);
  for (std::size_t f = 0; f < n_faces; ++f) {
    const DecFace& face = c_.faces[FaceId(f)];
    if (face.behind.valid()) of_tetrahedra[face.behind.index][found[face.behind.index]++] = {f, 1};
    if (face.ahead.valid()) of_tetrahedra[face.ahead.index][found[face.ahead.index]++] = {f, -1};
  }
  c_.d2 = incidence_of(n_tetrahedra, n_faces, 4, [&](std::size_t t, std::size_t k) { return of_tetrahedra[t][k]; });
}

}  // namespace

DecComplex dec_operators(const TetMesh& mesh) { return DecBuilder(mesh).build(); }

Expected<DecComplex> with_coefficient(const TetMesh& mesh, DecComplex complex, std::span<const double> coefficient,
                                      const InputNames* names) {
  const InputNames from_zero;
  const InputNames& numbers = names != nullptr ? *names : from_zero;
  const auto tetrahedron = [&](std::size_t t) {
    return std::pair(numbers.tetrahedron_where(t), numbers.tetrahedron(t));
  };
  if (auto error = check_coefficient(coefficient, mesh.n_tetrahedra(), "tetrahedra", tetrahedron)) return *error;
  complex.coefficient = IdVector<TetId, double>(coefficient.size());
  std::copy(coefficient.begin(), coefficient.end(), complex.coefficient.begin());
  WithFactors made = with_factors(mesh, complex, complex.coefficient);
  complex.star1 = std::move(made.star1);
  complex.capacity = std::move(made.star0);
  complex.transmissibility = std::move(made.transmissibility);
  return complex;
}

WithFactors with_factors(const TetMesh& mesh, const DecComplex& complex, const IdVector<TetId, double>& factors) {
  WithFactors made;
  IdVector<FaceId, double> ratios;
  ratios.reserve(complex.faces.size());
  made.transmissibility.reserve(complex.faces.size());
  for (const DecFace& face : complex.faces) {
    const double behind = factors[face.behind.valid() ? face.behind : face.ahead];
    const double ahead = factors[face.ahead.valid() ? face.ahead : face.behind];
    const DualEdge dual = {face.dual_length, face.behind_height, face.ahead_height};
    ratios.push_back(dual.combined(behind, ahead) / face.area);
    const double resistance = dual.combined(1 / behind, 1 / ahead);
    made.transmissibility.push_back(resistance == 0 ? std::numeric_limits<double>::infinity() : face.area / resistance);
  }
  add_stars(mesh, complex, ratios, made.star1, made.star0);
  return made;
}

// --- a summary for the authors of solvers: signs, sums, extremes ----------------------------------------------------

namespace {

double least_of(std::span<const double> values) {
  return values.empty() ? 0 : *std::min_element(values.begin(), values.end());
}
double largest_of(std::span<const double> values) {
  return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}
std::size_t negative_in(std::span<const double> values) {
  return static_cast<std::size_t>(std::count_if(values.begin(), values.end(), [](double x) { return x < 0; }));
}

void summarize_faces(DecSummary& s, const DecComplex& complex) {
  std::vector<double> transmissibilities;
  std::vector<bool> bad(complex.volumes.size(), false);
  transmissibilities.reserve(complex.faces.size());
  for (std::size_t i = 0; i < complex.faces.size(); ++i) {
    const DecFace& face = complex.faces[FaceId(i)];
    const double value = complex.star2[FaceId(i)];
    if (face.behind.valid() && face.behind_height <= 0) bad[face.behind.index] = true;
    if (face.ahead.valid() && face.ahead_height <= 0) bad[face.ahead.index] = true;
    if (face.is_boundary()) {
      ++s.boundary_faces;
      s.negative_boundary_star2 += value < 0 ? 1 : 0;
      continue;
    }
    s.negative_star2 += value < 0 ? 1 : 0;
    s.zero_star2 += value == 0 ? 1 : 0;
    transmissibilities.push_back(std::abs(complex.transmissibility[FaceId(i)]));
  }
  s.not_well_centered = static_cast<std::size_t>(std::count(bad.begin(), bad.end(), true));
  s.max_transmissibility = largest_of(transmissibilities);
  s.median_transmissibility = median_of(std::move(transmissibilities));
}

}  // namespace

DecSummary summarize(const DecComplex& complex) {
  DecSummary s;
  s.vertices = complex.star0.size();
  s.edges = complex.edges.size();
  s.faces = complex.faces.size();
  s.tetrahedra = complex.volumes.size();
  summarize_faces(s, complex);
  s.negative_star0 = negative_in(complex.star0.raw());
  s.negative_star1 = negative_in(complex.star1.raw());
  s.min_star0 = least_of(complex.star0.raw());
  s.min_star1 = least_of(complex.star1.raw());
  s.min_star2 = least_of(complex.star2.raw());
  std::vector<double> stars;
  stars.reserve(complex.edges.size());
  for (const double value : complex.star1) stars.push_back(std::abs(value));
  s.max_star1 = largest_of(stars);
  s.median_star1 = median_of(std::move(stars));
  for (const double v : complex.volumes) s.volume += v;
  for (const double v : complex.star0) s.star0_sum += v;
  return s;
}

}  // namespace temper::tets
