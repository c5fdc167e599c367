// Traces, certificates and layers, as the program reads them: what is read is checked and done again.
#include <algorithm>
#include <vector>

#include "exit.hpp"
#include "files/trace_jsonl.hpp"
#include "target.hpp"
#include "temper/detail/certificate_io.hpp"
#include "temper/detail/dec_io.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"

namespace temper::fuzz {
namespace {

using app::Input;

/// A random mesh, through a file, as the program has it.
const Input& input() {
  static const Scratch scratch;
  static const Input kInput = [] {
    const auto mesh = random_mesh({.vertices = 12, .seed = 3});
    insist(mesh.has_value(), "an example is made");
    insist(io::write(scratch.path("m.vtu"), io::from_mesh(*mesh)).has_value(), "and written");
    return app::read_input(scratch.path("m.vtu"));
  }();
  return kInput;
}

/// work, of which the only way to fail is a message with an exit code for bad input.
template <class Work>
void survive(Work work) {
  try {
    work();
  } catch (const app::Failure& failure) {
    insist(failure.what()[0] != '\0' && failure.exit == app::Exit::bad_input, "bad input is told");
  }
}

void read_certificate(std::string_view bytes) {
  const auto read = [](std::string_view text) {
    return app::or_fail(io::certificate_from_json(text, input().loaded.vertex_of_point, "c.json"));
  };
  survive([&] {
    const io::AnyCertificate any = read(bytes);
    if (const auto* const proof = std::get_if<ConnectivityProof>(&any)) {
      static_cast<void>(check_proof(input().mesh(), *proof));
      static_cast<void>(read(io::certificate_to_json(*proof, input().points)));
      return;
    }
    const auto& certificate = std::get<Certificate>(any);
    static_cast<void>(check_certificate(input().mesh(), certificate));
    static_cast<void>(read(io::certificate_to_json(certificate, input().points)));
  });
}

void read_trace(std::string_view bytes) {
  static const Scratch scratch;
  survive([&] {
    const app::Trace trace = app::read_trace(scratch.make("t.jsonl", bytes), input());
    const auto replayed = replay_with_vertices(input().mesh(), trace.events, input().names.get());
    if (!replayed) return insist(!replayed.error().message.empty(), "an error has a message");
    static_cast<void>(app::is_end_of(trace.end, replayed->mesh));
  });
}

void read_layers(std::string_view bytes) {
  static const Scratch scratch;
  const Mesh& mesh = input().mesh();
  static const DecComplex complex = dec_operators(mesh);
  static const CellPolygons cells = cell_polygons(mesh, complex);
  const auto layers = io::read_layers(scratch.make("l.csv", bytes), input().file, input().loaded);
  if (!layers) return insist(!layers.error().message.empty(), "an error has a message");
  const auto made = columns(mesh, complex, cells, *layers);
  if (!made) return insist(!made.error().message.empty(), "an error has a message");
  for (const double volume : made->volumes) insist(volume >= 0, "volumes are numbers");
}

std::vector<std::string> certificates() {
  Certificate certificate;
  const Mesh& mesh = input().mesh();
  const auto [p, q, r] = mesh.corners(TriangleId(0));
  certificate.terms.push_back({{WeightConstraint::Kind::height, p, q, r}, 0.25});
  certificate.terms.push_back({{WeightConstraint::Kind::crossing, q, p, VertexId()}, 1.5});
  Certificate of_duals;
  of_duals.constraints = Constraints::regular;
  of_duals.margin = kRefutedDual;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_edge_representative(h) || mesh.is_boundary(h)) continue;
    of_duals.terms.push_back(
        {{WeightConstraint::Kind::dual, mesh.origin(h), mesh.target(h), mesh.opposite(h), mesh.opposite(mesh.twin(h))},
         0.5});
  }
  ConnectivityProof proof;
  proof.lemmas.push_back({.edges = {{std::min(p, r), std::max(p, r)}}, .terms = certificate.terms});
  proof.lemmas.push_back({.edges = {}, .side = {p, q}, .cases = {{r, 0}}});
  return {io::certificate_to_json(certificate, input().points), io::certificate_to_json(of_duals, input().points),
          io::certificate_to_json(proof, input().points)};
}

std::vector<std::string> traces() {
  std::vector<std::string> all;
  OptimizeOptions with_removals = *options_for("paper");
  with_removals.max_sweeps = 2;
  for (const OptimizeOptions& options : {OptimizeOptions{.max_sweeps = 3}, with_removals}) {
    std::string text = app::trace_header(input());
    std::size_t n = 0;
    OptimizeHooks hooks;
    hooks.tracer = [&](const TraceEvent& event) {
      text += app::trace_line(event, input());
      ++n;
    };
    Mesh mesh = input().mesh();
    if (optimize(mesh, options, hooks)) all.push_back(text + app::trace_end(n, mesh, input()));
  }
  return all;
}

}  // namespace

std::vector<Target> program_file_targets() {
  return {{"certificate", read_certificate, certificates},
          {"trace", read_trace, traces},
          {"layers", read_layers, [] {
             return std::vector<std::string>{
                 "vertex,top,bottom 1,bottom 2,active 1,active 2\n*,3,2,1,1,1\n# c\n4,,2.5,nan,,0\n",
                 "vertex,top,bottom\n*,1e3,0\n"};
           }}};
}

}  // namespace temper::fuzz
