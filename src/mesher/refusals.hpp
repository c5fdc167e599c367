// Why there is no mesh, in the user's terms: where the outline is narrowest, how many triangles there would be, and
// what to do next.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "mesher/arrangement.hpp"
#include "mesher/deadline.hpp"
#include "mesher/placement.hpp"

namespace temper::mesher {

/// The largest number of triangles that the option, the memory, and halfedges with numbers of 32 bits allow.
[[nodiscard]] double most_triangles(const MesherOptions& options);

/// `what` would make that many triangles. `advice`: what to do next.
[[nodiscard]] InputError refused(const MesherOptions& options, double triangles, const std::string& what,
                                 const std::string& advice);

/// Sizes that make fewer triangles than `expected`, which are too many. Nothing if the reason is not the size.
/// `count`: the number of triangles by the sizes, with another largest size.
[[nodiscard]] std::optional<std::string> sizes_that_fit(const Problem& problem, double expected,
                                                        const std::function<double(double)>& count,
                                                        const Deadline& deadline);

/// Where the outline is narrowest: where, how wide, between what, and the tolerance that closes it. Empty if its width
/// is not far below the sizes.
[[nodiscard]] std::string narrow_text(const Problem& problem, const Arrangement& arrangement,
                                      const std::optional<Gap>& narrowest, double far = 1e-3);

/// The run stopped while the outline was `doing`. `narrow`: the text of the narrowest place, or empty.
[[nodiscard]] InputError stopped(const std::string& doing, const std::string& narrow = {});

/// Division points meet or cross others: the outline is too narrow there for its coordinates. Looks for a place that is
/// nearer to an edge than the narrowest one so far.
[[nodiscard]] InputError too_fine(const Problem& problem, const Arrangement& arrangement, std::optional<Gap> narrowest,
                                  const InputError& error);
[[nodiscard]] InputError too_coarse(const Problem& problem);
/// There would be too many edges and triangles, for another reason than the size.
[[nodiscard]] InputError too_many(const std::string& narrow);

}  // namespace temper::mesher
