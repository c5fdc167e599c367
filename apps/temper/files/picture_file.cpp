#include <fmt/format.h>

#include <cerrno>
#include <cstring>

#include "exit.hpp"
#include "files/outputs.hpp"
#include "system/system.hpp"

namespace temper::app {
namespace {

constexpr const char* kProgram = "rsvg-convert";

[[noreturn]] void fail(const std::string& path, const std::string& why) {
  throw Failure(Exit::bad_input, fmt::format("{}: cannot be written: {}", path, why));
}

}  // namespace

bool is_picture_name(const std::string& path) {
  const std::string suffix = suffix_of(path);
  return suffix.empty() || suffix == ".svg" || suffix == ".png" || suffix == ".pdf";
}

std::string picture_bytes(const std::string& path, std::string_view svg) {
  const std::string suffix = suffix_of(path);
  if (suffix != ".png" && suffix != ".pdf") return std::string(svg);
  // The limit on long paths is against attacks, and not needed here.
  std::vector<std::string> words = {kProgram, "--unlimited", "--format", suffix.substr(1)};
  if (suffix == ".png") words.insert(words.end(), {"--zoom", "2"});
  Ended ended = run_other_program(std::move(words), svg);
  if (ended.error == ENOENT) {
    fail(path,
         fmt::format("{} is not there, which converts SVG. Next: install it (Debian: librsvg2-bin), or write .svg",
                     kProgram));
  }
  if (ended.error != 0) fail(path, fmt::format("{}: {}", kProgram, std::strerror(ended.error)));
  if (ended.status == 0) return std::move(ended.output);
  while (!ended.messages.empty() && ended.messages.back() == '\n') ended.messages.pop_back();
  fail(path, fmt::format("{} failed: {}", kProgram, ended.messages));
}

}  // namespace temper::app
