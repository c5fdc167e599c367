// temper reproduce, in a program that was built without the paper's figures.
#include "exit.hpp"
#include "help/command.hpp"
#include "verbs.hpp"

namespace temper::app {
namespace {

constexpr const char* kMissing =
    "this program was built without the paper's figures. Next: build it with -DTEMPER_BUILD_GALLERY=ON";

}  // namespace

Exit run_reproduce(const Arguments& arguments) {
  const bool help = !arguments.empty() && (arguments.front() == "-h" || arguments.front().starts_with("--help"));
  if (!help) throw Failure(Exit::bad_usage, std::string("reproduce: ") + kMissing);
  Command command("reproduce",
                  std::string("Makes the figures of \"Not so HOT Triangulations\" again. But ") + kMissing + ".");
  command.add_help({"", "  temper reproduce --help\n", {Exit::done, Exit::bad_usage}});
  static_cast<void>(command.parse(arguments));
  return Exit::done;
}

}  // namespace temper::app
