// The manufactured solutions, as functions of the frame's coordinates, of order 1 in [−1, 1]².
#pragma once

#include <cstddef>
#include <string_view>

#include "temper/verify.hpp"

namespace temper::verify_detail {

/// The values of a field at a point that the measures need.
struct FieldValue {
  double u = 0;
  Vec2 gradient;
  double laplacian = 0;
  double antiderivative = 0;  ///< U with ∂U/∂x = u: ∫ u over a region is ∫ U n_x around it
};

struct Field {
  VerifyField field;
  FieldValue (*at)(Vec2 p);
};
[[nodiscard]] std::span<const Field> all_fields();

/// Root mean squares over [−1, 1]², which errors are relative to: they do not depend on any mesh.
struct FieldSize {
  double value = 0;
  double gradient = 0;
};
[[nodiscard]] FieldSize size_of(const Field& field);

/// The fields that VerifyOptions::fields asks for, in the order of all_fields(), each once.
[[nodiscard]] Expected<std::vector<Field>> select_fields(const std::vector<std::string>& names);

}  // namespace temper::verify_detail
