// The graded size by a tree over its sources: branches that cannot lower the best value so far are skipped.
#include "mesher/graded_size.hpp"

#include <algorithm>

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

std::uint32_t GradedSize::build(std::size_t begin, std::size_t end) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  Node node{box_of(sources_[begin].at, sources_[begin].at), sources_[begin].size, static_cast<std::uint32_t>(begin),
            static_cast<std::uint32_t>(end)};
  for (std::size_t i = begin + 1; i < end; ++i) {
    const SizeSource& s = sources_[i];
    node.box = united(node.box, {s.at, s.at});
    node.least = std::min(node.least, s.size);
  }
  nodes_.push_back(node);
  if (end - begin <= kLeaf) return index;
  const std::size_t middle = begin + (end - begin) / 2;
  double Vec3::*const side = node.box.longest();
  const auto before = [side](const SizeSource& a, const SizeSource& b) {
    if (a.at.*side != b.at.*side) return a.at.*side < b.at.*side;
    for (double Vec3::*const other : {&Vec3::x, &Vec3::y, &Vec3::z}) {
      if (a.at.*other != b.at.*other) return a.at.*other < b.at.*other;
    }
    return a.size < b.size;
  };
  const auto at = [&](std::size_t i) { return sources_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), before);
  build(begin, middle);
  const std::uint32_t right = build(middle, end);
  nodes_[index].right = right;
  return index;
}

double GradedSize::bound(const Node& node, Vec3 x) const {
  const auto beyond = [&](double Vec3::*side) {
    return std::max({node.box.low.*side - x.*side, 0.0, x.*side - node.box.high.*side});
  };
  return node.least + grade_ * length(Vec3{beyond(&Vec3::x), beyond(&Vec3::y), beyond(&Vec3::z)});
}

void GradedSize::lower(std::uint32_t at, Vec3 x, double& best) const {
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

double GradedSize::operator()(Vec3 x) const {
  double best = wanted_.at(x, surface_);
  if (!nodes_.empty() && bound(nodes_[0], x) < best) lower(0, x, best);
  return best;
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
