// An empty folder of its own for each test, and the program to run in it.
#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace temper::test {

struct Outcome {
  int exit = -1;    ///< −signal when a signal ended it
  std::string out;  ///< standard output
  std::string err;  ///< standard error
};

class Workshop : public ::testing::Test {
 protected:
  Workshop();
  ~Workshop() override;

  /// Runs the program and waits for it.
  static Outcome temper(const std::vector<std::string>& arguments);
  /// The same, which must exit with 0.
  static Outcome temper_ok(const std::vector<std::string>& arguments);
  /// A command line, by the shell, with `temper` on the path.
  static Outcome shell(const std::string& command);

  /// Starts the program; its outputs go to the files `out` and `err`.
  static pid_t start(const std::vector<std::string>& arguments, const std::string& out, const std::string& err);
  static int wait_for(pid_t process);

  static std::string read(const std::string& path);
  static void write(const std::string& path, const std::string& text);
  static bool exists(const std::string& path) { return std::filesystem::exists(path); }
  static nlohmann::json read_json(const std::string& path) { return nlohmann::json::parse(read(path)); }
  /// Names in the folder, sorted: to see that nothing was written.
  static std::vector<std::string> names();

  /// The numbers of `temper check --json`, without what belongs to the call.
  static nlohmann::json numbers_of(const std::string& path);

  /// A sheared grid with bad triangles, quick to cure.
  static void make_input(const std::string& path = "in.vtu");
  /// Two tetrahedra on the sides of the face 2 3 4, the second one flat enough to be bad. The first point is of none.
  static void make_tetrahedra(const std::string& path = "two.mesh");

 private:
  std::filesystem::path folder_, home_;
};

testing::AssertionResult contains(const std::string& text, const std::string& part);

}  // namespace temper::test
