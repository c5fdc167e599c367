// See input.hpp. The child reports its end through a pipe; if it died, the pipe just ends.
#include "files/input.hpp"

#ifdef __linux__
#include <sys/prctl.h>
#endif
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>

#include "exit.hpp"

namespace temper::app {
namespace {

using Clock = std::chrono::steady_clock;

// The answer of the child; after kFailed the code of the error, its place, a zero, and its message.
constexpr char kDone = 'd', kFailed = 'f';

struct Budget {
  unsigned seconds = 0;     ///< of processor time
  std::uint64_t bytes = 0;  ///< of memory, on top of the process, if the system gives its size
};
/// Many times the need of reading and unpacking a file of that size, and of the libraries that do it.
Budget budget_of(std::uint64_t file_bytes) {
  constexpr std::uint64_t kMegabyte = 1 << 20;
  return {static_cast<unsigned>(3 + file_bytes / kMegabyte), 768 * kMegabyte + 256 * file_bytes};
}

/// The size of a file of HDF5; nothing for others and for pipes.
std::optional<std::uint64_t> size_of_hdf5(const std::string& path) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) return std::nullopt;
  char head[8] = {};
  std::ifstream(path, std::ios::binary).read(head, sizeof head);
  if (std::memcmp(head, "\x89HDF\r\n\x1a\n", sizeof head) != 0) return std::nullopt;
  return std::filesystem::file_size(path, none);
}

/// Memory that the process has, or 0 if the system does not report it.
std::uint64_t address_space() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

void limit_this_process(const Budget& budget) {
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  for (const int each : {SIGINT, SIGTERM, SIGXCPU}) std::signal(each, SIG_DFL);
  const rlimit seconds = {budget.seconds, budget.seconds + 1};
  setrlimit(RLIMIT_CPU, &seconds);
  if (const std::uint64_t now = address_space(); now > 0) {
    const rlimit bytes = {now + budget.bytes, now + budget.bytes};
    setrlimit(RLIMIT_AS, &bytes);
  }
}

[[noreturn]] void be_the_child(int pipe, const Budget& budget, const std::string& path,
                               const io::ReadOptions& options) {
  limit_this_process(budget);
  std::string said = {kDone};
  if (const auto file = io::read_any(path, {.flat = options.flat}); !file) {
    said = {kFailed, static_cast<char>(file.error().code)};
    said.append(file.error().where).append(1, '\0').append(file.error().message);
  }
  std::size_t at = 0;
  while (at < said.size()) {
    const ssize_t n = ::write(pipe, said.data() + at, said.size() - at);
    if (n < 0 && errno != EINTR) break;
    if (n > 0) at += static_cast<std::size_t>(n);
  }
  _exit(0);  // nothing of the parent's is flushed or torn down
}

/// All that comes through the pipe until its end, or nothing when the end does not come in time.
std::optional<std::string> listen(int pipe, Clock::time_point until) {
  std::string said;
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
    if (left <= 0) return std::nullopt;
    pollfd wait = {pipe, POLLIN, 0};
    const int ready = poll(&wait, 1, static_cast<int>(left));
    if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
    char buffer[4096];
    const ssize_t n = ::read(pipe, buffer, sizeof buffer);
    if (n == 0) return said;
    if (n < 0 && errno != EINTR) return std::nullopt;
    if (n > 0) said.append(buffer, static_cast<std::size_t>(n));
  }
}

int end_of(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

/// The reason not to read the file here; nothing when the child could read it.
Expected<void> try_in_child(const std::string& path, const Budget& budget, const io::ReadOptions& options) {
  int ends[2];
  const pid_t child = pipe(ends) == 0 ? fork() : -1;
  if (child < 0) {
    return InputError{
        ErrorCode::unsupported, path,
        std::string("cannot be read: the process that reads it first could not be started: ") + std::strerror(errno)};
  }
  if (child == 0) be_the_child(ends[1], budget, path, options);
  close(ends[1]);
  // A child that waits forever takes no processor time. On a busy machine a healthy child may get little.
  const auto patience = std::chrono::seconds(20 + 10 * budget.seconds);
  const auto said = listen(ends[0], Clock::now() + patience);
  close(ends[0]);
  if (!said) kill(child, SIGKILL);
  const int status = end_of(child);
  if (said && said->starts_with(kDone)) return {};
  if (said && said->starts_with(kFailed)) {
    const std::size_t end = said->find('\0', 2);
    return InputError{static_cast<ErrorCode>((*said)[1]), said->substr(2, end - 2), said->substr(end + 1)};
  }
  const bool slow = !said || (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL));
  return InputError{ErrorCode::syntax, path,
                    slow ? "libhdf5 does not finish within " + std::to_string(budget.seconds) +
                               " s: the file is damaged or slow to read. Next: write it without compression, or as "
                               "classic NetCDF (nccopy -k cdf5)"
                         : "libhdf5 crashes: the file is damaged"};
}

}  // namespace

namespace {

void try_hdf5(const std::string& path, const io::ReadOptions& options) {
  if (const auto size = size_of_hdf5(path)) or_fail(try_in_child(path, budget_of(*size), options));
}

}  // namespace

io::MeshFile read_tried(const std::string& path, const io::ReadOptions& options) {
  try_hdf5(path, options);
  return or_fail(io::read(path, options));
}

std::variant<io::MeshFile, io::TetFile> read_any_tried(const std::string& path, const io::ReadOptions& options) {
  try_hdf5(path, options);
  return or_fail(io::read_any(path, options));
}

}  // namespace temper::app
