// The upper limit of local sizes while vertices are removed: a factor times the size field.
#pragma once

#include <utility>

#include "optimize/repair/neighborhood.hpp"
#include "optimize/working/working_copy.hpp"
#include "temper/detail/size.hpp"

namespace temper {

class SizeLimit {
 public:
  /// `field`: in the user's units. `factor`: at least 1.
  SizeLimit(const WorkingCopy& work, SizeField field, double factor)
      : work_(work), field_(std::move(field)), factor_(factor) {}

  /// Says whether the sizes around a place may change to those of `local`, which takes the place of the neighborhood. A
  /// size beyond the limit must not grow.
  [[nodiscard]] bool allows(const Neighborhood& around, const Mesh& local) const;

 private:
  const WorkingCopy& work_;
  SizeField field_;
  double factor_;
};

}  // namespace temper
