// temper dec IN -o DIR: the operators of discrete exterior calculus and finite volumes, as files for solvers.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "console.hpp"
#include "dec_report.hpp"
#include "help.hpp"
#include "input.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "projection_option.hpp"
#include "suggest.hpp"
#include "temper/dec_io.hpp"
#include "threads.hpp"

namespace temper::app {
namespace {

namespace fs = std::filesystem;

constexpr Choice<io::DecFormat> kDecFormats[] = {
    {"npz", io::DecFormat::npz}, {"mtx", io::DecFormat::mtx}, {"vtu", io::DecFormat::vtu}};

struct DecSettings {
  std::string projection;
  std::string input, output, formats = "npz,mtx,vtu";
  std::uint64_t threads = 0;
  bool json = false;
};

void add_options(Command& command, DecSettings& s) {
  command.group("Files");
  add_argument(command, "IN", s.input, "the mesh; its content tells the format").require();
  add_projection(command, s.projection);
  add_text(command, "-o,--output", "DIR", s.output, "the folder for the files; made when it is missing").require();
  add_text(command, "--format", "LIST", s.formats,
           "the kinds of files to write, separated by commas: npz (NumPy and SciPy), mtx (Matrix Market), vtu (the "
           "dual, for ParaView)")
      .defaults_to([&s] { return s.formats; });
  command.group("Report");
  command.add_flag("--json", s.json, "the summary as JSON");
  add_count(command, "--threads", s.threads, 0, "threads; 0: as many as the machine has; the result is the same");
  command.group("Help");
  command.add_help({"IN -o DIR [options]",
                    "  temper dec in.vtu -o operators\n"
                    "  temper dec in.vtu -o operators --format npz --json\n",
                    {Exit::done, Exit::bad_input, Exit::bad_usage, Exit::internal}});
}

std::vector<io::DecFormat> parse_formats(std::string_view list) {
  std::vector<io::DecFormat> formats;
  std::vector<std::string_view> names;
  for (const auto& choice : kDecFormats) names.push_back(choice.name);
  for (const std::string& name : comma_separated(list)) {
    const auto known = std::find_if(std::begin(kDecFormats), std::end(kDecFormats),
                                    [&](const auto& choice) { return choice.name == name; });
    if (known == std::end(kDecFormats)) {
      throw Failure(Exit::bad_usage, fmt::format("dec: --format: {}\nSee temper dec --help", none_of(name, names)));
    }
    formats.push_back(known->value);
  }
  return formats;
}

/// Before the work: a folder can be there, and the input is none of the files that will be replaced.
void check_folder(const DecSettings& s, const std::vector<io::DecFormat>& formats) {
  std::error_code ignored;
  if (fs::exists(s.output, ignored) && !fs::is_directory(s.output, ignored)) {
    throw Failure(Exit::bad_input, fmt::format("{}: is no folder; expected the name of one, or of none", s.output));
  }
  for (const io::DecFormat format : formats) {
    for (const std::string_view name : io::dec_file_names(format)) {
      const std::string path = (fs::path(s.output) / name).string();
      if (!same_file(path, s.input)) continue;
      throw Failure(Exit::bad_usage, fmt::format("dec: --output: {} is the input mesh", path));
    }
  }
}

}  // namespace

Exit run_dec(const Arguments& arguments) {
  Command command("dec",
                  "Writes what a solver needs of a mesh: incidence d0 and d1, diagonal stars with signed power duals, "
                  "orthocenters, "
                  "weighted midpoints, transmissibilities, and power cells within the domain.");
  DecSettings s;
  add_options(command, s);
  if (!command.parse(arguments)) return Exit::done;
  const std::vector<io::DecFormat> formats = parse_formats(s.formats);
  check_folder(s, formats);

  const std::unique_ptr<Executor> threads = make_threads(s.threads);
  const Input input = read_input(s.input, {s.projection, {}, threads.get(), true});
  print_warnings(input.warnings());
  const DecComplex complex = dec(input.mesh());
  const PowerCells cells = power_cells(input.mesh(), complex);
  const DecSummary summary = summarize(input.mesh(), complex);
  DecRecord record = {s.input, summary, cells, {}};
  print_warnings(dec_warnings(record));
  record.files = or_fail(
      io::write_dec(s.output, input.mesh(), complex, cells, {formats, input.points, input.file.z, threads.get()}));
  print(s.json ? dec_json(record) : dec_text(record));
  return Exit::done;
}

}  // namespace temper::app
