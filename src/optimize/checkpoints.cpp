#include "optimize/checkpoints.hpp"

#include <utility>

#include "mesh/mesh_archive.hpp"
#include "temper/envelope.hpp"
#include "temper/optimize_table.hpp"

namespace temper {
namespace {

constexpr std::string_view kKind = "temper run state";

}  // namespace

std::uint64_t identity_of(const OptimizeOptions& options, const Mesh& mesh) {
  std::string all;
  Archive archive(all);
  Mesh copy = mesh;
  archive(copy);
  for (const OptionGroup& group : option_groups()) {
    for (const OptionRow& row : group.rows) {
      if (row.name != "time_limit") all.append(row.name).append(option_text(row.get(options))).append("\n");
    }
  }
  if (options.size_field) {
    copy = options.size_field->mesh();
    archive(copy);
    for (const VertexId v : copy.vertices()) {
      double size = options.size_field->at(v);
      archive(size);
    }
  }
  return checksum(all);
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
