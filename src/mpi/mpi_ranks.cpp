// See temper/mpi_ranks.hpp.
#include "temper/mpi_ranks.hpp"

#include <mpi.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>

namespace temper {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 30;  // of one call: MPI counts in int

}  // namespace

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

std::vector<std::string> MpiRanks::all_gather(std::string_view mine) {
  const std::uint64_t own_bytes = mine.size();
  std::vector<std::uint64_t> bytes(size_);
  MPI_Allgather(&own_bytes, 1, MPI_UINT64_T, bytes.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD);
  // Each in turn, straight into its place: no rank needs room for all of it a second time.
  std::vector<std::string> all(size_);
  for (std::size_t r = 0; r < size_; ++r) {
    if (r == rank_) {
      all[r] = mine;
    } else {
      all[r].resize(bytes[r]);
    }
    for (std::size_t begin = 0; begin < bytes[r]; begin += kMostBytes) {
      const std::size_t count = std::min<std::size_t>(kMostBytes, bytes[r] - begin);
      MPI_Bcast(all[r].data() + begin, static_cast<int>(count), MPI_BYTE, static_cast<int>(r), MPI_COMM_WORLD);
    }
  }
  return all;
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
