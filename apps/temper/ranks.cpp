#include "ranks.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

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

#ifdef TEMPER_WITH_MPI

std::unique_ptr<MpiRanks> ranks;
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
                 count == all.size() ? message : fmt::format("rank {}: {}", failed - all.begin(), message));
}

}  // namespace

#ifdef TEMPER_WITH_MPI

std::string mpi_library() { return MpiRanks::library(); }

void join_ranks() {
  if (launched() == 0) return;
  ranks = std::make_unique<MpiRanks>();
  const auto n = static_cast<std::size_t>(launched());
  if (ranks->size() < n) {
    throw Failure(Exit::bad_usage, fmt::format("optimize: started as {} processes, of which {} knows {}: mpirun is of "
                                               "another MPI",
                                               n, mpi_library(), ranks->size()));
  }
  if (ranks->rank() > 0) be_silent();
}

Ranks* joined_ranks() { return ranks.get(); }

void end_ranks(const std::string& message, Exit exit) {
  if (!ranks || ranks->size() == 1) return;
  const std::string line = fmt::format("temper: error: rank {}: {}\n", ranks->rank(), message);
  const int to = standard_error >= 0 ? standard_error : STDERR_FILENO;
  static_cast<void>(!write(to, line.data(), line.size()));  // nobody may be there to read it
  ranks->abort(static_cast<int>(exit));
}

void leave_ranks() { ranks.reset(); }

#else

std::string mpi_library() { return {}; }

void join_ranks() {
  if (launched() < 2) return;
  throw Failure(Exit::bad_usage,
                "optimize: started as several processes, by a program that was built without MPI; for ranks configure "
                "it with -DTEMPER_BUILD_MPI=ON");
}

Ranks* joined_ranks() { return nullptr; }
void end_ranks(const std::string&, Exit) {}
void leave_ranks() {}

#endif

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
