// A first try, in a process of its own, of what a foreign library makes of a file. Libraries have bugs: on a damaged
// file they may loop for ever or crash, and then only the child does.
//
// The child is a fork: it has the file, the code and one thread, and must do without what other threads may hold.
// Nothing of the library may be under way on another thread when try_in_child is called.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace temper::io {

struct TrialBudget {
  unsigned seconds = 0;     ///< of processor time
  std::uint64_t bytes = 0;  ///< of memory, on top of what the process has; where the system tells how much that is
};
/// For a file of that size: what reading and unpacking it takes, many times over.
[[nodiscard]] TrialBudget trial_budget(std::uint64_t file_bytes);

/// What is said of a trial that ends badly.
struct Trial {
  std::string where;    ///< the file
  std::string library;  ///< that reads it
  std::string remedy;   ///< what should be done with a file that is not damaged, and takes too long
};

/// Runs work in a child process. Failure, when work fails there, dies, or takes more than the budget: the same work is
/// then not to be done here.
void try_in_child(const TrialBudget& budget, const Trial& trial, const std::function<void()>& work);

}  // namespace temper::io
