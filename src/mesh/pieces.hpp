// Meshes are mapped into the planes of tensors. Meshes of triangles and of tetrahedra share these functions.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "temper/detail/tensor.hpp"

namespace temper {

/// The place and the name of a cell, for errors. Other cells have this function in their own namespace.
[[nodiscard]] inline std::pair<std::string, std::string> place_and_name(const InputNames& names, TriangleId t) {
  return {names.triangle_where(t.index), names.triangle(t.index)};
}

template <class K>
[[nodiscard]] bool is_finite(const K& k) {
  return std::ranges::all_of(k.components(), [](double c) { return std::isfinite(c); });
}

/// The components of √(det K) K⁻¹, which are the same for multiples of K, as integers in units of 10⁻¹⁰ of their norm.
template <class K>
[[nodiscard]] std::vector<std::int64_t> plane_of(const K& k) {
  constexpr double kUnit = 1e-10;
  double norm = 0;
  for (const double c : k.components()) norm = std::hypot(norm, c);
  std::vector<std::int64_t> plane;
  for (const double c : k.components()) plane.push_back(std::llround(c / norm / kUnit));
  return plane;
}

template <class K, class CellId, class Names>
Expected<MetricsOf<K, CellId, Names>> MetricsOf<K, CellId, Names>::of(std::span<const K> tensors, const Names& names) {
  std::map<decltype(K().components()), std::uint32_t> numbers;
  std::map<std::vector<std::int64_t>, std::uint32_t> planes;
  MetricsOf metrics;
  metrics.distinct_.clear();
  metrics.of_cell_.reserve(tensors.size());
  for (std::size_t t = 0; t < tensors.size(); ++t) {
    const K& k = tensors[t];
    const auto next = static_cast<std::uint32_t>(metrics.distinct_.size());
    // Numbers that are not finite have no order.
    const auto [at, is_new] = is_finite(k) ? numbers.try_emplace(k.components(), next) : std::pair(numbers.end(), true);
    if (is_new) {
      auto metric = MetricOf<K>::of(k);
      if (!metric) {
        const auto [where, name] = place_and_name(names, CellId(t));
        return InputError{metric.error().code, where, name + ": " + metric.error().message};
      }
      const std::uint32_t plane = planes.try_emplace(plane_of(k), next).first->second;
      if (plane != next) metric->to_ = metrics.distinct_[plane].to_, metric->from_ = metrics.distinct_[plane].from_;
      metrics.distinct_.push_back(*metric);
    }
    metrics.of_cell_.push_back(at->second);
  }
  if (metrics.distinct_.empty()) return MetricsOf();
  if (metrics.distinct_.size() == 1) metrics.of_cell_ = {};
  return metrics;
}

/// The error of tensors, or of weights of corners, that are not as many as the cells need.
template <class AnyMetrics>
[[nodiscard]] Expected<void> expect_sizes(const AnyMetrics& metrics, std::span<const double> corner_weights,
                                          std::size_t n_cells, std::size_t n_corners, const char* cells) {
  const auto refused = [&](const char* what, std::size_t expected, std::size_t found) {
    return InputError{ErrorCode::invalid_option, "",
                      std::string(what) + ": expected " + std::to_string(expected) + " for " + std::to_string(n_cells) +
                          " " + cells + ", found " + std::to_string(found)};
  };
  if (!metrics.is_constant() && metrics.n_cells() != n_cells) return refused("tensors", n_cells, metrics.n_cells());
  if (!corner_weights.empty() && corner_weights.size() != n_corners)
    return refused("corner weights", n_corners, corner_weights.size());
  return {};
}

/// Numbers each pair of a region and a metric, and gives each cell that number as its region.
template <class Pieces, class Cells>
void number_regions(Pieces& pieces, const Cells& cells) {
  std::map<std::pair<std::int32_t, std::uint32_t>, std::int32_t> numbers;
  for (const auto t : cells) {
    const std::pair kind(pieces.mesh.region(t), pieces.metrics.number(t));
    const auto [at, is_new] = numbers.try_emplace(kind, static_cast<std::int32_t>(pieces.regions.size()));
    if (is_new) pieces.regions.push_back({kind.first, kind.second});
    pieces.mesh.set_region(t, at->second);
  }
}

/// Pieces after a change of their mesh: see with_mesh().
template <class Pieces, class AnyMesh>
[[nodiscard]] Pieces with_other_mesh(const Pieces& pieces, AnyMesh changed,
                                     const IdVector<VertexId, VertexId>& vertices) {
  Pieces now = {std::move(changed), pieces.metrics, {}, pieces.regions};
  if (!pieces.is_cut()) return now;
  IdVector<VertexId, VertexId> first(pieces.mesh.n_vertices());  // of the copies that are left
  now.first_copies.reserve(now.mesh.n_vertices());
  for (const VertexId v : now.mesh.vertices()) {
    const VertexId old = vertices.empty() ? v : vertices[v];
    if (!old.valid()) {
      now.first_copies.push_back(v);
      continue;
    }
    VertexId& known = first[pieces.first_copy(old)];
    if (!known.valid()) known = v;
    now.first_copies.push_back(known);
  }
  return now;
}

/// The numbers before the cut of the vertices that join kept, by their numbers in the pieces; empty if there are none.
template <class Pieces>
[[nodiscard]] IdVector<VertexId, VertexId> numbers_before_cut(const IdVector<VertexId, VertexId>& kept,
                                                              const Pieces& pieces,
                                                              const IdVector<VertexId, VertexId>& vertices) {
  IdVector<VertexId, VertexId> before;
  if (vertices.empty()) return before;
  for (const VertexId v : kept) {
    const VertexId old = vertices[v];
    before.push_back(old.valid() ? pieces.first_copy(old) : old);
  }
  return before;
}

/// Adds up the values of the copies of each of the first `n` vertices, which are those of the whole mesh.
template <class Pieces>
[[nodiscard]] IdVector<VertexId, double> sums_of_copies(const Pieces& pieces, const IdVector<VertexId, double>& values,
                                                        std::size_t n) {
  IdVector<VertexId, double> sums(n, 0.0);
  for (const VertexId v : pieces.mesh.vertices()) sums[pieces.first_copy(v)] += values[v];
  return sums;
}

/// The quotient of the size of a face by the height over it.
[[nodiscard]] inline double over_height(double size, double height) {
  return height == 0 ? std::numeric_limits<double>::infinity() : size / height;
}

}  // namespace temper
