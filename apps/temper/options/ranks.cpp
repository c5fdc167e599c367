#include "options/ranks.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "console.hpp"
#include "interrupt.hpp"
#include "processors.hpp"
#include "temper/io.hpp"
#include "threads.hpp"

#ifdef TEMPER_WITH_MPI
#include "temper/mpi_ranks.hpp"
#endif

namespace temper::app {
namespace {

/// The number of processes that the launchers of Open MPI, MPICH and Slurm say they have started; 0: none of them has.
int launched() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"}) {
    if (const char* text = std::getenv(name)) return std::max(1, std::atoi(text));
  }
  return 0;
}

bool have_agreed = false;
const char* unit_name = "process";  // of what has a number: processes, until they are ranks

#ifdef TEMPER_WITH_MPI

struct Processes {
  MpiRanks all;
  std::optional<MpiRanks> machine = {};  // those of this one's
  std::optional<MpiRanks> ranks = {};    // of all, when the others have left the run to them
  std::size_t in_rank = 1;               // processes that are this rank
  std::string processors = {};           // of all these

  [[nodiscard]] MpiRanks& at_work() { return ranks ? *ranks : all; }
};
std::unique_ptr<Processes> processes;
int standard_error = -1;  // of a rank that is silent

void be_silent() {
  standard_error = dup(STDERR_FILENO);
  for (std::FILE* stream : {stdout, stderr}) static_cast<void>(std::freopen("/dev/null", "w", stream));
}

#endif

/// The failure of the first rank that has one, where this one has `mine`, or none (an empty message).
std::optional<Failure> first_failure(const std::string& mine, Exit exit) {
  have_agreed = true;
  const std::string told = mine.empty() ? std::string() : fmt::format("{}{}", static_cast<int>(exit), mine);
  Ranks* const joined = joined_ranks();
  const std::vector<std::string> all = joined != nullptr ? joined->all_gather(told) : std::vector{told};
  const auto failed = std::find_if(all.begin(), all.end(), [](const std::string& each) { return !each.empty(); });
  if (failed == all.end()) return std::nullopt;
  const std::size_t count = static_cast<std::size_t>(std::count(all.begin(), all.end(), *failed));
  const std::string message = failed->substr(1);
  return Failure(static_cast<Exit>(failed->front() - '0'),
                 count == all.size() ? message : fmt::format("{} {}: {}", unit_name, failed - all.begin(), message));
}

#ifdef TEMPER_WITH_MPI

/// Makes one rank of the processes of this machine, if all may run on each other's processors. Says whether this
/// process is a rank.
bool join_machine(const Arguments& words) {
  MpiRanks& all = processes->all;
  MpiRanks& machine = processes->machine.emplace(all.of_machine());
  std::string given = std::filesystem::current_path().string();
  for (const std::string& word : words) given += '\0' + word;
  have_agreed = false;
  if (machine.all_gather(given).front() != given) {
    throw Failure(
        Exit::bad_input,
        "optimize: was started with other words, or in another folder, than the first process of its machine, "
        "with which it makes one rank: see --ranks");
  }
  agree_to_go_on();
  std::string joint;
  for (const std::string& each : machine.all_gather(own_processors())) joint = both(std::move(joint), each);
  const bool is_first = machine.rank() == 0;
  std::string merged = is_first && (machine.size() == 1 || run_on(joint)) ? "yes" : "";
  machine.broadcast(merged, 0);
  if (!merged.empty()) {
    processes->in_rank = machine.size();
    processes->processors = joint;
  }
  const std::vector<std::string> apart = all.all_gather(is_first && merged.empty() ? "apart" : "");
  if (const auto n = std::count(apart.begin(), apart.end(), "apart"); n > 0) {
    print_warnings(std::vector{fmt::format(
        "the processes of {} may not run on each other's processors: each of them is a rank, and has the whole mesh",
        n == 1 ? "one machine" : fmt::format("{} machines", n))});
  }
  const bool is_rank = is_first || merged.empty();
  processes->ranks.emplace(all.of_group(is_rank ? 0 : 1));
  return is_rank;
}

#endif

}  // namespace

#ifdef TEMPER_WITH_MPI

std::string mpi_library() { return MpiRanks::library(); }

void join_ranks() {
  if (launched() == 0) return;
  processes = std::make_unique<Processes>();
  const auto n = static_cast<std::size_t>(launched());
  if (processes->all.size() < n) {
    throw Failure(Exit::bad_usage, fmt::format("optimize: started as {} processes, of which {} knows {}: mpirun is of "
                                               "another MPI",
                                               n, mpi_library(), processes->all.size()));
  }
  if (processes->all.rank() > 0) be_silent();
}

bool become_ranks(std::optional<RankUnit> unit, const Arguments& words) {
  if (!processes) return unit.has_value();
  agree_to_go_on();  // all have been told what to do
  if (unit && !has_threads()) unit = RankUnit::process;
  const std::string plan = unit ? std::to_string(static_cast<int>(*unit)) : "nothing";
  const std::vector<std::string> plans = processes->all.all_gather(plan);
  if (std::any_of(plans.begin(), plans.end(), [&](const std::string& each) { return each != plan; })) {
    throw Failure(Exit::bad_input, "optimize: --ranks, or --help, is not the same for all processes");
  }
  if (!unit) return false;
  const bool is_rank = *unit == RankUnit::process || join_machine(words);
  have_agreed = false;  // ranks read and fail on their own
  unit_name = "rank";
  if (!is_rank) catch_interrupts();
  return is_rank;
}

std::size_t threads_of_rank(std::size_t threads) {
  if (!processes || processes->in_rank == 1) return threads;
  if (threads == 0) return count_processors(processes->processors);
  return std::max(threads, threads * processes->in_rank);  // a product that wraps around is no more than was asked for
}

Ranks* joined_ranks() {
  if (!processes) return nullptr;
  MpiRanks& ranks = processes->at_work();
  return ranks.size() > 1 ? &ranks : nullptr;
}

void end_ranks(const std::string& message, Exit exit) {
  if (!processes || processes->all.size() == 1) return;
  io::discard_unfinished();
  const std::string line = fmt::format("temper: error: {} {}: {}\n", unit_name, processes->at_work().rank(), message);
  const int to = standard_error >= 0 ? standard_error : STDERR_FILENO;
  static_cast<void>(!write(to, line.data(), line.size()));  // nobody may be there to read it
  processes->all.abort(static_cast<int>(exit));
}

void leave_ranks() {
  if (processes) processes->all.wait_for_all();
  processes.reset();
}

#else

std::string mpi_library() { return {}; }

void join_ranks() {
  if (launched() < 2) return;
  throw Failure(Exit::bad_usage,
                "optimize: started as several processes, by a program that was built without MPI; for ranks configure "
                "it with -DTEMPER_BUILD_MPI=ON");
}

bool become_ranks(std::optional<RankUnit> unit, const Arguments&) { return unit.has_value(); }
std::size_t threads_of_rank(std::size_t threads) { return threads; }
Ranks* joined_ranks() { return nullptr; }
void end_ranks(const std::string&, Exit) {}
void leave_ranks() {}

#endif

void alone(const std::function<void()>& work) {
  try {
    work();
  } catch (const Failure& failure) {
    if (joined_ranks() != nullptr) end_ranks(failure.what(), failure.exit);
    throw;
  }
}

bool is_first_rank() { return joined_ranks() == nullptr || joined_ranks()->rank() == 0; }

void agree_to_go_on() {
  if (joined_ranks() == nullptr) return;
  if (const auto failure = first_failure({}, Exit::done)) throw Failure(*failure);
}

std::optional<Failure> agreed(const Failure& failure) {
  if (joined_ranks() == nullptr) return failure;
  // After that what fails fails on all ranks alike, or is an output of the first one.
  std::optional<Failure> shown = failure;
  if (!have_agreed) shown = first_failure(failure.what(), failure.exit);
  return is_first_rank() ? shown : std::nullopt;
}

}  // namespace temper::app
