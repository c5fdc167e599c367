#include "tets/transfer/pieces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace temper::tets {
namespace {

// Pieces below this share of their tetrahedron are rounding.
constexpr double kNegligible = 1e-15;

/// Fills in what follows from the body.
void measure(TetPiece& piece) {
  constexpr double kRounding = 0x1p-46;  // an overlap as thick as some roundings of the coordinates
  piece.volume = piece.body.volume();
  piece.center = {};
  for (const Polyhedron::Corner& c : piece.body.corners()) piece.center = piece.center + c.at;
  piece.center = (1 / static_cast<double>(piece.body.corners().size())) * piece.center;
  for (const Polyhedron::Corner& c : piece.body.corners())
    piece.radius = std::max(piece.radius, length(c.at - piece.center));
  piece.negligible = kRounding * piece.radius * piece.radius * piece.radius;
}

}  // namespace

VertexNeighbors::VertexNeighbors(const TetMesh& mesh) {
  std::vector<std::size_t> next(mesh.n_vertices() + 1, 0);
  for (const TetId t : mesh.tetrahedra()) {
    for (const VertexId v : mesh.corners(t)) next[v.index + 1] += 3;
  }
  for (std::size_t v = 0; v < mesh.n_vertices(); ++v) next[v + 1] += next[v];
  const std::vector<std::size_t> first = next;
  std::vector<VertexId> found(next.back());
  for (const TetId t : mesh.tetrahedra()) {
    for (const VertexId v : mesh.corners(t)) {
      for (const VertexId w : mesh.corners(t)) {
        if (v != w) found[next[v.index]++] = w;
      }
    }
  }
  starts_.push_back(0);
  for (std::size_t v = 0; v < mesh.n_vertices(); ++v) {
    const auto begin = found.begin() + static_cast<std::ptrdiff_t>(first[v]),
               end = found.begin() + static_cast<std::ptrdiff_t>(first[v + 1]);
    std::sort(begin, end);
    all_.insert(all_.end(), begin, std::unique(begin, end));
    starts_.push_back(all_.size());
  }
}

CutTet TetCuts::cut(TetId t) {
  CutTet cut;
  cut.origin = mesh_.position(mesh_.corners(t)[0]);
  for (std::size_t k = 0; k < 4; ++k) cut.corners[k] = mesh_.position(mesh_.corners(t)[k]) - cut.origin;
  for (std::size_t f = 0; f < 4; ++f) {
    const auto [a, b, c] = TetMesh::kFaceCorners[f];
    const Vec3 p = cut.corners[std::size_t(a)], q = cut.corners[std::size_t(b)], r = cut.corners[std::size_t(c)];
    cut.sides[f] = {p, cross(q - p, r - p)};
  }
  whole_ = Polyhedron(cut.corners);
  if (of_ == CellsOf::vertices) {
    cut_for_vertices(t, cut);
  } else {
    cut.pieces.push_back({t.index, whole_, {}, 0, 0, {}, 0});
    measure(cut.pieces.back());
  }
  return cut;
}

void TetCuts::cut_for_vertices(TetId t, CutTet& cut) {
  candidates_.clear();
  for (const VertexId v : mesh_.corners(t)) add(v, cut.origin);
  const double negligible = kNegligible * whole_.volume();
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    if (!(candidates_[i].piece.body.volume() > negligible)) continue;
    for (const VertexId w : (*neighbors_)[candidates_[i].vertex]) add(w, cut.origin);
  }
  for (Candidate& c : candidates_) {
    if (!(c.piece.body.volume() > negligible)) continue;
    measure(c.piece);
    cut.pieces.push_back(std::move(c.piece));
  }
}

/// Takes from the others the part that is nearer to v.
void TetCuts::add(VertexId v, Vec3 origin) {
  if (std::ranges::any_of(candidates_, [v](const Candidate& c) { return c.vertex == v; })) return;
  Candidate added = {v, mesh_.position(v) - origin, mesh_.weight(v), {}};
  added.piece.cell = v.index;
  if (candidates_.empty() || wins_anywhere(added)) {
    added.piece.body = whole_;
    for (const Candidate& other : candidates_) {
      if (!other.piece.body.empty()) divide(added.piece, added, other);
    }
    if (!added.piece.body.empty()) {
      for (Candidate& other : candidates_) {
        if (!other.piece.body.empty()) divide(other.piece, other, added);
      }
    }
  }
  candidates_.push_back(std::move(added));
}

/// Says whether the vertex added is nearer than the owner anywhere. The difference is linear, so corners decide.
bool TetCuts::wins_anywhere(const Candidate& added) const {
  return std::ranges::any_of(candidates_, [&](const Candidate& owner) {
    const Vec3 e = added.at - owner.at;
    const double constant = squared_length(e) + (owner.weight - added.weight);
    return std::ranges::any_of(owner.piece.body.corners(),
                               [&](const Polyhedron::Corner& c) { return 2 * dot(c.at - owner.at, e) > constant; });
  });
}

/// The plane where both power distances are equal crosses the line from the owner to the other. It is computed from
/// the lower vertex, so that both get the same corners.
void TetCuts::divide(TetPiece& piece, const Candidate& owner, const Candidate& other) {
  const bool swapped = other.vertex < owner.vertex;
  const Candidate &low = swapped ? other : owner, &high = swapped ? owner : other;
  const Vec3 e = high.at - low.at;
  const double part = 0.5 + 0.5 * (low.weight - high.weight) / squared_length(e);
  const HalfSpace nearer = {low.at + part * e, (swapped ? 1.0 : -1.0) * e};
  if (piece.body.cut(nearer)) piece.cuts.push_back(nearer);
}

}  // namespace temper::tets
