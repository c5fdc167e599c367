// Diffusion tensors as JavaScript gives them, and meshes in their planes (temper/detail/tensor.hpp).
#pragma once

#include <optional>
#include <vector>

#include "answer.hpp"
#include "held_mesh.hpp"
#include "temper/detail/tensor.hpp"

namespace temper::wasm {

/// Tensors of a mesh: one, or one for each triangle.
struct GivenTensors {
  std::optional<Tensor> one;
  std::vector<Tensor> of_triangles;
};

/// The member `tensor` of `given`: kxx, kxy, kyy; a list of one for each triangle; or an object of one for each region
/// number. Nothing if there is no such member.
[[nodiscard]] std::optional<GivenTensors> tensors_from(const Json& given, const Mesh& mesh);
/// The mesh in the planes of these tensors, with its weights of corners.
[[nodiscard]] MetricMesh in_metric(const HeldMesh& held, const GivenTensors& tensors);

}  // namespace temper::wasm
