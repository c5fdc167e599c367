#include "optimize/agreement.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include "optimize/checkpoints.hpp"
#include "temper/version.hpp"

namespace temper {

std::optional<InputError> expect_agreement(const OptimizeHooks& hooks, const OptimizeOptions& options,
                                           const Mesh& mesh) {
  if (hooks.ranks == nullptr) return std::nullopt;
  std::string given(version());
  Archive archive(given);
  std::uint64_t run = identity_of(options, mesh), state = checksum(hooks.resume);
  bool traced = static_cast<bool>(hooks.tracer);
  archive(run, state, traced);
  archive.seal();
  const std::vector<std::string> all = hooks.ranks->all_gather(given);
  for (std::size_t r = 1; r < all.size(); ++r) {
    if (all[r] == all[0]) continue;
    return InputError{
        ErrorCode::rank_mismatch,
        {},
        "rank " + std::to_string(r) +
            " has another mesh, other options or another build of temper than "
            "rank 0: all ranks of a run must be given the same, and files may not change while they read them"};
  }
  return std::nullopt;
}

}  // namespace temper
