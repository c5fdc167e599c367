// Linux and macOS: see system.hpp.
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "system/system.hpp"
#ifdef __GLIBC__
#include <malloc.h>
#endif
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "temper/io.hpp"

extern char** environ;  // NOLINT(readability-redundant-declaration): unistd.h of macOS has none

namespace temper::app {
namespace {

/// Without standard output, the next file to be opened would be standard output, and get all that is printed. So a file
/// that refuses each read or write takes the place of a stream that is closed.
void keep_closed_streams_closed() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) >= 0 || errno != EBADF) continue;
    static_cast<void>(::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY));  // the least free number
  }
}

}  // namespace

void prepare_process() {
#ifdef __GLIBC__
  // Arrays of a large mesh that are freed after reading go back to the system. Smaller ones, which steps need again and
  // again, do not: the system clears each page that it gives out.
  mallopt(M_MMAP_THRESHOLD, 16 << 20);
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
#endif
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error of writing
  std::signal(SIGPIPE, SIG_IGN);  // and so is a pipe without a reader
  keep_closed_streams_closed();
}

void prepare_for_file([[maybe_unused]] std::uint64_t bytes) {
#ifdef __GLIBC__
  constexpr std::uint64_t kLarge = 32 << 20;
  if (bytes <= kLarge) return;
  mallopt(M_MMAP_THRESHOLD, 4 << 20);
  mallopt(M_TRIM_THRESHOLD, 4 << 20);
#endif
}

void return_freed_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

std::vector<std::string> program_words(int argc, char** argv) { return {argv + (argc > 0 ? 1 : 0), argv + argc}; }

namespace {

volatile std::sig_atomic_t signal_seen = 0;
int true_standard_error = STDERR_FILENO;
sigset_t before_signals_were_held;

void handle(int signal, void (*handler)(int), int flags) {
  struct sigaction before = {}, action = {};
  sigaction(signal, nullptr, &before);
  if (before.sa_handler == SIG_IGN) return;
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  action.sa_flags = flags;
  sigaction(signal, &action, nullptr);
}

extern "C" void end_program(int signal) {
  io::discard_unfinished();
  write_to_error("\ntemper: stopped by a signal; a file that was not finished is as it was before\n");
  raise(signal);  // which has its first meaning again
}

void end_on(int signal) { handle(signal, end_program, static_cast<int>(SA_RESETHAND | SA_NODEFER)); }

extern "C" void note_signal(int) {
  signal_seen = 1;
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) end_on(signal);
}

}  // namespace

void end_on_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) end_on(signal);
}

void catch_interrupts() {
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) handle(signal, note_signal, SA_RESTART);  // no write is cut short
}

bool interrupted() { return signal_seen != 0; }

SignalsHeld::SignalsHeld() {
  sigset_t held;
  sigemptyset(&held);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&held, signal);
  sigprocmask(SIG_BLOCK, &held, &before_signals_were_held);
}

SignalsHeld::~SignalsHeld() { sigprocmask(SIG_SETMASK, &before_signals_were_held, nullptr); }

bool error_is_terminal() { return isatty(STDERR_FILENO) == 1; }

bool utf8_terminal() {
  for (const char* variable : {"LC_ALL", "LC_CTYPE", "LANG"}) {
    const char* value = std::getenv(variable);
    if (value == nullptr || *value == '\0') continue;  // unset: the next one decides
    std::string lower;
    for (const char* c = value; *c != '\0'; ++c) lower += static_cast<char>(*c >= 'A' && *c <= 'Z' ? *c + 32 : *c);
    return lower.find("utf-8") != std::string::npos || lower.find("utf8") != std::string::npos;
  }
  return false;
}

std::size_t terminal_columns() {
  winsize size = {};
  return ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

void be_silent() {
  true_standard_error = dup(STDERR_FILENO);
  for (std::FILE* stream : {stdout, stderr}) static_cast<void>(std::freopen("/dev/null", "w", stream));
}

void write_to_error(std::string_view text) {
  static_cast<void>(!write(true_standard_error, text.data(), text.size()));  // nobody may be there to read it
}

bool may_write(const std::string& file) { return access(file.c_str(), W_OK) == 0; }
bool may_fill(const std::string& folder) { return access(folder.c_str(), W_OK | X_OK) == 0; }

namespace {

/// A file without a name, which disappears when it is closed.
class Scratch {
 public:
  ~Scratch() {
    if (file_ != nullptr) std::fclose(file_);
  }
  Scratch() = default;
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  [[nodiscard]] bool exists() const { return file_ != nullptr; }
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
  std::FILE* file_ = std::tmpfile();
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

int end_of(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

}  // namespace

Ended run_other_program(std::vector<std::string> words, std::string_view input) {
  Scratch in, out, said;
  if (!in.exists() || !out.exists() || !said.exists() || !in.write(input)) return {.error = errno};
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
      posix_spawnp(&process, arguments[0], &files, nullptr, arguments.data(), environment_without_dates().data());
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) return {.error = error};
  return {.status = end_of(process), .output = out.read(), .messages = said.read()};
}

namespace {

using Clock = std::chrono::steady_clock;

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

constexpr char kDone = 'd';  // the first byte of a child that has done the work; a child that died just closes the pipe

[[noreturn]] void be_the_child(int pipe, const Budget& budget, const std::function<std::string()>& work) {
  limit_this_process(budget);
  const std::string said = kDone + work();
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

}  // namespace

std::optional<Tried> try_in_child(const Budget& budget, const std::function<std::string()>& work) {
  int ends[2];
  const pid_t child = pipe(ends) == 0 ? fork() : -1;
  if (child < 0) return Tried{Tried::End::not_started, {}};
  if (child == 0) be_the_child(ends[1], budget, work);
  close(ends[1]);
  // A child that waits forever takes no processor time. On a busy machine a healthy child may get little.
  const auto patience = std::chrono::seconds(20 + 10 * budget.seconds);
  const auto said = listen(ends[0], Clock::now() + patience);
  close(ends[0]);
  if (!said) kill(child, SIGKILL);
  const int status = end_of(child);
  if (said && said->starts_with(kDone)) return Tried{Tried::End::done, said->substr(1)};
  const bool slow = !said || (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL));
  return Tried{slow ? Tried::End::too_slow : Tried::End::crashed, {}};
}

}  // namespace temper::app
