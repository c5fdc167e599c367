#include "optimize/agreement.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include <bit>

#include "temper/archive.hpp"
#include "temper/optimize_table.hpp"
#include "temper/version.hpp"

namespace temper {
namespace {

template <class T>
std::uint64_t checksum_of(const T* values, std::size_t n) {
  return checksum({reinterpret_cast<const char*>(values), n * sizeof(T)});
}

/// A hash of a mesh, of its arrays where they lie: the largest ones have no room for a copy.
std::uint64_t identity_of(const Mesh& mesh) {
  std::uint64_t all = checksum_of(mesh.vertex_data(), mesh.n_vertices() * Mesh::kVertexStride / sizeof(double));
  all = mixed(all, checksum_of(mesh.corner_data().data(), mesh.n_halfedges()));
  return all;
}

std::uint64_t identity_of(const OptimizeOptions& options, const Mesh& mesh) {
  std::uint64_t all = identity_of(mesh);
  std::string given;
  for (const OptionGroup& group : option_groups()) {
    for (const OptionRow& row : group.rows) {
      if (row.name != "time_limit") given.append(row.name).append(option_text(row.get(options))).append("\n");
    }
  }
  return mixed(all, checksum(given));
}

}  // namespace

std::optional<InputError> expect_agreement(const OptimizeHooks& hooks, const OptimizeOptions& options,
                                           const Mesh& mesh) {
  if (hooks.ranks == nullptr) return std::nullopt;
  std::string given(version());
  Archive archive(given);
  std::uint64_t run = identity_of(options, mesh), state = 0;
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
