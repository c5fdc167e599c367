#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "base/assert.hpp"
#include "base/sum.hpp"
#include "base/text.hpp"
#include "geometry/triangle_kernel.hpp"
#include "mesh/blocks.hpp"
#include "mesh/edge_lengths.hpp"
#include "size/star_area.hpp"
#include "temper/detail/location.hpp"
#include "temper/detail/size.hpp"

namespace temper {
namespace {

/// The rank of a percentile: the least value that at least `part` of all n do not exceed.
std::size_t rank_of(double part, std::size_t n) {
  return static_cast<std::size_t>(std::max(1.0, std::ceil(part * static_cast<double>(n)))) - 1;
}

/// The value of that rank.
double percentile(std::vector<double>& values, double part) {
  const auto rank = static_cast<std::ptrdiff_t>(rank_of(part, values.size()));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

constexpr std::array<double, 5> kParts = {0, 0.05, 0.5, 0.95, 1};  // of a Spread

using BinCounts = std::vector<std::uint32_t>;

/// The sum of the counts that count(first, last, counts) makes in each of a few slices of 0 … n − 1, which run at once.
template <class Count>
BinCounts counted(std::size_t n, std::size_t n_counts, Executor* executor, Count&& count) {
  constexpr std::size_t kSlices = 8;  // each has counts of its own
  std::array<BinCounts, kSlices> slices;
  or_serial(executor).run(kSlices, [&](std::size_t i) {
    slices[i].assign(n_counts, 0);
    count(n * i / kSlices, n * (i + 1) / kSlices, slices[i]);
  });
  for (std::size_t i = 1; i < kSlices; ++i) {
    for (std::size_t k = 0; k < n_counts; ++k) slices[0][k] += slices[i][k];
  }
  return std::move(slices[0]);
}

/// The spread of positive floats that each(first, last, take) hands to take, without keeping them. Such floats are in
/// the order of their bits. So the first pass counts the upper halves, and the second one the lower halves next to a
/// percentile. A small number of floats is kept instead: counting takes longer.
template <class Each>
Spread spread_of_floats(std::size_t n_items, Executor* executor, Each&& each) {
  constexpr std::size_t kHalf = std::size_t{1} << 16;
  if (n_items <= 4 * kHalf) {
    std::vector<double> values;
    each(0, n_items, [&](float x) { values.push_back(double{x}); });
    return spread(std::move(values));
  }
  const BinCounts upper =
      counted(n_items, kHalf, executor, [&](std::size_t first, std::size_t last, BinCounts& counts) {
        each(first, last, [&](float x) { ++counts[std::bit_cast<std::uint32_t>(x) >> 16]; });
      });
  const std::size_t n = std::accumulate(upper.begin(), upper.end(), std::size_t{0});
  if (n == 0) return {};
  std::array<std::size_t, kParts.size()> ranks{}, halves{};
  for (std::size_t i = 0; i < kParts.size(); ++i) {
    ranks[i] = rank_of(kParts[i], n);
    while (ranks[i] >= upper[halves[i]]) ranks[i] -= upper[halves[i]++];
  }
  const auto count_lower = [&](std::size_t first, std::size_t last, BinCounts& counts) {
    each(first, last, [&](float x) {
      const auto bits = std::bit_cast<std::uint32_t>(x);
      for (std::size_t i = 0; i < kParts.size(); ++i)
        counts[i * kHalf + (bits & (kHalf - 1))] += bits >> 16 == halves[i] ? 1 : 0;
    });
  };
  const BinCounts lower = counted(n_items, kParts.size() * kHalf, executor, count_lower);
  std::array<double, kParts.size()> values{};
  for (std::size_t i = 0; i < kParts.size(); ++i) {
    std::size_t half = 0;
    while (ranks[i] >= lower[i * kHalf + half]) ranks[i] -= lower[i * kHalf + half++];
    values[i] = double{std::bit_cast<float>(static_cast<std::uint32_t>(halves[i] << 16 | half))};
  }
  return {values[0], values[1], values[2], values[3], values[4]};
}

/// The triangle of the field from which the search for v starts.
TriangleId start_for(VertexId v, const Mesh& mesh, const Mesh& of_field, const IdVector<VertexId, VertexId>& near) {
  VertexId there = v;
  if (near.size() == mesh.n_vertices()) {
    there = near[v];
  } else if (mesh.n_vertices() != of_field.n_vertices()) {
    return {};
  }
  return there.index < of_field.n_vertices() ? Mesh::triangle(of_field.outgoing(there)) : TriangleId();
}

/// The gradation at every edge, from the sizes at the vertices.
Spread gradation(const Mesh& mesh, const std::vector<double>& sizes, Executor* executor) {
  return spread_of_floats(mesh.n_halfedges(), executor, [&](std::size_t first, std::size_t last, auto&& take) {
    for (std::size_t i = first; i < last; ++i) {
      const HalfedgeId h(i);
      if (!mesh.is_edge_representative(h)) continue;
      const auto [low, high] = std::minmax(sizes[mesh.origin(h).index], sizes[mesh.target(h).index]);
      take(static_cast<float>(high / low));
    }
  });
}

double largest_edge_ratio(const Mesh& mesh, Executor* executor) {
  const std::size_t n = mesh.n_triangles();
  std::vector<double> largest2((n + kLoopBlock - 1) / kLoopBlock, 1.0);
  for_blocks(n, executor, [&](std::size_t first, std::size_t last) {
    double largest = 1;
    for (std::size_t t = first; t < last; ++t) {
      const auto [a, b, c] = mesh.points(TriangleId(t));
      const auto between2 = [&](const WeightedPoint& p, const WeightedPoint& q) {
        return edge_measures(mesh.space(), p, q).l2;
      };
      const auto [low, high] = std::minmax({between2(a, b), between2(b, c), between2(c, a)});
      largest = std::max(largest, high / low);
    }
    largest2[first / kLoopBlock] = largest;
  });
  return std::sqrt(largest2.empty() ? 1.0 : *std::max_element(largest2.begin(), largest2.end()));
}

}  // namespace

double local_size(const Mesh& mesh, VertexId v) {
  TEMPER_ASSERT(!mesh.is_isolated(v));
  return star_area(mesh, v).size();
}

IdVector<VertexId, double> local_sizes(const Mesh& mesh, Executor* executor) {
  return local_sizes(mesh, Walk(mesh, executor), executor);
}

IdVector<VertexId, double> local_sizes(const Mesh& mesh, const Walk& walk, Executor* executor) {
  IdVector<VertexId, double> sizes(mesh.n_vertices());
  for_each_index(mesh.n_vertices(), executor, [&](std::size_t i) {
    const VertexId v = walk[i];
    sizes[v] = mesh.is_isolated(v) ? 0 : local_size(mesh, v);
  });
  return sizes;
}

namespace {

template <class Size>
RelativeLengths relative(const Mesh& mesh, HalfedgeId h, const Size& size_at) {
  const auto [edge, dual] = edge_lengths(mesh, h);
  const double size = 0.5 * (size_at(mesh.origin(h)) + size_at(mesh.target(h)));
  return {edge / size, dual / size};
}

}  // namespace

RelativeLengths relative_lengths(const Mesh& mesh, const IdVector<VertexId, double>& sizes, HalfedgeId h) {
  return relative(mesh, h, [&](VertexId v) { return sizes[v]; });
}

RelativeLengths relative_lengths(const Mesh& mesh, HalfedgeId h) {
  return relative(mesh, h, [&](VertexId v) { return local_size(mesh, v); });
}

Spread spread(std::vector<double> values) {
  if (values.empty()) return {};
  return {percentile(values, kParts[0]), percentile(values, kParts[1]), percentile(values, kParts[2]),
          percentile(values, kParts[3]), percentile(values, kParts[4])};
}

double SizeReport::band() const { return std::max(over_field.max, 1 / over_field.min); }

SizeReport measure_size(const Mesh& mesh, const SizeField& field, Executor* executor,
                        const IdVector<VertexId, VertexId>& near) {
  TEMPER_ASSERT(mesh.space().kind() == field.mesh().space().kind());
  SizeReport report;
  const Walk walk(mesh, executor);
  std::vector<double> sizes(mesh.n_vertices());
  for_each_index(sizes.size(), executor, [&](std::size_t i) { sizes[walk[i].index] = local_size(mesh, walk[i]); });
  report.gradation = gradation(mesh, sizes, executor);
  // In place: a second array would raise the memory of a run, whose maximum is here.
  std::vector<double> ratios = std::move(sizes);
  report.vertices_outside_field = static_cast<std::size_t>(blockwise_sum(ratios.size(), executor, [&](std::size_t i) {
    const VertexId v = walk[i];
    const SizeField::Sample s = field.at(mesh.point(v), start_for(v, mesh, field.mesh(), near));
    ratios[v.index] /= s.size;
    return s.outside ? 1.0 : 0.0;
  }));
  report.over_field = spread(std::move(ratios));
  report.largest_edge_ratio = largest_edge_ratio(mesh, executor);
  return report;
}

struct SizeField::Data {
  Mesh own;          // empty when the field looks at a mesh of the caller's
  const Mesh* mesh;  // own, or the caller's
  IdVector<VertexId, double> sizes;
  PointLocator finder{*mesh};

  Data(Mesh copy, IdVector<VertexId, double> values) : own(std::move(copy)), mesh(&own), sizes(std::move(values)) {}
  Data(const Mesh* seen, IdVector<VertexId, double> values) : mesh(seen), sizes(std::move(values)) {}
  Data(const Data&) = delete;
  Data& operator=(const Data&) = delete;
  ~Data() = default;
};

Expected<SizeField> SizeField::from_values(const Mesh& mesh, std::span<const double> sizes, const InputNames* names) {
  const InputNames numbers_from_0;
  const InputNames& say = names != nullptr ? *names : numbers_from_0;
  if (sizes.size() != mesh.n_vertices()) {
    return InputError{ErrorCode::size_mismatch,
                      {},
                      "the size field has " + std::to_string(sizes.size()) + " sizes; expected one for each of the " +
                          std::to_string(mesh.n_vertices()) + " vertices"};
  }
  IdVector<VertexId, double> values(mesh.n_vertices());
  for (const VertexId v : mesh.vertices()) {
    const double size = sizes[v.index];
    if (!(size > 0) || !std::isfinite(size)) {
      return InputError{std::isfinite(size) ? ErrorCode::invalid_option : ErrorCode::not_finite,
                        say.point_where(v.index),
                        say.point(v.index) + " has size " + to_text(size) + "; expected a finite, positive length"};
    }
    values[v] = size;
  }
  return SizeField(std::make_shared<const Data>(mesh, std::move(values)));
}

SizeField::Sample SizeField::at(const WeightedPoint& p, TriangleId hint) const {
  const Place place = data_->finder.find(p, hint);
  return {interpolated(place, [this](VertexId v) { return data_->sizes[v]; }), place.triangle, place.outside};
}

const Mesh& SizeField::mesh() const { return *data_->mesh; }
double SizeField::at(VertexId v) const { return data_->sizes[v]; }

SizeField input_size_field(const Mesh& mesh) {
  return SizeField(std::make_shared<const SizeField::Data>(mesh, local_sizes(mesh, nullptr)));
}

SizeField input_size_field_of(const Mesh& mesh, Executor* executor) {
  return SizeField(std::make_shared<const SizeField::Data>(&mesh, local_sizes(mesh, executor)));
}

}  // namespace temper
