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
/// Of the ranks; null: this process is alone.
[[nodiscard]] Communicator* communicator();
[[nodiscard]] bool is_first_rank();
/// A warning when other ranks run on this machine: each takes memory and threads of its own. Collective.
[[nodiscard]] std::vector<std::string> warnings_of_ranks();
/// The MPI library that the program has; empty: none.
[[nodiscard]] std::string mpi_library();

/// All ranks say that they have come so far; once, when all that can fail on one of them alone is done. Throws the
/// Failure of the first rank that has one.
void agree_to_go_on();
/// The Failure to print for one of this rank: that of the first rank that has one. None where another rank prints it.
[[nodiscard]] std::optional<Failure> agreed(const Failure& failure);
/// Does this on the first rank. The others do not wait here but at the next message, so a Failure ends them.
void on_first_rank(const std::function<void()>& work);
/// Ends all ranks, which may be waiting for this one. Returns where there are no others.
void end_ranks(const std::string& message, Exit exit);

}  // namespace temper::app
