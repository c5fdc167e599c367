#include "experiments/closeness.hpp"

#include <algorithm>
#include <limits>

#include "experiments/numbers.hpp"

namespace temper::gallery {
namespace {

constexpr const char* kRed = "#d62728";
constexpr const char* kYellow = "#e8b500";

double distance(const Mesh& mesh, VertexId a, VertexId b) { return length(mesh.position(a) - mesh.position(b)); }

bool same_edge(const ClosePair& a, const ClosePair& b) {
  return (a.vertex == b.vertex && a.neighbor == b.neighbor) || (a.vertex == b.neighbor && a.neighbor == b.vertex);
}

}  // namespace

ClosePair closest_neighbor(const Mesh& mesh, VertexId v) {
  ClosePair best{v, {}, kInfinity};
  for (const HalfedgeId spoke : mesh.star(v)) {
    const VertexId q = mesh.target(spoke);
    const VertexId next = mesh.target(Mesh::next(spoke)), previous = mesh.target(Mesh::next(mesh.twin(spoke)));
    const double shorter = std::min(distance(mesh, q, next), distance(mesh, q, previous));
    const double ratio = distance(mesh, v, q) / shorter;
    if (ratio < best.ratio) best.neighbor = q, best.ratio = ratio;
  }
  return best;
}

std::vector<ClosePair> close_pairs(const Mesh& mesh, double ratio) {
  std::vector<ClosePair> pairs;
  for (const VertexId v : mesh.vertices()) {
    if (mesh.is_boundary(v)) continue;
    const ClosePair pair = closest_neighbor(mesh, v);
    const auto known = std::ranges::find_if(pairs, [&](const ClosePair& p) { return same_edge(p, pair); });
    if (known != pairs.end()) {
      known->ratio = std::min(known->ratio, pair.ratio);
    } else if (pair.ratio < ratio) {
      pairs.push_back(pair);
    }
  }
  std::ranges::sort(pairs, {}, &ClosePair::ratio);
  return pairs;
}

double least_closeness(const Mesh& mesh) {
  const std::vector<ClosePair> pairs = close_pairs(mesh, kInfinity);
  return pairs.empty() ? kInfinity : pairs.front().ratio;
}

std::vector<Mark> closeness_marks(const Mesh& mesh) {
  std::vector<Mark> marks;
  for (const ClosePair& pair : close_pairs(mesh, kCollapseRatio)) {
    const char* color = pair.ratio < kNearlyCoincident ? kRed : kYellow;
    for (const VertexId v : {pair.vertex, pair.neighbor}) marks.push_back({mesh.position(v), color, {}});
  }
  std::ranges::reverse(marks);  // the nearest on top
  return marks;
}

}  // namespace temper::gallery
