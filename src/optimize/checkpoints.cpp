#include "optimize/checkpoints.hpp"

#include <bit>
#include <utility>

#include "mesh/mesh_archive.hpp"
#include "temper/envelope.hpp"
#include "temper/optimize_table.hpp"

namespace temper {
namespace {

constexpr std::string_view kKind = "temper run state";

template <class T>
std::uint64_t checksum_of(const T* values, std::size_t n) {
  return checksum({reinterpret_cast<const char*>(values), n * sizeof(T)});
}

/// A hash of a mesh, of its arrays where they lie: the largest ones have no room for a copy.
std::uint64_t identity_of(const Mesh& mesh) {
  std::string of_space;
  Archive archive(of_space);
  Space space = mesh.space();
  archive(space);
  std::uint64_t all = checksum(of_space);
  all = mixed(all, checksum_of(mesh.vertex_data(), mesh.n_vertices() * Mesh::kVertexStride / sizeof(double)));
  all = mixed(all, checksum_of(mesh.corner_data().data(), mesh.n_halfedges()));
  all = mixed(all, checksum_of(mesh.twin_data().data(), mesh.n_halfedges()));
  for (const TriangleId t : mesh.triangles()) all = mixed(all, static_cast<std::uint64_t>(mesh.region(t)));
  for (const HalfedgeId h : mesh.halfedges()) all = mixed(all, mesh.is_constrained(h) ? 1 : 0);
  return all;
}

}  // namespace

std::uint64_t identity_of(const OptimizeOptions& options, const Mesh& mesh) {
  std::uint64_t all = identity_of(mesh);
  std::string given;
  for (const OptionGroup& group : option_groups()) {
    for (const OptionRow& row : group.rows) {
      if (row.name != "time_limit") given.append(row.name).append(option_text(row.get(options))).append("\n");
    }
  }
  all = mixed(all, checksum(given));
  if (!options.size_field) return all;
  all = mixed(all, identity_of(options.size_field->mesh()));
  for (const VertexId v : options.size_field->mesh().vertices()) {
    all = mixed(all, std::bit_cast<std::uint64_t>(options.size_field->at(v)));
  }
  return all;
}

Expected<Checkpoints> Checkpoints::of(const OptimizeHooks& hooks, const OptimizeOptions& options, const Mesh& mesh) {
  Checkpoints all;
  if (!hooks.checkpoints && hooks.resume.empty()) return all;
  all.listener_ = hooks.checkpoints;
  all.owner_ = identity_of(options, mesh);
  if (hooks.resume.empty()) return all;
  const Expected<std::string_view> bytes = from_envelope(kKind, hooks.resume);
  if (!bytes) return bytes.error();
  Archive rest(*bytes);
  std::uint64_t owner = 0;
  rest(owner);
  if (owner != all.owner_) {
    return InputError{ErrorCode::checkpoint_mismatch, {}, "is of a run with another mesh or other options"};
  }
  all.rest_ = rest;
  return all;
}

bool Checkpoints::here() {
  if (rest_ && !rest_->at_end()) {
    rest_->require(false);
    return false;
  }
  rest_.reset();
  if (listener_) listener_([this] { return state(); });
  return true;
}

std::string Checkpoints::state() const {
  std::string bytes;
  Archive archive(bytes);
  std::uint64_t owner = owner_;
  archive(owner);
  for (const Visit* visit : under_way_) (*visit)(archive);
  return in_envelope(kKind, bytes);
}

std::optional<InputError> Checkpoints::error() const {
  if (!rest_) return std::nullopt;
  return InputError{ErrorCode::unsupported,
                    {},
                    "was written by another build of temper, or is damaged: only the build that wrote it can read it"};
}

}  // namespace temper
