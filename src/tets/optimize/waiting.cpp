#include "tets/optimize/waiting.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "base/sort_unique.hpp"
#include "base/text.hpp"
#include "temper/tets/location.hpp"
#include "tets/optimize/draft.hpp"
#include "tets/optimize/sweeper.hpp"

namespace temper::tets {
namespace {

// Cones are judged by the energy at this γ, as in repairs.
constexpr double kConeGamma = 0.2;

std::string shown(Vec3 p) { return "(" + to_text(p.x) + ", " + to_text(p.y) + ", " + to_text(p.z) + ")"; }

bool is_upright(const TetMesh& mesh, TetId t) {
  const auto& [a, b, c, d] = mesh.corners(t);
  return orientation(mesh.position(a), mesh.position(b), mesh.position(c), mesh.position(d)) == Sign::positive;
}

/// The energy of the cone that fills a cavity.
double energy_of(const TetMesh& mesh, const Filling& filling) {
  const WeightedPoint apex = filling.apex.valid() ? mesh.point(filling.apex) : filling.point;
  double sum = 0;
  for (const HalffaceId h : filling.base(mesh)) {
    const auto [q, r, s] = mesh.vertices(h);
    sum += tetrahedron_energy({mesh.point(q), mesh.point(r), mesh.point(s), apex}, kConeGamma);
  }
  return sum;
}

/// The weight at p that is linear in the tetrahedron.
double interpolated_weight(const TetMesh& mesh, TetId t, Vec3 p) {
  const auto corners = mesh.points(t);
  double sum = 0, total = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    std::array<Vec3, 4> q;
    for (std::size_t i = 0; i < 4; ++i) q.at(i) = i == k ? p : corners.at(i).position();
    const double volume = dot(cross(q[1] - q[0], q[2] - q[0]), q[3] - q[0]);
    sum += volume * corners.at(k).w;
    total += volume;
  }
  return sum / total;
}

class Changing {
 public:
  Changing(const TetMesh& mesh, const temper::InputNames* names)
      : draft_(mesh, IdVector<VertexId, Mobility>(mesh.n_vertices(), Mobility::free)),
        names_(names != nullptr ? *names : from_0_) {}

  std::optional<InputError> make(const WaitingChanges& waiting) {
    if (auto error = check(waiting)) return error;
    if (auto error = move(waiting)) return error;
    for (const auto& [v, w] : waiting.weighed) draft_.mesh.set_weight(v, w);
    if (auto error = remove(waiting.removed)) return error;
    return insert(waiting.inserted);
  }

  ChangedTetrahedra take(std::size_t n_before) && {
    Names& names = draft_.names;
    if (!has_filled_) return {std::move(draft_.mesh)};
    for (VertexId& v : names.vertices) {
      if (v.index >= n_before) v = VertexId();
    }
    return {std::move(draft_.mesh), {std::move(names.vertices), std::move(names.faces), std::move(names.lines)}};
  }

 private:
  [[nodiscard]] InputError error(ErrorCode code, VertexId v, const std::string& message) const {
    return {code, names_.point_where(v.index), names_.point(v.index) + " " + message};
  }
  [[nodiscard]] std::optional<InputError> check(const WaitingChanges& waiting) const;
  std::optional<InputError> move(const WaitingChanges& waiting);
  std::optional<InputError> remove(std::vector<VertexId> names);
  std::optional<InputError> insert(std::span<const Vec3> places);
  [[nodiscard]] std::optional<Filling> without(const Cavities& cavities, VertexId v) const;
  [[nodiscard]] std::optional<Filling> with(const Cavities& cavities, TetId t, Vec3 place) const;
  bool fill(std::span<const Filling> fillings) {
    has_filled_ = true;
    return draft_.fill(fillings);
  }

  Draft draft_;
  temper::InputNames from_0_;
  const temper::InputNames& names_;
  bool has_filled_ = false;
};

std::optional<InputError> Changing::check(const WaitingChanges& waiting) const {
  const auto missing = [&](VertexId v) -> std::optional<InputError> {
    const std::size_t n = draft_.mesh.n_vertices();
    if (v.index < n) return std::nullopt;
    return InputError{
        ErrorCode::index_out_of_range,
        {},
        "vertex " + std::to_string(v.index) + " is not in the mesh; expected numbers below " + std::to_string(n)};
  };
  const auto not_finite = [](const std::string& what) {
    return InputError{ErrorCode::not_finite, {}, what + "; expected finite numbers in the range of exact arithmetic"};
  };
  for (const auto& [v, p] : waiting.moved) {
    if (auto e = missing(v)) return e;
    if (!is_exact({p.x, p.y, p.z, 0})) return not_finite(names_.point(v.index) + " moves to " + shown(p));
  }
  for (const auto& [v, w] : waiting.weighed) {
    if (auto e = missing(v)) return e;
    if (!is_exact_weight(w)) return not_finite(names_.point(v.index) + " gets the weight " + to_text(w));
  }
  for (const VertexId v : waiting.removed) {
    if (auto e = missing(v)) return e;
  }
  for (const Vec3 p : waiting.inserted) {
    if (!is_exact({p.x, p.y, p.z, 0})) return not_finite("a new vertex is at " + shown(p));
  }
  return std::nullopt;
}

std::optional<InputError> Changing::move(const WaitingChanges& waiting) {
  TetMesh& mesh = draft_.mesh;
  for (const auto& [v, p] : waiting.moved) mesh.set_point(v, {p.x, p.y, p.z, mesh.weight(v)});
  if (waiting.moved.empty()) return std::nullopt;
  const VertexStars stars(mesh);
  for (const auto& [v, p] : waiting.moved) {
    const auto link = stars.link(v);
    if (std::ranges::all_of(link, [&](HalffaceId h) { return is_upright(mesh, TetMesh::tetrahedron(h)); })) continue;
    return error(ErrorCode::overlap, v,
                 "cannot move to " + shown(p) +
                     ": a tetrahedron would turn over. Next: move it less far in one update, or remove it and insert "
                     "another one");
  }
  return std::nullopt;
}

/// The best filling of the star of v from one of its neighbors.
std::optional<Filling> Changing::without(const Cavities& cavities, VertexId v) const {
  const TetMesh& mesh = draft_.mesh;
  const auto star = cavities.of_vertex(v);
  if (!star) return std::nullopt;
  std::vector<VertexId> neighbors;
  for (const HalffaceId h : star->faces) {
    for (const VertexId u : mesh.vertices(h)) neighbors.push_back(u);
  }
  sort_unique(neighbors);
  std::optional<Filling> best;
  double least = std::numeric_limits<double>::infinity();
  for (const VertexId u : neighbors) {
    Filling filling{*star, u, {}, v};
    if (!is_valid(mesh, filling)) continue;
    const double energy = energy_of(mesh, filling);
    if (best && !(energy < least)) continue;
    best = std::move(filling);
    least = energy;
  }
  return best;
}

/// Removes vertices, as many at once as share no tetrahedron.
std::optional<InputError> Changing::remove(std::vector<VertexId> names) {
  sort_unique(names);
  while (!names.empty()) {
    const TetMesh& mesh = draft_.mesh;
    const Cavities cavities(mesh);
    IdVector<TetId, std::uint8_t> used(mesh.n_tetrahedra(), 0);
    std::vector<Filling> chosen;
    std::vector<VertexId> later;
    for (const VertexId v : mesh.vertices()) {
      const VertexId name = draft_.names.vertices[v];
      if (!std::ranges::binary_search(names, name)) continue;
      auto filling = without(cavities, v);
      if (!filling)
        return error(ErrorCode::invalid_option, name,
                     "cannot be removed: it is on the boundary, an interface or a tagged part, or its neighbors cannot "
                     "be joined");
      const auto& around = filling->cavity.tetrahedra;
      if (std::ranges::any_of(around, [&](TetId t) { return used[t] != 0; })) {
        later.push_back(name);
        continue;
      }
      for (const TetId t : around) used[t] = 1;
      chosen.push_back(*std::move(filling));
    }
    if (!fill(chosen)) return error(ErrorCode::invalid_option, names.front(), "cannot be removed");
    names = std::move(later);
    sort_unique(names);
  }
  return std::nullopt;
}

/// The best filling with a new vertex at a place in or on t.
std::optional<Filling> Changing::with(const Cavities& cavities, TetId t, Vec3 place) const {
  const TetMesh& mesh = draft_.mesh;
  const WeightedPoint p = {place.x, place.y, place.z, interpolated_weight(mesh, t, place)};
  std::optional<Filling> best;
  double least = std::numeric_limits<double>::infinity();
  const auto judge = [&](const std::optional<Cavity>& cavity) {
    if (!cavity) return;
    Filling filling{*cavity, {}, p, {}};
    if (!is_valid(mesh, filling)) return;
    const double energy =
        energy_of(mesh, filling) / static_cast<double>(std::max<std::size_t>(1, filling.base(mesh).size()));
    if (best && !(energy < least)) return;
    best = std::move(filling);
    least = energy;
  };
  const auto& corners = mesh.corners(t);
  judge(cavities.of_tetrahedron(t));
  for (int f = 0; f < 4; ++f) judge(cavities.of_face(TetMesh::halfface(t, f)));
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) judge(cavities.of_edge(t, corners.at(i), corners.at(j)));
  }
  return best;
}

/// Inserts vertices, as many at once, in order, as share no tetrahedron.
std::optional<InputError> Changing::insert(std::span<const Vec3> places) {
  while (!places.empty()) {
    const TetMesh& mesh = draft_.mesh;
    const Cavities cavities(mesh);
    IdVector<TetId, std::uint8_t> used(mesh.n_tetrahedra(), 0);
    std::vector<Filling> chosen;
    TetId near(0);
    for (const Vec3 place : places) {
      near = find_tetrahedron(mesh, place, near);
      auto filling = with(cavities, near, place);
      const auto& around = filling ? filling->cavity.tetrahedra : std::vector<TetId>();
      if (std::ranges::any_of(around, [&](TetId t) { return used[t] != 0; })) break;
      if (!filling) {
        if (used[near] != 0) break;  // it is on a face of a cavity of this round
        return InputError{ErrorCode::overlap,
                          {},
                          "no vertex can be inserted at " + shown(place) +
                              ": this is outside the mesh, on a part that stays, or at a vertex"};
      }
      for (const TetId t : around) used[t] = 1;
      chosen.push_back(*std::move(filling));
    }
    places = places.subspan(chosen.size());
    if (!fill(chosen))
      return InputError{
          ErrorCode::overlap, {}, "no vertex can be inserted near " + shown(chosen.front().point.position())};
  }
  return std::nullopt;
}

}  // namespace

Expected<ChangedTetrahedra> changed(const TetMesh& mesh, const WaitingChanges& waiting,
                                    const temper::InputNames* names) {
  Changing changing(mesh, names);
  if (auto error = changing.make(waiting)) return *std::move(error);
  return std::move(changing).take(mesh.n_vertices());
}

}  // namespace temper::tets
