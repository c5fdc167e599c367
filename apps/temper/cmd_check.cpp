// temper check IN: the quality of a mesh as a table or as JSON, and requirements on it.
#include <fmt/format.h>

#include <memory>

#include "console.hpp"
#include "help.hpp"
#include "input.hpp"
#include "options.hpp"
#include "projection_option.hpp"
#include "report_json.hpp"
#include "report_text.hpp"
#include "requirement.hpp"
#include "temper/quality.hpp"
#include "threads.hpp"

namespace temper::app {
namespace {

struct CheckSettings {
  std::string projection;
  std::string input;
  std::vector<std::string> require;
  SofteningOptions gamma, h0;
  std::uint64_t worst = 5, threads = 0;
  bool json = false;
};

void add_options(Command& command, CheckSettings& s) {
  command.group("Report");
  add_argument(command, "IN", s.input, "the mesh; its content tells the format").require();
  add_projection(command, s.projection);
  command.add_flag("--json", s.json, "the report as JSON, with vertices and triangles counted from 0");
  add_count(command, "--worst", s.worst, 0, "list this many of the worst triangles");
  add_gamma(command, s.gamma, " (default: 1)");
  add_h0(command, s.h0, " (default: 0)");
  add_count(command, "--threads", s.threads, 0, "threads; 0: as many as the machine has; the result is the same");
  command.group("Requirements");
  add_texts(command, "--require", "LIST", Values::repeated, s.require,
            "key=value,key>=value,key<=value,...: exit with 3 when one does not hold. key=value asks of a count that "
            "it is the value, of a minimum or a fraction that it is no less, of a maximum or an energy that it is no "
            "more. Keys: " +
                requirement_keys());
  command.group("Help");
  command.add_help({"IN [options]",
                    "  temper check in.vtu\n"
                    "  temper check in.vtu --json --worst 20\n"
                    "  temper check in.vtu --require inverted=0,\"min_angle>=1\"\n",
                    {Exit::done, Exit::bad_input, Exit::bad_usage, Exit::requirement, Exit::internal}});
}

/// Says which requirements fail, all of them.
Exit judge(const std::vector<Requirement>& requirements, const Quality& quality, const std::string& path) {
  Exit exit = Exit::done;
  for (const Requirement& requirement : requirements) {
    const std::optional<std::string> problem = unmet(requirement, quality);
    if (!problem) continue;
    print_error(fmt::format("{}: requirement not met: {}", path, *problem));
    exit = Exit::requirement;
  }
  return exit;
}

}  // namespace

Exit run_check(const Arguments& arguments) {
  Command command("check",
                  "Reports on a mesh: what is exactly right or wrong with it, margins, energies, the worst triangles.");
  CheckSettings s;
  add_options(command, s);
  if (!command.parse(arguments)) return Exit::done;
  std::vector<Requirement> requirements;
  for (const std::string& list : s.require) {
    for (Requirement& requirement : parse_requirements(list)) requirements.push_back(std::move(requirement));
  }

  const std::unique_ptr<Executor> threads = make_threads(s.threads);
  const Input input = read_input(s.input, {s.projection, {}, threads.get()});
  print_warnings(input.warnings());
  QualityOptions options;
  options.gamma = s.gamma.value().value_or(options.gamma);
  options.h0 = s.h0.value().value_or(options.h0);
  options.worst = s.worst;
  options.executor = threads.get();
  const Quality measured = quality(input.mesh(), options);
  print(s.json ? quality_json(measured, input.points) : quality_text(measured, input, text_style()));
  flush_output();  // before the verdict on standard error
  return judge(requirements, measured, s.input);
}

}  // namespace temper::app
