#include "mesher/sizing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace temper::mesher {
namespace {

/// Sources of a size along a line, or at a point.
void add_sources(const Problem& problem, const std::array<Vec3, 2>& line, double size,
                 std::vector<SizeSource>& sources) {
  if (size >= problem.wanted.most) return;
  const auto [a, b] = line;
  const double n = std::max(1.0, std::ceil(problem.surface.distance(a, b) / size));
  for (double k = 0; k <= n; ++k) sources.push_back({problem.surface.between(a, b, k / n), size});
}

void grade_field(const Problem& problem, const SizeField& field, std::vector<SizeSource>& sources) {
  const Mesh& mesh = field.mesh();
  const Surface& surface = problem.surface;
  for (const VertexId v : mesh.vertices()) {
    const Vec3 p = surface.place(mesh.point(v));
    const double here = field.at(v);
    const auto is_steep = [&](VertexId u) {
      return field.at(u) > here + problem.options.grade * length(surface.place(mesh.point(u)) - p);
    };
    bool steep = false;
    for (const HalfedgeId h : mesh.star(v)) steep = steep || is_steep(mesh.target(h)) || is_steep(mesh.opposite(h));
    if (steep) sources.push_back({p, here});
  }
}

}  // namespace

double count_on_lines(const Problem& problem, const Domain& domain) {
  double triangles = 0;
  for (std::size_t i = 0; i < domain.arrangement.edges.size(); ++i) {
    const auto [a, b] = domain.arrangement.ends(i);
    const double whole = problem.surface.distance(a, b);
    for (const std::int32_t area : domain.areas.sides[i]) {
      if (area == kOutside) continue;
      const double size = domain.area(area).size;
      if (size < problem.wanted.most) triangles += whole / size;
    }
  }
  for (const OutlineSize& s : problem.outline.sizes)
    triangles += 2 * problem.surface.distance(problem.point(s.points[0]), problem.point(s.points[1])) / s.size;
  return triangles;
}

Sizing first_sizing(const Problem& problem, const Domain& domain) {
  Sizing sizing;
  std::vector<SizeSource>& sources = sizing.sources;
  for (std::size_t i = 0; i < domain.arrangement.edges.size(); ++i) {
    const std::array<Vec3, 2> ends = domain.arrangement.ends(i);
    const double whole = problem.surface.distance(ends[0], ends[1]);
    const auto edge = static_cast<std::uint32_t>(i);
    if (!sizing.narrowest || whole < sizing.narrowest->width) sizing.narrowest = {whole, ends[0], {edge, edge}};
    for (const Vec3 end : ends) sources.push_back({end, whole});
    for (const std::int32_t area : domain.areas.sides[i]) {
      if (area != kOutside) add_sources(problem, ends, domain.area(area).size, sources);
    }
  }
  for (const OutlineSize& s : problem.outline.sizes)
    add_sources(problem, {problem.point(s.points[0]), problem.point(s.points[1])}, s.size, sources);
  if (problem.options.field) grade_field(problem, *problem.options.field, sources);
  sizing.corners = within_size(
      domain.arrangement, corner_radii(problem.surface, domain.arrangement, problem.wanted.most), sizing.size(problem));
  return sizing;
}

void refine_around(const Problem& problem, const Mesh& mesh, const std::vector<TriangleId>& bad, Sizing& sizing) {
  constexpr double kSmaller = 0.7;
  const GradedSize now = sizing.size(problem);  // a copy, without the new sources
  for (const TriangleId t : bad) {
    for (const VertexId v : mesh.corners(t)) {
      const Vec3 p = problem.surface.place(mesh.point(v));
      sizing.sources.push_back({p, kSmaller * now(p)});
    }
  }
}

void make_shorter(const std::vector<LongPieces>& pieces, Sizing& sizing) {
  constexpr double kShorter = 0.7;
  for (const LongPieces& at : pieces) {
    // At a corner the radius decides. Smaller sizes there would make the gaps beside it smaller, and so on.
    if (at.place < sizing.corners.size() && sizing.corners[at.place] > 0)
      sizing.corners[at.place] = std::min(sizing.corners[at.place], kShorter * at.length);
    else
      sizing.sources.push_back({at.at, kShorter * at.length});
  }
}

void add(const NarrowPlaces& narrow, Sizing& sizing) {
  std::optional<Gap>& narrowest = sizing.narrowest;
  if (narrow.narrowest && (!narrowest || narrow.narrowest->width < narrowest->width)) narrowest = narrow.narrowest;
  sizing.sources.insert(sizing.sources.end(), narrow.sources.begin(), narrow.sources.end());
}

}  // namespace temper::mesher
