#include "exit.hpp"

#include <unistd.h>

#include <csignal>
#include <string_view>

#include "temper/io.hpp"

namespace temper::app {
namespace {

volatile std::sig_atomic_t signal_seen = 0;

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
  constexpr std::string_view kMessage =
      "\ntemper: stopped by a signal; a file that was not finished is as it was before\n";
  static_cast<void>(!write(STDERR_FILENO, kMessage.data(), kMessage.size()));  // nobody may be there to read it
  raise(signal);                                                               // which has its first meaning again
}

void end_on(int signal) { handle(signal, end_program, static_cast<int>(SA_RESETHAND | SA_NODEFER)); }

extern "C" void note_signal(int) {
  signal_seen = 1;
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) end_on(signal);
}

}  // namespace

std::string_view meaning(Exit exit, std::string_view verb) {
  switch (exit) {
    case Exit::done:
      return "Done.";
    case Exit::bad_input:
      return "Bad input, or an output cannot be written. The message names all written files.";
    case Exit::bad_usage:
      return "Bad usage: options that are wrong or missing.";
    case Exit::requirement:
      return "A requirement of --require or --require-claims is not met.";
    case Exit::stopped_early:
      if (verb == "weights")
        return "A signal or --time-limit stopped the search before it found weights. OUT is not written.";
      if (verb == "mesh") return "A signal or --time-limit stopped the run. The best mesh is written, if there is one.";
      return verb.empty() ? "A signal or --time-limit stopped the run, or edges are not regular. The best mesh is "
                            "written, except by weights."
                          : "A signal or --time-limit stopped the run, or edges are not regular. The best mesh is "
                            "written.";
    case Exit::internal:
      return "Out of memory, or an internal error. Please report it.";
    case Exit::infeasible:
      return "No weights meet the request. Only the certificate is written.";
  }
  return "";
}

void end_on_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) end_on(signal);
}

void catch_interrupts() {
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) handle(signal, note_signal, SA_RESTART);  // no write is cut short
}

bool interrupted() { return signal_seen != 0; }

}  // namespace temper::app
