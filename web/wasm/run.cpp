// Optimisation and replay. JavaScript hears of progress and events by two functions that it gives to the module.
#include "answer.hpp"
#include "held_mesh.hpp"
#include "records.hpp"
#include "temper/optimize.hpp"
#include "temper/trace.hpp"

namespace temper::wasm {
namespace {

#define TEMPER_IMPORT(name) extern "C" __attribute__((import_module("temper"), import_name(#name)))

/// The sweep that is done, as JSON; 0 stops the run.
TEMPER_IMPORT(progress) int tell_progress(const char* record, std::size_t size, double fraction, int max_sweeps);
/// An event of the run, as JSON.
TEMPER_IMPORT(trace) void tell_event(const char* event, std::size_t size);

Continue tell(const Progress& progress) {
  const std::string record = to_json(progress.last).dump();
  return tell_progress(record.data(), record.size(), progress.fraction, progress.max_sweeps) != 0 ? Continue::yes
                                                                                                  : Continue::no;
}

}  // namespace

TEMPER_EXPORT(option_table) void answer_option_table() { answer(option_table()); }
TEMPER_EXPORT(methods) void answer_methods() { answer(method_table()); }

/// In place, whatever ends the run but an error. The answer is the report.
TEMPER_EXPORT(mesh_optimize)
int mesh_optimize(HeldMesh* held, const char* options, std::size_t size, int traced) {
  return done([&] {
    const OptimizeOptions given = options_from(parse({options, size}));
    OptimizeHooks hooks;
    hooks.observer = tell;
    if (traced != 0) {
      hooks.tracer = [](const TraceEvent& event) {
        const std::string text = to_json(event).dump();
        tell_event(text.data(), text.size());
      };
    }
    Mesh mesh = held->mesh;
    const Expected<OptimizeReport> report = optimize(mesh, given, hooks);
    if (!report) throw BadInput{spelled(report.error())};
    held->replace(std::move(mesh), report->vertices);
    answer(to_json(*report));
  });
}

/// Another mesh: the input after these events, a JSON array. The answer is {"vertices"}.
TEMPER_EXPORT(mesh_replay) HeldMesh* mesh_replay(const HeldMesh* input, const char* events, std::size_t size) {
  return guarded<HeldMesh*>(nullptr, [&] {
    std::vector<TraceEvent> trace;
    for (const Json& event : parse({events, size})) trace.push_back(event_from(event));
    Replay again = or_fail(replay_with_vertices(input->mesh, trace));
    Json vertices = Json::array();
    for (const VertexId v : again.vertices) vertices.push_back(number(v));
    auto result = std::make_unique<HeldMesh>(*input);
    result->replace(std::move(again.mesh), again.vertices);
    answer(Json{{"vertices", vertices}});
    return result.release();
  });
}

}  // namespace temper::wasm
