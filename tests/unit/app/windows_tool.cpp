// What scripts/windows.sh cannot do from outside of Windows:
//
//   windows_tool hold FILE WORD …        runs a command while this program has the file open, and returns its exit
//   status windows_tool press SECONDS WORD …    runs a command, and presses Ctrl-C after so many seconds
//   windows_tool kill SECONDS WORD …     the same, but ends it
#define WIN32_LEAN_AND_MEAN
#define NOMINMAX
#include <windows.h>
// After it:
#include <shellapi.h>

#include <cstdio>
#include <cwchar>
#include <string>

namespace {

PROCESS_INFORMATION start(int n, wchar_t** words) {
  std::wstring line;
  for (int i = 0; i < n; ++i) line += L"\"" + std::wstring(words[i]) + L"\" ";
  STARTUPINFOW how = {};
  how.cb = sizeof how;
  PROCESS_INFORMATION process = {};
  if (!CreateProcessW(nullptr, line.data(), nullptr, nullptr, TRUE, 0, nullptr, nullptr, &how, &process)) {
    std::fprintf(stderr, "windows_tool: cannot start %ls: %lu\n", words[0], GetLastError());
    ExitProcess(99);
  }
  return process;
}

int status_of(const PROCESS_INFORMATION& process) {
  DWORD status = 0;
  WaitForSingleObject(process.hProcess, INFINITE);
  GetExitCodeProcess(process.hProcess, &status);
  return static_cast<int>(status);
}

}  // namespace

int main() {
  int n = 0;
  wchar_t** const words = CommandLineToArgvW(GetCommandLineW(), &n);
  if (n < 4) return 98;
  const std::wstring what = words[1];
  if (what == L"hold") {
    const HANDLE file = CreateFileW(words[2], GENERIC_READ, 0, nullptr, OPEN_EXISTING, 0, nullptr);
    if (file == INVALID_HANDLE_VALUE) return 97;
    return status_of(start(n - 3, words + 3));
  }
  const PROCESS_INFORMATION process = start(n - 3, words + 3);
  Sleep(static_cast<DWORD>(1000 * std::wcstod(words[2], nullptr)));
  if (what == L"press") {
    SetConsoleCtrlHandler(nullptr, TRUE);  // both programs of this console get it
    if (!GenerateConsoleCtrlEvent(CTRL_C_EVENT, 0)) {
      std::fprintf(stderr, "windows_tool: no Ctrl-C: error %lu\n", GetLastError());
      return 96;
    }
  } else {
    TerminateProcess(process.hProcess, 137);
  }
  return status_of(process);
}
