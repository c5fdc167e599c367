#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

#include "exit.hpp"
#include "files/outputs.hpp"

namespace temper::app {
namespace {

constexpr const char* kProgram = "rsvg-convert";

[[noreturn]] void fail(const std::string& path, const std::string& why) {
  throw Failure(Exit::bad_input, fmt::format("{}: cannot be written: {}", path, why));
}

/// A file without a name, which disappears when it is closed.
class Scratch {
 public:
  explicit Scratch(const std::string& path) : file_(std::tmpfile()) {
    if (file_ == nullptr) fail(path, std::strerror(errno));
  }
  ~Scratch() { std::fclose(file_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  [[nodiscard]] int descriptor() const { return fileno(file_); }
  [[nodiscard]] bool write(std::string_view text) {
    return std::fwrite(text.data(), 1, text.size(), file_) == text.size() && std::fflush(file_) == 0 &&
           std::fseek(file_, 0, SEEK_SET) == 0;
  }
  [[nodiscard]] std::string read() {
    std::string text;
    std::rewind(file_);
    std::array<char, 1 << 16> some;
    std::size_t n = 0;
    while ((n = std::fread(some.data(), 1, some.size(), file_)) > 0) text.append(some.data(), n);
    return text;
  }

 private:
  std::FILE* file_;
};

/// This process' environment, with a fixed date: dates in a PDF would change its bytes each time.
std::vector<char*> environment_without_dates() {
  static char epoch[] = "SOURCE_DATE_EPOCH=0";
  std::vector<char*> variables;
  for (char** variable = environ; *variable != nullptr; ++variable) variables.push_back(*variable);
  if (std::getenv("SOURCE_DATE_EPOCH") == nullptr) variables.push_back(epoch);
  variables.push_back(nullptr);
  return variables;
}

/// Runs rsvg-convert from one file to another; any output of it is an error.
void convert(const std::string& path, std::vector<std::string> words, Scratch& in, Scratch& out) {
  Scratch said(path);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, in.descriptor(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, out.descriptor(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&files, said.descriptor(), STDERR_FILENO);
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t process = 0;
  const int error =
      posix_spawnp(&process, kProgram, &files, nullptr, arguments.data(), environment_without_dates().data());
  posix_spawn_file_actions_destroy(&files);
  if (error == ENOENT) {
    fail(path,
         fmt::format("{} is not there, which converts SVG. Next: install it (Debian: librsvg2-bin), or write .svg",
                     kProgram));
  }
  if (error != 0) fail(path, fmt::format("{}: {}", kProgram, std::strerror(error)));
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  if (status == 0) return;
  std::string message = said.read();
  while (!message.empty() && message.back() == '\n') message.pop_back();
  fail(path, fmt::format("{} failed: {}", kProgram, message));
}

}  // namespace

bool is_picture_name(const std::string& path) {
  const std::string suffix = suffix_of(path);
  return suffix.empty() || suffix == ".svg" || suffix == ".png" || suffix == ".pdf";
}

std::string picture_bytes(const std::string& path, std::string_view svg) {
  const std::string suffix = suffix_of(path);
  if (suffix != ".png" && suffix != ".pdf") return std::string(svg);
  Scratch in(path), out(path);
  if (!in.write(svg)) fail(path, std::strerror(errno));
  // The limit on long paths is against attacks, and not needed here.
  std::vector<std::string> words = {kProgram, "--unlimited", "--format", suffix.substr(1)};
  if (suffix == ".png") words.insert(words.end(), {"--zoom", "2"});
  convert(path, words, in, out);
  return out.read();
}

}  // namespace temper::app
