// Algorithm 1 of the paper on one screen: sweeps over the vertices until the energy no longer falls.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/sum.hpp"
#include "base/text.hpp"
#include "optimize/frame.hpp"
#include "optimize/settings.hpp"
#include "optimize/vertex_step.hpp"
#include "temper/geometry.hpp"
#include "temper/optimize.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

constexpr std::size_t kVerticesBetweenCalls = 8192;  // of the observer and the clock: a few milliseconds

using Clock = std::chrono::steady_clock;

std::size_t count_bad(const Mesh& mesh, Executor* executor) {
  return static_cast<std::size_t>(blockwise_sum(mesh.n_triangles(), executor, [&](std::size_t i) {
    const auto [p, q, r] = mesh.corners(TriangleId(i));
    return is_well_centered(mesh.point(p), mesh.point(q), mesh.point(r)) ? 0.0 : 1.0;
  }));
}

class Driver {
 public:
  Driver(Mesh& mesh, Settings& settings, const Frame& frame, const Observer& observer)
      : mesh_(mesh),
        settings_(settings),
        energy_unit_(std::pow(frame.scale, settings_.energy.length_exponent)),
        observer_(observer),
        step_(mesh, settings_, frame),
        start_(Clock::now()) {}

  OptimizeReport run() {
    record(0, 0);
    best_energy_ = report_.history[0].energy;
    report_.stopped = Stopped::max_sweeps;
    for (int sweep = 0; sweep < settings_.options.max_sweeps; ++sweep) {
      const bool softened = soften(sweep);
      const double before = total();
      const bool whole = improve_all_vertices(sweep);
      // Collapse, removal and insertion of vertices go here: they change the mesh between sweeps, never within one.
      shift_weights_to_anchor();
      record(sweep + 1, step_.flips() + restore_deferred_flips());
      keep_if_best();
      if (!whole) break;  // stopped by the caller or the clock
      if (!softened && converged(before, report_.history.back().energy)) {
        report_.stopped = Stopped::converged;
        break;
      }
    }
    return_best();
    report_.seconds = elapsed();
    return std::move(report_);
  }

 private:
  /// γ or h° of this sweep. True when it will change again: the energies of two sweeps then do not compare.
  bool soften(int sweep) {
    if (settings_.energy.softened_by_gamma) {
      settings_.model.gamma = settings_.gamma.at(sweep);
      return settings_.gamma.at(sweep + 1) != settings_.model.gamma;
    }
    if (settings_.energy.softened_by_h0 && settings_.h0_follows_mesh && sweep > 0) {
      constexpr double kSettled = 0.01;  // a relative change that moves no minimum by more
      const Softening last = settings_.model.h0;
      settings_.model.h0 = next_h0(mesh_, last);
      return settings_.model.h0.value < (1 - kSettled) * last.value;
    }
    return false;
  }

  /// One Gauss-Seidel sweep. False when it was cut short.
  bool improve_all_vertices(int sweep) {
    step_.begin_sweep(sweep);
    const std::size_t n = mesh_.n_vertices();
    for (const VertexId v : mesh_.vertices()) {
      if (v.index % kVerticesBetweenCalls == 0 &&
          asked_to_stop(static_cast<double>(v.index) / static_cast<double>(n))) {
        return false;
      }
      step_.improve(v);
    }
    return true;
  }

  bool asked_to_stop(double fraction) {
    if (settings_.options.time_limit > 0 && elapsed() > settings_.options.time_limit) {
      report_.stopped = Stopped::time_limit;
      return true;
    }
    if (observer_ && observer_({report_.history.back(), fraction, settings_.options.max_sweeps}) == Continue::no) {
      report_.stopped = Stopped::cancelled;
      return true;
    }
    return false;
  }

  /// Line 17 of Algorithm 1. Equal shifts of all weights change no energy and, but for their rounding, no edge.
  void shift_weights_to_anchor() {
    if (!settings_.options.anchor) return;
    const double shift = mesh_.weight(VertexId(*settings_.options.anchor));
    for (const VertexId v : mesh_.vertices()) mesh_.set_weight(v, mesh_.weight(v) - shift);
    if (settings_.options.flips) report_.flips += restore_regularity(mesh_).flips;
  }

  /// Line 20 of Algorithm 1, at the end of each sweep.
  std::size_t restore_deferred_flips() {
    if (!settings_.options.flips || settings_.options.flip_timing == FlipTiming::immediate) return 0;
    return restore_regularity(mesh_).flips;
  }

  [[nodiscard]] bool converged(double before, double after) const {
    const double fall = before - after;
    if (settings_.options.stopping == StoppingRule::paper) {
      return fall < settings_.options.tolerance * static_cast<double>(mesh_.n_triangles());
    }
    return fall <= settings_.options.tolerance * std::abs(after);
  }

  /// HOT energies need not fall at every flip: the best sweep is kept. A barrier's does, once γ has settled.
  void keep_if_best() {
    const double energy = report_.history.back().energy;
    if (settings_.energy.barrier || !(energy < best_energy_)) return;
    best_ = mesh_;
    best_energy_ = energy;
  }

  void return_best() {
    report_.final_energy = report_.history.back().energy;
    if (!best_ || !(best_energy_ < report_.final_energy)) return;
    mesh_ = *std::move(best_);
    report_.final_energy = best_energy_;
    report_.notes.push_back("the energy rose in the last sweeps; the mesh with the least one is returned");
  }

  [[nodiscard]] double total() const {
    return energy_unit_ * total_energy(mesh_, settings_.model, settings_.options.executor);
  }
  [[nodiscard]] double elapsed() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  void record(int sweep, std::size_t flips) {
    SweepRecord r;
    r.sweep = sweep;
    r.energy = total();
    r.bad = count_bad(mesh_, settings_.options.executor);
    r.flips = flips;
    r.softening = settings_.energy.softened_by_h0 ? settings_.model.h0.value : settings_.model.gamma.value;
    r.seconds = elapsed();
    report_.flips += flips;
    report_.sweeps = sweep;
    report_.history.push_back(r);
  }

  Mesh& mesh_;
  Settings& settings_;
  double energy_unit_;  // the user's energy of one unit in the frame
  const Observer& observer_;
  VertexStep step_;
  std::optional<Mesh> best_;  // of HOT energies: the best sweep, when it was better than the input
  double best_energy_ = 0;
  Clock::time_point start_;
  OptimizeReport report_;
};

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

/// Hidden vertices have no power cell, so no regular triangulation keeps them: the user must know which.
InputError hidden_error(const Mesh& mesh, const std::vector<VertexId>& hidden, const InputNames& names) {
  constexpr std::size_t kNamed = 5;
  std::string list;
  for (std::size_t i = 0; i < std::min(hidden.size(), kNamed); ++i) {
    list += (i > 0 ? ", " : "") + names.point(hidden[i].index) + " (weight " + to_text(mesh.weight(hidden[i])) + ")";
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

/// Whether a is worse than b: for a barrier, which is there to make triangles well-centered, by their number first.
bool is_worse(const Mesh& a, const Mesh& b, const Settings& settings, const EnergyModel& model) {
  const auto standing = [&](const Mesh& mesh) {
    const std::size_t bad = settings.energy.barrier ? count_bad(mesh, settings.options.executor) : 0;
    return std::pair(bad, total_energy(mesh, model, settings.options.executor));
  };
  return standing(b) < standing(a);
}

}  // namespace

Expected<OptimizeReport> optimize(Mesh& mesh, const OptimizeOptions& options, const Observer& observer) {
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
  // E_BH and E_BHs can only stay inside their barrier; E_BP gets in from anywhere.
  if (settings->energy.barrier && !settings->energy.softened_by_gamma &&
      !std::isfinite(total_energy(work.mesh, settings->model))) {
    return outside_domain_error(work.mesh, *settings);
  }

  OptimizeReport report = Driver(work.mesh, *settings, work.frame, observer).run();

  report.flips += restored.flips;
  if (restored.flips > 0) {
    report.notes.push_back(std::to_string(restored.flips) + " edges of the input were flipped to make it regular");
  }
  Mesh result = std::move(work).in_user_terms();
  const EnergyModel model = in_user_units(settings->model, work.frame);
  report.initial_energy = total_energy(mesh, model, options.executor);
  if (is_worse(result, mesh, *settings, model)) {
    report.final_energy = report.initial_energy;
    report.notes.push_back("no better mesh was found: the input is returned as it was");
  } else {
    mesh = std::move(result);
  }
  return report;
}

}  // namespace temper
