// What the report says of a run in sentences: what was done, and what is left.
#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "optimize/run/run.hpp"
#include "optimize/options/settings.hpp"

namespace temper {

/// The part of the triangles that is not well-centered.
[[nodiscard]] inline double bad_part(const Mesh& mesh, std::size_t bad) {
  return static_cast<double>(bad) / static_cast<double>(mesh.n_triangles());
}

/// The sentences of a report, in the order in which they are told.
class Notes {
 public:
  Notes(const Mesh& mesh, const Settings& settings, OptimizeReport& report)
      : mesh_(mesh), settings_(settings), options_(settings.options), report_(report) {}

  void tell(const RunFacts& facts);
  void tell_input_is_returned(const RunFacts& facts, bool flipped);
  void tell_if_more_are_bad(double bad_before);
  void tell_what_is_not_regular();
  void tell_sizes();
  void tell_energy();
  void tell_edges_that_must_be_split(std::size_t bad);
  void tell_corners_that_stay(std::size_t bad);
  void tell_objective();
  void tell_programmes();
  void tell_accuracy(std::size_t bad);

 private:
  void add(std::string note) { report_.notes.push_back(std::move(note)); }
  void tell_input_flips(std::size_t flips);
  void tell_cuts(const BoundaryCuts& cuts);
  [[nodiscard]] std::size_t count_thin() const;
  [[nodiscard]] std::string name_of(VertexId v) const;

  const Mesh& mesh_;
  const Settings& settings_;
  const OptimizeOptions& options_;
  OptimizeReport& report_;
};

}  // namespace temper
