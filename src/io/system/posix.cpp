// Linux and macOS: see system.hpp. Other runs may write the same file, and signals end this one.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#ifdef __APPLE__
#include <sys/sysctl.h>
#endif

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <optional>
#include <utility>

#include "io/system/free_memory.hpp"
#include "io/system/system.hpp"
#include "io/text/failure.hpp"
#include "temper/io.hpp"

namespace temper::io {
namespace {

constexpr std::size_t kEntries = 32, kNoEntry = kEntries;  // more at once than any format writes

/// The list of files to remove when the program ends. The handler of a signal may read it, so its storage is never
/// freed.
struct Entry {
  enum State : int { free, being_written, listed };
  std::atomic<int> state = free;
  std::array<char, PATH_MAX> path = {};
};
std::array<Entry, kEntries> entries;

void strike(std::size_t entry) {
  if (entry != kNoEntry) entries[entry].state = Entry::free;
}

/// A place in the list for a file that is about to be made; the file is in the list before any signal ends the program.
/// This thread is always fast enough, and the handler in another thread waits. If the list is full, the file stays when
/// the program ends, and the next run removes it.
class Place {
 public:
  Place() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
    for (entry_ = 0; entry_ < kEntries; ++entry_) {
      int expected = Entry::free;
      if (entries[entry_].state.compare_exchange_strong(expected, Entry::being_written)) break;
    }
  }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;
  ~Place() {
    strike(entry_);
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }

  /// Puts the file into the list. Returns its entry there.
  std::size_t take(const std::string& path) {
    if (entry_ == kNoEntry || path.size() >= PATH_MAX) return kNoEntry;
    std::memcpy(entries[entry_].path.data(), path.c_str(), path.size() + 1);
    entries[entry_].state = Entry::listed;
    return std::exchange(entry_, kNoEntry);
  }

 private:
  sigset_t before_ = {};
  std::size_t entry_ = kNoEntry;
};

/// Waits at most a second for the file that another thread is making.
void wait_for(const Entry& entry) {
  constexpr timespec kMillisecond = {0, 1000000};
  for (int i = 0; i < 1000 && entry.state == Entry::being_written; ++i) nanosleep(&kMillisecond, nullptr);
}

bool lock(int file) { return flock(file, LOCK_EX | LOCK_NB) == 0; }

/// Says whether the open file is still the file of this name, and belongs to this user. Its owner may have renamed it
/// just before we got the lock.
bool is_ours(int file, const std::string& path) {
  struct stat opened, named;
  return fstat(file, &opened) == 0 && lstat(path.c_str(), &named) == 0 && S_ISREG(opened.st_mode) &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino && opened.st_nlink == 1 &&
         opened.st_uid == geteuid();
}

/// Removes a file that a killed run has left. False when the file is something else.
bool remove_left_over(const std::string& path) {
  const int file = ::open(path.c_str(), O_WRONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) return false;
  const bool removed = lock(file) && is_ours(file, path) && unlink(path.c_str()) == 0;
  close(file);
  return removed;
}

/// A new file, locked; −1 when there is none, with EEXIST when another run has this name.
int create(const std::string& path) {
  constexpr mode_t kAsUsual = 0666;  // less what the user's mask takes away
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kAsUsual);
  // In a file system without locks no other run takes the file for left over, either.
  if (file < 0 || lock(file) || errno != EWOULDBLOCK) return file;
  close(file);
  errno = EEXIST;
  return -1;
}

/// The target, with room for a suffix behind its name, of which file systems allow 255 bytes.
std::string with_room(const std::string& target) {
  constexpr std::size_t kLongest = 245;
  const std::size_t slash = target.rfind('/'), name = slash == std::string::npos ? 0 : slash + 1;
  return target.substr(0, name + kLongest);
}

}  // namespace

void discard_unfinished() noexcept {
  for (const Entry& entry : entries) {
    wait_for(entry);
    if (entry.state == Entry::listed) unlink(entry.path.data());
  }
}

Temporary Temporary::beside(const std::string& target) {
  constexpr int kTries = 1000;  // as many runs may write the same file at once
  Place place;
  for (int i = 0; i < kTries; ++i) {
    std::string path = text(with_room(target), ".tmp", i);
    int file = create(path);
    const bool taken = file < 0 && errno == EEXIST;
    if (taken && remove_left_over(path)) file = create(path);
    if (file >= 0) {
      const std::size_t entry = place.take(path);
      return {std::move(path), entry, file};
    }
    if (!taken) break;
  }
  return {};
}

int Temporary::open() const { return dup(lock_); }

void Temporary::take_permissions(const std::string& target) const {
  constexpr mode_t kPermissions = 07777;
  struct stat found;
  if (stat(target.c_str(), &found) == 0) chmod(path_.c_str(), found.st_mode & kPermissions);
}

/// The file no longer exists, renamed or removed.
void Temporary::end() {
  path_.clear();
  strike(entry_);
  close(lock_);
}

void* load_library(const std::string& file) { return dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL); }
void* symbol_of(void* library, const char* name) { return dlsym(library, name); }

void free_of_library(void* memory) { std::free(memory); }

std::string file_of_this_code() {
  static const char here = 0;
  Dl_info self = {};
  return dladdr(&here, &self) != 0 ? self.dli_fname : "";
}

namespace {

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "." : path.substr(0, slash + 1);
}

/// Where the link leads, or nothing if the path is no link.
std::optional<std::string> behind_link(const std::string& path) {
  std::array<char, PATH_MAX> target;
  const ssize_t n = readlink(path.c_str(), target.data(), target.size());
  if (n <= 0) return std::nullopt;
  const std::string name(target.data(), static_cast<std::size_t>(n));
  return name.front() == '/' ? name : folder_of(path) + "/" + name;
}

/// The name of the folder without links, or empty.
std::string real_folder(const std::string& folder) {
  std::array<char, PATH_MAX> real;
  return realpath(folder.c_str(), real.data()) != nullptr ? real.data() : "";
}

/// The last path on the way along the links that is in the file system of processes, where a link is more than its
/// text: it leads to an open file, even if that has no name any more. Empty: none.
std::string path_in_proc(const std::string& path) {
  constexpr int kMost = 40;  // as in without_links()
  std::optional<std::string> now = path;
  for (int i = 0; i < kMost && now; ++i, now = behind_link(*now)) {
    const std::string folder = real_folder(folder_of(*now));
    if (folder.starts_with("/proc/") || folder == "/dev/fd") return *now;
  }
  return {};
}

/// These names have their meaning even without the file system of processes.
int standard_stream(const std::string& path) {
  return path == "/dev/stdin" ? 0 : path == "/dev/stdout" ? 1 : path == "/dev/stderr" ? 2 : -1;
}

}  // namespace

bool is_of_process(const std::string& path) { return standard_stream(path) >= 0 || !path_in_proc(path).empty(); }

int open_file_of(const std::string& path) {
  if (const int stream = standard_stream(path); stream >= 0) return stream;
  const std::string found = path_in_proc(path);
  if (found.empty()) return -1;
  const std::string folder = real_folder(folder_of(found));
  bool ours = folder == "/dev/fd";
  for (const char* open_files : {"/proc/self/fd", "/proc/thread-self/fd"})
    ours = ours || folder == real_folder(open_files);
  const std::string name = found.substr(found.rfind('/') + 1);
  int number = -1;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  return ours && error == std::errc() && end == name.data() + name.size() ? number : -1;
}

int open_to_write(const std::string& path) {
  if (const int file = open_file_of(path); file >= 0) return fcntl(file, F_DUPFD_CLOEXEC, 0);
  // What another process writes to its file stays.
  return ::open(path.c_str(), O_WRONLY | (is_of_process(path) ? O_APPEND : O_TRUNC) | O_CLOEXEC);
}

bool is_open_to_write(int file) {
  const int flags = fcntl(file, F_GETFL);
  return flags >= 0 && (flags & O_ACCMODE) != O_RDONLY;
}

std::string without_links(const std::string& path) {
  constexpr int kMost = 40;  // as Linux follows
  std::string result = path;
  for (int i = 0; i < kMost; ++i) {
    const std::optional<std::string> next = behind_link(result);
    if (!next) return result;
    result = *next;
  }
  errno = ELOOP;
  return {};
}

namespace {

std::optional<std::uint64_t> memory_of_machine() {
#ifdef __APPLE__
  std::uint64_t bytes = 0;
  std::size_t size = sizeof bytes;
  if (sysctlbyname("hw.memsize", &bytes, &size, nullptr, 0) == 0) return bytes;
#endif
  return free_memory_in_files("");
}

/// What a limit of this process leaves. `used`: pages.
std::uint64_t left_of(int resource, std::uint64_t used) {
  rlimit limit = {};
  if (getrlimit(static_cast<decltype(RLIMIT_AS)>(resource), &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
    return UINT64_MAX;
  const std::uint64_t most = limit.rlim_cur;
  return most - std::min(most, used * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)));
}

}  // namespace

std::optional<std::uint64_t> free_memory() {
  // In pages: size, resident, shared, text, library, data. Other systems than Linux do not say.
  std::array<std::uint64_t, 6> pages = {};
  std::ifstream file("/proc/self/statm");
  for (std::uint64_t& n : pages) file >> n;
  const std::uint64_t left = std::min(left_of(RLIMIT_AS, pages[0]), left_of(RLIMIT_DATA, pages[5]));
  const std::optional<std::uint64_t> machine = memory_of_machine();
  if (left == UINT64_MAX) return machine;
  return machine ? std::min(*machine, left) : left;
}

}  // namespace temper::io
