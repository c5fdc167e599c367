// temper paper replay IN TRACE -o OUT: repeats the events of a trace, and writes the mesh that temper optimize wrote.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <string_view>

#include "console.hpp"
#include "files/input.hpp"
#include "files/outputs.hpp"
#include "files/trace_jsonl.hpp"
#include "options/options.hpp"
#include "reports/reports.hpp"
#include "temper/detail/trace.hpp"
#include "verbs/paper.hpp"

namespace temper::app {
namespace {

struct ReplaySettings {
  std::string projection;
  Heights heights;
  std::string input, trace;
  MeshOutput output;
  std::optional<int> sweeps;
  DataWords data_words;
};

void add_options(Command& command, ReplaySettings& s) {
  add_argument(command, "IN", s.input, "Mesh that was optimized.").require();
  add_argument(command, "TRACE", s.trace, "Trace (.jsonl) that temper optimize IN --write wrote.").require();
  add_mesh_output(command, s.output, "OUT");
  command.option("--output").require();
  add_projection(command, s.projection);
  add_heights(command, s.heights);
  add_data_rules(command, s.data_words);
  add_count(command, "--sweeps", s.sweeps, 0, "Last sweep to repeat. 0 stops when IN has been made regular.");
}

/// The library counts events; a file has lines.
[[noreturn]] void fail_at_event(const std::string& path, const InputError& error) {
  constexpr std::string_view kEvent = "event ";
  std::size_t index = 0;
  const std::string_view where = error.where;
  if (where.starts_with(kEvent)) std::from_chars(where.data() + kEvent.size(), where.data() + where.size(), index);
  throw Failure(Exit::bad_input, trace_place(path, index) + ": " + error.message);
}

/// Events of the requested sweeps: a prefix, because sweeps only go up.
std::span<const TraceEvent> wanted(const std::vector<TraceEvent>& events, std::optional<int> sweeps) {
  const auto past =
      std::find_if(events.begin(), events.end(), [&](const TraceEvent& e) { return sweeps && e.sweep > *sweeps; });
  return {events.begin(), past};
}

Exit replay(const ReplaySettings& s) {
  Outputs outputs("paper replay");
  outputs.expect_mesh(s.output, {s.trace});

  Input input = read_input(s.input, {.projection = s.projection, .heights = s.heights});
  outputs.expect_place(s.output, input.file);
  print_warnings(input.warnings());
  const io::UpdateOptions data = data_rules(s.data_words, input.path, input.file.point_data, input.file.triangles.data);
  const Trace trace = read_trace(s.trace, input);
  const std::vector<TraceEvent>& events = trace.events;
  const auto applied = wanted(events, s.sweeps);
  const Expected<Replay> replayed = replay_with_vertices(input.mesh(), applied, input.names.get());
  if (!replayed) fail_at_event(s.trace, replayed.error());

  if (applied.size() == events.size() && !is_end_of(trace.end, replayed->mesh)) {
    throw Failure(Exit::bad_input,
                  trace_place(s.trace, events.size()) + ": is the end of another mesh than the events make");
  }

  const std::size_t known = input.file.warnings.size();
  io::update(input.file, input.loaded, replayed->mesh, replayed->vertices, data);
  print_warnings(std::span(input.file.warnings).subspan(known));
  print_warnings(outputs.write_mesh(s.output, input.file));
  print(fmt::format("{} of {}: {}\nwrote {}\n", applied.size(), plural(events.size(), "event", "events"),
                    mesh_size(replayed->mesh), s.output.path));
  return Exit::done;
}

}  // namespace

std::function<Exit()> add_replay(Command& paper) {
  Command& command = paper.add_subcommand(
      "replay", "repeat the steps of a trace, and write the mesh with the same bytes as temper optimize did");
  const auto settings = std::make_shared<ReplaySettings>();
  add_options(command, *settings);
  return [settings] { return replay(*settings); };
}

}  // namespace temper::app
