#include "temper/detail/mpi_communicator.hpp"

#include <mpi.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>

namespace temper {

MpiCommunicator::MpiCommunicator() {
  int begun = 0;
  MPI_Initialized(&begun);
  if (begun == 0) {
    int level = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level);
    begins_mpi_ = true;
  }
  int size = 1, rank = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  size_ = static_cast<std::size_t>(size);
  rank_ = static_cast<std::size_t>(rank);
}

MpiCommunicator::~MpiCommunicator() {
  if (begins_mpi_) MPI_Finalize();
}

void MpiCommunicator::broadcast(std::string& bytes, std::size_t from) {
  const int root = static_cast<int>(from);
  std::uint64_t size = bytes.size();
  MPI_Bcast(&size, 1, MPI_UINT64_T, root, MPI_COMM_WORLD);
  bytes.resize(size);
  in_pieces(bytes, [&](char* data, std::size_t count) {
    MPI_Bcast(data, static_cast<int>(count), MPI_BYTE, root, MPI_COMM_WORLD);
  });
}

std::size_t MpiCommunicator::ranks_on_machine() const {
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  int size = 1;
  MPI_Comm_size(machine, &size);
  MPI_Comm_free(&machine);
  return static_cast<std::size_t>(size);
}

void MpiCommunicator::abort(int status) {
  MPI_Abort(MPI_COMM_WORLD, status);
  std::abort();
}

std::string MpiCommunicator::library() {
  std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> text{};
  int length = 0;
  MPI_Get_library_version(text.data(), &length);
  const std::string whole(text.data(), static_cast<std::size_t>(std::max(0, length)));
  return whole.substr(0, whole.find_first_of(",\n"));
}

}  // namespace temper
