#include "optimize/run/changes.hpp"

#include "base/text.hpp"

namespace temper {

std::string changes_note(const ChangeCounts& changed) {
  return count_of(changed.vertices_moved, "vertex", "vertices") + " moved, " +
         count_of(changed.weights_changed, "weight", "weights") + " and " +
         count_of(changed.edges_changed, "edge", "edges") + " changed; all else is as it was";
}

std::string criterion_is_met_note(Criterion criterion) {
  return "the input has all that the target needs (" +
         std::string(criteria_table()[static_cast<std::size_t>(criterion)].sentence) + "): it comes back as it was";
}

std::string whole_mesh_note(const std::string& places, bool many_are_bad) {
  return many_are_bad ? places + " violated what the target needs: so many that the whole mesh was changed"
                      : "changes nearby left " + places + " at violations: the whole mesh was changed";
}

}  // namespace temper
