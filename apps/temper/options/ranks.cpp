#include "options/ranks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <memory>

#include "system/system.hpp"
#include "temper/io.hpp"

#ifdef TEMPER_WITH_MPI
#include "temper/detail/mpi_communicator.hpp"
#endif

namespace temper::app {
namespace {

/// The number of processes that the launcher (Open MPI, MPICH or Slurm) has started; 0: no launcher.
int launched() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"}) {
    if (const char* text = std::getenv(name)) return std::max(1, std::atoi(text));
  }
  return 0;
}

bool have_agreed = false;

/// The failure of the first of `ranks` that has one. `mine` is the failure of this rank, or empty. Collective.
std::optional<Failure> first_failure(Communicator& ranks, const std::string& mine, Exit exit) {
  have_agreed = true;
  const std::string message = mine.empty() ? std::string() : fmt::format("{}{}", static_cast<int>(exit), mine);
  const std::vector<std::string> all = ranks.all_gather(message);
  const auto failed = std::find_if(all.begin(), all.end(), [](const std::string& each) { return !each.empty(); });
  if (failed == all.end()) return std::nullopt;
  const bool all_alike = std::count(all.begin(), all.end(), *failed) == std::ssize(all);
  const std::string text = failed->substr(1);
  return Failure(static_cast<Exit>(failed->front() - '0'),
                 all_alike ? text : fmt::format("rank {}: {}", failed - all.begin(), text));
}

}  // namespace

#ifdef TEMPER_WITH_MPI

namespace {

std::unique_ptr<MpiCommunicator> world;
}  // namespace

std::string mpi_library() { return MpiCommunicator::library(); }

void join_ranks() {
  const auto n = static_cast<std::size_t>(launched());
  if (n == 0) return;
  world = std::make_unique<MpiCommunicator>();
  if (world->size() < n) {
    throw Failure(
        Exit::bad_usage,
        fmt::format("optimize: started as {} processes, but {} has only {}. Next: start it with the mpirun of this MPI",
                    n, mpi_library(), world->size()));
  }
  if (world->rank() > 0) be_silent();
}

void leave_ranks() {
  // A rank that has only shown its help must not leave the others waiting.
  if (communicator() != nullptr && !have_agreed) {
    static_cast<void>(first_failure(*communicator(), "optimize: has only shown its help", Exit::bad_usage));
  }
  world.reset();
}

Communicator* communicator() { return world && world->size() > 1 ? world.get() : nullptr; }

std::vector<std::string> warnings_of_ranks() {
  const std::size_t here = communicator() != nullptr ? world->ranks_on_machine() : 1;
  if (here == 1) return {};
  return {
      fmt::format("{} ranks share this machine, and each has its own copy of the mesh and its own threads. One rank "
                  "per machine is faster: mpirun --map-by ppr:1:node --bind-to none",
                  here)};
}

void end_ranks(const std::string& message, Exit exit) {
  if (communicator() == nullptr) return;
  io::discard_unfinished();
  write_to_error(fmt::format("temper: error: rank {}: {}\n", world->rank(), message));
  world->abort(static_cast<int>(exit));
}

#else

std::string mpi_library() { return {}; }

void join_ranks() {
  if (launched() < 2) return;
  throw Failure(Exit::bad_usage,
                "optimize: started as several processes, but this program was built without MPI. Next: build it with "
                "-DTEMPER_BUILD_MPI=ON");
}

void leave_ranks() {}
Communicator* communicator() { return nullptr; }
std::vector<std::string> warnings_of_ranks() { return {}; }
void end_ranks(const std::string&, Exit) {}

#endif

bool is_first_rank() { return communicator() == nullptr || communicator()->rank() == 0; }

void on_first_rank(const std::function<void()>& work) {
  if (!is_first_rank()) return;
  try {
    work();
  } catch (const Failure& failure) {
    end_ranks(failure.what(), failure.exit);
    throw;
  }
}

void agree_to_go_on() {
  if (communicator() == nullptr) return;
  if (const auto failure = first_failure(*communicator(), {}, Exit::done)) throw Failure(*failure);
}

std::optional<Failure> agreed(const Failure& failure) {
  if (communicator() == nullptr) return failure;
  // After that, failures are equal on all ranks, or concern an output of the first one.
  std::optional<Failure> shown = failure;
  if (!have_agreed) shown = first_failure(*communicator(), failure.what(), failure.exit);
  return is_first_rank() ? shown : std::nullopt;
}

}  // namespace temper::app
