// A communicator by one of mpi4py. This module itself knows no MPI.
#pragma once

#include <cstdlib>
#include <string>

#include "bind.hpp"
#include "temper/detail/communicator.hpp"

namespace temper::python {

class PythonCommunicator final : public Communicator {
 public:
  /// `communicator` has what mpi4py's Comm has: Get_size, Get_rank, bcast, Bcast and Abort.
  explicit PythonCommunicator(const py::object& communicator)
      : communicator_(communicator),
        size_(communicator.attr("Get_size")().cast<std::size_t>()),
        rank_(communicator.attr("Get_rank")().cast<std::size_t>()) {}

  [[nodiscard]] std::size_t size() const override { return size_; }
  [[nodiscard]] std::size_t rank() const override { return rank_; }

  /// What fails here leaves the other ranks waiting, and cannot be raised through the library: it ends them all.
  void broadcast(std::string& bytes, std::size_t from) override {
    const py::gil_scoped_acquire gil;
    try {
      send_or_receive(bytes, from);
    } catch (py::error_already_set& error) {
      error.restore();
      PyErr_Print();
      end_all();
    } catch (...) {
      end_all();
    }
  }

 private:
  [[noreturn]] void end_all() const {
    try {
      communicator_.attr("Abort")(1);
    } catch (...) {  // this process ends, and MPI the others
    }
    std::abort();
  }

  void send_or_receive(std::string& bytes, std::size_t from) const {
    bytes.resize(communicator_.attr("bcast")(bytes.size(), py::arg("root") = from).cast<std::size_t>());
    in_pieces(bytes, [&](char* data, std::size_t count) {
      communicator_.attr("Bcast")(py::memoryview::from_memory(data, static_cast<py::ssize_t>(count)),
                                  py::arg("root") = from);
    });
  }

  const py::object& communicator_;
  std::size_t size_, rank_;
};

}  // namespace temper::python
