// Several machines on one, for ranks.py: loaded before a program, this tells it that MACHINE_SIZE processes each share
// a machine, and that the processes of the machine of number MACHINE_BOUND may not run on other processors than their
// own.
#include <mpi.h>
#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>

namespace {

/// The number of this process over how many make a machine; less than 0 where nobody says so.
int machine() {
  const char* number = std::getenv("OMPI_COMM_WORLD_RANK");
  if (number == nullptr) number = std::getenv("PMI_RANK");
  const char* size = std::getenv("MACHINE_SIZE");
  return number != nullptr && size != nullptr ? std::atoi(number) / std::atoi(size) : -1;
}

}  // namespace

extern "C" int MPI_Comm_split_type(MPI_Comm of, int /*type*/, int key, MPI_Info /*info*/, MPI_Comm* made) {
  return PMPI_Comm_split(of, machine() < 0 ? 0 : machine(), key, made);
}

extern "C" int sched_setaffinity(pid_t process, std::size_t size, const cpu_set_t* mask) noexcept {
  const char* bound = std::getenv("MACHINE_BOUND");
  if (bound == nullptr || std::atoi(bound) != machine()) {
    return syscall(SYS_sched_setaffinity, process, size, mask) < 0 ? -1 : 0;
  }
  errno = EPERM;
  return -1;
}
