// Optimization and replay. The module calls functions of JavaScript for progress, events and snapshots.
#include "answer.hpp"
#include "held_mesh.hpp"
#include "records.hpp"
#include "temper/detail/trace.hpp"
#include "temper/optimize.hpp"
#include "temper/solvers.hpp"
#include "tensor.hpp"

namespace temper::wasm {
namespace {

/// Passes on the progress as JSON. The result 0 stops the run.
TEMPER_IMPORT(progress) int report_progress(const char* progress, std::size_t size);
/// Passes on an event of the run as JSON.
TEMPER_IMPORT(trace) void report_event(const char* event, std::size_t size);

/// The mesh between two sweeps, to be looked at until the function returns.
TEMPER_IMPORT(snapshot) void show_snapshot(const HeldMesh* mesh, int sweep);

Continue tell(const Progress& progress) {
  const std::string text = json_of(progress).dump();
  return report_progress(text.data(), text.size()) != 0 ? Continue::yes : Continue::no;
}

}  // namespace

TEMPER_EXPORT(option_table) void answer_option_table() { answer(option_table()); }
TEMPER_EXPORT(presets) void answer_presets() { answer(preset_table()); }

/// The answer is all options of {"target", "effort", "keep"}.
TEMPER_EXPORT(options_for) int options_for_words(const char* words, std::size_t size) {
  return done([&] { answer(to_json(options_from(parse({words, size})))); });
}

/// Optimizes in place, unless an error ends the run. The answer is the report.
TEMPER_EXPORT(mesh_optimize)
int mesh_optimize(HeldMesh* held, const char* run, std::size_t size, int traced, int shown) {
  return done([&] {
    Json given = parse({run, size});
    const std::optional<GivenTensors> tensors = tensors_from(given, held->mesh);
    given.erase("tensor");
    OptimizeOptions options = options_from(given);
    if (tensors) {
      options.tensor = tensors->one;
      options.triangle_tensors = tensors->of_triangles;
      if (!tensors->one) options.corner_weights = held->corner_weights;
    }
    OptimizeHooks hooks;
    hooks.observer = tell;
    hooks.solvers = solvers();
    if (traced != 0) {
      hooks.tracer = [](const TraceEvent& event) {
        const std::string text = json_of(event).dump();
        report_event(text.data(), text.size());
      };
    }
    if (shown != 0) {
      hooks.snapshots = [](const Snapshot& s) {
        if (s.moment != Snapshot::Moment::after_sweep) return;
        const HeldMesh mesh(s.mesh);
        show_snapshot(&mesh, s.sweep);
      };
    }
    Mesh mesh = held->mesh;
    Expected<OptimizeReport> report = optimize(mesh, options, hooks);
    if (!report) throw BadInput{spelled(report.error())};
    held->replace(std::move(mesh), report->vertices, std::move(report->corner_weights));
    answer(json_of(*report));
  });
}

/// Puts a mesh that was made elsewhere in place. `vertices` has the former number of each vertex, −1 for inserted ones;
/// if it is empty, the numbers are the same. The file behind the mesh stays.
TEMPER_EXPORT(mesh_replace)
int mesh_replace(HeldMesh* held, const HeldMesh* other, const std::int32_t* vertices, std::size_t n) {
  return done([&] {
    const std::size_t expected = other->mesh.n_vertices();
    if (n != expected && (n != 0 || expected != held->mesh.n_vertices())) {
      fail(ErrorCode::size_mismatch,
           "vertices: expected " + std::to_string(expected) + " numbers, found " + std::to_string(n));
    }
    IdVector<VertexId, VertexId> former;
    for (std::size_t v = 0; v < n; ++v) {
      former.push_back(vertices[v] < 0 ? VertexId() : VertexId(static_cast<std::size_t>(vertices[v])));
    }
    held->replace(other->mesh, former);
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
