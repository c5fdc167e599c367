// Outlines that are moved by rounding, through the mesher: twenty kinds with touching lines and points.
//
// The bytes of an input choose a kind, the perturbation (0, or 1e-16 to 1e-3 of the extent), and the options. Each run
// gives a mesh with all regions, tags and points, or an error with a place and a cure, within 20 s.
// `fuzz_smoke 600 outline_mesh` makes as many runs as fit into 600 s.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <ctime>
#include <numbers>
#include <numeric>
#include <regex>
#include <set>

#include "base/rng.hpp"
#include "target.hpp"
#include "temper/mesher.hpp"

namespace temper::fuzz {
namespace {

constexpr double kPi = std::numbers::pi;

/// Lines of one tag; closed ones are parts.
struct Line {
  std::vector<Vec2> points;
  bool closed = false;
};
struct Kind {
  std::vector<Line> lines;
  std::vector<Vec2> wells;
};

std::vector<Vec2> ring(Vec2 center, double radius, int n) {
  std::vector<Vec2> points;
  for (int i = 0; i < n; ++i) {
    const double t = 2 * kPi * i / n + 0.1;
    points.push_back({center.x + radius * std::cos(t), center.y + radius * std::sin(t)});
  }
  return points;
}
std::vector<Vec2> box(double x, double y, double w, double h) {
  return {{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}};
}
Vec2 on(Vec2 a, Vec2 b, double part) { return a + part * (b - a); }

/// In a square of about 10 units.
std::vector<Kind> kinds() {
  const std::vector<Vec2> slanted = {{0, 0}, {10, 1}, {9, 9}, {1, 8}};
  const auto side = [&](int i, double part) {
    return on(slanted[static_cast<std::size_t>(i)], slanted[static_cast<std::size_t>((i + 1) % 4)], part);
  };
  const Vec2 a = {2, 2}, b = {7, 6};
  std::vector<Kind> all = {
      {{{slanted, true}, {{side(0, 0.3), {4, 4}, side(2, 0.6)}, false}}, {}},       // a river across
      {{{slanted, true}, {{a, b}, false}, {{on(a, b, 0.37), {6, 3}}, false}}, {}},  // a tee inside
      {{{slanted, true}, {{a, b}, false}, {{on(a, b, 0.7), {3, 6}}, false}}, {on(a, b, 0.2)}},
      {{{slanted, true}, {{side(1, 0.25), side(3, 0.55)}, false}}, {side(2, 0.4)}},  // a well on the border
      {{{box(0, 0, 4, 8), true}, {{{4, 0}, {9, 0}, {9, 8}, {4, 8}, {4, 5}, {4, 2.5}}, true}}, {}},  // a shared border
      {{{{{0, 0}, {6, 0}, {8, 8}, {1, 7}}, true}, {{{6, 0}, {12, 1}, {11, 9}, {8, 8}, on({6, 0}, {8, 8}, 0.3)}, true}},
       {}},
      {{{{{0, 0}, {6, 0}, {8, 8}, {1, 7}, on({0, 0}, {1, 7}, 0.5)}, true},
        {{{6, 0}, {12, 1}, {8, 8}, on({6, 0}, {8, 8}, 0.7), on({6, 0}, {8, 8}, 0.2)}, true}},
       {{3, 3}}},
      {{{ring({5, 5}, 5, 17), true}, {ring({5, 5}, 5, 17), false}}, {}},  // a line on the border
      {{{ring({5, 5}, 5, 13), true}, {{{5, 5}, {7, 6}}, false}, {{{5, 5}, {4, 8}}, false}, {{{5, 5}, {2, 3}}, false}},
       {{5, 5}}},  // a star
      {{{box(0, 0, 9, 9), true}, {{{0, 3}, {9, 3}}, false}, {{{3, 0}, {3, 3}}, false}, {{{6, 3}, {6, 9}}, false}}, {}},
      {{{box(0, 0, 9, 9), true}, {{{1, 1}, {8, 8}}, false}, {{{2, 2}, {5, 5}}, false}}, {{7, 7}}},  // a line on a line
      {{{box(0, 0, 9, 9), true}, {ring({4, 4}, 2, 9), true}}, {}},                                  // overlap: an error
      {{{box(0, 0, 4, 4), true}, {box(4, 4, 4, 4), true}}, {}},                                     // touch at a point
      {{{box(0, 0, 4, 4), true}, {{{4, 1}, {8, 0}, {8, 4}}, true}}, {}},              // a corner on a side
      {{{slanted, true}, {{{-3, 5}, {12, 4}}, false}}, {}},                           // out of the domain
      {{{slanted, true}, {{{3, 3}, {6, 5}}, false}, {{{3, 5}, {6, 3}}, false}}, {}},  // a crossing
      {{{slanted, true}, {{side(0, 0.5), side(2, 0.5)}, false}, {{side(1, 0.5), side(3, 0.5)}, false}}, {}},
      {{{ring({5, 5}, 5, 40), true}, {{{5, 5}, {5.5, 5}, {5.4, 5.4}}, false}}, {{5.2, 5}, {20, 20}}},
      {{{box(0, 0, 3, 9), true}, {box(3, 0, 3, 4), true}, {box(3, 4, 3, 5), true}, {box(6, 0, 3, 9), true}}, {}},
      {{{{{0, 0}, {9, 0}, {9, 9}, {5, 9}, {4.5, 1}, {4, 9}, {0, 9}}, true}, {{{4.5, 1}, {4.5, 0}}, false}}, {}}};
  return all;
}

/// Equal positions stay equal points in a part of the runs, as a reader makes them.
Outline outline_of(const Kind& kind, double perturbation, double scale, Vec2 offset, Rng& rng) {
  Outline o;
  const auto moved = [&](Vec2 p) {
    const auto noise = [&] { return rng.below(3) == 0 ? 0.0 : 10 * perturbation * (2 * rng.uniform() - 1); };
    return Vec2{offset.x + scale * (p.x + noise()), offset.y + scale * (p.y + noise())};
  };
  const auto point = [&](Vec2 p) {
    const Vec2 q = moved(p);
    for (std::size_t i = 0; i < o.points.size(); ++i) {
      if (o.points[i] == q) return static_cast<std::int32_t>(i);
    }
    o.points.push_back(q);
    return static_cast<std::int32_t>(o.points.size() - 1);
  };
  std::int32_t tag = 10;
  for (const Line& line : kind.lines) {
    std::vector<std::int32_t> numbers;
    for (const Vec2 p : line.points) numbers.push_back(point(p));
    if (line.closed) numbers.push_back(numbers.front());
    OutlinePart part;
    part.region = tag;
    ++tag;
    for (std::size_t i = 0; i + 1 < numbers.size(); ++i) {
      part.segments.push_back(static_cast<std::int32_t>(o.segments.size()));
      o.segments.push_back({{numbers[i], numbers[i + 1]}, tag});
    }
    if (line.closed) o.parts.push_back(part);
  }
  for (const Vec2 p : kind.wells) point(p);
  return o;
}

bool contains(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

/// "(8.5, 53.25)" somewhere in the text.
bool names_place(const std::string& text) {
  static const std::regex place(R"(\(-?[0-9][-+.e0-9]*, -?[0-9][-+.e0-9]*\))");
  return std::regex_search(text, place);
}

/// Counts the results of all runs.
struct Outcome {
  std::set<std::uint64_t> inputs;
  std::size_t meshes = 0, errors = 0, bad = 0;
  double slowest = 0;  // seconds
  std::string slow;    // that run
};
Outcome& outcome() {
  static Outcome all;
  return all;
}

/// Sets of vertices that edges of one tag connect.
class Chains {
 public:
  Chains(const OutlineMesh& made, std::int32_t tag) : first_(made.mesh.n_vertices()) {
    std::iota(first_.begin(), first_.end(), 0u);
    for (const MeshLine& line : made.lines) {
      insist(made.mesh.find_halfedge(line.a, line.b).valid() || made.mesh.find_halfedge(line.b, line.a).valid(),
             "a line of the result is an edge of the mesh");
      if (line.tag == tag) first_[root(line.a.index)] = root(line.b.index);
    }
  }
  [[nodiscard]] bool connect(VertexId a, VertexId b) { return root(a.index) == root(b.index); }

 private:
  std::uint32_t root(std::uint32_t i) {
    while (first_[i] != i) i = first_[i] = first_[first_[i]];
    return i;
  }
  std::vector<std::uint32_t> first_;
};

/// The edges with a tag of a segment lead from one of its ends to the other, if both are in the mesh. Each domain is
/// convex, so the segment is inside. A tag with no edge at all is named.
void check_tags(const OutlineMesh& made, const Outline& outline, const std::vector<std::int32_t>& vertex_of_point,
                const std::string& words) {
  const bool divided = contains(words, "touched itself");  // then chains are cut, too
  for (std::size_t first = 0, next = 0; first < outline.segments.size(); first = next) {
    const std::int32_t tag = outline.segments[first].tag;
    Chains chains(made, tag);
    const bool any = std::any_of(made.lines.begin(), made.lines.end(), [&](const auto& l) { return l.tag == tag; });
    insist(any || contains(words, "tag " + std::to_string(tag)), "a tag without edges is named: " + words);
    for (next = first; next < outline.segments.size() && outline.segments[next].tag == tag; ++next) {
      const auto [a, b] = outline.segments[next].ends;
      const std::int32_t from = vertex_of_point[static_cast<std::size_t>(a)],
                         to = vertex_of_point[static_cast<std::size_t>(b)];
      if (from < 0 || to < 0 || divided) continue;
      insist(chains.connect(VertexId(static_cast<std::size_t>(from)), VertexId(static_cast<std::size_t>(to))),
             "the edges of tag " + std::to_string(tag) + " lead from point " + std::to_string(a) + " to point " +
                 std::to_string(b));
    }
  }
}

/// `n_copies`: how often the points are in the result. Points of no segment are in the last copy.
void check_result(const Expected<OutlineMesh>& made, const Outline& outline, std::size_t n_copies) {
  if (!made) {
    ++outcome().errors;
    const std::string what = made.error().what();
    insist(contains(what, "Next") || contains(what, "expected"), "an error has a cure: " + what);
    insist(names_place(what), "an error has a place: " + what);
    return;
  }
  ++outcome().meshes;
  outcome().bad += made->bad > 0 ? 1 : 0;
  insist(!made->mesh.validate().has_value(), "the mesh is valid");
  const std::size_t n = outline.points.size();
  insist(made->vertex_of_point.size() == n_copies * n, "each point has a vertex or none");
  std::set<std::int32_t> found, wanted;
  for (const TriangleId t : made->mesh.triangles()) found.insert(made->mesh.region(t));
  for (const OutlinePart& part : outline.parts) wanted.insert(part.region);
  insist(found == wanted, "all regions are there");
  std::string words;
  for (const auto* list : {&made->notes, &made->warnings}) {
    for (const std::string& text : *list) words += text + "\n";
  }
  std::vector<std::int32_t> vertex_of_point(n, -1);  // of any copy
  for (std::size_t i = 0; i < n_copies * n; ++i) {
    const VertexId v = made->vertex_of_point[i];
    if (v.valid()) vertex_of_point[i % n] = static_cast<std::int32_t>(v.index);
  }
  check_tags(*made, outline, vertex_of_point, words);
  std::vector<bool> alone(n, true);
  for (const OutlineSegment& s : outline.segments) alone[s.ends[0]] = alone[s.ends[1]] = false;
  for (std::size_t i = 0; i < n; ++i) {
    insist(!alone[i] || vertex_of_point[i] >= 0 || contains(words, "point " + std::to_string(i) + " at"),
           "a point without a vertex is named");
  }
}

void mesh_moved_outline(std::string_view bytes) {
  std::array<std::uint64_t, 3> words = {1, 2, 3};
  std::memcpy(words.data(), bytes.data(), std::min(bytes.size(), sizeof words));
  Rng rng(words[0] ^ (words[1] << 1) ^ (words[2] << 2));
  static const std::vector<Kind> all = kinds();
  const Kind& kind = all[rng.below(static_cast<std::uint32_t>(all.size()))];
  const std::uint32_t power = rng.below(15);  // 0: none
  const double perturbation = power == 0 ? 0 : std::pow(10.0, -17.0 + power);
  const bool sphere = rng.below(2) == 0, split = rng.below(3) == 0;
  MesherOptions options;
  options.split_crossings = split;
  options.attempts = 2;
  options.time_limit = 15;
  if (rng.below(4) == 0) options.snap = sphere ? 2e6 * perturbation : 20 * perturbation;
  outcome().inputs.insert(words[0] ^ (words[1] << 1) ^ (words[2] << 2));
  const std::clock_t start = std::clock();  // of the processor: other programs may run beside
  if (sphere) {
    const Outline outline = outline_of(kind, perturbation, 1, {rng.below(360) - 180.0, 20}, rng);
    SphereOutline on_sphere;
    on_sphere.basins.points = on_sphere.lines.points = outline.points;
    std::vector<std::uint8_t> closed(outline.segments.size(), 0);
    for (OutlinePart part : outline.parts) {
      for (std::int32_t& s : part.segments) {
        closed[static_cast<std::size_t>(s)] = 1;
        on_sphere.basins.segments.push_back(outline.segments[static_cast<std::size_t>(s)]);
        s = static_cast<std::int32_t>(on_sphere.basins.segments.size() - 1);
      }
      on_sphere.basins.parts.push_back(std::move(part));
    }
    for (std::size_t i = 0; i < closed.size(); ++i) {
      if (closed[i] == 0) on_sphere.lines.segments.push_back(outline.segments[i]);
    }
    options.size = 150'000;
    check_result(mesh_sphere(on_sphere, options), outline, 2);
  } else {
    const double scale = std::pow(10.0, static_cast<int>(rng.below(7)) - 2.0);
    const Vec2 offset = rng.below(2) == 0 ? Vec2{} : Vec2{4e4 * scale, 6e5 * scale};
    const Outline outline = outline_of(kind, perturbation, scale, offset, rng);
    options.size = 1.5 * scale;
    check_result(mesh_outline(outline, options), outline, 1);
  }
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  if (seconds > outcome().slowest) {
    outcome().slowest = seconds;
    outcome().slow =
        fmt::format("kind {}, moved by {:.0e}, {}", &kind - all.data(), perturbation, sphere ? "sphere" : "plane");
  }
  insist(seconds < 20, "a run ends in 20 s");
}

}  // namespace

std::vector<Target> outline_mesh_targets() {
  return {{"outline_mesh", mesh_moved_outline,
           [] {
             std::vector<std::string> seeds;
             for (char c = 'a'; c <= 'p'; ++c) seeds.emplace_back(24, c);
             return seeds;
           },
           [] {
             const Outcome& o = outcome();
             return fmt::format(
                 "{} different inputs: {} meshes ({} with bad triangles), {} errors; slowest {:.1f} s ({})",
                 o.inputs.size(), o.meshes, o.bad, o.errors, o.slowest, o.slow);
           }}};
}

}  // namespace temper::fuzz
