#include "workshop.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

extern char** environ;

namespace temper::test {
namespace {

namespace fs = std::filesystem;

// Outside of the test's folder, so that the folder holds only what the program wrote.
std::string beside(const fs::path& folder, const char* suffix) { return folder.string() + suffix; }

pid_t spawn(const std::vector<std::string>& words, const std::string& out, const std::string& err) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_addopen(&actions, 2, err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  std::vector<char*> argv;
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  pid_t process = -1;
  const int failed = posix_spawn(&process, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) throw std::runtime_error("cannot start " + words.front());
  return process;
}

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Outcome run(const std::vector<std::string>& words) {
  const std::string out = beside(fs::current_path(), ".out"), err = beside(fs::current_path(), ".err");
  const pid_t process = spawn(words, out, err);
  int status = 0;
  waitpid(process, &status, 0);
  const int exit = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  Outcome outcome = {exit, text_of(out), text_of(err)};
  fs::remove(out);
  fs::remove(err);
  return outcome;
}

}  // namespace

Workshop::Workshop() : home_(fs::current_path()) {
  std::string name = (fs::temp_directory_path() / "temper-test-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  folder_ = name;
  fs::current_path(folder_);
  setenv("LC_ALL", "C.UTF-8", 1);
}

Workshop::~Workshop() {
  fs::current_path(home_);
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

Outcome Workshop::temper(const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {TEMPER_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return run(words);
}

Outcome Workshop::temper_ok(const std::vector<std::string>& arguments) {
  Outcome outcome = temper(arguments);
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  return outcome;
}

Outcome Workshop::shell(const std::string& command) {
  const std::string folder = fs::path(TEMPER_PROGRAM).parent_path().string();
  return run({"/bin/sh", "-c", "PATH='" + folder + "':$PATH; " + command});
}

pid_t Workshop::start(const std::vector<std::string>& arguments, const std::string& out, const std::string& err) {
  std::vector<std::string> words = {TEMPER_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return spawn(words, out, err);
}

int Workshop::wait_for(pid_t process) {
  int status = 0;
  waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

std::string Workshop::read(const std::string& path) { return text_of(path); }

void Workshop::write(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

std::vector<std::string> Workshop::names() {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(".")) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

nlohmann::json Workshop::numbers_of(const std::string& path) {
  nlohmann::json report = nlohmann::json::parse(temper_ok({"check", path, "--json"}).out);
  for (const char* key : {"schema", "file", "verdict", "requirements"}) report.erase(key);
  return report;
}

void Workshop::make_tetrahedra(const std::string& path) {
  write(path,
        "MeshVersionFormatted 2\nDimension 3\nVertices\n6\n9 9 9 0\n0 0 0 0\n2 0 0 0\n1 1.7 0 0\n1 0.6 1.6 0\n"
        "1 0.6 -0.3 0\nTetrahedra\n2\n2 3 4 5 1\n2 4 3 6 2\nEnd\n");
}

void Workshop::make_input(const std::string& path) {
  temper_ok({"example", "sheared-grid", "--nx", "6", "--ny", "6", "--shear", "0.4", "-o", path});
}

testing::AssertionResult contains(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "no \"" << part << "\" in:\n" << text;
}

}  // namespace temper::test
