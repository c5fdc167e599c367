// Windows: see system.hpp.
#define WIN32_LEAN_AND_MEAN
#define NOMINMAX
#include <windows.h>
// After it:
#include <fcntl.h>
#include <io.h>
#include <shellapi.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <system_error>

#include "system/system.hpp"
#include "temper/detail/path.hpp"

namespace temper::app {
namespace {

constexpr int kStandardError = 2;
int true_standard_error = kStandardError;
UINT code_page_before = 0;

std::wstring wide(const std::string& utf8) { return path_of(utf8).wstring(); }

int code_of_last_error() { return std::system_category().default_error_condition(int(GetLastError())).value(); }

}  // namespace

void prepare_process() {
  for (const int stream : {0, 1, 2}) _setmode(stream, _O_BINARY);  // files have the bytes that they have elsewhere
  code_page_before = GetConsoleOutputCP();
  SetConsoleOutputCP(CP_UTF8);
  std::atexit([] { SetConsoleOutputCP(code_page_before); });
  SetErrorMode(SEM_FAILCRITICALERRORS | SEM_NOGPFAULTERRORBOX);  // no window waits for an answer
}

void prepare_for_file(std::uint64_t /*bytes*/) {}
void return_freed_memory() {}

std::vector<std::string> program_words(int /*argc*/, char** /*argv*/) {
  std::vector<std::string> words;
  int n = 0;
  wchar_t** const all = CommandLineToArgvW(GetCommandLineW(), &n);
  for (int i = 1; i < n; ++i) words.push_back(utf8(std::wstring(all[i])));
  LocalFree(all);
  return words;
}

namespace {

std::atomic<bool> is_noted = false, notes_next = false;
std::mutex files_are_written;

/// Runs in a thread of its own. FALSE: Windows ends the program, and unfinished files disappear with it.
BOOL WINAPI on_event(DWORD event) {
  const bool asks = event == CTRL_C_EVENT || event == CTRL_BREAK_EVENT;  // nothing stops a window that closes
  if (asks && notes_next.exchange(false)) {
    is_noted = true;
    return TRUE;
  }
  files_are_written.lock();  // until the end
  write_to_error("\ntemper: stopped by a signal; a file that was not finished is as it was before\n");
  return FALSE;
}

}  // namespace

void end_on_signals() { SetConsoleCtrlHandler(on_event, TRUE); }
void catch_interrupts() { notes_next = true; }
bool interrupted() { return is_noted; }

SignalsHeld::SignalsHeld() { files_are_written.lock(); }
SignalsHeld::~SignalsHeld() { files_are_written.unlock(); }

bool error_is_terminal() {
  // Progress moves the cursor.
  DWORD mode = 0;
  const HANDLE error = GetStdHandle(STD_ERROR_HANDLE);
  return GetConsoleMode(error, &mode) && SetConsoleMode(error, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
}

bool utf8_terminal() { return true; }  // since prepare_process()

std::size_t terminal_columns() {
  CONSOLE_SCREEN_BUFFER_INFO info = {};
  if (!GetConsoleScreenBufferInfo(GetStdHandle(STD_OUTPUT_HANDLE), &info)) return 0;
  return static_cast<std::size_t>(info.srWindow.Right - info.srWindow.Left + 1);
}

void be_silent() {
  true_standard_error = _dup(kStandardError);
  for (std::FILE* stream : {stdout, stderr}) static_cast<void>(std::freopen("NUL", "w", stream));
}

void write_to_error(std::string_view text) {
  static_cast<void>(_write(true_standard_error, text.data(), static_cast<unsigned>(text.size())));
}

bool may_write(const std::string& file) { return _waccess(wide(file).c_str(), 2) == 0; }
bool may_fill(const std::string& /*folder*/) { return true; }  // only making a file can tell

namespace {

/// A file for another program, which disappears when it is closed.
class Scratch {
 public:
  Scratch() {
    std::array<wchar_t, MAX_PATH> folder = {}, name = {};
    if (GetTempPathW(MAX_PATH, folder.data()) == 0 || GetTempFileNameW(folder.data(), L"tmp", 0, name.data()) == 0)
      return;
    SECURITY_ATTRIBUTES inherited = {sizeof inherited, nullptr, TRUE};
    handle_ =
        CreateFileW(name.data(), GENERIC_READ | GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
                    &inherited, CREATE_ALWAYS, FILE_ATTRIBUTE_TEMPORARY | FILE_FLAG_DELETE_ON_CLOSE, nullptr);
  }
  ~Scratch() { CloseHandle(handle_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  [[nodiscard]] bool exists() const { return handle_ != INVALID_HANDLE_VALUE; }
  [[nodiscard]] HANDLE get() const { return handle_; }
  [[nodiscard]] bool write(std::string_view text) {
    DWORD n = 0;
    return WriteFile(handle_, text.data(), static_cast<DWORD>(text.size()), &n, nullptr) && n == text.size() &&
           rewind();
  }
  [[nodiscard]] std::string read() {
    std::string text;
    std::array<char, 1 << 16> some;
    DWORD n = 0;
    rewind();
    while (ReadFile(handle_, some.data(), some.size(), &n, nullptr) && n > 0) text.append(some.data(), n);
    return text;
  }

 private:
  bool rewind() { return SetFilePointer(handle_, 0, nullptr, FILE_BEGIN) == 0; }

  HANDLE handle_ = INVALID_HANDLE_VALUE;
};

}  // namespace

Ended run_other_program(std::vector<std::string> words, std::string_view input) {
  Scratch in, out, said;
  if (!in.exists() || !out.exists() || !said.exists() || !in.write(input)) return {.error = code_of_last_error()};
  if (std::getenv("SOURCE_DATE_EPOCH") == nullptr) SetEnvironmentVariableW(L"SOURCE_DATE_EPOCH", L"0");
  std::wstring line;
  for (const std::string& word : words) line += L"\"" + wide(word) + L"\" ";
  STARTUPINFOW start = {};
  start.cb = sizeof start;
  start.dwFlags = STARTF_USESTDHANDLES;
  start.hStdInput = in.get(), start.hStdOutput = out.get(), start.hStdError = said.get();
  PROCESS_INFORMATION process = {};
  if (!CreateProcessW(nullptr, line.data(), nullptr, nullptr, TRUE, 0, nullptr, nullptr, &start, &process))
    return {.error = code_of_last_error()};
  DWORD status = 1;
  WaitForSingleObject(process.hProcess, INFINITE);
  GetExitCodeProcess(process.hProcess, &status);
  CloseHandle(process.hThread), CloseHandle(process.hProcess);
  return {.status = static_cast<int>(status), .output = out.read(), .messages = said.read()};
}

std::optional<Tried> try_in_child(const Budget& /*budget*/, const std::function<std::string()>& /*work*/) {
  return std::nullopt;
}

}  // namespace temper::app
