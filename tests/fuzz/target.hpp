// What fuzzing drives: a name, what is done with bytes from anywhere, and bytes to begin with. Run it by libFuzzer
// (fuzzer.cpp, scripts/fuzz.sh), or by a loop of mutations with any compiler (smoke.cpp, a test).
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace temper::fuzz {

struct Target {
  std::string name;
  std::function<void(std::string_view bytes)> run;  ///< ends the process when something does not hold
  std::function<std::vector<std::string>()> seeds;
  std::function<std::string()> outcome = {};  ///< what came of all runs, if the target counts it
};

/// A target a format, as its row is called.
[[nodiscard]] std::vector<Target> mesh_file_targets();
/// Outlines of each format, and JSON.
[[nodiscard]] std::vector<Target> outline_targets();
/// Outlines that are moved by rounding, through mesh_outline() and mesh_sphere().
[[nodiscard]] std::vector<Target> outline_mesh_targets();
/// Traces, certificates and layers of the program.
[[nodiscard]] std::vector<Target> program_file_targets();
/// Meshes and options made of the bytes, through optimize().
[[nodiscard]] std::vector<Target> optimize_targets();

/// All of them.
[[nodiscard]] std::vector<Target> targets();
/// The one of that name; ends the process when there is none.
[[nodiscard]] Target target(const std::string& name);

/// Its seeds, and what it once did not survive: the files finds/NAME-….
[[nodiscard]] std::vector<std::string> seeds_and_finds(const Target& target);

/// Ends the process, with a word on why, unless it holds.
void insist(bool holds, std::string_view what);

/// A folder in memory where the system has one, which goes with the process.
class Scratch {
 public:
  Scratch();
  ~Scratch();
  /// A file of that content; returns its path.
  std::string make(const std::string& name, std::string_view content) const;
  [[nodiscard]] std::string path(const std::string& name) const { return folder_ + "/" + name; }
  void clear() const;

 private:
  std::string folder_;
};

}  // namespace temper::fuzz
