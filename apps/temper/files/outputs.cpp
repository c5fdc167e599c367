#include "files/outputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "console.hpp"
#include "exit.hpp"
#include "files/input.hpp"
#include "system/system.hpp"
#include "temper/detail/path.hpp"
#include "temper/detail/suggest.hpp"

namespace temper::app {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void not_writable(const std::string& path, const std::string& message) {
  throw Failure(Exit::bad_input, path + ": cannot be written: " + message);
}

/// The path behind links, whether a file is there or not.
fs::path target_of_links(const std::string& name) {
  constexpr int kMost = 40;  // as systems follow
  fs::path path = path_of(name);
  std::error_code ignored;
  for (int i = 0; i < kMost && fs::is_symlink(path, ignored); ++i)
    path = path.parent_path() / fs::read_symlink(path, ignored);
  return path;
}

void check_writable(const std::string& name) {
  const fs::path path = path_of(name);
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) not_writable(name, "it is a directory");
  const int open_file = io::open_file_of(name);
  if (open_file >= 0 && !io::is_open_to_write(open_file)) not_writable(name, io::kClosedStream);
  if (open_file >= 0) return;
  if (!path.has_filename()) not_writable(name, "it names no file");
  std::error_code error;
  const bool there = fs::exists(path, error);
  if (error == std::errc::filename_too_long || error == std::errc::too_many_symbolic_link_levels)
    not_writable(name, error.message());
  if (there && !may_write(name)) not_writable(name, std::strerror(errno));
  if (io::is_stream(name)) return;  // written in place

  // A new file next to a file replaces it (next to the target of a link), so that folder must be writable.
  const fs::path target = target_of_links(name);
  const fs::path parent = target.has_parent_path() ? target.parent_path() : fs::path(".");
  const std::string folder = utf8(parent);
  if (!fs::exists(parent, ignored)) not_writable(name, fmt::format("there is no directory {}", folder));
  if (!fs::is_directory(parent, ignored)) not_writable(name, fmt::format("{} is not a directory", folder));
  if (!may_fill(folder)) not_writable(name, fmt::format("directory {}: {}", folder, std::strerror(errno)));
}

/// The input that reads the file, or null.
const std::string* input_with(const std::string& file, const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs) {
    if (input.empty()) continue;
    if (same_file(file, input)) return &input;
    for (const std::string& part : io::files_to_read(input)) {
      if (same_file(file, part)) return &input;
    }
  }
  return nullptr;
}

/// `what`: the name of the input. The file is this input, or a part of it.
std::string what_it_is(const std::string& file, const std::string& input, std::string_view what) {
  return same_file(file, input) ? fmt::format("{} is {}", file, what)
                                : fmt::format("{} is read with {}, {}", file, input, what);
}

const OutputKind* kind_of(std::span<const OutputKind> kinds, const std::string& path) {
  const std::string suffix = suffix_of(path);
  for (const OutputKind& kind : kinds) {
    const std::vector<std::string> suffixes = separated(kind.suffixes, ' ');
    if (std::ranges::find(suffixes, suffix) != suffixes.end()) return &kind;
  }
  return nullptr;
}

/// ".json (report), .html (page) or .svg .png .pdf (picture)"
std::string list_of(std::span<const OutputKind> kinds) {
  std::string text;
  for (const OutputKind& kind : kinds) {
    text += text.empty() ? "" : &kind == &kinds.back() ? " or " : ", ";
    text += fmt::format("{} ({})", kind.suffixes, kind.what);
  }
  return text;
}

}  // namespace

void add_mesh_output(Command& command, MeshOutput& target, const std::string& value_name, const std::string& sentence) {
  add_text(command, "-o,--output", value_name, target.path, sentence + " '-' writes to standard output.");
  command.option("--output").take = [&target](const std::string& text) {
    if (text.empty()) throw BadValue("needs a value, found an empty one");
    target.path = text == "-" ? kStandardOutput : text;
  };
  std::vector<std::string_view> names;
  for (const io::Format& format : io::formats()) {
    if (format.writes) names.push_back(format.name);
  }
  for (const io::CellFormat& format : io::cell_formats()) {
    if (std::ranges::find(names, format.name) == names.end()) names.push_back(format.name);
  }
  add_name(
      command, "--format", names, [&target](std::string_view name) { target.options.format = name; },
      "Format of " + value_name + ". Without it, the suffix selects the format.");
  add_choice(
      command, "--cells", kCellsOf, [&target](CellsOf value) { target.options.cells = value; },
      "Cells to write as polygons, instead of the mesh: power cells within the domain, or triangles. Each has its "
      "region, area and center. The formats are GeoJSON, GeoPackage, VTU and UGRID.");
  static constexpr Choice<io::Encoding> kEncodings[] = {{"ascii", io::Encoding::ascii},
                                                        {"base64", io::Encoding::base64},
                                                        {"appended", io::Encoding::appended},
                                                        {"binary", io::Encoding::appended}};
  add_choice(
      command, "--encoding", kEncodings, [&target](io::Encoding value) { target.options.encoding = value; },
      "Encoding, for formats that have several. The fastest is 'appended'. (default: the most compact)");
  command.add(
      {.names = "--no-triangle-quality",
       .value_name = "",
       .sentence =
           "Leave out the quality of " + any_elements() +
           ": the cell data well_centered, min_h_over_l, min_d_over_l, min_angle_deg and min_dihedral_deg of VTU and "
           "VTKHDF.",
       .take = [&target](const std::string&) { target.options.triangle_quality = false; }});
}

Option& add_write(Command& command, std::vector<std::string>& paths, std::span<const OutputKind> kinds) {
  Option& option = add_texts(command, "--write", "FILE ...", Values::words, paths,
                             fmt::format("Further files, by suffix: {}.", list_of(kinds)));
  option.cells_of = [kinds](std::string_view path) {
    const OutputKind* const kind = kind_of(kinds, std::string(path));
    return kind == nullptr ? CellKinds::all : kind->cells;
  };
  return option;
}

std::string suffix_of(const std::string& path) {
  std::string suffix = utf8(path_of(path).extension());
  for (char& c : suffix) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return suffix;
}

bool is_output_of(std::span<const OutputKind> kinds, const std::string& path) {
  return kind_of(kinds, path) != nullptr;
}

FurtherOutputs sorted_outputs(std::string_view verb, const std::vector<std::string>& paths,
                              std::span<const OutputKind> kinds) {
  FurtherOutputs outputs;
  for (const std::string& path : paths) {
    const OutputKind* const kind = kind_of(kinds, path);
    if (kind == nullptr) {
      refuse_usage(std::string(verb),
                   fmt::format("--write: the suffix of {} names no output; expected {}", path, list_of(kinds)));
    }
    std::string& place = outputs.*kind->path;
    if (!place.empty()) {
      refuse_usage(std::string(verb),
                   fmt::format("--write: {} and {} are each a {}; expected one", place, path, kind->what));
    }
    place = path;
  }
  return outputs;
}

bool same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  if (fs::equivalent(path_of(a), path_of(b), error)) return true;
  const auto whole = [&](const std::string& path) {
    return fs::weakly_canonical(fs::absolute(path_of(path), error), error);
  };
  return whole(a) == whole(b);
}

void Outputs::refuse(const std::string& option, const std::string& message) const {
  throw Failure(Exit::bad_usage, fmt::format("{}: {}: {}", verb_, option, message));
}

void Outputs::expect(const std::string& option, const std::string& path, const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    for (const auto& [other_option, other_path, other] : expected_) {
      if (!same_file(file, other)) continue;
      refuse(option, fmt::format("{} is another output already: {} {}", file, other_option, other_path));
    }
  }
  for (const std::string& file : files) expected_.push_back({option, path, file});
  check_writable(path);
}

void Outputs::expect_mesh(const MeshOutput& output, const std::vector<std::string>& others) {
  const std::string option = "--output";
  const auto& [path, options] = output;
  std::error_code ignored;
  if (fs::is_directory(path_of(path), ignored)) not_writable(path, "it is a directory");
  const Expected<std::vector<std::string>> files = io::files_to_write(path, options.format, nullptr, options.cells);
  if (!files) refuse(option, files.error().what());
  for (const std::string& file : *files) {
    if (const std::string* const input = input_with(file, others))
      refuse(option, what_it_is(file, *input, "an input") + ", and would be replaced");
  }
  expect(option, path, *files);
  if (io::open_file_of(path) == 1) print_to_standard_error();
}

void Outputs::expect_place(const MeshOutput& output, const io::MeshFile& file) const {
  if (output.path.empty()) return;
  const auto files = io::files_to_write(output.path, output.options.format, &file, output.options.cells);
  if (!files) fail(files.error());
}

void Outputs::expect(const FurtherOutputs& outputs, const std::vector<std::string>& inputs) {
  for (const std::string& path : {outputs.report, outputs.page, outputs.history, outputs.trace, outputs.picture})
    expect_text("--write", path, inputs);
}

void Outputs::expect_picture(const std::string& option, const std::string& path,
                             const std::vector<std::string>& inputs) {
  expect_text(option, path, inputs);
  if (is_picture_name(path)) return;
  refuse(option, path + " names no picture that temper draws; expected one that ends in .svg, .png or .pdf");
}

void Outputs::expect_text(const std::string& option, const std::string& path, const std::vector<std::string>& inputs) {
  if (path.empty()) return;
  if (const std::string* const input = input_with(path, inputs)) {
    const bool is_mesh = input == &inputs.front() && verb_ != "mesh";
    refuse(option, what_it_is(path, *input, is_mesh ? "the input mesh" : "an input"));
  }
  expect(option, path, {path});
}

void Outputs::fail(const InputError& error) const {
  std::string message = spell_projection(error.what());
  for (std::size_t i = 0; i < written_.size(); ++i)
    message += (i == 0 ? "; written before that: " : ", ") + written_[i];
  throw Failure(Exit::bad_input, message);
}

std::vector<std::string> Outputs::write_mesh(const MeshOutput& output, const io::MeshFile& file, Executor* executor) {
  io::WriteOptions options = output.options;
  options.executor = executor;
  flush_output();  // the path may be standard output
  Expected<std::vector<std::string>> warnings = io::write(output.path, file, options);
  if (!warnings) fail(warnings.error());
  written_.push_back(output.path);
  return *std::move(warnings);
}

void Outputs::write_text(const std::string& path, std::string_view text) {
  flush_output();  // the path may be standard output
  const Expected<void> result = io::write_text(path, text);
  if (!result) fail(result.error());
  written_.push_back(path);
}

void Outputs::write_picture(const std::string& path, std::string_view svg) {
  write_text(path, picture_bytes(path, svg));
}

io::TextStream Outputs::open(const std::string& path) const {
  Expected<io::TextStream> stream = io::TextStream::open(path);
  if (!stream) fail(stream.error());
  return *std::move(stream);
}

void Outputs::commit(const std::string& path, io::TextStream& stream) {
  const Expected<void> result = stream.commit();
  if (!result) fail(result.error());
  written_.push_back(path);
}

}  // namespace temper::app
