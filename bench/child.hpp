// Measurements in a child process: its own peak of memory, its own processor time, and nothing left behind.
#pragma once

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <ctime>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace temper::bench {

/// Seconds of processor time of this process, all threads: what other programs on the machine disturb least.
inline double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

inline double wall_seconds() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The result of work() in a fork of this process, or nothing when it died.
template <class Work>
auto in_child(Work&& work) {
  using Result = std::invoke_result_t<Work>;
  static_assert(std::is_trivially_copyable_v<Result>);
  std::optional<Result> result;
  int ends[2];
  std::fflush(nullptr);
  if (pipe(ends) != 0) return result;
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    const Result value = work();
    const bool sent = write(ends[1], &value, sizeof value) == static_cast<ssize_t>(sizeof value);
    std::fflush(nullptr);
    _exit(sent ? 0 : 1);
  }
  close(ends[1]);
  Result value{};
  const bool received = child > 0 && read(ends[0], &value, sizeof value) == static_cast<ssize_t>(sizeof value);
  close(ends[0]);
  int status = 0;
  if (child > 0) waitpid(child, &status, 0);
  if (received) result = value;
  return result;
}

/// One run of a program.
struct ProgramRun {
  bool ok = false;
  double wall = 0, cpu = 0;  ///< seconds
  double peak_bytes = 0;     ///< of resident memory
};

inline ProgramRun run_program(const std::vector<std::string>& words) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  std::fflush(nullptr);
  const double start = wall_seconds();
  const pid_t child = vfork();
  if (child == 0) {
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  ProgramRun run;
  int status = 0;
  rusage used{};
  if (child > 0 && wait4(child, &status, 0, &used) == child) {
    run.ok = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    const auto seconds = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    run.cpu = seconds(used.ru_utime) + seconds(used.ru_stime);
    run.peak_bytes = 1024.0 * static_cast<double>(used.ru_maxrss);
  }
  run.wall = wall_seconds() - start;
  return run;
}

/// Peak of this process's resident memory so far, in bytes.
inline double peak_bytes() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return 1024.0 * static_cast<double>(used.ru_maxrss);
}

}  // namespace temper::bench
