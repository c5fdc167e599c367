#include "optimize/run/refusal.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/text.hpp"
#include "energy/whole_mesh.hpp"
#include "temper/regularity.hpp"

namespace temper {

InputError hidden_vertices_error(const Mesh& input, const InputNames* names) {
  constexpr std::size_t kNamed = 5;
  Mesh copy = input;
  const std::vector<VertexId> hidden = restore_regularity(copy).hidden;
  const InputNames numbers_from_0;
  const InputNames& named = names != nullptr ? *names : numbers_from_0;
  std::string list;
  for (std::size_t i = 0; i < std::min(hidden.size(), kNamed); ++i) {
    if (i > 0) list += ", ";
    list += named.point(hidden[i].index) + " (weight " + to_text(input.weight(hidden[i])) + ")";
  }
  if (hidden.size() > kNamed) list += " and " + std::to_string(hidden.size() - kNamed) + " more";
  // A flip that would make an edge of half a period leaves its quad as it does at a hidden vertex.
  const char* const or_too_few = input.space().is_periodic() ? ", and edges shorter than half a period" : "";
  return {ErrorCode::hidden_vertex, hidden.empty() ? std::string() : named.point_where(hidden[0].index),
          "weights hide " + list + "; expected weights that leave every vertex a power cell" + or_too_few};
}

std::optional<InputError> outside_domain_error(const Mesh& mesh, const Settings& settings) {
  const EnergyInfo& energy = energy_info(settings.policy.first_energy.value_or(settings.model.kind));
  EnergyModel model = settings.model;
  model.kind = energy.kind;
  const bool gets_in = energy.softened_by_gamma || (energy.softened_by_h0 && !settings.policy.h0);
  if (!energy.barrier || gets_in || std::isfinite(total_energy(mesh, model))) return std::nullopt;
  return InputError{
      ErrorCode::invalid_option,
      {},
      "energy " + std::string(energy.name) + " is infinite on this mesh, where " +
          std::to_string(count_bad(mesh, settings.hooks.executor)) + " of " + std::to_string(mesh.n_triangles()) +
          " triangles are not well-centered; expected a mesh inside its barrier, or energy BP, which needs none"};
}

}  // namespace temper
