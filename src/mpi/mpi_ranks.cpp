// See temper/mpi_ranks.hpp.
#include "temper/mpi_ranks.hpp"

#include <mpi.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <thread>
#include <utility>

namespace temper {

struct MpiRanks::Communicator {
  MPI_Comm mpi = MPI_COMM_WORLD;
  bool begins_mpi = false;

  Communicator() = default;
  Communicator(const Communicator&) = delete;
  Communicator& operator=(const Communicator&) = delete;
  ~Communicator() {
    int over = 0;
    MPI_Finalized(&over);  // by the caller
    if (mpi != MPI_COMM_WORLD && over == 0) MPI_Comm_free(&mpi);
    if (begins_mpi) MPI_Finalize();
  }
};

MpiRanks::MpiRanks(std::unique_ptr<Communicator> own) : of_(std::move(own)) {
  int size = 1, rank = 0;
  MPI_Comm_size(of_->mpi, &size);
  MPI_Comm_rank(of_->mpi, &rank);
  size_ = static_cast<std::size_t>(size);
  rank_ = static_cast<std::size_t>(rank);
}

MpiRanks::MpiRanks()
    : MpiRanks([] {
        auto world = std::make_unique<Communicator>();
        int begun = 0;
        MPI_Initialized(&begun);
        if (begun == 0) {
          int level = 0;
          MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level);
          world->begins_mpi = true;
        }
        return world;
      }()) {}

MpiRanks::MpiRanks(MpiRanks&& other) noexcept = default;
MpiRanks::~MpiRanks() = default;

MpiRanks MpiRanks::of_machine() const {
  auto own = std::make_unique<Communicator>();
  MPI_Comm_split_type(of_->mpi, MPI_COMM_TYPE_SHARED, static_cast<int>(rank_), MPI_INFO_NULL, &own->mpi);
  return MpiRanks(std::move(own));
}

MpiRanks MpiRanks::of_group(int number) const {
  auto own = std::make_unique<Communicator>();
  MPI_Comm_split(of_->mpi, number, static_cast<int>(rank_), &own->mpi);
  return MpiRanks(std::move(own));
}

void MpiRanks::broadcast(std::string& bytes, std::size_t from) {
  const int root = static_cast<int>(from);
  std::uint64_t size = bytes.size();
  MPI_Bcast(&size, 1, MPI_UINT64_T, root, of_->mpi);
  bytes.resize(size);
  in_pieces(bytes,
            [&](char* data, std::size_t count) { MPI_Bcast(data, static_cast<int>(count), MPI_BYTE, root, of_->mpi); });
}

void MpiRanks::wait_for_all() const {
  constexpr std::chrono::milliseconds kNap(10);
  MPI_Request all_here = MPI_REQUEST_NULL;
  MPI_Ibarrier(of_->mpi, &all_here);
  for (int done = 0; done == 0;) {
    MPI_Test(&all_here, &done, MPI_STATUS_IGNORE);
    if (done == 0) std::this_thread::sleep_for(kNap);
  }
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
