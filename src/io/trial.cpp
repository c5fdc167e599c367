// See trial.hpp. The child tells how it ended through a pipe: nothing but the end of the pipe when it died.
#include "io/trial.hpp"

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
#include <cstdio>
#include <cstring>
#include <new>
#include <optional>

#include "io/failure.hpp"

namespace temper::io {

namespace {

using Clock = std::chrono::steady_clock;

// The first byte of what the child says; after kFailed the code of the error, its place, a zero, and its message.
constexpr char kDone = 'd', kFailed = 'f', kNoMemory = 'm';

/// Memory that the process has, or 0 when the system does not tell.
std::uint64_t address_space() {
  std::uint64_t pages = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
    unsigned long first = 0;
    if (std::fscanf(file, "%lu", &first) == 1) pages = first;
    std::fclose(file);
  }
  return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

void limit_this_process(const TrialBudget& budget) {
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

std::string run(const std::function<void()>& work) {
  try {
    work();
    return {kDone};
  } catch (const Failure& failure) {
    std::string said = {kFailed, static_cast<char>(failure.error.code)};
    said.append(failure.error.where).append(1, '\0').append(failure.error.message);
    return said;
  } catch (const std::bad_alloc&) {
    return {kNoMemory};
  }
}

[[noreturn]] void be_the_child(int pipe, const TrialBudget& budget, const std::function<void()>& work) {
  limit_this_process(budget);
  const std::string said = run(work);
  std::size_t at = 0;
  while (at < said.size()) {
    const ssize_t n = ::write(pipe, said.data() + at, said.size() - at);
    if (n < 0 && errno != EINTR) break;
    if (n > 0) at += static_cast<std::size_t>(n);
  }
  _exit(0);  // nothing of the parent's is flushed or torn down
}

/// All that comes through the pipe until its end, or nothing when that does not come in time.
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

[[noreturn]] void fail_as_said(const std::string& said) {
  const std::size_t end = said.find('\0', 2);
  fail(static_cast<ErrorCode>(said[1]), said.substr(2, end - 2), said.substr(end + 1));
}

}  // namespace

TrialBudget trial_budget(std::uint64_t file_bytes) {
  constexpr std::uint64_t kMegabyte = 1 << 20;
  const std::uint64_t megabytes = file_bytes / kMegabyte;
  return {static_cast<unsigned>(3 + megabytes), 512 * kMegabyte + 256 * file_bytes};
}

void try_in_child(const TrialBudget& budget, const Trial& trial, const std::function<void()>& work) {
  const auto& [where, library, remedy] = trial;
  int ends[2];
  const pid_t child = pipe(ends) == 0 ? fork() : -1;
  if (child < 0) {
    fail(ErrorCode::unsupported, where,
         text("is first read in a process of its own, and none could be started: ", std::strerror(errno)));
  }
  if (child == 0) be_the_child(ends[1], budget, work);
  close(ends[1]);
  // A child that waits for ever costs no processor time. On a busy machine it may have little of it.
  const auto patience = std::chrono::seconds(20 + 10 * budget.seconds);
  const auto said = listen(ends[0], Clock::now() + patience);
  close(ends[0]);
  if (!said) kill(child, SIGKILL);
  const int status = end_of(child);
  if (said && said->starts_with(kDone)) return;
  if (said && said->starts_with(kFailed)) fail_as_said(*said);
  if (said && said->starts_with(kNoMemory))
    fail(ErrorCode::unsupported, where, text(library, " needs too much memory for it"));
  const bool slow = !said || (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL));
  fail(ErrorCode::syntax, where,
       slow ? text(library, " does not get to its end within ", budget.seconds, " s: the file is damaged, or ", remedy)
            : text(library, " dies of it: the file is damaged"));
}

}  // namespace temper::io
