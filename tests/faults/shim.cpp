// Preloaded before the program that is tested (LD_PRELOAD): counts its allocations and what it does to files that it
// writes, and lets one of them fail.
//
//   TEMPER_FAULT=KIND:N[:ERROR]   the Nth call of this kind fails, from 1; KIND+ lets all from the Nth on fail
//   TEMPER_FAULT_COUNTS=FILE      how many calls there were, a line a kind, when the program has ended
//
// Kinds: allocate, open, write, short (a write of half its bytes, which is no error), fsync, close, rename. Calls count
// from the beginning of main(): what comes before is the system's.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/types.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
}

namespace {

enum Kind { allocate, open_file, write_file, short_write, fsync_file, close_file, rename_file, kKinds };
constexpr const char* kNames[kKinds] = {"allocate", "open", "write", "short", "fsync", "close", "rename"};
constexpr int kFiles = 1024;

std::atomic<bool> active = false;
std::atomic<long> counts[kKinds];
std::atomic<bool> written[kFiles];  // by their numbers: files that are open for writing
Kind failing = kKinds;
long nth = 0;
bool and_all_after = false;
int code = ENOSPC;

void read_fault(const char* text) {
  char kind[16] = {};
  if (std::sscanf(text, "%15[a-z+]:%ld:%d", kind, &nth, &code) < 2) std::_Exit(99);
  const std::size_t n = std::strlen(kind);
  and_all_after = kind[n - 1] == '+';
  if (and_all_after) kind[n - 1] = '\0';
  for (int k = 0; k < kKinds; ++k) {
    if (std::strcmp(kind, kNames[k]) == 0) failing = static_cast<Kind>(k);
  }
}

/// Counts a call, and says whether it is to fail.
bool fails(Kind kind) {
  if (!active.load(std::memory_order_relaxed)) return false;
  const long n = ++counts[kind];
  return kind == failing && (and_all_after ? n >= nth : n == nth);
}

/// The same, with the error that the system gives.
bool fails_with(Kind kind, int error) {
  if (!fails(kind)) return false;
  errno = error;
  return true;
}

bool is_written(int file) { return file >= 0 && file < kFiles && written[file]; }

template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

void tell_counts() {
  active = false;
  const char* path = std::getenv("TEMPER_FAULT_COUNTS");
  if (path == nullptr) return;
  const int file = next<int(const char*, int, ...)>("open")(path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  for (int k = 0; k < kKinds; ++k) dprintf(file, "%s %ld\n", kNames[k], counts[k].load());
}

int (*main_of_program)(int, char**, char**) = nullptr;

int counted_main(int argc, char** argv, char** environment) {
  if (const char* fault = std::getenv("TEMPER_FAULT")) read_fault(fault);
  std::atexit(tell_counts);
  active = true;
  return main_of_program(argc, argv, environment);
}

int opened(int file, int flags) {
  if (file >= 0 && file < kFiles) written[file] = (flags & O_ACCMODE) != O_RDONLY;
  return file;
}

}  // namespace

extern "C" {

int __libc_start_main(int (*program)(int, char**, char**), int argc, char** argv, int (*init)(int, char**, char**),
                      void (*fini)(), void (*rtld_fini)(), void* stack_end) {
  main_of_program = program;
  return next<decltype(__libc_start_main)>("__libc_start_main")(counted_main, argc, argv, init, fini, rtld_fini,
                                                                stack_end);
}

void* malloc(std::size_t n) { return fails_with(allocate, ENOMEM) ? nullptr : __libc_malloc(n); }
void* calloc(std::size_t n, std::size_t each) {
  return fails_with(allocate, ENOMEM) ? nullptr : __libc_calloc(n, each);
}
void* realloc(void* old, std::size_t n) { return fails_with(allocate, ENOMEM) ? nullptr : __libc_realloc(old, n); }
void* aligned_alloc(std::size_t alignment, std::size_t n) {
  return fails_with(allocate, ENOMEM) ? nullptr : __libc_memalign(alignment, n);
}
int posix_memalign(void** result, std::size_t alignment, std::size_t n) {
  if (fails(allocate)) return ENOMEM;
  *result = __libc_memalign(alignment, n);
  return *result == nullptr ? ENOMEM : 0;
}

int open(const char* path, int flags, ...) {
  mode_t mode = 0;
  if ((flags & O_CREAT) != 0) {
    va_list more;
    va_start(more, flags);
    mode = va_arg(more, mode_t);
    va_end(more);
  }
  if ((flags & O_ACCMODE) != O_RDONLY && fails_with(open_file, code)) return -1;
  return opened(next<int(const char*, int, ...)>("open")(path, flags, mode), flags);
}
int dup(int file) { return opened(next<int(int)>("dup")(file), is_written(file) ? O_WRONLY : O_RDONLY); }

ssize_t write(int file, const void* bytes, std::size_t n) {
  const auto real = next<ssize_t(int, const void*, std::size_t)>("write");
  if (!is_written(file)) return real(file, bytes, n);
  if (fails_with(write_file, code)) return -1;
  return real(file, bytes, n > 1 && fails(short_write) ? n / 2 : n);
}
int fsync(int file) { return fails_with(fsync_file, code) ? -1 : next<int(int)>("fsync")(file); }
int close(int file) {
  const bool fail = is_written(file) && fails(close_file);
  if (is_written(file)) written[file] = false;
  const int result = next<int(int)>("close")(file);
  if (!fail) return result;
  errno = code;
  return -1;
}
int rename(const char* from, const char* to) {
  return fails_with(rename_file, code) ? -1 : next<int(const char*, const char*)>("rename")(from, to);
}

}  // extern "C"
