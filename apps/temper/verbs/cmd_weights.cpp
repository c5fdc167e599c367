// temper weights IN -o OUT: weights that make a mesh well-centered without other changes, or that satisfy other
// constraints. If none exist, it gives the reason. It also searches for a connectivity with better weights.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <optional>
#include <span>
#include <sstream>
#include <variant>

#include "console.hpp"
#include "files/input.hpp"
#include "files/outputs.hpp"
#include "files/tensor_option.hpp"
#include "help/help.hpp"
#include "options/options.hpp"
#include "reports/reports.hpp"
#include "system/system.hpp"
#include "temper/detail/certificate_io.hpp"
#include "temper/detail/connectivity.hpp"
#include "temper/detail/criterion.hpp"
#include "temper/detail/dec_io.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/detail/lp.hpp"
#include "temper/optimize.hpp"
#include "temper/regularity.hpp"
#include "temper/tets/weights.hpp"
#include "watch.hpp"

namespace temper::app {
namespace {

/// "well-centered" of well_centered.
std::string option_name(Constraints constraints) {
  std::string text(name(constraints));
  std::replace(text.begin(), text.end(), '_', '-');
  return text;
}

constexpr Choice<WeightGoal> kModes[] = {{"margin", WeightGoal::margin},
                                         {"change", WeightGoal::change},
                                         {"elastic", WeightGoal::elastic},
                                         {"center", WeightGoal::center},
                                         {"accuracy", WeightGoal::accuracy, CellKinds::both},
                                         {"least", WeightGoal::least},
                                         {"fewest", WeightGoal::fewest}};
enum class From { zero, input };
constexpr Choice<From> kFrom[] = {{"zero", From::zero}, {"input", From::input}};
/// The schemes: the targets of optimize that lower an offset, for --mode accuracy, and that have constraints.
constexpr Choice<Scheme> kSchemes[] = {{"any", Scheme::all},
                                       {"vertex", Scheme::vertex},
                                       {"cell", Scheme::cell},
                                       {"stars", Scheme::stars, CellKinds::both}};

enum class Connectivity { fixed, search };
constexpr Choice<Connectivity> kConnectivities[] = {{"fixed", Connectivity::fixed},
                                                    {"search", Connectivity::search, CellKinds::triangles}};

constexpr double kSearchLimit = 60;  // of the search over connectivities [s]

constexpr Choice<bool> kFlips[] = {{"none", false}, {"intrinsic", true, CellKinds::surfaces}};

struct WeightsSettings {
  std::string projection;
  Heights heights;
  std::string input, certificate, check;
  MeshOutput output;
  From from = From::zero;
  Scheme scheme = Scheme::all;
  WeightOptions options;
  std::string edges = "all";
  Connectivity connectivity = Connectivity::fixed;
  bool intrinsic_flips = false;
  std::uint64_t whole = WeightOptions().whole, programs = ConnectivityOptions().programs;
  std::optional<double> time_limit;
  TensorOption tensor;
  bool json = false, zero = false;
};

std::span<const ConstraintsInfo> constraints_of(CellKinds kind) {
  return with_subject(kind, [](auto subject) { return decltype(subject)::constraints(); });
}

/// The rows of the first kind of cells, then those that other kinds alone have.
const std::vector<ConstraintsInfo>& all_constraints() {
  static const std::vector<ConstraintsInfo> all = [] {
    std::vector<ConstraintsInfo> rows;
    for (const CellKinds kind : kEachKind) {
      for (const ConstraintsInfo& row : constraints_of(kind)) {
        if (std::ranges::find(rows, row.name, &ConstraintsInfo::name) == rows.end()) rows.push_back(row);
      }
    }
    return rows;
  }();
  return all;
}

/// The cells that have these constraints.
CellKinds cells_of(std::string_view constraints) {
  auto kinds = CellKinds();
  for (const CellKinds kind : kEachKind) {
    for (const ConstraintsInfo& row : constraints_of(kind)) {
      if (option_name(row.constraints) == constraints) kinds = kinds | kind;
    }
  }
  return kinds;
}

const ConstraintsInfo& row_of(std::span<const ConstraintsInfo> rows, Constraints constraints) {
  return *std::ranges::find(rows, constraints, &ConstraintsInfo::constraints);
}

void add_conditions(Command& command, WeightsSettings& s) {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> of_rows;
    for (const ConstraintsInfo& row : all_constraints()) of_rows.push_back(option_name(row.constraints));
    return of_rows;
  }();
  std::string text = "Constraints on the weights, with margin t and ";
  for (const CellKinds kind : kEachKind) {
    if (kind != kEachKind[0] && constraints_of(kind).data() == constraints_of(kEachKind[0]).data()) continue;
    const std::string_view length = with_subject(kind, [](auto subject) { return subject.length_of_constraints; });
    text += kind == kEachKind[0] ? fmt::format("{}.", length) : fmt::format(" For {}, with {}:", name(kind), length);
    for (const ConstraintsInfo& row : constraints_of(kind))
      text += fmt::format(" '{}': {}.", option_name(row.constraints), row.keeps);
  }
  const auto use = [&s](std::string_view chosen) {
    const auto at = std::find(names.begin(), names.end(), chosen);
    s.options.constraints = all_constraints()[static_cast<std::size_t>(at - names.begin())].constraints;
  };
  Option& option = add_name(command, "--constraints", {names.begin(), names.end()}, use, text);
  option.defaults_to([] { return option_name(Constraints::well_centered); });
  option.cells_of = cells_of;
}

void add_files(Command& command, WeightsSettings& s) {
  command.group("Files");
  add_argument(command, "IN", s.input, "Mesh file, of " + any_elements() + ". Its content shows the format.").require();
  add_projection(command, s.projection);
  add_heights(command, s.heights);
  add_mesh_output(command, s.output, "OUT",
                  "Mesh file to write, with the new weights. You may leave it out with --mode margin.");
  add_text(command, "--certificate", "FILE", s.certificate,
           "Write the proof as JSON: that no weights exist, or that the weights of --mode center or accuracy are best. "
           "See docs/reference/formats/certificate.md.");
  add_text(command, "--check-certificate", "FILE", s.check,
           "Only check the proof in FILE against IN, in exact arithmetic.");
  command
      .add_flag("--zero", s.zero,
                "Set all weights to zero, and flip edges until they are Delaunay. Solvers without weights need this.")
      .cells = CellKinds::triangles;
  command.add_flag("--json", s.json, "Print the report as JSON, with vertices and elements counted from 0.");
}

void add_goal(Command& command, WeightsSettings& s) {
  command.group("Weights");
  add_choice(
      command, "--mode", kModes, s.options.goal,
      "Goal of the search. 'margin' tests if good weights exist, and finds the best margin. 'change' makes the least "
      "change that gives the margin. If no weights have the margin, 'elastic' finds the least violation, and 'fewest' "
      "weights with few violations. 'center' "
      "finds the greatest product of all h/l, d/l and 1 - d/l, or of all dual lengths/l. 'accuracy' finds the least "
      "offsets between the midpoints of edges and their duals, with the margin. 'least' finds the least sum of squares "
      "of the changes of d/l, with the margin or a smaller one.");
  add_choice(
      command, "--for", kSchemes, s.scheme,
      "Scheme of the solver, as for optimize. It sets --mode least, and what the scheme needs: --constraints "
      "coefficients for 'vertex', distances for 'cell'. With --mode accuracy it is the scheme whose error falls.");
  add_number(command, "--margin", s.options.margin, {0, 0.5, true},
             "Least h/l, d/l, 1 - d/l or dual length/l in the mesh. With --mode margin or accuracy, half of the best "
             "margin is used if it is less.");
  add_choice(
      command, "--from", kFrom, s.from,
      "Weights from which the change is measured. 'zero' means that all are 0, and 'input' means the weights of IN.");
  add_count(command, "--whole", s.whole, 0,
            "Largest number of " + any_elements() +
                " in a component that is solved as a whole. In larger components, only the elements around bad ones "
                "are solved, as far out as needed.");
}

void add_connectivity(Command& command, WeightsSettings& s) {
  command.group("Constraints and connectivity");
  add_conditions(command, s);
  add_text(command, "--edges", "all|lines|FILE", s.edges,
           "Edges of --constraints regular. 'all' are all edges inside. 'lines' are tagged lines and the edges between "
           "regions. FILE has two vertices per line, numbered as in IN.")
      .cells = CellKinds::triangles;
  add_choice(command, "--connectivity", kConnectivities, s.connectivity,
             "Connectivity of the result. 'fixed' keeps the edges of IN. 'search' looks for edges with a margin, and "
             "flips edges while this raises the best margin. If the mesh is in the plane and has at most "
             "300 vertices, it finds edges that have weights, or proves that no edges have any.");
  add_choice(
      command, "--flips", kFlips, s.intrinsic_flips,
      "Flips of edges of a curved surface. 'intrinsic' flips them on the surface, which stays. No mesh file holds "
      "such edges, so OUT is a folder for arrays: operators.npz has triangles, lengths, weights and operators.");
  add_count(command, "--programs", s.programs, 1, "Largest number of linear programs of the whole mesh in the search.");
  add_number(
      command, "--time-limit", s.time_limit, kNotNegative,
      "Time limit in seconds. temper then writes no weights. But --connectivity search, which has a limit of 60 if "
      "none is given, reports the best bound so far. 0 sets no limit.");
}

void add_options(Command& command, WeightsSettings& s) {
  add_files(command, s);
  add_goal(command, s);
  add_connectivity(command, s);
  add_tensor(command, s.tensor, "Find weights");
  command.group("Help");
  command.add_help(
      {"IN -o OUT [options]",
       "  temper example annulus -o ring.vtu && temper weights ring.vtu -o out.vtu\n"
       "  temper weights ring.vtu -o best.vtu --mode accuracy --for vertex\n"
       "  # what a solver with unknowns in cells needs, and no more\n"
       "  temper weights ring.vtu -o cells.vtu --for cell\n"
       "  temper weights best.vtu -o plain.vtu --zero\n"
       "  temper weights ring.vtu -o inside.vtu --constraints heights-only\n"
       "  # a mesh without such weights: write the proof, check it, and find the least violation\n"
       "  temper example sparse-horseshoe -o shoe.vtu\n"
       "  temper weights shoe.vtu --mode margin --certificate why.json; test $? = 6\n"
       "  temper weights shoe.vtu --check-certificate why.json\n"
       "  temper weights shoe.vtu -o out.vtu --mode elastic --json\n"
       "  # bring orthocenters inside by other diagonals\n"
       "  temper example random --vertices 40 -o random.vtu\n"
       "  temper weights random.vtu -o flipped.vtu --constraints heights-only --connectivity search\n",
       {Exit::done, Exit::bad_input, Exit::bad_usage, Exit::stopped_early, Exit::internal, Exit::infeasible}});
}

/// What a scheme needs, unless other options say so. --mode accuracy takes the factors of the scheme alone.
void follow_scheme(const Command& command, WeightsSettings& s) {
  if (!command.was_given("--for") || s.options.goal == WeightGoal::accuracy) return;
  if (!command.was_given("--mode")) s.options.goal = s.tensor.may_differ() ? WeightGoal::change : WeightGoal::least;
  if (!command.was_given("--constraints"))
    s.options.constraints =
        std::ranges::find(all_constraints(), name(criterion_of(s.scheme)), &ConstraintsInfo::name)->constraints;
}

void check_usage(const Command& command, const WeightsSettings& s) {
  const auto fail = [](const std::string& message) { refuse_usage("weights", message); };
  const auto conflict = [&](const std::string& a, const std::string& b) {
    fail(fmt::format("{} takes no {}. Next: leave one out", a, b));
  };
  const auto lacks = [&](const std::string& option, const std::string& other) {
    fail(fmt::format("{} needs {}. Next: add it, or leave out {}", option, other, option));
  };
  if (!s.check.empty() && s.zero) conflict("--check-certificate", "--zero");
  if (!s.check.empty()) {
    for (const char* option : {"--output", "--certificate", "--mode", "--margin", "--from", "--for", "--whole",
                               "--constraints", "--edges", "--connectivity", "--programs", "--time-limit"}) {
      if (command.was_given(option)) conflict("--check-certificate", option);
    }
  } else if (s.zero) {
    for (const char* option : {"--certificate", "--mode", "--margin", "--from", "--for", "--whole", "--constraints",
                               "--edges", "--connectivity", "--programs", "--time-limit"}) {
      if (command.was_given(option)) conflict("--zero", option);
    }
    if (s.output.path.empty()) fail("--output is missing. Next: -o OUT");
  } else if (s.output.path.empty() && s.options.goal != WeightGoal::margin) {
    fail("--output is missing. Next: -o OUT, or --mode margin");
  }
  for (const char* option : {"--zero", "--connectivity", "--edges"}) {
    if (s.tensor.given() && command.was_given(option)) conflict("--tensor", option);
  }
  const bool regular = s.options.constraints == Constraints::regular, search = s.connectivity == Connectivity::search;
  if (!regular && command.was_given("--edges")) lacks("--edges", "--constraints regular");
  if (!search && command.was_given("--programs")) lacks("--programs", "--connectivity search");
  if (search && regular) {
    fail(
        "--connectivity search has no use with --constraints regular, because flips alone make edges regular. "
        "Next: temper weights IN --zero -o OUT");
  }
  if (s.options.goal == WeightGoal::center && command.was_given("--margin")) conflict("--mode center", "--margin");
  if (!s.intrinsic_flips) return;
  for (const char* option : {"--certificate", "--check-certificate", "--format"}) {
    if (command.was_given(option)) conflict("--flips intrinsic", option);
  }
  if (s.output.path.empty() || s.output.path == "-") fail("--flips intrinsic needs a folder. Next: -o DIR");
}

/// The fault of a certificate, after its name.
std::string_view fault_text(CertificateCheck fault) {
  switch (fault) {
    case CertificateCheck::proves:
      break;
    case CertificateCheck::proves_nothing:
      return "the sum of its terms is no contradiction, or a case is missing";
    case CertificateCheck::not_of_this_mesh:
      return "a term names an element that the mesh does not have, or is not of these constraints";
    case CertificateCheck::bad_multiplier:
      return "its margin is outside [0, 1/2), a multiplier is negative or not finite, or all of them are 0";
    case CertificateCheck::out_of_range:
      return "its numbers are too far apart for exact arithmetic";
  }
  return {};
}

/// Reports the verdict on the certificate of --check-certificate.
Exit report_check(const WeightsSettings& s, const io::AnyCertificate& any, CertificateCheck result,
                  std::span<const ConstraintsInfo> rows) {
  const bool proves = result == CertificateCheck::proves;
  if (s.json) {
    print_data(fmt::format("{{\"schema\": {}, \"proves\": {}, \"check\": \"{}\"}}\n", kSchema, proves, name(result)));
  } else if (proves) {
    const Certificate* const certificate = std::get_if<Certificate>(&any);
    const Constraints constraints =
        certificate ? certificate->constraints : std::get<ConnectivityProof>(any).constraints;
    const ConstraintsInfo& row = row_of(rows, constraints);
    std::string what;
    if (!certificate) {
      what = ", with any connectivity";
    } else if (certificate->margin != 0 && constraints != Constraints::regular) {
      what = fmt::format(" with a margin of {} ({})", certificate->margin, row.keeps);
    }
    print(fmt::format("{} proves it for {}: {}{}\n", s.check, s.input, row.failure, what));
  }
  flush_output();
  if (!proves)
    throw Failure(Exit::bad_input,
                  fmt::format("{}: not a proof about {}: {}. Next: give the mesh for which it was written", s.check,
                              s.input, fault_text(result)));
  return Exit::done;
}

io::AnyCertificate read_certificate(const std::string& path, const io::VertexOfPoint& vertex_of_point,
                                    std::string_view cell) {
  std::ifstream file = open_text(path);
  std::ostringstream text;
  text << file.rdbuf();
  if (!text) throw Failure(Exit::bad_input, path + ": cannot be read, or empty");
  return or_fail(io::certificate_from_json(text.str(), vertex_of_point, path, cell));
}

// These functions differ between the kinds of cells.

Space space_of(const Mesh& mesh) { return mesh.space(); }
template <class SpaceMesh>
Space space_of(const SpaceMesh& /*mesh*/) {
  return {};
}

std::function<TriangleId(const WeightConstraint&)> triangles_of(const Mesh& mesh) {
  return [&mesh](const WeightConstraint& c) { return triangle_of(mesh, c); };
}
std::function<TriangleId(const WeightConstraint&)> triangles_of(const surfaces::SurfaceMesh& mesh) {
  return triangles_of(mesh.connectivity());
}
std::function<TriangleId(const WeightConstraint&)> triangles_of(const tets::TetMesh& /*mesh*/) { return {}; }

CertificateCheck check_of(const WeightsSettings& s, const Mesh& mesh, const ConnectivityProof& proof) {
  if (s.tensor.given())
    throw Failure(Exit::bad_usage, fmt::format("{}: proofs over connectivities are for meshes without tensors. Next: "
                                               "leave out --tensor",
                                               s.check));
  if (mesh.space().is_plane() && !mesh.space().is_periodic()) return check_proof(mesh, proof);
  throw Failure(Exit::bad_input, fmt::format("{}: proofs over connectivities are for meshes of the plane. Next: give "
                                             "the mesh for which it was written",
                                             s.check));
}
template <class SpaceMesh>
CertificateCheck check_of(const WeightsSettings& s, const SpaceMesh& /*mesh*/, const ConnectivityProof& /*proof*/) {
  throw Failure(Exit::bad_input,
                fmt::format("{}: proofs over connectivities are for triangles of the plane alone. Next: give the "
                            "mesh for which it was written",
                            s.check));
}

/// Checks the certificate of a mesh, or of its pieces in metrics.
template <class Subject, class Checked>
Exit check_in(const WeightsSettings& s, const InputOf<Subject>& input, const io::VertexOfPoint& vertices,
              const Checked& mesh) {
  const io::AnyCertificate any = read_certificate(s.check, vertices, Subject::element);
  const auto* const certificate = std::get_if<Certificate>(&any);
  const CertificateCheck found =
      certificate ? check_certificate(mesh, *certificate) : check_of(s, input.mesh(), std::get<ConnectivityProof>(any));
  return report_check(s, any, found, Subject::constraints());
}

template <class Subject>
Exit check(const WeightsSettings& s, const InputOf<Subject>& input) {
  if constexpr (is_flat_subject<Subject>) {
    if (const auto pieces = metric_of(input, s.tensor))
      return check_in(s, input, number_copies(input, *pieces).vertices, *pieces);
  }
  return check_in(s, input, input.loaded.vertex_of_point, input.mesh());
}

/// On the sphere setting a weight rounds the place: only changed weights are set.
template <class AnyMesh>
AnyMesh with_weights(AnyMesh mesh, const IdVector<VertexId, double>& weights) {
  for (const VertexId v : mesh.vertices()) {
    if (mesh.weight(v) != weights[v]) mesh.set_weight(v, weights[v]);
  }
  return mesh;
}

/// The mesh of the input with the requested connectivity.
std::optional<ConnectivityReport> searched(const WeightsSettings& s, const Input& input, LpSolver& solver) {
  if (s.connectivity == Connectivity::fixed) return std::nullopt;
  using Clock = std::chrono::steady_clock;
  const double limit = s.time_limit.value_or(kSearchLimit);
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limit));
  catch_interrupts();
  const auto stop = [&] { return interrupted() || (limit > 0 && Clock::now() >= end); };
  return or_fail(best_connectivity(input.mesh(), solver, {s.options.constraints, s.programs, stop}));
}

/// The weights of a mesh. A signal or the time limit ends the process, unless a search came before, which has its own.
template <class Mesh>
WeightReport found(const WeightsSettings& s, const Mesh& mesh, bool is_searched = false) {
  const std::optional<Watch> watch =
      is_searched ? std::nullopt : std::optional<Watch>(std::in_place, s.time_limit.value_or(0));
  return or_fail(find_weights(mesh, *clp_solver(), s.options, interior_point_solver().get()));
}

/// Puts the mesh back into the file of the input, and writes it.
template <class Subject>
void write_weighted(const WeightsSettings& s, InputOf<Subject>& input, const typename Subject::Mesh& mesh,
                    Outputs& outputs) {
  const std::size_t known = input.file.warnings.size();
  io::update(input.file, input.loaded, mesh);
  print_warnings(std::span(input.file.warnings).subspan(known));
  print_warnings(outputs.write_mesh(s.output, input.file));
}

/// Writes the mesh without weights.
Exit drop(const WeightsSettings& s, Input& input, Outputs& outputs) {
  Mesh mesh = input.mesh();
  std::size_t weighted = 0;
  for (const VertexId v : mesh.vertices()) weighted += mesh.weight(v) != 0 ? 1 : 0;
  const IdVector<VertexId, double> zeros(mesh.n_vertices(), 0.0);
  mesh = with_weights(std::move(mesh), zeros);
  const std::size_t flips = restore_regularity(mesh).flips;
  std::size_t bad = 0;
  for (const TriangleId t : mesh.triangles()) {
    const auto [p, q, r] = mesh.points(t);
    bad += is_well_centered(mesh.space(), p, q, r) ? 0 : 1;
  }
  write_weighted(s, input, mesh, outputs);
  if (s.json) {
    print(fmt::format("{{\"zeroed\": {}, \"flips\": {}, \"bad\": {}}}\n", weighted, flips, bad));
    return Exit::done;
  }
  print(fmt::format("{} set to zero, {} flipped, {} bad (not well-centered)\nwrote {}\n",
                    plural(weighted, "weight", "weights"), plural(flips, "edge", "edges"),
                    plural(bad, "triangle is", "triangles are"), s.output.path));
  return Exit::done;
}

/// Writes the certificate, and reports.
Exit end(const WeightsSettings& s, WeightsRecord& record, Outputs& outputs) {
  const WeightReport& report = record.report;
  if (!s.certificate.empty() && record.search && !record.search->proof.lemmas.empty()) {
    outputs.write_text(s.certificate, io::certificate_to_json(record.search->proof, record.points));
    record.certificate = s.certificate;
  } else if (!s.certificate.empty() && (report.optimality || !report.certificate.terms.empty())) {
    outputs.write_text(s.certificate,
                       report.optimality
                           ? io::optimality_to_json(report, record.space, record.points)
                           : io::certificate_to_json(report.certificate, record.numbers.points, record.numbers.copies));
    record.certificate = s.certificate;
  }
  s.json ? print_data(weights_json(record)) : print(weights_text(record));
  if (record.report.solved) return Exit::done;
  return record.search && record.search->end == SearchEnd::stopped ? Exit::stopped_early : Exit::infeasible;
}

/// The record of a search for weights of `mesh`.
template <class Subject>
WeightsRecord record_of(const WeightsSettings& s, const InputOf<Subject>& input, const typename Subject::Mesh& mesh,
                        const WeightReport& report, const ConnectivityReport* search) {
  return {kModes[static_cast<std::size_t>(s.options.goal)].name,
          s.options,
          row_of(Subject::constraints(), s.options.constraints),
          report,
          input.path,
          mesh_size(mesh),
          space_of(mesh),
          input.points,
          [&](const WeightConstraint& c) { return constraint_text(c, input, mesh); },
          triangles_of(mesh),
          search,
          {},
          {},
          {input.points, {}, {}}};
}

/// Finds weights in the planes of tensors.
template <class Subject>
Exit find_in_metric(const WeightsSettings& s, InputOf<Subject>& input, Outputs& outputs) {
  typename Subject::Pieces pieces =
      in_metric(input.mesh(), tensors_of(s.tensor, input), io::corner_weights_of(input.file, input.loaded), input);
  const WeightReport report = found(s, pieces);
  InputOf<Subject> named = input;
  name_copies(named, pieces);
  WeightsRecord record = record_of(s, named, pieces.mesh, report, nullptr);
  record.numbers = number_copies(input, pieces);
  if (report.solved && !s.output.path.empty()) {
    pieces.mesh = with_weights(std::move(pieces.mesh), report.weights);
    const typename Subject::WholeMesh whole = or_fail(mapped_back(pieces, input.mesh(), pieces));
    io::update(input.file, input.loaded, whole.mesh);
    io::set_corner_weights(input.file, whole.corner_weights);
    print_warnings(outputs.write_mesh(s.output, input.file));
    record.output = s.output.path;
  }
  return end(s, record, outputs);
}

/// Finds weights of `mesh`. The mesh comes from the input, or from `search`, which is null without a search.
template <class Subject>
Exit find(const WeightsSettings& s, InputOf<Subject>& input, const typename Subject::Mesh& mesh,
          const ConnectivityReport* search, Outputs& outputs) {
  const WeightReport report = found(s, mesh, search != nullptr);
  WeightsRecord record = record_of(s, input, mesh, report, search);
  if (report.solved && !s.output.path.empty()) {
    write_weighted(s, input, with_weights(mesh, report.weights), outputs);
    record.output = s.output.path;
  }
  return end(s, record, outputs);
}

/// Faces on lines need the weights that they have.
void refuse_faces(const Input& input) {
  const Mesh& mesh = input.mesh();
  for (const VertexId v : mesh.vertices()) {
    if (!mesh.is_frozen(v)) continue;
    throw Failure(Exit::bad_input, input.path +
                                       ": faces of the mesh lie on lines, and other weights would move them. Next: "
                                       "temper optimize, which keeps them, or leave out --output");
  }
}

Exit run(WeightsSettings& s, Input& input, Outputs& outputs) {
  if (!s.output.path.empty()) refuse_faces(input);
  if (s.tensor.given()) return find_in_metric(s, input, outputs);
  if (s.zero) return drop(s, input, outputs);
  if (s.options.constraints == Constraints::regular) s.options.edges = prescribed_edges(s.edges, input);
  const std::optional<ConnectivityReport> search = searched(s, input, *clp_solver());
  return search ? find(s, input, search->mesh, &*search, outputs) : find(s, input, input.mesh(), nullptr, outputs);
}
/// Flips on the surface, finds weights, and writes arrays.
Exit find_intrinsic(const WeightsSettings& s, const SurfaceInput& input, Outputs& outputs) {
  surfaces::IntrinsicMesh mesh(input.mesh());
  const surfaces::IntrinsicWeights found = [&] {
    const Watch watch(s.time_limit.value_or(0));
    return or_fail(find_intrinsic_weights(mesh, *clp_solver(), s.options, interior_point_solver().get()));
  }();
  WeightsRecord record = record_of(s, input, input.mesh(), found.report, nullptr);
  record.text = [&](const WeightConstraint& c) { return constraint_text(c, input, mesh); };
  record.triangle = triangles_of(mesh.connectivity());
  record.intrinsic = &found;
  if (found.report.solved) {
    or_fail(io::write_dec(s.output.path, mesh, dec_operators(mesh), input.points));
    record.output = s.output.path;
  }
  return end(s, record, outputs);
}

Exit run(WeightsSettings& s, SurfaceInput& input, Outputs& outputs) {
  if (s.intrinsic_flips) return find_intrinsic(s, input, outputs);
  return find(s, input, input.mesh(), nullptr, outputs);
}
Exit run(const WeightsSettings& s, TetInput& input, Outputs& outputs) {
  if (s.tensor.given()) return find_in_metric(s, input, outputs);
  return find(s, input, input.mesh(), nullptr, outputs);
}

}  // namespace

Exit run_weights(const Arguments& arguments) {
  Command command(
      "weights",
      "Finds weights that make every " + any_element() +
          " well-centered, or proves that there are none. Positions and connectivity stay. With --constraints, weights "
          "bring orthocenters inside or make edges regular instead. With --connectivity search, it looks for a better "
          "connectivity first.");
  WeightsSettings s;
  add_options(command, s);
  if (!command.parse(arguments)) return Exit::done;
  follow_scheme(command, s);
  check_usage(command, s);
  const SchemeWeights factors = scheme_weights(s.scheme);
  s.options.offset_factor = factors.offset_factor;
  s.options.boundary_offset_factor = factors.boundary_offset_factor;
  s.options.from_input = s.from == From::input;
  s.options.whole = s.whole;
  Outputs outputs("weights");
  const bool writes_mesh = !s.output.path.empty() && !s.intrinsic_flips;
  if (writes_mesh) outputs.expect_mesh(s.output, {s.edges});
  outputs.expect_text("--certificate", s.certificate, {s.input, s.edges});

  AnyInput any = read_any(command, s.input, {s.projection, {}, nullptr, s.heights});
  return std::visit(
      [&](auto& input) {
        if (writes_mesh) outputs.expect_place(s.output, input.file);
        print_warnings(input.warnings());
        return s.check.empty() ? run(s, input, outputs) : check(s, input);
      },
      any);
}

}  // namespace temper::app
