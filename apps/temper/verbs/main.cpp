// temper VERB …: finds the verb, and turns every failure into one line on standard error and an exit code.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <optional>

#include "console.hpp"
#include "exit.hpp"
#include "help/help.hpp"
#include "options/ranks.hpp"
#include "reports/reports.hpp"
#include "subject.hpp"
#include "system/system.hpp"
#include "temper/detail/build_info.hpp"
#include "temper/detail/suggest.hpp"
#include "temper/detail/version.hpp"
#include "temper/io.hpp"
#include "verbs.hpp"

namespace temper::app {

std::span<const Verb> verbs() {
  static const auto all = std::to_array<Verb>({
      {"check", "report on the quality of a mesh, and test requirements", run_check},
      {"optimize", "make " + any_elements() + " well-centered: move vertices, change weights, flip edges",
       run_optimize},
      {"mesh", "mesh an outline, and optimize the mesh", run_mesh},
      {"weights", "find weights for a mesh as it is, or prove that there are none", run_weights},
      {"explain", "explain why " + any_elements() + " are bad, and find cures", run_explain},
#ifdef TEMPER_WITH_ERRORS
      {"errors", "measure the errors that solvers make on a mesh", run_errors},
#endif
      {"operators", "write the operators of a mesh, for solvers", run_operators},
      {"draw", "draw triangles with their dual, or a cut through tetrahedra, as SVG, PNG or PDF", run_draw},
      {"convert", "write a mesh in another file format", run_convert},
      {"example", "make an example mesh", run_example},
      {"paper", "make the figures of the paper again, or repeat the steps of a run", run_paper},
  });
  return all;
}

namespace {

Exit run_verb(const std::string& name, const Arguments& arguments) {
  std::vector<std::string_view> names;
  for (const Verb& verb : verbs()) {
    if (verb.name == name) return verb.run(arguments);
    names.push_back(verb.name);
  }
  throw Failure(Exit::bad_usage, none_of(name, names) + "\nSee temper --help");
}

std::string version_text() {
  std::string text = fmt::format("temper {}\n\n", version());
  for (const BuildFact& fact : build_info()) {
    if (fact.name != "version") text += fmt::format("  {:<14}{}\n", fact.name, fact.value);
  }
  if (const std::string mpi = mpi_library(); !mpi.empty()) text += fmt::format("  {:<14}{}\n", "MPI", mpi);
  return text;
}

Exit run(const Arguments& words) {
  if (words.empty()) {
    put_to_error(short_help());
    return Exit::bad_usage;
  }
  const std::string& first = words.front();
  if (first == "--version") {
    print(version_text());
    return Exit::done;
  }
  if (first == kHelpWords && words.size() > 2) {
    Arguments of_verb = words;
    of_verb.erase(of_verb.begin() + 1);
    return run_verb(words[1], of_verb);
  }
  if (first == "--help=tables") {  // for scripts/docs/records.py
    print(tables_json());
    return Exit::done;
  }
  if (print_other_help(words)) return Exit::done;
  const bool help = first == "--help" || first == "-h" || first == "help";
  if (help && words.size() == 1) {
    print(text_of(help_of_program()));
    return Exit::done;
  }
  if (help) return run_verb(words[1], {"--help"});
  if (first[0] == '-')
    throw Failure(Exit::bad_usage, fmt::format("expected a verb, found '{}'\nSee temper --help", first));
  return run_verb(first, Arguments(words.begin() + 1, words.end()));
}

int internal_error(std::string_view what) {
  print_error(fmt::format("internal error: {}", what));
  put_to_error(fmt::format(
      "This is a defect of temper {}. Please report it, with the command and the mesh it was run on.\n", version()));
  return static_cast<int>(Exit::internal);
}

/// Runs on an exception in a place that must not throw, for example a failed allocation in a destructor. Nothing can be
/// undone any more. But unfinished files are removed, and the usual message is printed.
[[noreturn]] void end_on_terminate() {
  io::discard_unfinished();
  const char* message = "temper: error: internal error, in a place that cannot fail; please report it\n";
  if (std::current_exception()) {
    try {
      throw;
    } catch (const std::bad_alloc&) {
      message = "temper: error: out of memory\n";
    } catch (...) {
    }
  }
  std::fputs(message, stderr);
  std::_Exit(static_cast<int>(Exit::internal));
}

/// Runs the command line; returns its exit status.
int run_program(int argc, char** argv) {
  prepare_process();
  std::set_terminate(end_on_terminate);
  end_on_signals();
  try {
    const Exit exit = run(program_words(argc, argv));
    flush_output();
    leave_ranks();
    if (is_quiet() && (exit == Exit::stopped_early || exit == Exit::infeasible)) print_error(meaning(exit, argv[1]));
    return static_cast<int>(exit);
  } catch (const Failure& failure) {
    const std::optional<Failure> shown = agreed(failure);
    if (shown) print_error(shown->what());
    leave_ranks();
    return static_cast<int>(shown ? shown->exit : Exit::done);  // or the exit status is another rank's
  } catch (const std::bad_alloc&) {
    end_ranks("out of memory", Exit::internal);
    print_error("out of memory");
    return static_cast<int>(Exit::internal);
  } catch (const std::exception& error) {
    end_ranks(error.what(), Exit::internal);
    return internal_error(error.what());
  } catch (...) {
    end_ranks("unknown exception", Exit::internal);
    return internal_error("unknown exception");
  }
}

}  // namespace
}  // namespace temper::app

int main(int argc, char** argv) { return temper::app::run_program(argc, argv); }
