// The bytes that runs end with, as one hash for each mesh and set of options: the same for every compiler, processor,
// instruction set and number of threads.
//
//   golden_bytes              writes the table
//   golden_bytes TABLE        compares with the one in that file; 1 where a line differs
//   golden_bytes TABLE MESH   runs of that mesh alone: an emulated processor takes long
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "temper/detail/instruction_set.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"

namespace temper {
namespace {

struct Example {
  const char* name;
  Mesh mesh;
};

/// Coordinates without their last bits, which come from sines and cosines and so from the library of the platform.
Mesh rounded(Mesh mesh) {
  constexpr double kGrid = 1 << 24;
  for (const VertexId v : mesh.vertices()) {
    const Vec2 p = mesh.position(v);
    mesh.set_position(v, {std::round(kGrid * p.x) / kGrid, std::round(kGrid * p.y) / kGrid});
  }
  return mesh;
}

std::vector<Example> examples() {
  return {{"sparse_horseshoe", rounded(sparse_horseshoe())},
          {"horseshoe", rounded(*horseshoe())},
          {"letter_a", rounded(letter_a())},
          {"random_130", rounded(*random_mesh({.vertices = 130, .seed = 5}))},
          {"random_1100", rounded(*random_mesh({.vertices = 1100, .seed = 2}))},
          {"sheared_grid", rounded(*sheared_grid())},
          {"annulus", rounded(*annulus())},
          {"airfoil", rounded(*airfoil())},
          {"wedge", rounded(*wedge())},
          {"graded_mesh", rounded(*graded_mesh())}};
}

struct Options {
  const char* name;
  OptimizeOptions options;
};

std::vector<Options> option_sets() {
  OptimizeOptions paper = *options_for("paper");
  paper.energy = EnergyKind::dT;
  paper.max_sweeps = 20;
  constexpr auto kEnergy = Objective::energy;
  return {{"default", {}},
          {"energy", {.objective = kEnergy}},
          {"accuracy",
           {.objective = Objective::accuracy,
            .accuracy = {.offset_factor = 10, .boundary_offset_factor = 18, .margin = 0.02},
            .max_sweeps = 60}},
          {"lengths",
           {.accuracy = {.min_edge = 0.75, .min_dual = 0.3},
            .repair = Repair::vertices,
            .repair_trials = 200,
            .max_sweeps = 120}},
          {"paper", paper},
          {"golden", {.max_sweeps = 8, .paper = {.solver = Solver::golden}}},
          {"alternating", {.max_sweeps = 30, .paper = {.solver = Solver::alternating}}},
          {"HOT", {.energy = EnergyKind::T, .max_sweeps = 30}},
          {"positions", {.objective = kEnergy, .unknowns = Unknowns::positions, .max_sweeps = 30}},
          {"weights", {.objective = kEnergy, .unknowns = Unknowns::weights, .max_sweeps = 30}},
          {"split_and_repair",
           {.objective = kEnergy,
            .boundary = BoundaryVertices::split,
            .repair = Repair::vertices,
            .repair_trials = 200,
            .max_sweeps = 60}},
          {"size_band", {.objective = kEnergy, .size_band = 1.5, .max_sweeps = 30}}};
}

/// FNV-1a, 64 bits.
class Hash {
 public:
  void add(std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte) value_ = (value_ ^ ((word >> (8 * byte)) & 0xff)) * 0x100000001b3;
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325;
};

std::uint64_t hash_of(const Mesh& mesh) {
  Hash hash;
  for (const VertexId v : mesh.vertices()) {
    const WeightedPoint p = mesh.point(v);
    for (const double x : {p.x, p.y, p.w}) hash.add(std::bit_cast<std::uint64_t>(x));
  }
  for (const TriangleId t : mesh.triangles()) {
    for (const VertexId v : mesh.corners(t)) hash.add(v.index);
  }
  return hash.value();
}

/// The lines of the table, by mesh and options, of one mesh where it is named; nothing, and a message, where two
/// instruction sets differ.
std::optional<std::map<std::string, std::string>> table(const std::string& only) {
  std::map<std::string, std::string> lines;
  for (const InstructionSet set : instruction_sets()) {
    use_instruction_set(set);
    for (const Example& example : examples()) {
      if (!only.empty() && only != example.name) continue;
      for (const Options& options : option_sets()) {
        Mesh mesh = example.mesh;
        const auto report = optimize(mesh, options.options);
        char hash[17] = "refused";
        if (report) std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(hash_of(mesh)));
        const std::string key = std::string(example.name) + " " + options.name;
        const auto [line, fresh] = lines.emplace(key, hash);
        if (fresh || line->second == hash) continue;
        std::printf("%s: %s with %s, %s before\n", key.c_str(), hash, name(set).data(), line->second.c_str());
        return std::nullopt;
      }
    }
  }
  return lines;
}

/// The number of lines that differ, each of which is told.
int compare(const std::map<std::string, std::string>& lines, std::istream& expected, const std::string& only) {
  int n_lines = 0, n_different = 0;
  std::string mesh, options, hash;
  while (expected >> mesh >> options >> hash) {
    if (!only.empty() && only != mesh) continue;
    ++n_lines;
    const auto line = lines.find(mesh + " " + options);
    const std::string found = line == lines.end() ? "no such run" : line->second;
    if (found == hash) continue;
    ++n_different;
    std::printf("%s %s: expected %s, found %s\n", mesh.c_str(), options.c_str(), hash.c_str(), found.c_str());
  }
  std::printf("%d of %d runs end with the expected bytes, for %d instruction sets\n", n_lines - n_different, n_lines,
              static_cast<int>(instruction_sets().size()));
  return n_different + (n_lines > 0 && n_lines == static_cast<int>(lines.size()) ? 0 : 1);
}

}  // namespace
}  // namespace temper

int main(int argc, char** argv) {
  const std::string only = argc > 2 ? argv[2] : "";
  const auto lines = temper::table(only);
  if (!lines) return 1;
  if (argc < 2) {
    for (const auto& [run, hash] : *lines) std::printf("%s %s\n", run.c_str(), hash.c_str());
    return 0;
  }
  std::ifstream expected(argv[1]);
  return temper::compare(*lines, expected, only) == 0 ? 0 : 1;
}
