// Windows: see system.hpp. Functions of the C library take text for that of the code page, so all of these are wide.
//
// A temporary file is to be removed when its last handle is closed, however the program ends, unless it is renamed. So
// nothing has to be done when a signal comes, and a killed run leaves no file.
#define WIN32_LEAN_AND_MEAN
#define NOMINMAX
#include <windows.h>
// After it:
#include <fcntl.h>
#include <io.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstring>
#include <system_error>
#include <vector>

#include "io/system/system.hpp"
#include "io/text/failure.hpp"
#include "temper/detail/path.hpp"
#include "temper/io.hpp"

namespace temper::io {
namespace {

constexpr std::size_t kNoEntry = 0;  // no list of files to remove

std::wstring wide(const std::string& utf8) { return path_of(utf8).wstring(); }

/// The last error of Windows as errno.
int code_of_last_error() { return std::system_category().default_error_condition(int(GetLastError())).value(); }

bool or_errno(bool done) {
  if (!done) errno = code_of_last_error();
  return done;
}

/// An open file, which closes by itself.
class Handle {
 public:
  Handle(const std::string& path, DWORD access, DWORD share, DWORD creation, DWORD flags = FILE_ATTRIBUTE_NORMAL)
      : handle_(CreateFileW(wide(path).c_str(), access, share, nullptr, creation, flags, nullptr)) {
    or_errno(exists());
  }
  ~Handle() {
    if (exists()) CloseHandle(handle_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  [[nodiscard]] bool exists() const { return handle_ != INVALID_HANDLE_VALUE; }
  [[nodiscard]] HANDLE get() const { return handle_; }
  /// The file as one of the C library, which closes it from now on.
  [[nodiscard]] int give(int flags) {
    return exists() ? _open_osfhandle(reinterpret_cast<std::intptr_t>(std::exchange(handle_, INVALID_HANDLE_VALUE)),
                                      flags | _O_BINARY | _O_NOINHERIT)
                    : -1;
  }

 private:
  HANDLE handle_;
};

constexpr DWORD kShareAll = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;

/// To look at a file or a folder, in use or not.
Handle looking_at(const std::string& path) {
  return {path, FILE_READ_ATTRIBUTES, kShareAll, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS};
}

/// Returns the number of the standard stream with this name, such as 1 for "/dev/stdout", or −1.
int standard_stream(const std::string& path) {
  return path == "/dev/stdin" ? 0 : path == "/dev/stdout" ? 1 : path == "/dev/stderr" ? 2 : -1;
}

int binary_copy(int stream) {
  const int copy = _dup(stream);
  if (copy >= 0) _setmode(copy, _O_BINARY);
  return copy;
}

HANDLE handle_of(int file) { return reinterpret_cast<HANDLE>(_get_osfhandle(file)); }

/// Says whether the file disappears when it is closed. File systems that do not allow that keep it.
void remove_at_end(int file, bool removed) {
  FILE_DISPOSITION_INFO disposition = {};
  disposition.DeleteFile = removed;
  SetFileInformationByHandle(handle_of(file), FileDispositionInfo, &disposition, sizeof disposition);
}

/// Another run has the name, even if its file is about to disappear.
bool is_taken(const std::string& path) {
  return GetFileAttributesW(wide(path).c_str()) != INVALID_FILE_ATTRIBUTES || GetLastError() == ERROR_ACCESS_DENIED;
}

/// A new file that nobody else may write or remove; −1: errno has the reason.
int create(const std::string& path) {
  const int file = Handle(path, GENERIC_WRITE | DELETE, FILE_SHARE_READ, CREATE_NEW).give(_O_WRONLY);
  if (file >= 0) remove_at_end(file, true);
  return file;
}

/// The target, with room for a suffix behind its name, of which file systems allow 255 characters.
std::string with_room(const std::string& target) {
  constexpr std::size_t kLongest = 245;
  const std::size_t slash = target.find_last_of("/\\:"), name = slash == std::string::npos ? 0 : slash + 1;
  return target.substr(0, name + kLongest);
}

}  // namespace

int open_file_of(const std::string& path) { return standard_stream(path); }

bool is_open_to_write(int file) {
  const intptr_t handle = _get_osfhandle(file);
  return handle != -1 && handle != -2;  // −2: the process has no such stream
}

OnDisk look_at(const std::string& path) {
  if (standard_stream(path) >= 0) return {OnDisk::Kind::other};
  const Handle file = looking_at(path);
  if (!file.exists()) return {};
  BY_HANDLE_FILE_INFORMATION found = {};
  if (GetFileType(file.get()) != FILE_TYPE_DISK || !GetFileInformationByHandle(file.get(), &found))
    return {OnDisk::Kind::other};
  if ((found.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0) return {OnDisk::Kind::folder};
  return {OnDisk::Kind::file, std::uint64_t{found.nFileSizeHigh} << 32 | found.nFileSizeLow};
}

std::string without_links(const std::string& path) {
  const DWORD attributes = GetFileAttributesW(wide(path).c_str());
  if (attributes == INVALID_FILE_ATTRIBUTES || (attributes & FILE_ATTRIBUTE_REPARSE_POINT) == 0) return path;
  const Handle file = looking_at(path);
  if (!file.exists()) return path;
  std::wstring name(32768, L'\0');  // more than any path has
  name.resize(GetFinalPathNameByHandleW(file.get(), name.data(), static_cast<DWORD>(name.size()), VOLUME_NAME_DOS));
  return name.empty() ? path : utf8(name);
}

std::string reason(int code) {
  std::string text = std::strerror(code);
  if (code == EACCES) text += ", or another program has it open";
  return text;
}

std::FILE* open_to_read(const std::string& path) {
  if (const int stream = standard_stream(path); stream >= 0) {
    const int copy = binary_copy(stream);
    return copy >= 0 ? _fdopen(copy, "rb") : nullptr;
  }
  return _wfopen(wide(path).c_str(), L"rb");
}

int open_to_write(const std::string& path) {
  if (const int stream = standard_stream(path); stream >= 0) return binary_copy(stream);
  return Handle(path, GENERIC_WRITE, kShareAll, OPEN_EXISTING).give(_O_WRONLY);
}

bool write_all(int file, const char* bytes, std::size_t n) {
  while (n > 0) {
    const int written = _write(file, bytes, static_cast<unsigned>(std::min(n, std::size_t{INT_MAX})));
    if (written < 0) return false;
    bytes += written;
    n -= static_cast<std::size_t>(written);
  }
  return true;
}

bool reach_disk(int file) {
  return _commit(file) == 0 || errno == EBADF;
}  // EBADF: the file system has no such function
bool close_file(int file) { return _close(file) == 0; }

bool make_folder(const std::string& path) { return or_errno(CreateDirectoryW(wide(path).c_str(), nullptr)); }
void remove_folder(const std::string& path) { RemoveDirectoryW(wide(path).c_str()); }

void give_memory_back() {}  // the C library keeps none

std::optional<std::uint64_t> free_memory() {
  std::optional<std::uint64_t> least;
  MEMORYSTATUSEX status = {};
  status.dwLength = sizeof status;
  if (GlobalMemoryStatusEx(&status) != 0) least = std::min<std::uint64_t>(status.ullAvailPhys, status.ullAvailVirtual);
  JOBOBJECT_EXTENDED_LIMIT_INFORMATION job = {};  // of the job of this process, if any
  if (QueryInformationJobObject(nullptr, JobObjectExtendedLimitInformation, &job, sizeof job, nullptr) == 0)
    return least;
  const DWORD limits = job.BasicLimitInformation.LimitFlags;
  const auto take = [&least](std::uint64_t bytes) { least = std::min(least.value_or(bytes), bytes); };
  if ((limits & JOB_OBJECT_LIMIT_PROCESS_MEMORY) != 0) take(job.ProcessMemoryLimit);
  if ((limits & JOB_OBJECT_LIMIT_JOB_MEMORY) != 0) take(job.JobMemoryLimit);
  return least;
}

void discard_unfinished() noexcept {}

Temporary Temporary::beside(const std::string& target) {
  constexpr int kTries = 1000;  // as many runs may write the same file at once
  for (int i = 0; i < kTries; ++i) {
    std::string path = text(with_room(target), ".tmp", i);
    int file = create(path);
    // A file that nobody has open was left over by the end of the whole system.
    if (file < 0 && is_taken(path)) {
      if (!DeleteFileW(wide(path).c_str())) continue;
      file = create(path);
    }
    if (file < 0) break;
    return {std::move(path), kNoEntry, file};
  }
  return {};
}

int Temporary::open() const { return _dup(lock_); }

void Temporary::take_permissions(const std::string& /*target*/) const {}  // a file has those of its folder

bool Temporary::rename_to(const std::string& target) {
  std::error_code ignored;
  const std::wstring name = std::filesystem::absolute(path_of(target), ignored).wstring();
  const std::size_t bytes = name.size() * sizeof(wchar_t);
  std::vector<char> memory(sizeof(FILE_RENAME_INFO) + bytes);
  auto* const info = reinterpret_cast<FILE_RENAME_INFO*>(memory.data());
  info->ReplaceIfExists = TRUE;
  info->FileNameLength = static_cast<DWORD>(bytes);
  std::memcpy(info->FileName, name.data(), bytes);
  remove_at_end(lock_, false);
  const auto size = static_cast<DWORD>(memory.size());
  if (!or_errno(SetFileInformationByHandle(handle_of(lock_), FileRenameInfo, info, size))) {
    const int why = errno;
    remove_at_end(lock_, true);
    errno = why;
    return false;
  }
  end();
  return true;
}

void Temporary::remove() {
  if (!exists()) return;
  remove_at_end(lock_, true);
  end();
}

void Temporary::end() {
  path_.clear();
  _close(lock_);
}

void* load_library(const std::string& file) {
  const std::filesystem::path path = path_of(file).make_preferred();  // '/' would hide what its folder has for it
  return LoadLibraryExW(path.c_str(), nullptr, path.is_absolute() ? LOAD_WITH_ALTERED_SEARCH_PATH : 0);
}

void* symbol_of(void* library, const char* name) {
  return reinterpret_cast<void*>(GetProcAddress(static_cast<HMODULE>(library), name));
}

void free_of_library(void* /*memory*/) {}  // its C library may be another one, and has this memory until the end

std::string file_of_this_code() {
  static const char here = 0;
  HMODULE module = nullptr;
  constexpr DWORD kFlags = GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS | GET_MODULE_HANDLE_EX_FLAG_UNCHANGED_REFCOUNT;
  if (!GetModuleHandleExW(kFlags, reinterpret_cast<const wchar_t*>(&here), &module)) return {};
  std::wstring name(32768, L'\0');  // more than any path has
  name.resize(GetModuleFileNameW(module, name.data(), static_cast<DWORD>(name.size())));
  return utf8(name);
}

}  // namespace temper::io
