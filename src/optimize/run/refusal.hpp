// Refusals: the errors of a run that only its mesh and its energy show.
#pragma once

#include "optimize/options/settings.hpp"

namespace temper {

/// Hidden vertices have no power cell, so no regular triangulation keeps them: the user must know which.
[[nodiscard]] InputError hidden_vertices_error(const Mesh& input, const InputNames* names);

/// E_BH, and E_BHs with the user's h°, can only stay inside their barrier; the others get in from anywhere.
[[nodiscard]] std::optional<InputError> outside_domain_error(const Mesh& mesh, const Settings& settings);

}  // namespace temper
