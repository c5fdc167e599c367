// Reasons and cures in words. Vertices, edges and triangles have the names of quality reports.
#include <algorithm>
#include <array>

#include "feasibility/constraints.hpp"
#include "geometry/surface.hpp"
#include "quality/measure.hpp"
#include "temper/explain.hpp"

namespace temper {
namespace {

constexpr std::size_t kNamed = 8;      // triangles or vertices in one sentence; the rest is counted
constexpr double kNotableRatio = 4.0;  // of two edges at a corner: what boundary grading keeps to

constexpr double kSharpCorner = 60.0;  // degrees: less room than one equilateral triangle takes

class Speaker {
 public:
  Speaker(const Mesh& mesh, const InputNames* names) : mesh_(mesh), names_(names) {}

  [[nodiscard]] std::string number(VertexId v) const { return number_of(v, names_); }
  [[nodiscard]] std::string vertex(VertexId v) const { return "vertex " + number(v); }
  [[nodiscard]] std::string edge(VertexId p, VertexId q) const {
    const bool boundary = !mesh_.find_halfedge(p, q).valid() || !mesh_.find_halfedge(q, p).valid();
    return (boundary ? "boundary edge " : "edge ") + number(p) + "-" + number(q);
  }
  [[nodiscard]] std::string interface_edge(VertexId p, VertexId q) const {
    return "interface edge " + number(p) + "-" + number(q);
  }
  /// Nine digits find a place on a map, in meters.
  [[nodiscard]] static std::string place(Vec2 p) { return "(" + rounded(p.x, 9) + ", " + rounded(p.y, 9) + ")"; }

  /// "triangle 3", "triangles 3, 5 and 8", "triangles 3, 5, … (12 in all)".
  template <class IdType>
  [[nodiscard]] std::string list(const std::string& one, const std::string& many,
                                 const std::vector<IdType>& ids) const {
    if (ids.size() == 1) return one + " " + number_of(ids[0], names_);
    std::string text = many + " ";
    const std::size_t named = std::min(ids.size(), kNamed);
    for (std::size_t i = 0; i < named; ++i) {
      if (i > 0) text += i + 1 == ids.size() ? " and " : ", ";
      text += number_of(ids[i], names_);
    }
    return ids.size() > named ? text + ", … (" + std::to_string(ids.size()) + " in all)" : text;
  }
  [[nodiscard]] std::string triangles(const std::vector<TriangleId>& ids) const {
    return list("triangle", "triangles", ids);
  }

  [[nodiscard]] ReasonWords reason(const Reason& r) const {
    switch (r.kind) {
      case ReasonKind::split:
        return must_split(r);
      case ReasonKind::edge:
      case ReasonKind::fan:
      case ReasonKind::patch:
        return {opening(r), (r.crossing ? crossing(r) : together(r)) + proof(r) + freedom(r)};
      case ReasonKind::at_interface:
        return {opening(r), equal_crossings(r) + proof(r) + freedom(r)};
      case ReasonKind::weights:
        return {worst(r), weights_exist(r)};
      case ReasonKind::undecided:
        return {worst(r),
                "No weights were found for its neighborhood, and no proof that there are none: the best margin "
                "is zero up to rounding."};
    }
    return {};
  }

  [[nodiscard]] std::string cure(const Cure& c) const {
    const std::string what = action(c);
    if (c.action == Cure::Action::find_weights || c.action == Cure::Action::optimize) return what + ".";
    if (c.ends_conflict) return "Necessary, and enough for this edge, verified: " + what + ".";
    if (!c.verified) return "May help, not verified: " + what + ".";
    const std::string count = std::to_string(c.triangles);
    if (c.conflict_only) {
      return "Resolves this conflict, verified: " + what + ". The " + count +
             " triangles concerned then have weights (margin " + rounded(c.margin) +
             "), but not together with all of those around them.";
    }
    std::string text = "Cures it, verified: " + what + ". Weights then exist that make the " + count +
                       " triangles around well-centered (margin " + rounded(c.margin) + ")";
    if (c.left_out > 0) text += ", not counting " + std::to_string(c.left_out) + " of other conflicts";
    return text + ".";
  }

 private:
  /// "Boundary edge 17-18 must be split, …".
  [[nodiscard]] ReasonWords must_split(const Reason& r) const {
    const EdgeConflict& c = *r.must_split;
    const VertexId u = mesh_.origin(c.edge), v = mesh_.target(c.edge);
    const Surface surface(mesh_.space());
    const double l = surface.distance(surface.place(mesh_.point(u)), surface.place(mesh_.point(v)));
    std::string what = r.at_interface ? interface_edge(u, v) : edge(u, v);
    what.front() = static_cast<char>(what.front() + ('A' - 'a'));
    what += " must be split, whatever is done inside.";
    if (!r.bad.empty()) what += " Bad there: " + triangles(r.bad) + ".";
    return {what, "It is " + rounded(l) + " long, and its dual must cross it less than " + rounded(c.a * l) + " from " +
                      vertex(u) + ", for the sake of " + vertex(c.near_u) + ", and less than " + rounded(c.b * l) +
                      " from " + vertex(v) + ", for the sake of " + vertex(c.near_v) +
                      ": no well-centered mesh keeps the edge and these vertices (decided exactly)."};
  }

  /// "Triangles 3, 5 and 8 exclude each other. They lie at the boundary corner of 35.2° at vertex 12, where …"
  [[nodiscard]] std::string opening(const Reason& r) const {
    std::string text = triangles(r.conflict) + " exclude each other.";
    text.front() = 'T';
    if (!r.center) return text;
    const FanCenter& c = *r.center;
    const double ratio = c.longest_length / c.shortest_length;
    const bool notable = c.on_boundary && (ratio >= kNotableRatio || c.angle_deg < kSharpCorner);
    if (r.kind == ReasonKind::edge && !notable) return text;
    std::size_t degree = 0;
    for ([[maybe_unused]] const HalfedgeId h : mesh_.star(c.vertex)) ++degree;
    const bool whole = degree == r.conflict.size();
    text += whole ? " They are all the triangles at " : " They lie at ";
    text +=
        c.on_boundary ? "the boundary corner of " + degrees(c.angle_deg) + " at " + vertex(c.vertex) : vertex(c.vertex);
    if (ratio >= kNotableRatio) {
      text += ", where " + edge(c.vertex, c.longest) + " is " + rounded(ratio) + " times as long as " +
              edge(c.vertex, c.shortest) + " (" + rounded(c.longest_length) + " and " + rounded(c.shortest_length) +
              ")";
    }
    return text + ".";
  }

  /// "triangle 3 (angle of 138.3° at vertex 10)".
  [[nodiscard]] std::string side(const CrossingSide& s) const {
    return triangles(s.triangles) + " (" + (s.triangles.size() > 1 ? "largest angle " : "angle of ") +
           degrees(s.angle_deg) + " at " + vertex(s.widest) + ")";
  }

  [[nodiscard]] std::string crossing(const Reason& r) const {
    const CrossingConflict& c = *r.crossing;
    const bool left_is_near = c.left.to <= c.right.from;
    const CrossingSide& near = left_is_near ? c.left : c.right;
    const CrossingSide& far = left_is_near ? c.right : c.left;
    // The sentence starts from the end next to the tighter bound.
    const bool from_p = near.to <= c.length - far.from;
    const VertexId from = from_p ? c.p : c.q, to = from_p ? c.q : c.p;
    const CrossingSide &less = from_p ? near : far, &more = from_p ? far : near;
    const double at_most = from_p ? near.to : c.length - far.from;
    const double at_least = from_p ? far.from : c.length - near.to;
    return "They cannot agree on where the dual crosses " + edge(from, to) + ", which is " + rounded(c.length) +
           " long: for " + side(less) + (at_most <= 0 ? " nowhere on it" : " less than " + rounded(at_most)) +
           " from " + vertex(from) + ", for " + side(more) + " more than " + rounded(at_least) + ". ";
  }

  [[nodiscard]] std::string together(const Reason& r) const {
    double widest = 0;
    VertexId where;
    std::size_t obtuse = 0;
    for (const TriangleId t : r.conflict) {
      const TriangleMeasure m = measure_triangle(mesh_, t);
      for (int k = 0; k < 3; ++k) {
        obtuse += m.angle_deg[k] > 90;
        if (m.angle_deg[k] > widest) widest = m.angle_deg[k], where = mesh_.corners(t)[k];
      }
    }
    return "Any of them can be left out, and weights suit the others; all at once none do. " + std::to_string(obtuse) +
           (obtuse == 1 ? " of their angles is" : " of their angles are") + " obtuse, the largest " + degrees(widest) +
           " at " + vertex(where) + ". ";
  }

  /// "Each region alone has weights. But dual edges must cross interface edges 3-4 and 4-9 at one place …".
  [[nodiscard]] std::string equal_crossings(const Reason& r) const {
    std::vector<std::string> edges;
    for (const auto& [c, multiplier] : r.certificate.terms) {
      if (c.kind == WeightConstraint::Kind::equal_crossing) edges.push_back(number(c.p) + "-" + number(c.q));
    }
    std::string text = "Each region alone has weights for them. But ";
    text += edges.size() == 1 ? "the dual edge must cross interface edge " : "dual edges must cross interface edges ";
    const std::size_t named = std::min(edges.size(), kNamed);
    for (std::size_t i = 0; i < named; ++i) text += (i == 0 ? "" : i + 1 == edges.size() ? " and " : ", ") + edges[i];
    if (edges.size() > named) text += ", … (" + std::to_string(edges.size()) + " in all)";
    return text + " at one place for both tensors. ";
  }

  [[nodiscard]] static std::string proof(const Reason& r) {
    return "So no weights make them well-centered as they stand (best margin " + rounded(r.margin) +
           "; proved exactly, by a certificate of " + std::to_string(r.certificate.terms.size()) + " terms). ";
  }

  [[nodiscard]] std::string freedom(const Reason& r) const {
    if (!r.free.empty()) {
      return "Of their corners " + list("vertex", "vertices", r.free) + (r.free.size() == 1 ? " is" : " are") +
             " free to move.";
    }
    std::vector<TriangleId> sorted = r.conflict;
    bool all_boundary = true;
    for (const VertexId v : vertices_of(mesh_, sorted)) all_boundary = all_boundary && mesh_.is_boundary(v);
    if (r.at_interface) return "None of their corners is free to move: all are on interfaces, the boundary or fixed.";
    return all_boundary
               ? "None of their corners is free to move: all are on the boundary."
               : "None of their corners is free to move: all are on the boundary, on constrained edges or fixed.";
  }

  [[nodiscard]] std::string worst(const Reason& r) const {
    const WorstTriangle w = describe(mesh_, r.bad.front(), names_);
    return (r.bad.size() > 1 ? "Worst is triangle " : "Triangle ") + number_of(r.bad.front(), names_) + ": " + w.why +
           ".";
  }

  [[nodiscard]] static std::string weights_exist(const Reason& r) {
    if (r.margin == kUnbounded || r.checked == 0) return "Weights that cure it have not been looked for.";
    if (r.each) {
      return "With every vertex where it is, weights exist for each with its neighbors (" + std::to_string(r.checked) +
             " triangles at most, best margin at least " + rounded(r.margin) + "); for all together was not asked.";
    }
    return "Nothing stands in the way: with every vertex where it is, weights exist that make all " +
           std::to_string(r.checked) + " triangles here well-centered (best margin " + rounded(r.margin) + ").";
  }

  [[nodiscard]] std::string action(const Cure& c) const {
    using Action = Cure::Action;
    switch (c.action) {
      case Action::find_weights:
        return c.changed > 0 ? "Find weights: near here " + std::to_string(c.changed) + " would differ from zero"
                             : std::string("Find weights, once the conflicts nearby are cured");
      case Action::optimize:
        return "Let the free vertices move";
      case Action::move_vertex:
        return "move " + vertex(c.vertex) + " to " + place(c.at);
      case Action::flip_edge:
        return "flip " + edge(c.edge[0], c.edge[1]);
      case Action::insert_vertex:
        return "insert a vertex at " + place(c.at) + ", in triangle " + number_of(c.triangle, names_);
      case Action::split_edge:
      case Action::split_boundary:
        return "split " + edge(c.edge[0], c.edge[1]) + " at " + place(c.at);
      case Action::split_interface:
        return "split " + interface_edge(c.edge[0], c.edge[1]) + " at " + place(c.at) + ", on both sides";
    }
    return {};
  }

  const Mesh& mesh_;
  const InputNames* names_;
};

}  // namespace

ReasonWords reason_words(const Mesh& mesh, const Reason& reason, const InputNames* names) {
  return Speaker(mesh, names).reason(reason);
}

std::string reason_text(const Mesh& mesh, const Reason& reason, const InputNames* names) {
  const ReasonWords words = reason_words(mesh, reason, names);
  return words.what + " " + words.why;
}

std::string cure_text(const Mesh& mesh, const Cure& cure, const InputNames* names) {
  return Speaker(mesh, names).cure(cure);
}

}  // namespace temper
