// The ranks of a run of `temper optimize`: the processes that mpirun has started, or this one alone. Each has the whole
// mesh and threads of its own. The first rank writes and prints; the others are silent.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "exit.hpp"
#include "temper/detail/executor.hpp"

namespace temper::app {

/// Joins the other ranks, if there are any. Failure: mpirun has started several, and this program has no MPI.
void join_ranks();
/// Leaves them, when all are done.
void leave_ranks();
/// The communicator of the ranks; null: this process is alone.
[[nodiscard]] Communicator* communicator();
[[nodiscard]] bool is_first_rank();
/// A warning when other ranks run on this machine: each takes memory and threads of its own. Collective.
[[nodiscard]] std::vector<std::string> warnings_of_ranks();
/// The MPI library that the program has; empty: none.
[[nodiscard]] std::string mpi_library();

/// Waits until all ranks have come so far: once, after everything that can fail on one of them alone. Throws the
/// Failure of the first rank that has one.
void agree_to_go_on();
/// The Failure to print when this rank has one: the failure of the first rank that has one. None if another rank prints
/// it.
[[nodiscard]] std::optional<Failure> agreed(const Failure& failure);
/// Does the work on the first rank. The others do not wait here but at the next message, so a Failure ends them.
void on_first_rank(const std::function<void()>& work);
/// Ends all ranks, which may be waiting for this one. Returns if there are no others.
void end_ranks(const std::string& message, Exit exit);

}  // namespace temper::app
