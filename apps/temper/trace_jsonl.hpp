// Traces as files: a header and one JSON object a line (JSON Lines; the format is in docs/formats.md).
//
// Vertices are points of the input file, counted from 0 in the order of its arrays, as in reports. Numbers are
// the shortest that read back to the same double.
#pragma once

#include <string>
#include <vector>

#include "input.hpp"
#include "temper/trace.hpp"

namespace temper::app {

/// The first line: what the trace belongs to.
[[nodiscard]] std::string trace_header(const Input& input);

/// One event, with the newline.
[[nodiscard]] std::string trace_line(const TraceEvent& event, const Input& input);

/// All events of a trace of this input. Failure, with the line, when the text is no trace or is one of another mesh.
[[nodiscard]] std::vector<TraceEvent> read_trace(const std::string& path, const Input& input);

/// "T.jsonl:19": where an event is.
[[nodiscard]] std::string trace_place(const std::string& path, std::size_t event);

}  // namespace temper::app
