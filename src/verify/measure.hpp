// One mesh, all fields: what verify() and each level of a refinement do.
#pragma once

#include "verify/poisson.hpp"
#include "verify/stars.hpp"

namespace temper::verify_detail {

struct Measured {
  std::vector<FieldErrors> fields;
  VerifySystem poisson, flux;
  LocalErrors local;  ///< root mean square over the fields
};
[[nodiscard]] Measured measure(const Setting& setting, const std::vector<Field>& fields, bool condition);

/// The orders of convergence of each field, by least squares. See VerifyReport::orders.
[[nodiscard]] std::vector<FieldErrors> convergence_orders(const std::vector<VerifyLevel>& levels);

}  // namespace temper::verify_detail
