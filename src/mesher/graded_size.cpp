// The graded size by a tree over its sources: branches that cannot lower the best value so far are skipped.
#include "mesher/graded_size.hpp"

#include <algorithm>
#include <limits>

#include "base/pack.hpp"

namespace temper::mesher {
namespace {

constexpr std::size_t kLeaf = 8;  // sources tested one by one

}  // namespace

GradedSize::GradedSize(const Surface& surface, std::span<const SizeSource> sources, const WantedSize& wanted,
                       double grade)
    : surface_(surface), wanted_(wanted), grade_(grade) {
  for (const SizeSource& source : sources) {
    if (source.size < wanted.most) sources_.push_back(source);
  }
  if (!sources_.empty()) build(0, sources_.size());
}

/// Puts the sources before the middle first, along the longest side of the box of all.
void GradedSize::sort_by_halves(std::size_t begin, std::size_t middle, std::size_t end) {
  const auto at = [&](std::size_t i) { return sources_.begin() + static_cast<std::ptrdiff_t>(i); };
  BoundingBox box = box_of(at(begin)->at, at(begin)->at);
  for (std::size_t i = begin; i < end; ++i) box = united(box, {at(i)->at, at(i)->at});
  double Vec3::*const side = box.longest();
  const auto before = [side](const SizeSource& a, const SizeSource& b) {
    if (a.at.*side != b.at.*side) return a.at.*side < b.at.*side;
    for (double Vec3::*const other : {&Vec3::x, &Vec3::y, &Vec3::z}) {
      if (a.at.*other != b.at.*other) return a.at.*other < b.at.*other;
    }
    return a.size < b.size;
  };
  std::nth_element(at(begin), at(middle), at(end), before);
}

std::uint32_t GradedSize::build(std::size_t begin, std::size_t end) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  Node node = {};
  for (std::size_t k = 0; k <= kChildren; ++k)
    node.ends[k] = static_cast<std::uint32_t>(begin + k * (end - begin) / kChildren);
  if (end - begin > kLeaf) {
    sort_by_halves(begin, node.ends[2], end);
    sort_by_halves(begin, node.ends[1], node.ends[2]);
    sort_by_halves(node.ends[2], node.ends[3], end);
  }
  for (std::size_t k = 0; k < kChildren; ++k) {
    node.least[k] = std::numeric_limits<double>::infinity();
    node.child[k] = 0;
    for (std::uint32_t i = node.ends[k]; i < node.ends[k + 1]; ++i) {
      const Vec3 p = sources_[i].at;
      const std::array<double, 3> at = {p.x, p.y, p.z};
      const bool is_first = i == node.ends[k];
      for (std::size_t side = 0; side < 3; ++side) {
        node.low[side][k] = is_first ? at[side] : std::min(node.low[side][k], at[side]);
        node.high[side][k] = is_first ? at[side] : std::max(node.high[side][k], at[side]);
      }
      node.least[k] = std::min(node.least[k], sources_[i].size);
    }
    if (node.ends[k + 1] - node.ends[k] > kLeaf) node.child[k] = build(node.ends[k], node.ends[k + 1]);
  }
  nodes_[index] = node;
  return index;
}

double GradedSize::lower(std::uint32_t at, Vec3 x, double best) const {
  const Node& node = nodes_[at];
  const std::array<double, 3> place = {x.x, x.y, x.z};
  Lanes squared = {};
  for (std::size_t side = 0; side < 3; ++side) {
    for (std::size_t k = 0; k < kChildren; ++k) {
      const double beyond = place[side] - std::min(std::max(place[side], node.low[side][k]), node.high[side][k]);
      squared[k] += beyond * beyond;
    }
  }
  Lanes bound;
  using baseline::Register;  // compilers make no vectors of std::sqrt, which sets errno
  for (std::size_t k = 0; k < kChildren; k += Register::kSize)
    (Register::load(&node.least[k]) + grade_ * square_root(Register::load(&squared[k]))).store(&bound[k]);
  for (;;) {
    const auto k = static_cast<std::size_t>(std::min_element(bound.begin(), bound.end()) - bound.begin());
    if (!(bound[k] < best)) return best;
    bound[k] = std::numeric_limits<double>::infinity();
    if (node.child[k] != 0) {
      best = lower(node.child[k], x, best);
      continue;
    }
    for (std::uint32_t i = node.ends[k]; i < node.ends[k + 1]; ++i) {
      if (sources_[i].size < best) best = std::min(best, sources_[i].size + grade_ * length(x - sources_[i].at));
    }
  }
}

double GradedSize::operator()(Vec3 x) const {
  const double best = wanted_.at(x, surface_);
  return nodes_.empty() ? best : lower(0, x, best);
}

Vec3 GradedSize::start() const {
  if (!has_field()) return {surface_.space().radius(), 0, 0};
  const Mesh& mesh = wanted_.field->mesh();
  VertexId least(0);
  for (const VertexId v : mesh.vertices()) {
    if (wanted_.field->at(v) < wanted_.field->at(least)) least = v;
  }
  return surface_.place(mesh.point(least));
}

}  // namespace temper::mesher
