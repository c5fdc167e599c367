// temper weights IN -o OUT: weights that make a mesh well-centered as it is, or the reason why there are none.
#include <fmt/format.h>

#include <cmath>

#include "certificate_json.hpp"
#include "console.hpp"
#include "help.hpp"
#include "input.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "projection_option.hpp"
#include "temper/geometry.hpp"
#include "temper/lp.hpp"
#include "temper/optimize.hpp"
#include "weights_report.hpp"

namespace temper::app {
namespace {

enum class Mode { feasible, minimal, elastic, barrier };
constexpr Choice<Mode> kModes[] = {
    {"feasible", Mode::feasible}, {"minimal", Mode::minimal}, {"elastic", Mode::elastic}, {"barrier", Mode::barrier}};
enum class From { zero, input };
constexpr Choice<From> kFrom[] = {{"zero", From::zero}, {"input", From::input}};
enum class Barrier { hard, soft };
constexpr Choice<Barrier> kBarriers[] = {{"BH", Barrier::hard}, {"BP", Barrier::soft}};

struct WeightsSettings {
  std::string projection;
  std::string input, output, certificate, check;
  Mode mode = Mode::minimal;
  From from = From::zero;
  Barrier barrier = Barrier::hard;
  WeightOptions options;
  std::uint64_t whole = WeightOptions().whole;
  bool json = false;
};

void add_options(Command& command, WeightsSettings& s) {
  command.group("Files");
  add_argument(command, "IN", s.input, "the mesh; its content tells the format").require();
  add_projection(command, s.projection);
  add_text(command, "-o,--output", "OUT", s.output, "the mesh with its new weights; not needed with --mode feasible");
  add_text(command, "--certificate", "FILE", s.certificate,
           "write the proof that no weights exist, if so, as JSON (docs/weights.md describes it)");
  add_text(command, "--check-certificate", "FILE", s.check,
           "check such a proof against IN in exact arithmetic, and do nothing else");
  command.add_flag("--json", s.json, "the report as JSON, with vertices and triangles counted from 0");
  command.group("Weights");
  add_choice(command, "--mode", kModes, s.mode,
             "feasible: are there good weights, and with what best margin; minimal: the least change for the margin; "
             "elastic: where there are none, the least violation; barrier: the least barrier energy");
  add_number(command, "--margin", s.options.margin, {0, 0.5, true},
             "the least h/l, d/l and 1 - d/l wanted anywhere; feasible and barrier take half of the best when that "
             "is less");
  add_choice(command, "--from", kFrom, s.from, "the weights that change is measured from: all zero, or those of IN");
  add_choice(command, "--energy", kBarriers, s.barrier, "the energy of --mode barrier");
  add_count(command, "--whole", s.whole, 0,
            "components of more triangles than this are solved around their bad triangles only, as far out as "
            "needed");
  command.group("Help");
  command.add_help({"IN -o OUT [options]",
                    "  temper example annulus -o ring.vtu && temper weights ring.vtu -o out.vtu\n"
                    "  temper weights ring.vtu -o least.vtu --mode barrier\n"
                    "  # a mesh that has none: the proof, its verification, and what gives way\n"
                    "  temper example sparse-horseshoe -o shoe.vtu\n"
                    "  temper weights shoe.vtu --mode feasible --certificate why.json; test $? = 6\n"
                    "  temper weights shoe.vtu --check-certificate why.json\n"
                    "  temper weights shoe.vtu -o out.vtu --mode elastic --json\n",
                    {Exit::done, Exit::bad_input, Exit::bad_usage, Exit::internal, Exit::infeasible}});
}

void check_usage(const Command& command, const WeightsSettings& s) {
  const auto fail = [](const std::string& message) {
    throw Failure(Exit::bad_usage, "weights: " + message + "\nSee temper weights --help");
  };
  if (!s.check.empty()) {
    for (const char* option : {"--output", "--certificate", "--mode", "--margin", "--from", "--energy", "--whole"}) {
      if (command.was_given(option)) fail(fmt::format("--check-certificate takes no {}", option));
    }
  } else if (s.output.empty() && s.mode != Mode::feasible) {
    fail("--output is missing");
  }
  if (s.mode != Mode::barrier && command.was_given("--energy")) fail("--energy is of --mode barrier alone");
}

Exit check(const WeightsSettings& s, const Input& input) {
  const Certificate certificate = read_certificate(s.check, input);
  const CertificateCheck result = check_certificate(input.mesh(), certificate);
  const bool proves = result == CertificateCheck::proves;
  if (s.json) {
    print(fmt::format("{{\"proves\": {}, \"check\": \"{}\"}}\n", proves, name(result)));
  } else if (proves) {
    const std::string what = certificate.margin == 0 ? std::string("make every triangle well-centered")
                                                     : fmt::format("have a margin of {}", certificate.margin);
    print(fmt::format("{} proves it: no weights of {} {}\n", s.check, s.input, what));
  }
  flush_output();
  if (!proves)
    throw Failure(Exit::bad_input, fmt::format("{}: not a proof about {}: {}", s.check, s.input, name(result)));
  return Exit::done;
}

WeightGoal goal_of(Mode mode) {
  switch (mode) {
    case Mode::feasible:
    case Mode::barrier:  // any weights to start from
      return WeightGoal::feasible;
    case Mode::minimal:
      return WeightGoal::minimal;
    case Mode::elastic:
      return WeightGoal::elastic;
  }
  return WeightGoal::minimal;
}

Mesh with_weights(Mesh mesh, const IdVector<VertexId, double>& weights) {
  for (const VertexId v : mesh.vertices()) mesh.set_weight(v, weights[v]);
  return mesh;
}

bool all_well_centered(const Mesh& mesh) {
  for (const TriangleId t : mesh.triangles()) {
    const auto [p, q, r] = mesh.corners(t);
    if (!is_well_centered(mesh.point(p), mesh.point(q), mesh.point(r))) return false;
  }
  return true;
}

/// From good weights to those of least energy; the good ones stay when these are not good.
void lower_energy(const WeightsSettings& s, const Input& input, WeightReport& report) {
  Mesh moving = with_weights(input.mesh(), report.weights);
  OptimizeOptions options;
  options.energy = s.barrier == Barrier::hard ? EnergyKind::BH : EnergyKind::BP;
  options.unknowns = Unknowns::weights;
  options.flips = Flips::none;
  or_fail(optimize(moving, options, {.names = input.names.get()}));
  IdVector<VertexId, double> weights = report.weights;
  for (const VertexId v : moving.vertices()) weights[v] = moving.weight(v);
  const Mesh lowered = with_weights(input.mesh(), weights);
  if (!all_well_centered(lowered)) return;
  report.moved = 0;
  report.change = 0;
  const auto change = [&](VertexId v) { return weights[v] - (s.options.from_input ? input.mesh().weight(v) : 0.0); };
  for (const VertexId v : lowered.vertices()) report.moved += change(v) != 0 ? 1 : 0;
  for (const HalfedgeId h : lowered.halfedges()) {
    if (!lowered.is_edge_representative(h)) continue;
    const VertexId i = lowered.origin(h), j = lowered.target(h);
    report.change += 0.5 * std::abs(change(i) - change(j)) / length(lowered.position(i) - lowered.position(j));
  }
  report.attained = weight_margin(lowered);
  report.weights = std::move(weights);
}

Exit find(const WeightsSettings& s, Input& input, Outputs& outputs) {
  const auto solver = clp_solver();
  WeightReport report = or_fail(find_weights(input.mesh(), *solver, s.options));
  if (s.mode == Mode::barrier && report.solved) lower_energy(s, input, report);

  const bool proved = !report.certificate.terms.empty();
  WeightsRecord record = {kModes[static_cast<std::size_t>(s.mode)].name, s.options.margin, report, input, {}, {}};
  if (report.solved && !s.output.empty()) {
    const Mesh weighted = with_weights(input.mesh(), report.weights);
    const std::size_t known = input.file.warnings.size();
    io::update(input.file, input.loaded, weighted);
    print_warnings(std::span(input.file.warnings).subspan(known));
    print_warnings(outputs.write_mesh(s.output, input.file));
    record.output = s.output;
  }
  if (proved && !s.certificate.empty()) {
    outputs.write_text(s.certificate, certificate_text(report.certificate, input));
    record.certificate = s.certificate;
  }
  print(s.json ? weights_json(record) : weights_text(record));
  return report.solved ? Exit::done : Exit::infeasible;
}

}  // namespace

Exit run_weights(const Arguments& arguments) {
  Command command(
      "weights",
      "Finds weights that make every triangle well-centered, with positions and connectivity as they are; or proves "
      "that there are none.");
  WeightsSettings s;
  add_options(command, s);
  if (!command.parse(arguments)) return Exit::done;
  check_usage(command, s);
  s.options.goal = goal_of(s.mode);
  s.options.from_input = s.from == From::input;
  s.options.whole = s.whole;
  Outputs outputs("weights");
  if (!s.output.empty()) outputs.expect_mesh("--output", s.output);
  outputs.expect_text("--certificate", s.certificate, {s.input});

  Input input = read_input(s.input, {s.projection});
  print_warnings(input.warnings());
  return s.check.empty() ? find(s, input, outputs) : check(s, input);
}

}  // namespace temper::app
