// Segments into a Delaunay triangulation, of the plane or of the sphere.
//
// A segment is followed from vertex to vertex: a vertex that lies on it splits it. Between two such vertices u and w it
// may be an edge already, or it crosses a strip of triangles. Triangulations of the parts left and right of uw replace
// these. Then Lawson's flips make the rest constrained Delaunay again.
//
//           l1---l2                         The chain u l1 l2 … w need not be a simple polygon. An edge that hangs
//          / \  /  \      strip: the        into the strip is passed on both sides; its end comes once, its foot
//         u···\/····w     triangles that    comes twice. So triangles are joined by the names of their corners, not
//          \  /\   /      u···w enters      by their place in the chain.
//           r1--r2
//
// Rejected: flipping the crossed edges away one by one in a queue. It needs less code, but a flip may leave the new
// edge crossing, too. We found no proof that the queue runs empty.
#include <algorithm>
#include <unordered_map>

#include "generate/triangulation.hpp"
#include "geometry/surface.hpp"
#include "mesh/mesh_editor.hpp"
#include "mesh/predicates.hpp"

namespace temper::generate {
namespace {

using Chain = std::vector<VertexId>;

/// The strip of triangles that a segment crosses between two vertices.
struct Strip {
  std::vector<TriangleId> triangles;
  Chain left, right;  ///< from u to w, both included
};

/// The next part of a segment: an existing edge, a strip to the next vertex, or a constrained edge in the way.
struct Step {
  enum class Kind { edge, strip, blocked } kind;
  HalfedgeId h;  ///< the edge from u; or the constrained one
  Strip strip;
};

class SegmentInserter {
 public:
  explicit SegmentInserter(Triangulation& triangulation) : t_(triangulation), mesh_(triangulation.mesh), edit_(mesh_) {}

  std::optional<InputError> insert(std::uint32_t segment, VertexId from, VertexId to) {
    for (VertexId u = from; u != to;) {
      const Step step = next_step(u, to);
      if (step.kind == Step::Kind::blocked) return crossing(segment, from, to, step.h);
      HalfedgeId edge = step.h;
      if (step.kind == Step::Kind::strip) edge = replace(step.strip);
      if (!edge.valid()) return too_near(segment, from, to);
      mesh_.set_constrained(edge, true);
      segment_of_.emplace(key(mesh_.origin(edge), mesh_.target(edge)), Owner{segment, from, to});
      lawson_.run(mesh_, IgnoreFlips(), Lawson::kNoCap, t_.conflict_test());
      lawson_.clear();
      u = mesh_.origin(edge) == u ? mesh_.target(edge) : mesh_.origin(edge);
    }
    return std::nullopt;
  }

 private:
  struct Owner {
    std::uint32_t segment;
    VertexId from, to;
  };

  static std::uint64_t key(VertexId a, VertexId b) {
    return (std::uint64_t{std::min(a, b).index} << 32) | std::max(a, b).index;
  }
  [[nodiscard]] Sign side(VertexId u, VertexId w, VertexId v) const { return inlined::orientation(mesh_, u, w, v); }
  /// For v on the line of uw: is it on w's side of u?
  [[nodiscard]] bool is_ahead(VertexId u, VertexId w, VertexId v) const {
    return temper::is_ahead(mesh_.space(), mesh_.point(u), mesh_.point(w), mesh_.point(v));
  }

  Step next_step(VertexId u, VertexId w) const {
    HalfedgeId entry;
    for (const HalfedgeId h : mesh_.star(u)) {
      const VertexId a = mesh_.target(h), b = mesh_.opposite(h);
      const Sign of_a = side(u, w, a), of_b = side(u, w, b);
      if (of_a == Sign::zero && is_ahead(u, w, a)) return {Step::Kind::edge, h, {}};
      if (of_b == Sign::zero && is_ahead(u, w, b)) return {Step::Kind::edge, Mesh::prev(h), {}};
      if (of_a == Sign::negative && of_b == Sign::positive) entry = Mesh::next(h);
    }
    return follow(u, w, entry);
  }

  /// Follows the segment through the strip, starting across the halfedge from the right chain to the left one.
  Step follow(VertexId u, VertexId w, HalfedgeId across) const {
    Step step{Step::Kind::strip, {}, {}};
    Strip& strip = step.strip;
    strip.triangles = {Mesh::triangle(across)};
    strip.right = {u, mesh_.origin(across)};
    strip.left = {u, mesh_.target(across)};
    for (;;) {
      if (mesh_.is_constrained(across)) return {Step::Kind::blocked, across, {}};
      const HalfedgeId h = mesh_.twin(across);  // from left to right
      const VertexId apex = mesh_.opposite(h);
      strip.triangles.push_back(Mesh::triangle(h));
      const Sign of_apex = side(u, w, apex);
      if (of_apex != Sign::negative) strip.left.push_back(apex);
      if (of_apex != Sign::positive) strip.right.push_back(apex);
      if (of_apex == Sign::zero) return step;
      // h: left → right; next(h): right → apex; prev(h): apex → left. The segment leaves between right and left.
      across = of_apex == Sign::positive ? Mesh::next(h) : Mesh::prev(h);
    }
  }

  /// Retriangulates both sides of a strip. Returns the edge from u to w; invalid, with nothing changed, if a triangle
  /// would be turned over.
  HalfedgeId replace(const Strip& strip) {
    corners_.clear();
    triangulate_chain(strip.right, false);
    triangulate_chain(strip.left, true);
    TEMPER_ASSERT(corners_.size() == strip.triangles.size());
    for (const auto& [a, b, c] : corners_) {
      if (side(a, b, c) != Sign::positive) return {};
    }

    std::unordered_map<std::uint64_t, inlined::OuterSide> outside;
    for (const TriangleId t : strip.triangles) {
      for (int k = 0; k < 3; ++k) {
        const HalfedgeId h = Mesh::halfedge(t, k);
        outside.emplace(directed(mesh_.origin(h), mesh_.target(h)), inlined::outer_side(mesh_, h));
      }
    }
    std::unordered_map<std::uint64_t, HalfedgeId> inside;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        const HalfedgeId h = Mesh::halfedge(strip.triangles[i], k);
        edit_.set_corner(h, corners_[i][k]);
        inside.emplace(directed(corners_[i][k], corners_[i][(k + 1) % 3]), h);
      }
    }
    for (const auto& [edge, h] : inside) join(edge, h, inside, outside);
    for (const TriangleId t : strip.triangles) {
      for (int k = 0; k < 3; ++k) {
        const HalfedgeId h = Mesh::halfedge(t, k);
        edit_.set_outgoing(mesh_.origin(h), h);
        lawson_.push(h);
      }
    }
    for (const Chain* chain : {&strip.left, &strip.right}) {
      for (const VertexId v : *chain) edit_.set_outgoing(v, canonical_outgoing(mesh_, mesh_.outgoing(v)));
    }
    return inside.at(directed(strip.left.front(), strip.left.back()));
  }

  using Sides = std::unordered_map<std::uint64_t, HalfedgeId>;
  using OuterSides = std::unordered_map<std::uint64_t, inlined::OuterSide>;

  void join(std::uint64_t edge, HalfedgeId h, const Sides& inside, const OuterSides& outside) {
    const auto before = outside.find(edge);
    const bool constrained = before != outside.end() && before->second.constrained;
    const auto other = inside.find((edge << 32) | (edge >> 32));
    if (other != inside.end()) {
      edit_.link(h, other->second);
    } else {
      TEMPER_ASSERT(before != outside.end());
      edit_.link(h, before->second.twin);
    }
    mesh_.set_constrained(h, constrained);
  }

  static std::uint64_t directed(VertexId a, VertexId b) { return (std::uint64_t{a.index} << 32) | b.index; }

  /// Triangles between the chord from front to back and the chain. Each takes a vertex whose circle with the chord
  /// contains no other vertex of the chain (Anglada 1997).
  void triangulate_chain(const Chain& chain, bool chain_is_left) {
    std::vector<std::pair<std::size_t, std::size_t>> chords = {{0, chain.size() - 1}};
    while (!chords.empty()) {
      const auto [i, j] = chords.back();
      chords.pop_back();
      if (j < i + 2) continue;
      std::size_t best = i + 1;
      for (std::size_t k = i + 2; k < j; ++k) {
        if (is_nearer(chain[i], chain[j], chain[best], chain[k], chain_is_left)) best = k;
      }
      if (!mesh_.space().is_plane()) best = innermost(chain, i, j, best);
      if (chain_is_left) {
        corners_.push_back({chain[i], chain[j], chain[best]});
      } else {
        corners_.push_back({chain[j], chain[i], chain[best]});
      }
      chords.emplace_back(i, best);
      chords.emplace_back(best, j);
    }
  }

  /// Is the candidate inside the circle of the chord uw and the best vertex so far? (The end of a hanging edge is
  /// inside its foot's circle, so the two places of a foot never both remain.)
  [[nodiscard]] bool is_nearer(VertexId u, VertexId w, VertexId best, VertexId candidate, bool left) const {
    if (candidate == best) return false;
    const inlined::Quad quad = left ? inlined::Quad{u, w, best, candidate} : inlined::Quad{w, u, best, candidate};
    return t_.conflict_test()(mesh_, quad) == Sign::positive;
  }

  /// On the sphere weights of vertices that nearly coincide are rounding, and circles mean nothing there. So the
  /// triangle on a chord takes a vertex inside it instead, until it is empty.
  [[nodiscard]] std::size_t innermost(const Chain& chain, std::size_t i, std::size_t j, std::size_t best) const {
    for (std::size_t k = i + 1; k < j; ++k) {
      const VertexId u = chain[i], w = chain[j], b = chain[best], v = chain[k];
      if (v == b) continue;
      const Sign turn = side(u, w, b);
      if (side(u, w, v) == turn && side(w, b, v) == turn && side(b, u, v) == turn) best = k, k = i;
    }
    return best;
  }

  [[nodiscard]] InputError too_near(std::uint32_t segment, VertexId from, VertexId to) const {
    return {ErrorCode::out_of_scale, "",
            "segment " + std::to_string(segment) + " (" + t_.name(from) + " to " + t_.name(to) +
                ") passes points that nearly coincide"};
  }

  InputError crossing(std::uint32_t segment, VertexId from, VertexId to, HalfedgeId constrained) const {
    const Owner& other = segment_of_.at(key(mesh_.origin(constrained), mesh_.target(constrained)));
    const auto text = [&](std::uint32_t number, VertexId a, VertexId b) {
      return "segment " + std::to_string(number) + " (" + t_.name(a) + " to " + t_.name(b) + ")";
    };
    return {ErrorCode::overlap, "",
            text(other.segment, other.from, other.to) + " and " + text(segment, from, to) +
                " cross; segments may only meet at points"};
  }

  Triangulation& t_;
  Mesh& mesh_;
  MeshEditor edit_;
  Lawson lawson_;
  std::vector<std::array<VertexId, 3>> corners_;
  std::unordered_map<std::uint64_t, Owner> segment_of_;
};

}  // namespace

std::optional<InputError> insert_segments(Triangulation& triangulation,
                                          std::span<const std::array<std::int32_t, 2>> segments,
                                          const std::function<bool()>& stop) {
  const auto n = static_cast<std::int64_t>(triangulation.vertex.size());
  SegmentInserter inserter(triangulation);
  for (std::uint32_t s = 0; s < segments.size(); ++s) {
    if (stop && stop()) return stopped_error();
    const auto [i, j] = segments[s];
    for (const std::int32_t end : segments[s]) {
      if (end < 0 || end >= n) {
        return InputError{ErrorCode::index_out_of_range, "",
                          "segment " + std::to_string(s) + " uses point " + std::to_string(end) + ", but there are " +
                              std::to_string(n) + " points"};
      }
    }
    if (i == j) {
      return InputError{ErrorCode::zero_area, "",
                        "segment " + std::to_string(s) + " joins point " + std::to_string(i) + " to itself"};
    }
    if (auto error = inserter.insert(s, triangulation.vertex[static_cast<std::size_t>(i)],
                                     triangulation.vertex[static_cast<std::size_t>(j)])) {
      return error;
    }
  }
  return std::nullopt;
}

}  // namespace temper::generate
