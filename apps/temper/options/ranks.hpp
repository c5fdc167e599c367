// The ranks of a run of `temper optimize`: the processes that mpirun has started with the same command, or this one
// alone. The first rank writes and prints; the others are silent.
//
// A rank has the whole mesh. So by default the processes of one machine are one rank: the first of them makes its part
// of the run with the threads and processors of all, and the others sleep.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "exit.hpp"
#include "help/command.hpp"
#include "temper/ranks.hpp"

namespace temper::app {

/// Joins the ranks, if there are any. Failure: mpirun has started several, and this program knows nothing of MPI.
void join_ranks();
/// What is one rank.
enum class RankUnit : std::uint8_t { machine, process };
/// Makes ranks of the processes, which have been given these words, before anything large is read. False: this one has
/// nothing more to do, since another process of its machine is the rank, or since there is nothing to do (`unit`: none)
/// for any of them. Where processes of a machine may not run on each other's processors each stays a rank, and a
/// warning says so; where the program has no threads, too.
[[nodiscard]] bool become_ranks(std::optional<RankUnit> unit, const Arguments& words);
/// Of so many threads for each process (0: as it may have), those of this rank.
[[nodiscard]] std::size_t threads_of_rank(std::size_t threads);

/// The library of MPI that the program has; empty: none.
[[nodiscard]] std::string mpi_library();
/// Null: this one is alone.
[[nodiscard]] Ranks* joined_ranks();
[[nodiscard]] bool is_first_rank();

/// All ranks say that they have come so far; once, when all that can fail on one of them alone is done. Throws the
/// Failure of the first rank that has one.
void agree_to_go_on();
/// What there is to say of a Failure of this rank: that of the first rank that has one. Nothing where another says it.
[[nodiscard]] std::optional<Failure> agreed(const Failure& failure);
/// Does what no other rank does: they wait meanwhile, so a Failure ends them.
void alone(const std::function<void()>& work);
/// Ends all ranks, which may be waiting for this one: returns where there are no others.
void end_ranks(const std::string& message, Exit exit);
/// When all ranks are done.
void leave_ranks();

}  // namespace temper::app
