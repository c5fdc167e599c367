// TetMesh::build: from arrays to a mesh, or to the first error in them.
#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "mesh/blocks.hpp"
#include "mesh/exact_range.hpp"
#include "temper/tets/mesh.hpp"
#include "tets/mesh/embedding.hpp"
#include "tets/mesh/input_errors.hpp"
#include "tets/mesh/rebuild.hpp"
#include "tets/mesh/tables.hpp"

namespace temper::tets {
namespace {

// Within these bounds nothing over- or underflows in the exact predicates (geometry.hpp), in the user's units and after
// scaling to an extent of about 1.
constexpr double kLargestCoordinate = 1e35;
constexpr double kSmallestCoordinate = 1e-35;  // absolute, and relative to the largest coordinate

VertexId id(std::int32_t i) { return VertexId(static_cast<std::size_t>(i)); }

std::optional<InputError> check_sizes(const TetMeshInput& in) {
  const std::size_t n = in.points.size(), m = in.tetrahedra.size();
  if (n == 0) return InputError{ErrorCode::empty_input, {}, "the mesh has no points. Next: give points and tetrahedra"};
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
  for (const Pair& p : {Pair{in.weights.size(), n, "weights", "points", true},
                        Pair{in.regions.size(), m, "regions", "tetrahedra", true},
                        Pair{in.face_tags.size(), in.faces.size(), "tags", "faces", false},
                        Pair{in.line_tags.size(), in.lines.size(), "tags", "lines", false},
                        Pair{in.point_tags.size(), in.marked_points.size(), "tags", "marked points", false}}) {
    if (p.have == p.want || (p.may_be_empty && p.have == 0)) continue;
    return InputError{ErrorCode::size_mismatch,
                      {},
                      quantity(p.have, p.what) + " given for " + quantity(p.want, p.of) + ". Next: give one for each" +
                          (p.may_be_empty ? ", or none" : "")};
  }
  return std::nullopt;
}

std::string cure(const ExactRange& range, double found) {
  return std::string(". Next: ") +
         (std::abs(found) > range.high ? "choose a larger unit of length" : "write smaller numbers as 0");
}

std::optional<InputError> check_scale(const TetMesh& mesh, double largest, const InputErrors& errors) {
  const ExactRange range = {kSmallestCoordinate * std::min(largest, kLargestCoordinate), kLargestCoordinate};
  for (const VertexId v : mesh.vertices()) {
    const auto [x, y, z, w] = mesh.point(v);
    if (!range.allows(x) || !range.allows(y) || !range.allows(z))
      return errors.at(ErrorCode::out_of_scale, v,
                       errors.name(v) + " has coordinates " + coordinates({x, y, z}) + "; " + range.text() +
                           cure(range, std::max({std::abs(x), std::abs(y), std::abs(z)})));
    if (!range.squared().allows(w))
      return errors.at(
          ErrorCode::out_of_scale, v,
          errors.name(v) + " has weight " + to_text(w) + "; " + range.squared().text() + cure(range.squared(), w));
  }
  return std::nullopt;
}

/// Looks for two points at one place, in a hash table.
std::optional<std::array<VertexId, 2>> find_duplicate(const TetMesh& mesh) {
  const std::size_t n = mesh.n_vertices(), slots = std::bit_ceil(2 * n);
  std::vector<VertexId> table(slots);
  const auto hash = [&](Vec3 p) {
    std::uint64_t h = 0;
    for (const double x : {p.x, p.y, p.z})
      h = (std::rotl(h, 23) ^ std::bit_cast<std::uint64_t>(x + 0.0)) * 0x9e3779b97f4a7c15U;  // −0 is 0
    return static_cast<std::size_t>(h >> 32) & (slots - 1);
  };
  for (const VertexId v : mesh.vertices()) {
    const Vec3 p = mesh.position(v);
    std::size_t slot = hash(p);
    for (; table[slot].valid(); slot = (slot + 1) & (slots - 1)) {
      if (mesh.position(table[slot]) == p) return std::array{table[slot], v};
    }
    table[slot] = v;
  }
  return std::nullopt;
}

using Sides = std::vector<FaceBuckets::Side>;

/// The first side of the face after the one that starts at i.
std::size_t end_of_face(const Sides& sides, std::size_t i) {
  std::size_t end = i + 1;
  while (end < sides.size() && sides[end].same_face(sides[i])) ++end;
  return end;
}

/// Two halffaces are the sides of one face if their vertices turn in opposite directions.
bool turn_alike(const TetMesh& mesh, HalffaceId g, HalffaceId h) {
  const auto a = mesh.vertices(g), b = mesh.vertices(h);
  const auto after = [](const std::array<VertexId, 3>& face, VertexId v) {
    return face[0] == v ? face[1] : face[1] == v ? face[2] : face[0];
  };
  return a[1] == after(b, a[0]);
}

std::optional<InputError> wrong_repetition(const TetMesh& mesh, const std::vector<TetId>& tetrahedra,
                                           const InputErrors& errors) {
  const auto sorted = [&](TetId t) {
    auto corners = mesh.corners(t);
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  for (std::size_t i = 0; i < tetrahedra.size(); ++i) {
    for (std::size_t j = i + 1; j < tetrahedra.size(); ++j) {
      const TetId s = tetrahedra[i], t = tetrahedra[j];
      if (sorted(s) != sorted(t)) continue;
      return errors.at(ErrorCode::overlap, t,
                       errors.name(t) + " repeats " + errors.name(s) + ": both have the corners " +
                           errors.numbers(sorted(t)) + errors.near(sorted(t)) + ". Next: remove one of them");
    }
  }
  return std::nullopt;
}

InputError crowded_face(const TetMesh& mesh, HalffaceId h, const std::vector<TetId>& tetrahedra,
                        const InputErrors& errors) {
  std::vector<std::string> all;
  all.reserve(tetrahedra.size());
  for (const TetId t : tetrahedra) all.push_back(last_word(errors.name(t)));
  const auto corners = mesh.vertices(h);
  return errors.at(ErrorCode::non_manifold_face, tetrahedra.back(),
                   "the face of points " + errors.numbers(corners) + " belongs to " +
                       quantity(all.size(), "tetrahedra (") + enumerated(all) + ")" + errors.near(corners) +
                       "; expected at most 2. Next: mesh this place again");
}

}  // namespace

/// The steps of TetMesh::build, in order. Each returns an error or nothing.
class TetMeshBuilder {
 public:
  explicit TetMeshBuilder(const TetMeshInput& input) : in_(input), errors_(input) {}

  Expected<BuiltTetMesh> build() {
    using Step = std::optional<InputError> (TetMeshBuilder::*)();
    constexpr Step kSteps[] = {&TetMeshBuilder::check_sizes,    &TetMeshBuilder::add_vertices,
                               &TetMeshBuilder::add_tetrahedra, &TetMeshBuilder::find_incident,
                               &TetMeshBuilder::check_places,   &TetMeshBuilder::link_twins,
                               &TetMeshBuilder::tag_faces,      &TetMeshBuilder::embed,
                               &TetMeshBuilder::tag_lines,      &TetMeshBuilder::tag_points};
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
  std::optional<InputError> check_sizes() { return tets::check_sizes(in_); }

  [[nodiscard]] bool is_point(std::int32_t i) const {
    return i >= 0 && static_cast<std::size_t>(i) < in_.points.size();
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
      if (!wrong.empty())
        return errors_.at(ErrorCode::not_finite, VertexId(i), errors_.name(VertexId(i)) + " has " + wrong);
      mesh_.set_point(VertexId(i), {p.x, p.y, p.z, w});
      largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    return check_scale(mesh_, largest, errors_);
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
      return errors_.at(ErrorCode::index_out_of_range, t,
                        errors_.name(t) + " uses point index " + std::to_string(i) + ", but there are " +
                            quantity(in_.points.size(), "points") + ". Next: count points from 0");
    }
    for (std::size_t k = 1; k < 4; ++k) {
      for (std::size_t j = 0; j < k; ++j) {
        if (in[j] == in[k])
          return errors_.at(ErrorCode::zero_volume, t,
                            errors_.name(t) + " is flat: it uses " + errors_.name(id(in[k])) +
                                " more than once. Next: remove it from the mesh");
        if (in_.points[id(in[j]).index] == in_.points[id(in[k]).index])
          return duplicate(std::min(id(in[j]), id(in[k])), std::max(id(in[j]), id(in[k])));
      }
    }
    const std::array<VertexId, 4> corners = {id(in[0]), id(in[1]), id(in[2]), id(in[3])};
    return errors_.at(ErrorCode::zero_volume, t,
                      errors_.name(t) + " is flat: its corners " + errors_.numbers(corners) + " are in one plane" +
                          errors_.near(corners) + ". Next: remove it from the mesh, or mesh this place again");
  }

  InputError duplicate(VertexId u, VertexId v) const {
    return errors_.at(ErrorCode::duplicate_point, v,
                      errors_.name(u) + " and " + errors_.name(v) + " are both at " + coordinates(in_.points[v.index]) +
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
      return errors_.at(ErrorCode::unused_point, v, errors_.name(v) + " belongs to no tetrahedron. Next: remove it");
    }
    return std::nullopt;
  }

  std::optional<InputError> check_places() {
    const auto found = find_duplicate(mesh_);
    return found ? std::optional(duplicate((*found)[0], (*found)[1])) : std::nullopt;
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
  /// Links the faces of a least vertex. False when one has more than two sides, or two equal ones.
  bool match(const Sides& sides) {
    for (std::size_t i = 0; i < sides.size();) {
      const std::size_t end = end_of_face(sides, i);
      if (end - i > 2 || (end - i == 2 && turn_alike(mesh_, sides[i].halfface, sides[i + 1].halfface))) return false;
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
      if (auto repeated = wrong_repetition(mesh_, tetrahedra, errors_)) return repeated;
      if (end - i > 2) return crowded_face(mesh_, sides[i].halfface, tetrahedra, errors_);
      if (end - i == 2 && turn_alike(mesh_, sides[i].halfface, sides[i + 1].halfface))
        return overlap(sides[i].halfface, tetrahedra[0], tetrahedra[1]);
    }
    return std::nullopt;
  }
  /// If three of four tetrahedra turn in one way, the one of the two that does not is inverted.
  InputError overlap(HalffaceId h, TetId s, TetId t) const {
    const auto corners = mesh_.vertices(h);
    std::string message = errors_.name(s) + " and " + errors_.name(t) +
                          " lie on the same side of their common face of points " + errors_.numbers(corners) +
                          errors_.near(corners);
    const std::size_t reversed = built_.reversed_tetrahedra, others = in_.tetrahedra.size() - reversed;
    TetId at = t;
    if (is_reversed(s) != is_reversed(t) && 4 * std::min(reversed, others) < reversed + others) {
      if (is_reversed(t) == (reversed > others)) at = s;
      message += ": " + errors_.name(at) + " is inverted. Next: move its vertices, so that it turns as most tetrahedra";
    } else {
      message += ". Next: move their vertices, or mesh this place again";
    }
    return errors_.at(ErrorCode::overlap, at, message);
  }

  std::optional<InputError> embed() { return check_embedding(mesh_, edges_.emplace(mesh_, in_.executor), errors_); }

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
  InputErrors errors_;
  BuiltTetMesh built_;
  TetMesh& mesh_ = built_.mesh;
  std::optional<FaceBuckets> faces_;  // from link_twins to tag_faces
  std::optional<EdgeTable> edges_;    // from embed or tag_lines on
};

std::optional<TetMesh> rebuilt(const TetMeshInput& input) { return TetMeshBuilder(input).rebuild(); }

Expected<BuiltTetMesh> TetMesh::build(const TetMeshInput& input) { return TetMeshBuilder(input).build(); }

}  // namespace temper::tets
