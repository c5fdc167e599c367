// A communicator by MPI, for optimize(). It has a library of its own, temper::mpi, which is built on demand.
//
//   temper::MpiCommunicator communicator;
//   temper::optimize(mesh, {}, {.communicator = &communicator});
#pragma once

#include <cstddef>
#include <string>

#include "temper/detail/executor.hpp"

namespace temper {

/// The processes of MPI_COMM_WORLD. One thread of a process calls the functions.
class MpiCommunicator final : public Communicator {
 public:
  /// Begins MPI, unless the caller has begun it. MPI can begin only once in a process.
  MpiCommunicator();
  /// Ends MPI if the constructor began it. It waits for all ranks.
  ~MpiCommunicator() override;
  MpiCommunicator(const MpiCommunicator&) = delete;
  MpiCommunicator& operator=(const MpiCommunicator&) = delete;

  [[nodiscard]] std::size_t size() const override { return size_; }
  [[nodiscard]] std::size_t rank() const override { return rank_; }
  /// MPI ends this process when another rank is lost.
  void broadcast(std::string& bytes, std::size_t from) override;
  /// Returns the number of ranks on this machine. Collective.
  [[nodiscard]] std::size_t ranks_on_machine() const;
  /// Ends all processes on all machines with this exit status.
  [[noreturn]] void abort(int status);

  /// The name of the MPI library, such as "Open MPI v4.1.4".
  [[nodiscard]] static std::string library();

 private:
  bool begins_mpi_ = false;
  std::size_t size_ = 1, rank_ = 0;
};

}  // namespace temper
