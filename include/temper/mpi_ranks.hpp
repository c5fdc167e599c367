// Ranks by MPI, for optimize(): in a library of its own (temper::mpi), which is built where it is asked for.
//
//   temper::MpiRanks ranks;
//   temper::optimize(mesh, {}, {.ranks = &ranks});
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "temper/ranks.hpp"

namespace temper {

/// The processes of MPI_COMM_WORLD, or some of them. One thread calls the functions of all such objects of a process.
class MpiRanks final : public Ranks {
 public:
  /// All. Begins MPI, unless the caller has: once in a process, as MPI wants it.
  MpiRanks();
  /// Ends it, if the constructor began it: when all ranks are there, and what was made of them is gone.
  ~MpiRanks() override;
  MpiRanks(MpiRanks&& other) noexcept;
  MpiRanks(const MpiRanks&) = delete;
  MpiRanks& operator=(const MpiRanks&) = delete;
  MpiRanks& operator=(MpiRanks&&) = delete;

  /// Those of these that run on this one's machine: that could share memory. In the same order. Collective.
  [[nodiscard]] MpiRanks of_machine() const;
  /// Those of these that give the same number, which is not negative. In the same order. Collective.
  [[nodiscard]] MpiRanks of_group(int number) const;

  [[nodiscard]] std::size_t size() const override { return size_; }
  [[nodiscard]] std::size_t rank() const override { return rank_; }
  /// When another rank is lost MPI ends this one.
  void broadcast(std::string& bytes, std::size_t from) override;
  /// Returns when all have called it. Asleep, while MPI's own barriers keep a processor busy. Collective.
  void wait_for_all() const;
  /// Ends all processes, wherever they are, with this exit status.
  [[noreturn]] void abort(int status);

  /// "Open MPI v4.1.4": which one it is.
  [[nodiscard]] static std::string library();

 private:
  struct Communicator;  // of MPI
  explicit MpiRanks(std::unique_ptr<Communicator> own);

  std::unique_ptr<Communicator> of_;
  std::size_t size_ = 1, rank_ = 0;
};

}  // namespace temper
