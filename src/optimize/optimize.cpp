// optimize(): checks what it is given, works on a copy, and gives back the best mesh it found.
#include "temper/optimize.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/rng.hpp"
#include "base/text.hpp"
#include "optimize/driver.hpp"
#include "temper/geometry.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

/// The mesh being worked on: in Hilbert order and in its frame, so that the user's stays as it is until the end.
struct WorkingCopy {
  Mesh mesh;
  Frame frame;
  MeshOrder order;

  explicit WorkingCopy(const Mesh& user) : mesh(user), frame(Frame::of(user)), order(hilbert_order(mesh)) {
    frame.enter(mesh);
  }
  [[nodiscard]] VertexId from_user(VertexId v) const {
    const auto found = std::find(order.vertices.begin(), order.vertices.end(), v);
    return VertexId(static_cast<std::size_t>(found - order.vertices.begin()));
  }
  [[nodiscard]] Mesh in_user_terms() && {
    frame.leave(mesh);
    restore_order(mesh, order);
    return std::move(mesh);
  }
};

/// Hidden vertices have no power cell, so no regular triangulation keeps them: the user must know which.
InputError hidden_error(const Mesh& mesh, const std::vector<VertexId>& hidden, const InputNames& names) {
  constexpr std::size_t kNamed = 5;
  std::string list;
  for (std::size_t i = 0; i < std::min(hidden.size(), kNamed); ++i) {
    if (i > 0) list += ", ";
    list += names.point(hidden[i].index) + " (weight " + to_text(mesh.weight(hidden[i])) + ")";
  }
  if (hidden.size() > kNamed) list += " and " + std::to_string(hidden.size() - kNamed) + " more";
  return {ErrorCode::hidden_vertex, hidden.empty() ? std::string() : names.point_where(hidden[0].index),
          "weights hide " + list + "; expected weights that leave every vertex a power cell"};
}

InputError outside_domain_error(const Mesh& mesh, const Settings& settings) {
  return {ErrorCode::invalid_option,
          {},
          "energy " + std::string(settings.energy.name) + " is infinite on this mesh, where " +
              std::to_string(count_bad(mesh, settings.options.executor)) + " of " + std::to_string(mesh.n_triangles()) +
              " triangles are not well-centered; expected a mesh inside its barrier, or energy BP, which needs none"};
}

/// E_BH, and E_BHs with the user's h°, can only stay inside their barrier; the others get in from anywhere.
bool starts_outside_domain(const Mesh& mesh, const Settings& settings) {
  const bool gets_in = settings.energy.softened_by_gamma || (settings.energy.softened_by_h0 && !settings.options.h0);
  return settings.energy.barrier && !gets_in && !std::isfinite(total_energy(mesh, settings.model));
}

/// Moves free vertices by up to `amount` of their shortest edge: symmetric grids are stationary in their positions.
void jitter(Mesh& mesh, const OptimizeOptions& options, const Frame& frame, double amount) {
  if (amount == 0 || options.unknowns == Unknowns::weights || !options.flips) return;
  const Mesh before = mesh;
  const auto mobility = mobilities(mesh, options.interfaces);
  Rng rng(options.seed);
  for (const VertexId v : mesh.vertices()) {
    const Vec2 p = mesh.position(v);
    double shortest2 = kInfinity;
    for (const HalfedgeId h : mesh.star(v)) {
      shortest2 = std::min(shortest2, squared_length(mesh.position(mesh.target(h)) - p));
    }
    const Vec2 away = amount * std::sqrt(shortest2) * Vec2{rng.uniform(-1, 1), rng.uniform(-1, 1)};
    if (mobility[v] != Mobility::free) continue;
    mesh.set_position(v, frame.snap(p + away));
    for (const HalfedgeId h : mesh.star(v)) {
      const auto [a, b, c] = mesh.corners(Mesh::triangle(h));
      if (orient2d(mesh.position(a), mesh.position(b), mesh.position(c)) != Sign::positive) mesh.set_position(v, p);
    }
  }
  if (!restore_regularity(mesh).regular()) mesh = before;
}

/// Whether a is worse than b: regularity first; for a barrier, which is there to make triangles well-centered, their
/// number next; then the energy.
bool is_worse(const Mesh& a, const Mesh& b, const Settings& settings, const EnergyModel& model) {
  const auto standing = [&](const Mesh& mesh) {
    const std::size_t bad = settings.energy.barrier ? count_bad(mesh, settings.options.executor) : 0;
    return std::tuple(count_non_regular_edges(mesh, false), bad, total_energy(mesh, model, settings.options.executor));
  };
  return standing(b) < standing(a);
}

}  // namespace

std::string_view name(Stopped stopped) {
  switch (stopped) {
    case Stopped::converged:
      return "converged";
    case Stopped::max_sweeps:
      return "max_sweeps";
    case Stopped::time_limit:
      return "time_limit";
    case Stopped::cancelled:
      return "cancelled";
  }
  return "unknown";
}

namespace {

constexpr const char* kStillInfinite =
    "the energy is infinite: on some edges weights differ by more than the squared length, and this run could not "
    "change that";
constexpr const char* kNegative =
    "the energy is negative: HOT has no lower bound in the weights; energies T and BP have one";

/// What an attempt starts from.
struct Prepared {
  WorkingCopy work;
  Settings settings;
  std::size_t flips = 0;  ///< that made the input regular
};

Expected<Prepared> prepare(const Mesh& mesh, const OptimizeOptions& options) {
  WorkingCopy work(mesh);
  auto settings = make_settings(options, work.mesh, work.frame);
  if (!settings) return settings.error();
  if (options.anchor) settings->options.anchor = work.from_user(VertexId(*options.anchor)).index;
  Restoration restored;
  if (options.flips) restored = restore_regularity(work.mesh);
  if (!restored.regular()) {
    for (VertexId& v : restored.hidden) v = work.order.vertices[v];
    const InputNames numbers_from_0;
    return hidden_error(mesh, restored.hidden, options.names != nullptr ? *options.names : numbers_from_0);
  }
  if (starts_outside_domain(work.mesh, *settings)) return outside_domain_error(work.mesh, *settings);
  return Prepared{std::move(work), *std::move(settings), restored.flips};
}

}  // namespace

Expected<OptimizeReport> optimize(Mesh& mesh, const OptimizeOptions& options, const Observer& observer) {
  Run run(options, observer);
  OptimizeReport& report = run.report;
  std::optional<Mesh> best;  // of the attempts so far, in the user's terms
  std::span<const Attempt> tries;
  for (std::size_t i = 0; i == 0 || i < tries.size(); ++i) {
    auto start = prepare(mesh, options);
    if (!start) return start.error();
    auto& [work, settings, flips] = *start;
    if (i == 0) tries = attempts(settings.energy, options, work.mesh);
    if (i == 0 && flips > 0) {
      report.flips = flips;
      report.notes.push_back(std::to_string(flips) + (flips == 1 ? " edge" : " edges") +
                             " of the input flipped to make it regular");
    }
    jitter(work.mesh, settings.options, work.frame, tries[i].jitter);
    Driver(work.mesh, settings, work.frame, run).optimize(tries[i], i + 1 < tries.size());

    const EnergyModel model = in_user_units(settings.model, work.frame);
    Mesh result = std::move(work).in_user_terms();
    if (!best || !is_worse(result, *best, settings, model)) best = std::move(result);
    const bool done = count_bad(*best, options.executor) == 0 || report.stopped == Stopped::cancelled ||
                      report.stopped == Stopped::time_limit || !run.sweeps_left() || i + 1 == tries.size();
    if (!done) continue;

    report.initial_energy = total_energy(mesh, model, options.executor);
    if (is_worse(*best, mesh, settings, model)) {
      report.notes.push_back("no better mesh was found: the input is returned as it was");
    } else {
      mesh = *std::move(best);
    }
    report.final_energy = total_energy(mesh, model, options.executor);
    if (!std::isfinite(report.final_energy)) report.notes.push_back(kStillInfinite);
    if (report.final_energy < 0) report.notes.push_back(kNegative);
    report.seconds = run.seconds();
    break;
  }
  return std::move(report);
}

}  // namespace temper
