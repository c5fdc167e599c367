// The ranks of a run of `temper optimize`: the processes that mpirun has started with the same command, or this one
// alone. The first rank writes and prints; the others are silent.
#pragma once

#include <optional>
#include <string>

#include "exit.hpp"
#include "temper/ranks.hpp"

namespace temper::app {

/// Joins the ranks, if there are any. Failure: mpirun has started several, and this program knows nothing of MPI.
void join_ranks();
/// The library of MPI that the program has; empty: none.
[[nodiscard]] std::string mpi_library();
/// Null: this process is alone.
[[nodiscard]] Ranks* joined_ranks();
[[nodiscard]] bool is_first_rank();

/// All ranks say that they have come so far; once, when all that can fail on one of them alone is done. Throws the
/// Failure of the first rank that has one.
void agree_to_go_on();
/// What there is to say of a Failure of this rank: that of the first rank that has one. Nothing where another says it.
[[nodiscard]] std::optional<Failure> agreed(const Failure& failure);
/// Ends all ranks, which may be waiting for this one: returns where there are no others.
void end_ranks(const std::string& message, Exit exit);
/// When all ranks are done.
void leave_ranks();

}  // namespace temper::app
