// Ranks by MPI, for optimize(): in a library of its own (temper::mpi), which is built where it is asked for.
//
//   temper::MpiRanks ranks;
//   temper::optimize(mesh, {}, {.ranks = &ranks});
#pragma once

#include <cstddef>
#include <string>

#include "temper/ranks.hpp"

namespace temper {

/// The processes of MPI_COMM_WORLD. One at most at a time, whose functions one thread calls; and one in a process,
/// unless the caller begins and ends MPI: it begins once.
class MpiRanks final : public Ranks {
 public:
  /// Begins MPI, unless the caller has.
  MpiRanks();
  /// Ends it, if the constructor began it: when all ranks are there.
  ~MpiRanks() override;
  MpiRanks(const MpiRanks&) = delete;
  MpiRanks& operator=(const MpiRanks&) = delete;

  [[nodiscard]] std::size_t size() const override { return size_; }
  [[nodiscard]] std::size_t rank() const override { return rank_; }
  /// When another rank is lost MPI ends this one.
  void broadcast(std::string& bytes, std::size_t from) override;
  /// Ends all ranks, wherever they are, with this exit status.
  [[noreturn]] void abort(int status);

  /// "Open MPI v4.1.4": which one it is.
  [[nodiscard]] static std::string library();

 private:
  bool began_ = false;
  std::size_t size_ = 1, rank_ = 0;
};

}  // namespace temper
