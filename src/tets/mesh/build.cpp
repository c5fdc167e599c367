// TetMesh::build: from arrays to a mesh, or to the first error in them.
#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "base/sort_unique.hpp"
#include "base/text.hpp"
#include "mesh/blocks.hpp"
#include "mesh/exact_range.hpp"
#include "temper/tets/mesh.hpp"
#include "tets/mesh/rebuild.hpp"
#include "tets/mesh/tables.hpp"

namespace temper::tets {
namespace {

// Within these bounds nothing over- or underflows in the exact predicates (geometry.hpp), in the user's units and after
// scaling to an extent of about 1.
constexpr double kLargestCoordinate = 1e35;
constexpr double kSmallestCoordinate = 1e-35;  // absolute, and relative to the largest coordinate

VertexId id(std::int32_t i) { return VertexId(static_cast<std::size_t>(i)); }

/// "a, b and c"
std::string enumerated(const std::vector<std::string>& names) {
  std::string result;
  for (std::size_t i = 0; i < names.size(); ++i)
    result += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return result;
}

/// Disjoint sets of corners, by the least corner of each.
class CornerSets {
 public:
  explicit CornerSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0U); }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t i, std::uint32_t j) {
    i = find(i), j = find(j);
    if (i != j) parent_[std::max(i, j)] = std::min(i, j);
  }
  [[nodiscard]] bool is_least(std::uint32_t i) const { return parent_[i] == i; }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace

/// The steps of TetMesh::build, in order. Each returns an error or nothing.
class TetMeshBuilder {
 public:
  explicit TetMeshBuilder(const TetMeshInput& input)
      : in_(input), names_(input.names != nullptr ? *input.names : default_) {}

  Expected<BuiltTetMesh> build() {
    using Step = std::optional<InputError> (TetMeshBuilder::*)();
    constexpr Step kSteps[] = {
        &TetMeshBuilder::check_sizes,   &TetMeshBuilder::add_vertices,   &TetMeshBuilder::add_tetrahedra,
        &TetMeshBuilder::find_incident, &TetMeshBuilder::check_places,   &TetMeshBuilder::link_twins,
        &TetMeshBuilder::tag_faces,     &TetMeshBuilder::check_stars,    &TetMeshBuilder::check_edges,
        &TetMeshBuilder::tag_lines,     &TetMeshBuilder::check_vertices, &TetMeshBuilder::tag_points};
    for (const Step step : kSteps) {
      if (auto error = (this->*step)()) return *std::move(error);
    }
    return std::move(built_);
  }
  std::optional<TetMesh> rebuild() {
    if (add_vertices() || add_tetrahedra() || built_.reversed_tetrahedra > 0) return std::nullopt;
    if (find_incident() || link_twins() || tag_faces() || tag_lines() || tag_points()) return std::nullopt;
    return std::move(mesh_);
  }

 private:
  using Sides = std::vector<FaceBuckets::Side>;
  static constexpr double kRounded = 1e-6;  // of a whole turn or sphere: above the rounding of a thousand angles

  [[nodiscard]] bool is_point(std::int32_t i) const {
    return i >= 0 && static_cast<std::size_t>(i) < in_.points.size();
  }
  [[nodiscard]] std::string name(VertexId v) const { return names_.point(v.index); }
  [[nodiscard]] std::string name(TetId t) const { return names_.tetrahedron(t.index); }
  template <class Corners>
  [[nodiscard]] std::string numbers(const Corners& corners) const {
    std::vector<std::string> all;
    all.reserve(corners.size());
    for (const VertexId v : corners) all.push_back(last_word(name(v)));
    return enumerated(all);
  }
  /// ", near (0.5, 0, 1)": the centroid of corners.
  template <class Corners>
  [[nodiscard]] std::string near(const Corners& corners) const {
    Vec3 sum;
    for (const VertexId v : corners) sum = sum + in_.points[v.index];
    const Vec3 p = 1.0 / static_cast<double>(corners.size()) * sum;
    return ", near (" + rounded(p.x, 6) + ", " + rounded(p.y, 6) + ", " + rounded(p.z, 6) + ")";
  }
  [[nodiscard]] InputError error_of(ErrorCode code, TetId t, const std::string& message) const {
    return {code, names_.tetrahedron_where(t.index), message};
  }
  [[nodiscard]] InputError error_of(ErrorCode code, VertexId v, const std::string& message) const {
    return {code, names_.point_where(v.index), message};
  }

  std::optional<InputError> check_sizes() {
    const std::size_t n = in_.points.size(), m = in_.tetrahedra.size();
    if (n == 0)
      return InputError{ErrorCode::empty_input, {}, "the mesh has no points. Next: give points and tetrahedra"};
    if (m == 0) return InputError{ErrorCode::empty_input, {}, "the mesh has no tetrahedra. Next: give their corners"};
    if (m >= HalffaceId::kInvalid / 6)
      return InputError{ErrorCode::unsupported,
                        {},
                        "the mesh has " + quantity(m, "tetrahedra") + "; expected less than " +
                            std::to_string(HalffaceId::kInvalid / 6) + ". Next: mesh more coarsely, or in parts"};
    struct Pair {
      std::size_t have, want;
      const char *what, *of;
      bool may_be_empty;
    };
    for (const Pair& p : {Pair{in_.weights.size(), n, "weights", "points", true},
                          Pair{in_.regions.size(), m, "regions", "tetrahedra", true},
                          Pair{in_.face_tags.size(), in_.faces.size(), "tags", "faces", false},
                          Pair{in_.line_tags.size(), in_.lines.size(), "tags", "lines", false},
                          Pair{in_.point_tags.size(), in_.marked_points.size(), "tags", "marked points", false}}) {
      if (p.have == p.want || (p.may_be_empty && p.have == 0)) continue;
      return InputError{ErrorCode::size_mismatch,
                        {},
                        quantity(p.have, p.what) + " given for " + quantity(p.want, p.of) +
                            ". Next: give one for each" + (p.may_be_empty ? ", or none" : "")};
    }
    return std::nullopt;
  }

  std::optional<InputError> add_vertices() {
    const std::size_t n = in_.points.size();
    mesh_.places_.resize(n);
    double largest = 1;
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3 p = in_.points[i];
      const double w = in_.weights.empty() ? 0.0 : in_.weights[i];
      const std::string wrong =
          !std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)
              ? "coordinates " + coordinates(p) + ", expected finite numbers. Next: give its place"
          : !std::isfinite(w) ? "weight " + to_text(w) + ", expected a finite number. Next: 0 stands for no weight"
                              : std::string();
      if (!wrong.empty()) return error_of(ErrorCode::not_finite, VertexId(i), name(VertexId(i)) + " has " + wrong);
      mesh_.set_point(VertexId(i), {p.x, p.y, p.z, w});
      largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    const ExactRange range = {kSmallestCoordinate * std::min(largest, kLargestCoordinate), kLargestCoordinate};
    for (const VertexId v : mesh_.vertices()) {
      const auto [x, y, z, w] = mesh_.point(v);
      if (!range.allows(x) || !range.allows(y) || !range.allows(z))
        return error_of(ErrorCode::out_of_scale, v,
                        name(v) + " has coordinates " + coordinates({x, y, z}) + "; " + range.text() +
                            cure(range, std::max({std::abs(x), std::abs(y), std::abs(z)})));
      if (!range.squared().allows(w))
        return error_of(
            ErrorCode::out_of_scale, v,
            name(v) + " has weight " + to_text(w) + "; " + range.squared().text() + cure(range.squared(), w));
    }
    return std::nullopt;
  }
  static std::string cure(const ExactRange& range, double found) {
    return std::string(". Next: ") +
           (std::abs(found) > range.high ? "choose a larger unit of length" : "write smaller numbers as 0");
  }

  std::optional<InputError> add_tetrahedra() {
    const std::size_t m = in_.tetrahedra.size();
    mesh_.corners_.resize(m);
    mesh_.twins_.resize(4 * m);
    const auto wrong = first_index(m, in_.executor, [&](std::size_t t) { return !add_tetrahedron(t); });
    if (wrong) return wrong_tetrahedron(*wrong);
    for (const TetId t : mesh_.tetrahedra()) built_.reversed_tetrahedra += is_reversed(t) ? 1 : 0;
    for (std::size_t t = 0; t < in_.regions.size(); ++t) mesh_.set_region(TetId(t), in_.regions[t]);
    return std::nullopt;
  }
  /// Adds a tetrahedron. False when it cannot be one.
  bool add_tetrahedron(std::size_t t) {
    const auto& in = in_.tetrahedra[t];
    if (!std::all_of(in.begin(), in.end(), [&](std::int32_t i) { return is_point(i); })) return false;
    const auto at = [&](std::size_t k) { return in_.points[static_cast<std::size_t>(in[k])]; };
    const Sign sign = orientation(at(0), at(1), at(2), at(3));
    auto& corners = mesh_.corners_[TetId(t)];
    corners = {id(in[0]), id(in[1]), id(in[2]), id(in[3])};
    if (sign == Sign::negative) std::swap(corners[2], corners[3]);
    return sign != Sign::zero;
  }
  [[nodiscard]] bool is_reversed(TetId t) const { return mesh_.corners(t)[2] != id(in_.tetrahedra[t.index][2]); }

  InputError wrong_tetrahedron(std::size_t index) const {
    const TetId t(index);
    const auto& in = in_.tetrahedra[index];
    for (const std::int32_t i : in) {
      if (is_point(i)) continue;
      return error_of(ErrorCode::index_out_of_range, t,
                      name(t) + " uses point index " + std::to_string(i) + ", but there are " +
                          quantity(in_.points.size(), "points") + ". Next: count points from 0");
    }
    for (std::size_t k = 1; k < 4; ++k) {
      for (std::size_t j = 0; j < k; ++j) {
        if (in[j] == in[k])
          return error_of(
              ErrorCode::zero_volume, t,
              name(t) + " is flat: it uses " + name(id(in[k])) + " more than once. Next: remove it from the mesh");
        if (in_.points[id(in[j]).index] == in_.points[id(in[k]).index])
          return duplicate(std::min(id(in[j]), id(in[k])), std::max(id(in[j]), id(in[k])));
      }
    }
    const std::array<VertexId, 4> corners = {id(in[0]), id(in[1]), id(in[2]), id(in[3])};
    return error_of(ErrorCode::zero_volume, t,
                    name(t) + " is flat: its corners " + numbers(corners) + " are in one plane" + near(corners) +
                        ". Next: remove it from the mesh, or mesh this place again");
  }

  InputError duplicate(VertexId u, VertexId v) const {
    return error_of(ErrorCode::duplicate_point, v,
                    name(u) + " and " + name(v) + " are both at " + coordinates(in_.points[v.index]) +
                        "; expected distinct points. Next: join them with temper convert IN --merge 0 -o OUT");
  }

  /// A tetrahedron at each vertex.
  std::optional<InputError> find_incident() {
    mesh_.incident_.resize(mesh_.n_vertices());
    for (const TetId t : mesh_.tetrahedra()) {
      for (const VertexId v : mesh_.corners(t)) mesh_.incident_[v] = t;
    }
    for (const VertexId v : mesh_.vertices()) {
      if (mesh_.incident(v).valid()) continue;
      return error_of(ErrorCode::unused_point, v, name(v) + " belongs to no tetrahedron. Next: remove it");
    }
    return std::nullopt;
  }

  /// Looks for two points at one place, in a hash table.
  std::optional<InputError> check_places() {
    const std::size_t n = in_.points.size(), slots = std::bit_ceil(2 * n);
    std::vector<VertexId> table(slots);
    const auto hash = [&](Vec3 p) {
      std::uint64_t h = 0;
      for (const double x : {p.x, p.y, p.z})
        h = (std::rotl(h, 23) ^ std::bit_cast<std::uint64_t>(x + 0.0)) * 0x9e3779b97f4a7c15U;  // −0 is 0
      return static_cast<std::size_t>(h >> 32) & (slots - 1);
    };
    for (const VertexId v : mesh_.vertices()) {
      const Vec3 p = mesh_.position(v);
      std::size_t slot = hash(p);
      for (; table[slot].valid(); slot = (slot + 1) & (slots - 1)) {
        if (mesh_.position(table[slot]) == p) return duplicate(table[slot], v);
      }
      table[slot] = v;
    }
    return std::nullopt;
  }

  std::optional<InputError> link_twins() {
    const FaceBuckets& buckets = faces_.emplace(mesh_);
    const auto wrong = first_index_by(mesh_.n_vertices(), in_.executor, [&] {
      return [&, sides = Sides()](std::size_t v) mutable {
        buckets.collect(VertexId(v), sides);
        return !match(sides);
      };
    });
    if (wrong) {
      Sides sides;
      buckets.collect(VertexId(*wrong), sides);
      return wrong_face(sides);
    }
    return std::nullopt;
  }
  /// The first side of the face after the one that starts at i.
  static std::size_t end_of_face(const Sides& sides, std::size_t i) {
    std::size_t end = i + 1;
    while (end < sides.size() && sides[end].same_face(sides[i])) ++end;
    return end;
  }
  /// Two halffaces are the sides of one face if their vertices turn in opposite directions.
  [[nodiscard]] bool turn_alike(HalffaceId g, HalffaceId h) const {
    const auto a = mesh_.vertices(g), b = mesh_.vertices(h);
    const auto after = [](const std::array<VertexId, 3>& face, VertexId v) {
      return face[0] == v ? face[1] : face[1] == v ? face[2] : face[0];
    };
    return a[1] == after(b, a[0]);
  }
  /// Links the faces of a least vertex. False when one has more than two sides, or two equal ones.
  bool match(const Sides& sides) {
    for (std::size_t i = 0; i < sides.size();) {
      const std::size_t end = end_of_face(sides, i);
      if (end - i > 2 || (end - i == 2 && turn_alike(sides[i].halfface, sides[i + 1].halfface))) return false;
      mesh_.twins_[sides[i].halfface] = end - i == 2 ? sides[i + 1].halfface : HalffaceId();
      if (end - i == 2) mesh_.twins_[sides[i + 1].halfface] = sides[i].halfface;
      i = end;
    }
    return true;
  }
  std::optional<InputError> wrong_face(const Sides& sides) const {
    for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
      end = end_of_face(sides, i);
      std::vector<TetId> tetrahedra;
      for (std::size_t k = i; k < end; ++k) tetrahedra.push_back(TetMesh::tetrahedron(sides[k].halfface));
      if (auto repeated = wrong_repetition(tetrahedra)) return repeated;
      if (end - i > 2) return crowded_face(sides[i].halfface, tetrahedra);
      if (end - i == 2 && turn_alike(sides[i].halfface, sides[i + 1].halfface))
        return overlap(sides[i].halfface, tetrahedra[0], tetrahedra[1]);
    }
    return std::nullopt;
  }
  std::optional<InputError> wrong_repetition(const std::vector<TetId>& tetrahedra) const {
    const auto sorted = [&](TetId t) {
      auto corners = mesh_.corners(t);
      std::sort(corners.begin(), corners.end());
      return corners;
    };
    for (std::size_t i = 0; i < tetrahedra.size(); ++i) {
      for (std::size_t j = i + 1; j < tetrahedra.size(); ++j) {
        const TetId s = tetrahedra[i], t = tetrahedra[j];
        if (sorted(s) != sorted(t)) continue;
        return error_of(ErrorCode::overlap, t,
                        name(t) + " repeats " + name(s) + ": both have the corners " + numbers(sorted(t)) +
                            near(sorted(t)) + ". Next: remove one of them");
      }
    }
    return std::nullopt;
  }
  InputError crowded_face(HalffaceId h, const std::vector<TetId>& tetrahedra) const {
    std::vector<std::string> all;
    all.reserve(tetrahedra.size());
    for (const TetId t : tetrahedra) all.push_back(last_word(name(t)));
    const auto corners = mesh_.vertices(h);
    return error_of(ErrorCode::non_manifold_face, tetrahedra.back(),
                    "the face of points " + numbers(corners) + " belongs to " + quantity(all.size(), "tetrahedra (") +
                        enumerated(all) + ")" + near(corners) + "; expected at most 2. Next: mesh this place again");
  }
  /// If three of four tetrahedra turn in one way, the one of the two that does not is inverted.
  InputError overlap(HalffaceId h, TetId s, TetId t) const {
    const auto corners = mesh_.vertices(h);
    std::string message = name(s) + " and " + name(t) + " lie on the same side of their common face of points " +
                          numbers(corners) + near(corners);
    const std::size_t reversed = built_.reversed_tetrahedra, others = in_.tetrahedra.size() - reversed;
    TetId at = t;
    if (is_reversed(s) != is_reversed(t) && 4 * std::min(reversed, others) < reversed + others) {
      if (is_reversed(t) == (reversed > others)) at = s;
      message += ": " + name(at) + " is inverted. Next: move its vertices, so that it turns as most tetrahedra";
    } else {
      message += ". Next: move their vertices, or mesh this place again";
    }
    return error_of(ErrorCode::overlap, at, message);
  }

  /// The link of a vertex consists of a triangle for each tetrahedron there, an edge for each face, and a vertex for
  /// each edge. It is a sphere or a disk if it is connected across its edges and its Euler characteristic is 2, or 1
  /// with a boundary: each pinch and each handle would lower this number.
  std::optional<InputError> check_stars() {
    const EdgeTable& edges = edges_.emplace(mesh_, in_.executor);
    CornerSets sets(mesh_.n_halffaces());
    IdVector<VertexId, std::int32_t> doubled(mesh_.n_vertices(), 0);  // twice the Euler characteristic
    boundary_.resize(mesh_.n_vertices());
    for (const HalffaceId h : mesh_.halffaces()) {
      const HalffaceId other = mesh_.twin(h);
      // A tetrahedron adds 1 to each of its corners, and half of each of its three faces there subtracts 1/2. A face on
      // the boundary has no other half.
      doubled[mesh_.opposite(h)] += 2;
      for (const VertexId v : mesh_.vertices(h)) {
        doubled[v] -= other.valid() ? 1 : 2;
        if (!other.valid()) boundary_[v] = 1;
        if (other.valid() && h < other) sets.join(corner(h, v), corner(other, v));
      }
    }
    IdVector<VertexId, std::uint32_t> parts(mesh_.n_vertices(), 0);
    for (const VertexId v : mesh_.vertices()) {
      doubled[v] += 2 * static_cast<std::int32_t>(edges.greater(v).size());
      for (const VertexId u : edges.greater(v)) doubled[u] += 2;
    }
    for (const HalffaceId h : mesh_.halffaces()) parts[mesh_.opposite(h)] += sets.is_least(h.index) ? 1 : 0;
    for (const VertexId v : mesh_.vertices()) {
      if (parts[v] != 1 || doubled[v] != (boundary_[v] != 0 ? 2 : 4)) return wrong_star(v);
    }
    return std::nullopt;
  }
  /// The corner at v of the tetrahedron of h has the number of the halfface opposite it.
  [[nodiscard]] std::uint32_t corner(HalffaceId h, VertexId v) const {
    return mesh_.halfface_opposite(TetMesh::tetrahedron(h), v).index;
  }
  InputError wrong_star(VertexId v) const {
    std::vector<VertexId> neighbors;
    for (const TetId t : mesh_.tetrahedra()) {
      const auto& corners = mesh_.corners(t);
      if (std::find(corners.begin(), corners.end(), v) == corners.end()) continue;
      for (const VertexId u : corners) {
        if (u != v) neighbors.push_back(u);
      }
    }
    sort_unique(neighbors);
    for (const VertexId u : neighbors) {
      if (n_parts({v, u}) < 2) continue;
      return error_of(ErrorCode::non_manifold_edge, v,
                      "the mesh touches itself along the edge from " + name(v) + " to " + name(u) +
                          ": its tetrahedra are not one fan around it" + near(std::array{v, u}) +
                          ". Next: separate or join its parts there");
    }
    return error_of(ErrorCode::non_manifold_vertex, v,
                    "the mesh touches itself at " + name(v) +
                        ": its tetrahedra are not one ball or half ball around it, at " +
                        coordinates(mesh_.position(v)) + ". Next: separate or join its parts there");
  }
  /// The number of parts, connected across faces that have both vertices, of the tetrahedra that have both.
  [[nodiscard]] std::size_t n_parts(std::array<VertexId, 2> edge) const {
    const auto has_both = [&](const auto& corners) {
      return std::count(corners.begin(), corners.end(), edge[0]) +
                 std::count(corners.begin(), corners.end(), edge[1]) ==
             2;
    };
    std::vector<TetId> left;
    for (const TetId t : mesh_.tetrahedra()) {
      if (has_both(mesh_.corners(t))) left.push_back(t);
    }
    std::size_t parts = 0;
    while (!left.empty()) {
      ++parts;
      std::vector<TetId> part = {left.back()};
      left.pop_back();
      for (std::size_t i = 0; i < part.size(); ++i) {
        for (int f = 0; f < 4; ++f) {
          const HalffaceId h = TetMesh::halfface(part[i], f), other = mesh_.twin(h);
          if (!other.valid() || !has_both(mesh_.vertices(h))) continue;
          const auto next = std::find(left.begin(), left.end(), TetMesh::tetrahedron(other));
          if (next == left.end()) continue;
          part.push_back(*next);
          left.erase(next);
        }
      }
    }
    return parts;
  }

  /// The dihedral angles at an inner edge add up to 2 π times its number of turns. If an inner vertex is covered once,
  /// so are its edges. So only edges between vertices of the boundary are looked at.
  std::optional<InputError> check_edges() {
    const EdgeTable& edges = *edges_;
    struct Part {
      std::uint32_t edge;
      TetId tetrahedron;
      double angle;
    };
    std::vector<Part> parts;
    for (const TetId t : mesh_.tetrahedra()) {
      const auto& c = mesh_.corners(t);
      for (const auto& [i, j, k, l] : kEdgeCorners) {
        const VertexId a = c[std::size_t(i)], b = c[std::size_t(j)];
        if (boundary_[a] == 0 || boundary_[b] == 0) continue;
        parts.push_back({*edges.find(a, b), t,
                         dihedral_angle(mesh_.position(a), mesh_.position(b), mesh_.position(c[std::size_t(k)]),
                                        mesh_.position(c[std::size_t(l)]))});
      }
    }
    std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
      return a.edge != b.edge ? a.edge < b.edge : a.tetrahedron < b.tetrahedron;
    });
    for (std::size_t i = 0, end = 0; i < parts.size(); i = end) {
      double turns = 0;
      for (end = i; end < parts.size() && parts[end].edge == parts[i].edge; ++end)
        turns += parts[end].angle / (2 * std::numbers::pi);
      if (turns > 1 + kRounded) return wrong_turns(parts[i].tetrahedron, parts[i].edge, turns);
    }
    return std::nullopt;
  }
  InputError wrong_turns(TetId t, std::uint32_t edge, double turns) const {
    const auto& c = mesh_.corners(t);
    const auto found = std::find_if(kEdgeCorners.begin(), kEdgeCorners.end(), [&](const auto& e) {
      return edges_->find(c[std::size_t(e[0])], c[std::size_t(e[1])]) == edge;
    });
    const std::array<VertexId, 2> ends = {c[std::size_t((*found)[0])], c[std::size_t((*found)[1])]};
    return error_of(ErrorCode::overlap, t,
                    "the tetrahedra around the edge from " + name(ends[0]) + " to " + name(ends[1]) +
                        " overlap: together they make " + rounded(turns, 3) + " turns around it" + near(ends) +
                        ". Next: mesh this place again");
  }

  /// The solid angles at an inner vertex add up to 4 π times the number of layers on top of each other.
  std::optional<InputError> check_vertices() {
    constexpr double kSphere = 4 * std::numbers::pi;
    IdVector<VertexId, double> angle(mesh_.n_vertices(), 0);
    for (const TetId t : mesh_.tetrahedra()) {
      const auto& c = mesh_.corners(t);
      std::array<Vec3, 4> p;
      for (std::size_t k = 0; k < 4; ++k) p[k] = mesh_.position(c[k]);
      angle[c[0]] += solid_angle(p[0], p[1], p[2], p[3]);
      angle[c[1]] += solid_angle(p[1], p[2], p[0], p[3]);
      angle[c[2]] += solid_angle(p[2], p[0], p[1], p[3]);
      angle[c[3]] += solid_angle(p[3], p[0], p[2], p[1]);
    }
    for (const VertexId v : mesh_.vertices()) {
      const double most = boundary_[v] != 0 ? (1 + kRounded) * kSphere : 1.5 * kSphere;
      if (angle[v] <= most) continue;
      return error_of(ErrorCode::overlap, v,
                      "the tetrahedra around " + name(v) + " overlap: together they fill " +
                          rounded(100 * angle[v] / kSphere) + " % of the sphere around " +
                          coordinates(mesh_.position(v)) + ". Next: mesh this place again");
    }
    return std::nullopt;
  }

  std::optional<InputError> tag_faces() {
    Sides sides;
    for (std::size_t i = 0; i < in_.faces.size(); ++i) {
      const auto& in = in_.faces[i];
      HalffaceId found;
      if (is_point(in[0]) && is_point(in[1]) && is_point(in[2])) {
        std::array<VertexId, 3> corners = {id(in[0]), id(in[1]), id(in[2])};
        std::sort(corners.begin(), corners.end());
        faces_->collect(corners[0], sides);
        for (const auto& side : sides) {
          if (side.middle != corners[1] || side.greatest != corners[2]) continue;
          if (!found.valid() || turns_as(side.halfface, in)) found = side.halfface;
        }
      }
      if (found.valid())
        mesh_.faces_.push_back({found, in_.face_tags[i]});
      else
        built_.dangling_faces.push_back(i);
    }
    faces_.reset();
    return std::nullopt;
  }
  [[nodiscard]] bool turns_as(HalffaceId h, const std::array<std::int32_t, 3>& face) const {
    const auto [a, b, c] = mesh_.vertices(h);
    return b == (a == id(face[0]) ? id(face[1]) : a == id(face[1]) ? id(face[2]) : id(face[0]));
  }
  std::optional<InputError> tag_lines() {
    if (!edges_ && !in_.lines.empty()) edges_.emplace(mesh_, in_.executor);
    for (std::size_t i = 0; i < in_.lines.size(); ++i) {
      const auto [a, b] = in_.lines[i];
      if (is_point(a) && is_point(b) && edges_->find(id(a), id(b)))
        mesh_.lines_.push_back({{id(a), id(b)}, in_.line_tags[i]});
      else
        built_.dangling_lines.push_back(i);
    }
    edges_.reset();
    return std::nullopt;
  }
  std::optional<InputError> tag_points() {
    for (std::size_t i = 0; i < in_.marked_points.size(); ++i) {
      const std::int32_t p = in_.marked_points[i];
      if (!is_point(p)) return no_point("marked", p);
      mesh_.points_.push_back({id(p), in_.point_tags[i]});
    }
    for (const std::int32_t p : in_.fixed_points) {
      if (!is_point(p)) return no_point("fixed", p);
      mesh_.fixed_.push_back(id(p));
    }
    return std::nullopt;
  }
  [[nodiscard]] InputError no_point(const std::string& what, std::int32_t p) const {
    return {ErrorCode::index_out_of_range,
            {},
            "a " + what + " point has index " + std::to_string(p) + ", but there are " +
                quantity(in_.points.size(), "points") + ". Next: count points from 0"};
  }

  const TetMeshInput& in_;
  InputNames default_;
  const InputNames& names_;
  BuiltTetMesh built_;
  TetMesh& mesh_ = built_.mesh;
  std::optional<FaceBuckets> faces_;           // from link_twins to tag_faces
  std::optional<EdgeTable> edges_;             // from check_stars or tag_lines on
  IdVector<VertexId, std::uint8_t> boundary_;  // from check_stars on
};

std::optional<TetMesh> rebuilt(const TetMeshInput& input) { return TetMeshBuilder(input).rebuild(); }

Expected<BuiltTetMesh> TetMesh::build(const TetMeshInput& input) { return TetMeshBuilder(input).build(); }

}  // namespace temper::tets
