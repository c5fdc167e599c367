// The sizes of a run: sources that grow from attempt to attempt, and what the division of the outline needs besides.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "mesher/corridors.hpp"
#include "mesher/domain.hpp"
#include "mesher/placement.hpp"

namespace temper::mesher {

struct Sizing {
  std::vector<SizeSource> sources;
  CornerRadii corners;
  std::optional<Gap> narrowest;  ///< the shortest edge at first

  /// The size by these sources. It is built again after new ones: sources only grow.
  [[nodiscard]] const GradedSize& size(const Problem& problem) {
    if (!graded_ || n_graded_ != sources.size()) {
      graded_ = std::make_shared<const GradedSize>(problem.surface, sources, problem.wanted, problem.options.grade);
      n_graded_ = sources.size();
    }
    return *graded_;
  }

 private:
  std::shared_ptr<const GradedSize> graded_;
  std::size_t n_graded_ = 0;  // sources in it
};

/// The number of triangles along lines and areas with sizes of their own.
[[nodiscard]] double count_on_lines(const Problem& problem, const Domain& domain);

/// Sources for short edges, for areas of smaller size, and at places where the size field grows faster than the grade.
[[nodiscard]] Sizing first_sizing(const Problem& problem, const Domain& domain);

/// Makes sizes around these triangles of the mesh, which stay bad, smaller.
void refine_around(const Problem& problem, const Mesh& mesh, const std::vector<TriangleId>& bad, Sizing& sizing);

/// Makes pieces that are too long for faces shorter.
void make_shorter(const std::vector<LongPieces>& pieces, Sizing& sizing);

/// Adds what one round found at narrow places.
void add(const NarrowPlaces& narrow, Sizing& sizing);

}  // namespace temper::mesher
