// The diagonal stars on smooth forms: exact integrals over cells against exact integrals over their duals.
#pragma once

#include <array>
#include <vector>

#include "verify/edge_means.hpp"

namespace temper::verify_detail {

/// The error of the mean over each vertex, edge and triangle: what is left of the form's size.
using LocalErrors = std::array<std::vector<double>, 3>;

/// Relative, of ★0, ★1, ★2: as VerifyReport::local has them.
[[nodiscard]] LocalErrors local_star_errors(const Setting& setting, const Field& field,
                                            const IdVector<EdgeId, EdgeMeans>& means);

/// |σ| |∗σ| of each vertex, edge and triangle, in the frame: what their errors weigh. Areas and lengths of the pieces,
/// without their signs.
[[nodiscard]] LocalErrors star_weights(const Setting& setting);

/// √(Σ weight · error² / (area · n)) and the largest error; n is 2 of ★1, whose weights make twice the area.
[[nodiscard]] std::array<ErrorNorms, 3> star_norms(const Setting& setting, const LocalErrors& weights,
                                                   const LocalErrors& errors);

/// √(Σ weight · error²), and the largest |error|: summed in blocks, with a result that is never NaN.
[[nodiscard]] ErrorNorms norms_of(const std::vector<double>& weights, const std::vector<double>& errors);

}  // namespace temper::verify_detail
