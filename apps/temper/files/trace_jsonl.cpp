#include "files/trace_jsonl.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string_view>

#include "exit.hpp"
#include "files/input.hpp"
#include "temper/detail/certificate_io.hpp"
#include "temper/detail/suggest.hpp"
#include "temper/detail/version.hpp"

namespace temper::app {
namespace {

using ParsedJson = nlohmann::json;

constexpr int kTraceVersion = 2;
constexpr int kVersionWithoutEnd = 1;
constexpr std::string_view kNumbering = "points of the input, from 0";
constexpr std::string_view kEnd = "end";
constexpr std::array kKinds = {EventKind::move,     EventKind::weight,  EventKind::flip,
                               EventKind::collapse, EventKind::removal, EventKind::insertion,
                               EventKind::split,    EventKind::hidden,  EventKind::undo};

// --- out ------------------------------------------------------------------------------------------------------

/// A hash of positions, weights and triangles, 64 bits (FNV-1a), so that a trace is not used with another mesh.
std::string checksum(const Mesh& mesh) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto add = [&hash](std::uint64_t value) {
    for (int shift = 0; shift < 64; shift += 8) hash = (hash ^ (value >> shift & 0xff)) * 0x100000001b3u;
  };
  const auto add_double = [&add](double value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    add(bits);
  };
  for (const VertexId v : mesh.vertices()) {
    const WeightedPoint p = mesh.point(v);
    for (const double value : {p.x, p.y, p.w}) add_double(value);
  }
  for (const TriangleId t : mesh.triangles()) {
    for (const VertexId v : mesh.corners(t)) add(v.index);
  }
  return fmt::format("{:016x}", hash);
}

/// Inserted vertices are numbered after all points of the file, including points of no triangle.
std::size_t point_of(const Input& input, VertexId v) {
  const std::size_t n_vertices = input.n_vertices, n_points = input.loaded.vertex_of_point.size();
  if (v.index >= n_vertices) return n_points + (v.index - n_vertices);
  return input.points.empty() ? v.index : input.points[v.index];
}

/// A line of JSON, made key by key.
class Line {
 public:
  Line(const Input& input, std::string_view event) : input_(input) { add("event", event); }

  void add(std::string_view key, std::string_view plain_text) { add_raw(key, fmt::format("\"{}\"", plain_text)); }
  void add(std::string_view key, int value) { add_raw(key, fmt::format("{}", value)); }
  void add(std::string_view key, double value) {
    if (!std::isfinite(value)) return add_raw(key, "null");
    // JSON readers read -0 as an integer, which has no sign.
    add_raw(key, value == 0 && std::signbit(value) ? "-0.0" : fmt::format("{}", value));
  }
  void add(std::string_view key, std::size_t value) { add_raw(key, fmt::format("{}", value)); }
  void add(std::string_view key, VertexId v) { add_raw(key, fmt::format("{}", point_of(input_, v))); }
  void add(std::string_view key, std::span<const VertexId> vertices) { add_raw(key, list(vertices)); }
  void add(std::string_view key, const std::vector<std::array<VertexId, 3>>& triangles) {
    std::string all;
    for (const auto& triangle : triangles) all += (all.empty() ? "" : ",") + list(triangle);
    add_raw(key, "[" + all + "]");
  }
  [[nodiscard]] std::string finish() && { return std::move(text_) + "}\n"; }

 private:
  void add_raw(std::string_view key, std::string_view value) {
    text_ += fmt::format("{}\"{}\":{}", text_.size() > 1 ? "," : "", key, value);
  }
  [[nodiscard]] std::string list(std::span<const VertexId> vertices) const {
    std::string text = "[";
    for (const VertexId v : vertices) text += fmt::format("{}{}", text.size() > 1 ? "," : "", point_of(input_, v));
    return text + "]";
  }

  const Input& input_;
  std::string text_ = "{";
};

// --- in -------------------------------------------------------------------------------------------------------

/// One line of a trace, and its errors.
class Record {
 public:
  Record(const std::string& text, std::string where, const Input& input) : where_(std::move(where)), input_(input) {
    if (io::is_too_deep(text)) fail(fmt::format("is nested more than {} deep", io::kDeepestJson));
    try {
      json_ = ParsedJson::parse(text);
    } catch (const ParsedJson::parse_error& error) {
      fail(fmt::format("is no JSON object: {}", reason(error.what())));
    } catch (const ParsedJson::out_of_range&) {
      fail("holds a number beyond what a double can hold");
    }
    if (!json_.is_object()) fail("is no JSON object");
  }

  /// Vertices that this line may name besides the vertices of the input: inserted by this line or an earlier one.
  void allow_inserted(std::size_t n) { n_inserted_ = n; }

  [[noreturn]] void fail(const std::string& message) const { throw Failure(Exit::bad_input, where_ + ": " + message); }
  [[nodiscard]] bool has(const char* key) const { return json_.contains(key); }

  [[nodiscard]] std::string text(const char* key) const {
    const ParsedJson& value = at(key);
    if (!value.is_string()) expected(key, "a text", value);
    return value.get<std::string>();
  }
  [[nodiscard]] std::int64_t whole(const char* key) const {
    const ParsedJson& value = at(key);
    const auto number = as_whole(value);
    if (!number) expected(key, "a whole number", value);
    return *number;
  }
  [[nodiscard]] std::size_t count(const char* key) const {
    const std::int64_t number = whole(key);
    if (number < 0) expected(key, "a count", at(key));
    return static_cast<std::size_t>(number);
  }
  [[nodiscard]] int sweep(const char* key) const {
    const std::int64_t number = whole(key);
    if (number < -1 || number > std::numeric_limits<int>::max()) expected(key, "a sweep", at(key));
    return static_cast<int>(number);
  }
  [[nodiscard]] double real(const char* key) const {
    const ParsedJson& value = at(key);
    if (!value.is_number()) expected(key, "a number", value);
    return value.get<double>();
  }
  /// null, or a missing member, is not a number.
  [[nodiscard]] double energy(const char* key) const {
    if (!has(key) || json_[key].is_null()) return std::numeric_limits<double>::quiet_NaN();
    return real(key);
  }
  [[nodiscard]] WeightedPoint place() const { return {real("x"), real("y"), real("w")}; }
  [[nodiscard]] VertexId vertex(const char* key) const { return vertex(key, at(key)); }
  template <std::size_t n>
  [[nodiscard]] std::array<VertexId, n> vertices(const char* key) const {
    return fixed_list<n>(key, at(key));
  }
  [[nodiscard]] std::vector<VertexId> all_vertices(const char* key) const {
    const ParsedJson& list = at(key);
    if (!list.is_array()) expected(key, "a list of vertices", list);
    std::vector<VertexId> all;
    for (const ParsedJson& value : list) all.push_back(vertex(key, value));
    return all;
  }
  [[nodiscard]] std::vector<std::array<VertexId, 3>> triangles(const char* key) const {
    const ParsedJson& list = at(key);
    if (!list.is_array()) expected(key, "a list of triangles", list);
    std::vector<std::array<VertexId, 3>> all;
    for (const ParsedJson& value : list) all.push_back(fixed_list<3>(key, value));
    return all;
  }

 private:
  /// The parser's message without its own name and number: "… at line 1, column 3: …".
  static std::string reason(const std::string& what) {
    const std::size_t at = what.find("column ");
    return at == std::string::npos ? what : what.substr(at);
  }
  [[noreturn]] void expected(const char* key, std::string_view what, const ParsedJson& found) const {
    fail(fmt::format("expected {} as \"{}\", found {}", what, key,
                     found.dump(-1, ' ', false, ParsedJson::error_handler_t::replace)));
  }
  [[nodiscard]] const ParsedJson& at(const char* key) const {
    const auto found = json_.find(key);
    if (found == json_.end()) fail(fmt::format("has no \"{}\"", key));
    return *found;
  }
  [[nodiscard]] static std::optional<std::int64_t> as_whole(const ParsedJson& value) {
    if (!value.is_number_integer()) return std::nullopt;
    if (value.is_number_unsigned() && value.get<std::uint64_t>() > std::numeric_limits<std::int64_t>::max()) {
      return std::nullopt;
    }
    return value.get<std::int64_t>();
  }
  [[nodiscard]] VertexId vertex(const char* key, const ParsedJson& value) const {
    const auto number = as_whole(value);
    if (!number) expected(key, "a vertex", value);
    const auto& vertex_of_point = input_.loaded.vertex_of_point;
    const std::size_t n_points = vertex_of_point.size(), index = static_cast<std::size_t>(*number);
    if (*number < 0 || index >= n_points + n_inserted_) {
      const std::string inserted = n_inserted_ == 0 ? "" : fmt::format(", and {} were inserted so far", n_inserted_);
      fail(fmt::format("\"{}\" has vertex {}, but {} has {} points, numbered from 0{}", key, *number, input_.path,
                       n_points, inserted));
    }
    if (index >= n_points) return VertexId(input_.n_vertices + (index - n_points));
    const std::int32_t v = vertex_of_point[index];
    if (v < 0) fail(fmt::format("\"{}\" has vertex {}, a point of no triangle", key, *number));
    return VertexId(static_cast<std::size_t>(v));
  }
  template <std::size_t n>
  [[nodiscard]] std::array<VertexId, n> fixed_list(const char* key, const ParsedJson& list) const {
    if (!list.is_array() || list.size() != n) expected(key, fmt::format("{} vertices", n), list);
    std::array<VertexId, n> all;
    for (std::size_t i = 0; i < n; ++i) all[i] = vertex(key, list[i]);
    return all;
  }

  ParsedJson json_;
  std::string where_;
  const Input& input_;
  std::size_t n_inserted_ = 0;
};

void check_header(const Record& header, const Input& input) {
  if (!header.has("trace")) header.fail("is not the header of a trace; expected {\"temper\":…,\"trace\":2,…}");
  if (header.whole("trace") == kVersionWithoutEnd) {
    header.fail(
        "is a trace of version 1, which has no end line to tell whether it is whole; write it again with temper "
        "optimize --write FILE.jsonl");
  }
  if (header.whole("trace") != kTraceVersion) {
    header.fail(
        fmt::format("is a trace of version {}; this temper reads version {}", header.whole("trace"), kTraceVersion));
  }
  if (header.text("numbering") != kNumbering) {
    header.fail(fmt::format("numbers its vertices as '{}'; expected '{}'", header.text("numbering"), kNumbering));
  }
  const Mesh& mesh = input.mesh();
  const auto count = [&](const char* key, std::size_t here) {
    const std::int64_t there = header.whole(key);
    if (there == static_cast<std::int64_t>(here)) return;
    header.fail(
        fmt::format("is of a mesh of {} {} ({}), but {} has {}", there, key, header.text("input"), input.path, here));
  };
  count("vertices", mesh.n_vertices());
  count("triangles", mesh.n_triangles());
  if (header.has("checksum") && header.text("checksum") != checksum(mesh)) {
    header.fail(fmt::format("is of another mesh ({}) of as many vertices and triangles as {}", header.text("input"),
                            input.path));
  }
}

bool inserts(EventKind kind) { return kind == EventKind::insertion || kind == EventKind::split; }

EventKind read_kind(const Record& record) {
  const std::string word = record.text("event");
  std::vector<std::string_view> names;
  for (const EventKind kind : kKinds) {
    if (name(kind) == word) return kind;
    names.push_back(name(kind));
  }
  record.fail("event " + none_of(word, names));
}

TraceEvent read_event(const Record& record) {
  TraceEvent e;
  e.kind = read_kind(record);
  e.sweep = record.sweep("sweep");
  e.before = record.energy("before");
  e.after = record.energy("after");
  const bool undoes_sweeps = e.kind == EventKind::undo && !record.has("vertex");
  if (undoes_sweeps) {
    e.to_sweep = record.sweep("to");
  } else if (e.kind != EventKind::flip) {
    e.vertex = record.vertex("vertex");
  }
  switch (e.kind) {
    case EventKind::move:
      e.point = record.place();
      break;
    case EventKind::weight:
      e.point.w = record.real("w");
      break;
    case EventKind::flip: {
      const auto [a, b] = record.vertices<2>("edge");
      const auto [c, d] = record.vertices<2>("opposite");
      e.quad = {a, b, c, d};
      break;
    }
    case EventKind::collapse:
    case EventKind::removal:
      e.link = record.all_vertices("link");
      e.triangles = record.triangles("triangles");
      break;
    case EventKind::insertion: {
      e.point = record.place();
      const auto triangle = record.vertices<3>("triangle");
      e.link.assign(triangle.begin(), triangle.end());
      break;
    }
    case EventKind::split: {
      e.point = record.place();
      const auto [a, b] = record.vertices<2>("edge");
      const auto beside = record.all_vertices("opposite");
      if (beside.empty() || beside.size() > 2) record.fail("\"opposite\" has neither one vertex nor two");
      e.quad = {a, b, beside.front(), beside.size() == 2 ? beside.back() : VertexId()};
      break;
    }
    case EventKind::hidden:
    case EventKind::undo:
      break;
  }
  return e;
}

TraceEnd read_end(const Record& record, std::size_t n_events) {
  TraceEnd end;
  end.events = record.count("events");
  if (end.events != n_events) {
    record.fail(fmt::format("ends a trace of {} events, but {} are before it", end.events, n_events));
  }
  if (record.has("vertices")) end.vertices = record.count("vertices");
  if (record.has("triangles")) end.triangles = record.count("triangles");
  if (record.has("checksum")) end.checksum = record.text("checksum");
  return end;
}

}  // namespace

std::string trace_header(const Input& input) {
  nlohmann::ordered_json header = {{"temper", version()},
                                   {"trace", kTraceVersion},
                                   {"input", input.path},
                                   {"vertices", input.mesh().n_vertices()},
                                   {"triangles", input.mesh().n_triangles()},
                                   {"numbering", kNumbering},
                                   {"checksum", checksum(input.mesh())}};
  return header.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string trace_line(const TraceEvent& event, const Input& input) {
  Line line(input, name(event.kind));
  line.add("sweep", event.sweep);
  if (event.vertex.valid()) line.add("vertex", event.vertex);
  line.add("before", event.before);
  line.add("after", event.after);
  if (event.kind == EventKind::move || inserts(event.kind)) {
    line.add("x", event.point.x);
    line.add("y", event.point.y);
    line.add("w", event.point.w);
  }
  switch (event.kind) {
    case EventKind::move:
    case EventKind::hidden:
      break;
    case EventKind::weight:
      line.add("w", event.point.w);
      break;
    case EventKind::flip:
      line.add("edge", std::span(event.quad).first<2>());
      line.add("opposite", std::span(event.quad).last<2>());
      break;
    case EventKind::collapse:
    case EventKind::removal:
      line.add("link", std::span(event.link));
      line.add("triangles", event.triangles);
      break;
    case EventKind::insertion:
      line.add("triangle", std::span(event.link));
      break;
    case EventKind::split:
      line.add("edge", std::span(event.quad).first<2>());
      line.add("opposite", std::span(event.quad).subspan(2, event.quad[3].valid() ? 2 : 1));
      break;
    case EventKind::undo:
      if (!event.vertex.valid()) line.add("to", event.to_sweep);
      break;
  }
  return std::move(line).finish();
}

std::string trace_end(std::size_t n_events, const Mesh& result, const Input& input) {
  Line line(input, kEnd);
  line.add("events", n_events);
  line.add("vertices", result.n_vertices());
  line.add("triangles", result.n_triangles());
  line.add("checksum", checksum(result));
  return std::move(line).finish();
}

bool is_end_of(const TraceEnd& end, const Mesh& result) {
  return end.vertices.value_or(result.n_vertices()) == result.n_vertices() &&
         end.triangles.value_or(result.n_triangles()) == result.n_triangles() &&
         (end.checksum.empty() || end.checksum == checksum(result));
}

Trace read_trace(const std::string& path, const Input& input) {
  std::ifstream file = open_text(path);
  std::string line;
  if (!std::getline(file, line)) {
    throw Failure(Exit::bad_input, path + (file.bad() ? ": cannot be read" : ": the file is empty"));
  }
  check_header(Record(line, path + ":1", input), input);
  Trace trace;
  std::vector<TraceEvent>& events = trace.events;
  std::optional<TraceEnd> end;
  std::size_t n_inserted = 0;
  while (std::getline(file, line)) {
    const std::string where = trace_place(path, events.size() + (end ? 1 : 0));
    if (file.eof() && (line.empty() || line.back() != '}')) {
      throw Failure(Exit::bad_input, where + ": the file ends within an event");
    }
    Record record(line, where, input);
    if (end) record.fail("follows the end of the trace");
    if (record.text("event") == kEnd) {
      end = read_end(record, events.size());
      continue;
    }
    if (inserts(read_kind(record))) ++n_inserted;
    record.allow_inserted(n_inserted);
    events.push_back(read_event(record));
  }
  if (file.bad()) throw Failure(Exit::bad_input, path + ": cannot be read to its end");
  if (!end) {
    throw Failure(Exit::bad_input,
                  fmt::format("{}: has no end line: only the first {} events of it are there", path, events.size()));
  }
  trace.end = *std::move(end);
  return trace;
}

std::string trace_place(const std::string& path, std::size_t event) {
  constexpr std::size_t kFirst = 2;  // lines count from 1, and the first is the header
  return fmt::format("{}:{}", path, event + kFirst);
}

}  // namespace temper::app
