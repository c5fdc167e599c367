// See temper/mpi_ranks.hpp.
#include "temper/mpi_ranks.hpp"

#include <mpi.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>

namespace temper {

MpiRanks::MpiRanks() {
  int begun = 0;
  MPI_Initialized(&begun);
  if (begun == 0) {
    int level = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level);
    began_ = true;
  }
  int size = 1, rank = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  size_ = static_cast<std::size_t>(size);
  rank_ = static_cast<std::size_t>(rank);
}

MpiRanks::~MpiRanks() {
  if (began_) MPI_Finalize();
}

void MpiRanks::broadcast(std::string& bytes, std::size_t from) {
  const int root = static_cast<int>(from);
  std::uint64_t size = bytes.size();
  MPI_Bcast(&size, 1, MPI_UINT64_T, root, MPI_COMM_WORLD);
  bytes.resize(size);
  in_pieces(bytes, [root](char* data, std::size_t count) {
    MPI_Bcast(data, static_cast<int>(count), MPI_BYTE, root, MPI_COMM_WORLD);
  });
}

void MpiRanks::abort(int status) {
  MPI_Abort(MPI_COMM_WORLD, status);
  std::abort();
}

std::string MpiRanks::library() {
  std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> text{};
  int length = 0;
  MPI_Get_library_version(text.data(), &length);
  const std::string whole(text.data(), static_cast<std::size_t>(std::max(0, length)));
  return whole.substr(0, whole.find_first_of(",\n"));
}

}  // namespace temper
