// What the program asks of the operating system: its process, signals, the terminal, other processes. posix.cpp answers
// on Linux and macOS, windows.cpp on Windows. (Files are the library's: temper/io.hpp.)
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace temper::app {

/// Called once, before all others: errors of writing come back as errors, and the standard streams take bytes.
void prepare_process();
/// Called before a mesh file of this size is read. With a large one, more of the arrays that are freed go back to the
/// system, since the memory in use counts.
void prepare_for_file(std::uint64_t bytes);
/// Gives memory that is free back to the system, after a long run.
void return_freed_memory();
/// The words of the command line behind the program's name, in UTF-8.
[[nodiscard]] std::vector<std::string> program_words(int argc, char** argv);

// SIGINT (Ctrl-C), SIGTERM and SIGHUP end the program at once, and leave every file unchanged or whole. A verb with a
// partial result notes the first one instead, and stops. On Windows these are Ctrl-C, Ctrl-Break and a closed window.

/// From here on a signal ends the program: it removes unfinished files, prints a line, and passes the signal on to the
/// process that waits for it. (A signal that is ignored, as by nohup, stays ignored.)
void end_on_signals();
/// From here on the first SIGINT, SIGTERM or SIGUSR1 is only noted; the second one ends the program. The launcher
/// mpirun hands these on, and job schedulers send them when time is nearly up.
void catch_interrupts();
/// Says whether a signal has been noted.
[[nodiscard]] bool interrupted();

/// While it lives, signals such as Ctrl-C end the program only when the current files are whole.
class SignalsHeld {
 public:
  SignalsHeld();
  ~SignalsHeld();
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;
};

[[nodiscard]] bool error_is_terminal();
/// Says whether the terminal takes UTF-8.
[[nodiscard]] bool utf8_terminal();
/// Columns of the terminal on standard output; 0 when it is none.
[[nodiscard]] std::size_t terminal_columns();
/// Nothing more reaches standard output or standard error, except what write_to_error() has.
void be_silent();
/// Text to the standard error that the program started with, at once. A handler of a signal may call it.
void write_to_error(std::string_view text);

/// Says whether this user may write a file, or put files into a folder. False: errno has the reason.
[[nodiscard]] bool may_write(const std::string& file);
[[nodiscard]] bool may_fill(const std::string& folder);

/// A program that has ended.
struct Ended {
  int error = 0;   ///< errno: it could not be started
  int status = 0;  ///< 0: it did its work
  std::string output = {}, messages = {};
};
/// Runs the program of the first word with this input. It sees a fixed date, so its output has the same bytes each
/// time.
[[nodiscard]] Ended run_other_program(std::vector<std::string> words, std::string_view input);

struct Budget {
  unsigned seconds = 0;     ///< of processor time
  std::uint64_t bytes = 0;  ///< of memory, on top of the process, if the system gives its size
};
/// Work that a copy of this process has done.
struct Tried {
  enum class End { done, crashed, too_slow, not_started };  ///< not_started: errno has the reason
  End end;
  std::string answer;  ///< of the work, if it is done
};
/// Does the work in a copy of this process, which may crash. Nothing: the system cannot copy a process.
[[nodiscard]] std::optional<Tried> try_in_child(const Budget& budget, const std::function<std::string()>& work);

}  // namespace temper::app
