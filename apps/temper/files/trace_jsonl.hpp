// Traces as files: a header and one JSON object per line (JSON Lines; the format is in
// docs/reference/formats/trace.md).
//
// Vertices are points of the input file, counted from 0 in the order of its arrays, as in reports; inserted ones
// follow. Numbers are the shortest that read back to the same double. The last line has the number of events. Without
// it, a file that was cut at the end of a line would replay to an earlier mesh.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "files/input.hpp"
#include "temper/detail/trace.hpp"

namespace temper::app {

/// The first line: the input of the trace.
[[nodiscard]] std::string trace_header(const Input& input);

/// One event, with the newline.
[[nodiscard]] std::string trace_line(const TraceEvent& event, const Input& input);

/// The last line, with the resulting mesh.
[[nodiscard]] std::string trace_end(std::size_t n_events, const Mesh& result, const Input& input);

/// The last line of a trace. Traces made by hand may lack the result.
struct TraceEnd {
  std::size_t events = 0;
  std::optional<std::size_t> vertices, triangles;
  std::string checksum;
};
/// Is this the final mesh of the trace?
[[nodiscard]] bool is_end_of(const TraceEnd& end, const Mesh& result);

struct Trace {
  std::vector<TraceEvent> events;
  TraceEnd end;
};
/// A trace of this input. Failure, with the line, when the text is no trace, is not whole, or is one of another mesh.
[[nodiscard]] Trace read_trace(const std::string& path, const Input& input);

/// "T.jsonl:19": the place of an event.
[[nodiscard]] std::string trace_place(const std::string& path, std::size_t event);

}  // namespace temper::app
