// The graded size by a tree over its sources: branches that cannot lower the best value so far are left out.
#include "mesher/graded_size.hpp"

#include <algorithm>
#include <cmath>

namespace temper::mesher {
namespace {

constexpr std::size_t kLeaf = 8;  // sources tested one by one

}  // namespace

GradedSize::GradedSize(std::span<const SizeSource> sources, double cap, double grade) : cap_(cap), grade_(grade) {
  for (const SizeSource& source : sources) {
    if (source.size < cap) sources_.push_back(source);
  }
  if (!sources_.empty()) build(0, sources_.size());
}

std::uint32_t GradedSize::build(std::size_t begin, std::size_t end) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  Node node{sources_[begin].at, sources_[begin].at, sources_[begin].size, static_cast<std::uint32_t>(begin),
            static_cast<std::uint32_t>(end)};
  for (std::size_t i = begin + 1; i < end; ++i) {
    const SizeSource& s = sources_[i];
    node.low = {std::min(node.low.x, s.at.x), std::min(node.low.y, s.at.y)};
    node.high = {std::max(node.high.x, s.at.x), std::max(node.high.y, s.at.y)};
    node.least = std::min(node.least, s.size);
  }
  nodes_.push_back(node);
  if (end - begin <= kLeaf) return index;
  const bool wide = node.high.x - node.low.x >= node.high.y - node.low.y;
  const std::size_t middle = begin + (end - begin) / 2;
  const auto before = [wide](const SizeSource& a, const SizeSource& b) {
    if (wide ? a.at.x != b.at.x : a.at.y != b.at.y) return wide ? a.at.x < b.at.x : a.at.y < b.at.y;
    if (wide ? a.at.y != b.at.y : a.at.x != b.at.x) return wide ? a.at.y < b.at.y : a.at.x < b.at.x;
    return a.size < b.size;
  };
  const auto at = [&](std::size_t i) { return sources_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), before);
  build(begin, middle);
  const std::uint32_t right = build(middle, end);
  nodes_[index].right = right;
  return index;
}

double GradedSize::bound(const Node& node, Vec2 x) const {
  const double dx = std::max({node.low.x - x.x, 0.0, x.x - node.high.x});
  const double dy = std::max({node.low.y - x.y, 0.0, x.y - node.high.y});
  return node.least + grade_ * std::sqrt(dx * dx + dy * dy);
}

void GradedSize::lower(std::uint32_t at, Vec2 x, double& best) const {
  const Node& node = nodes_[at];
  if (node.right == 0) {
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      if (sources_[i].size < best) best = std::min(best, sources_[i].size + grade_ * length(x - sources_[i].at));
    }
    return;
  }
  const double left = bound(nodes_[at + 1], x), right = bound(nodes_[node.right], x);
  const bool left_first = left <= right;
  if (std::min(left, right) < best) lower(left_first ? at + 1 : node.right, x, best);
  if (std::max(left, right) < best) lower(left_first ? node.right : at + 1, x, best);
}

double GradedSize::operator()(Vec2 x) const {
  double best = cap_;
  if (!nodes_.empty() && bound(nodes_[0], x) < best) lower(0, x, best);
  return best;
}

}  // namespace temper::mesher
