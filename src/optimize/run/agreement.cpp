#include "optimize/run/agreement.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "temper/detail/optimize_table.hpp"
#include "temper/detail/version.hpp"

namespace temper {
namespace {

/// A hash that any changed byte changes.
class Fingerprint {
 public:
  void add(std::uint64_t word) {
    hash_ = (hash_ ^ word) * 0x9e3779b97f4a7c15U;
    hash_ ^= hash_ >> 32;
  }
  template <class T>
  void add(const T* values, std::size_t n) {
    const auto* bytes = reinterpret_cast<const char*>(values);
    const std::size_t size = n * sizeof(T);
    add(size);
    for (std::size_t begin = 0; begin < size; begin += sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes + begin, std::min(sizeof word, size - begin));
      add(word);
    }
  }
  [[nodiscard]] std::uint64_t hash() const { return hash_; }

 private:
  std::uint64_t hash_ = 0;
};

void add_mesh(Fingerprint& all, const Mesh& mesh) {
  const Vec2 period = mesh.space().period();
  const double space[] = {mesh.space().radius(), period.x, period.y};
  all.add(space, std::size(space));
  all.add(mesh.vertex_data(), mesh.n_vertices() * Mesh::kVertexStride / sizeof(double));
  all.add(mesh.corner_data().data(), mesh.n_halfedges());
  all.add(mesh.twin_data().data(), mesh.n_halfedges());
  for (const TriangleId t : mesh.triangles()) all.add(static_cast<std::uint64_t>(mesh.region(t)));
  for (const HalfedgeId h : mesh.halfedges()) all.add(mesh.is_constrained(h) ? 1 : 0);
}

void add_options(Fingerprint& all, const OptimizeOptions& options) {
  std::string text;
  for (const OptionGroup& group : option_groups()) {
    for (const OptionRow& row : group.rows) {
      if (row.name != "time_limit") text.append(row.name).append(option_text(row, row.get(options))).append("\n");
    }
  }
  all.add(text.data(), text.size());
  if (!options.size_field) return;
  add_mesh(all, options.size_field->mesh());
  for (const VertexId v : options.size_field->mesh().vertices()) {
    const double size = options.size_field->at(v);
    all.add(&size, 1);
  }
}

}  // namespace

std::optional<InputError> expect_agreement(const OptimizeHooks& hooks, const OptimizeOptions& options,
                                           const Mesh& mesh) {
  if (hooks.communicator == nullptr) return std::nullopt;
  Fingerprint mine;
  add_mesh(mine, mesh);
  add_options(mine, options);
  mine.add(hooks.tracer ? 1 : 0);
  const std::string given = std::string(version()) + ' ' + std::to_string(mine.hash());
  const std::vector<std::string> all = hooks.communicator->all_gather(given);
  const auto other = std::find_if(all.begin(), all.end(), [&](const std::string& each) { return each != all[0]; });
  if (other == all.end()) return std::nullopt;
  return InputError{ErrorCode::rank_mismatch,
                    {},
                    "rank " + std::to_string(other - all.begin()) +
                        " has another mesh, other options or another version of temper than rank 0: all ranks of a "
                        "run must be given the same, and files may not change while they read them"};
}

}  // namespace temper
