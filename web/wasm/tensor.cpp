// See tensor.hpp.
#include "tensor.hpp"

#include <charconv>
#include <map>
#include <set>
#include <string>

namespace temper::wasm {
namespace {

Tensor tensor_from(const Json& given) {
  try {
    const auto k = given.get<std::vector<double>>();
    if (k.size() == 3) return {k[0], k[1], k[2]};
  } catch (const Json::exception&) {
  }
  throw WrongType{"tensor: expected kxx, kxy, kyy, found " + given.dump()};
}

std::int32_t region_from(const std::string& key) {
  std::int32_t region = 0;
  const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), region);
  if (error != std::errc() || end != key.data() + key.size())
    throw WrongType{"tensor: expected the number of a region, found " + key};
  return region;
}

std::string listed(const std::set<std::int32_t>& regions) {
  std::string text;
  for (const std::int32_t region : regions) text += (text.empty() ? "" : ", ") + std::to_string(region);
  return text;
}

std::vector<Tensor> tensors_of_regions(const Json& given, const Mesh& mesh) {
  std::map<std::int32_t, Tensor> of_region;
  for (const auto& [key, value] : given.items()) of_region[region_from(key)] = tensor_from(value);
  std::set<std::int32_t> known, missing, unknown;
  for (const TriangleId t : mesh.triangles()) known.insert(mesh.region(t));
  for (const std::int32_t region : known) {
    if (!of_region.contains(region)) missing.insert(region);
  }
  for (const auto& [region, tensor] : of_region) {
    if (!known.contains(region)) unknown.insert(region);
  }
  if (!missing.empty() || !unknown.empty()) {
    fail(ErrorCode::invalid_option,
         "tensor: expected a value for each of the regions " + listed(known) + "; " +
             (missing.empty() ? "the mesh has no region " + listed(unknown) : "there is none for " + listed(missing)));
  }
  std::vector<Tensor> tensors;
  tensors.reserve(mesh.n_triangles());
  for (const TriangleId t : mesh.triangles()) tensors.push_back(of_region[mesh.region(t)]);
  return tensors;
}

}  // namespace

std::optional<GivenTensors> tensors_from(const Json& given, const Mesh& mesh) {
  const auto found = given.find("tensor");
  if (found == given.end() || found->is_null()) return std::nullopt;
  if (found->is_object()) return GivenTensors{{}, tensors_of_regions(*found, mesh)};
  if (found->is_array() && !found->empty() && found->front().is_array()) {
    if (found->size() != mesh.n_triangles()) {
      fail(ErrorCode::size_mismatch, "tensor: expected one for each of the " + std::to_string(mesh.n_triangles()) +
                                         " triangles, found " + std::to_string(found->size()));
    }
    GivenTensors tensors;
    for (const Json& tensor : *found) tensors.of_triangles.push_back(tensor_from(tensor));
    return tensors;
  }
  return GivenTensors{or_fail(Metric::of(tensor_from(*found))).tensor(), {}};
}

MetricMesh in_metric(const HeldMesh& held, const GivenTensors& tensors) {
  const Metrics metrics =
      tensors.one ? Metrics(or_fail(Metric::of(*tensors.one))) : or_fail(Metrics::of(tensors.of_triangles));
  return or_fail(mapped(held.mesh, metrics, tensors.one ? std::vector<double>() : held.corner_weights));
}

}  // namespace temper::wasm
