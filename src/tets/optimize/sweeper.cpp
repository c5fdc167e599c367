#include "tets/optimize/sweeper.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>
#include <utility>

#include "base/compiler.hpp"
#include "base/instruction_set_choice.hpp"
#include "base/sum.hpp"
#include "geometry/bounding_boxes.hpp"
#include "tets/quality/duals.hpp"
#include "tets/quality/measure.hpp"

namespace temper::tets {
namespace {

constexpr int kMostColors = 63;
constexpr int kColorsOfFixed = 16;               // vertices whose position stays come first, as in most files
constexpr std::size_t kVerticesPerTask = 32;     // a tenth of a millisecond
constexpr std::size_t kVerticesPerLook = 16384;  // between two questions whether to stop: tens of milliseconds
constexpr std::size_t kAhead = 2;                // distance to the vertex whose memory is fetched in advance

bool is_positive(const TetMesh& mesh, std::span<const HalffaceId> link, const WeightedPoint& p) {
  return std::all_of(link.begin(), link.end(), [&](HalffaceId h) {
    const auto [q, r, s] = mesh.vertices(h);
    return orientation(mesh.position(q), mesh.position(r), mesh.position(s), p.position()) == Sign::positive;
  });
}

/// Numbers of tasks of some size for n items.
std::size_t n_tasks(std::size_t n, std::size_t size) { return (n + size - 1) / size; }

/// Puts two zeros between any two of the last ten bits.
std::uint32_t spread(std::uint32_t x) {
  x = (x | x << 16) & 0x030000ff;
  x = (x | x << 8) & 0x0300f00f;
  x = (x | x << 4) & 0x030c30c3;
  return (x | x << 2) & 0x09249249;
}

/// Places along a Z curve through 1024³ cells: links of vertices that follow each other share memory.
IdVector<VertexId, std::uint32_t> places_along_curve(const TetMesh& mesh, const std::vector<VertexId>& vertices) {
  const auto [low, high] = bounding_box(mesh, vertices);
  const Vec3 sides = high - low;
  const double extent = std::max({sides.x, sides.y, sides.z});
  const auto cell = [&](double x) { return spread(static_cast<std::uint32_t>(1023 * (x / extent))); };
  IdVector<VertexId, std::uint32_t> places(mesh.n_vertices(), 0);
  for (const VertexId v : vertices) {
    const Vec3 p = mesh.position(v) - low;
    if (extent > 0) places[v] = cell(p.x) | cell(p.y) << 1 | cell(p.z) << 2;
  }
  return places;
}

}  // namespace

const Kernels& kernels() { return *TEMPER_IN_USE(kTetKernels); }

Link gather(const TetMesh& mesh, std::span<const HalffaceId> halffaces, std::vector<LinkLanes>& room) {
  const std::size_t faces = halffaces.size(), blocks = n_tasks(faces, kLanes);
  if (room.size() < blocks) room.resize(blocks);
  for (std::size_t i = 0; i < blocks * kLanes; ++i) {
    const auto [q, r, s] = mesh.vertices(halffaces[std::min(i, faces - 1)]);
    LinkLanes& to = room[i / kLanes];
    to.q.set(i % kLanes, mesh.point(q)), to.r.set(i % kLanes, mesh.point(r)), to.s.set(i % kLanes, mesh.point(s));
  }
  return {room.data(), faces};
}

WeightedPoint improved(const TetMesh& mesh, std::span<const HalffaceId> halffaces, const WeightedPoint& origin,
                       const Mobility& mobility, const SweepParameters& parameters, std::vector<LinkLanes>& room) {
  const Link link = gather(mesh, halffaces, room);
  const auto [p, lower, certain] = kernels().step(link, origin, mobility, parameters);
  const bool is_kept = lower && is_exact(p) && (certain || is_positive(mesh, halffaces, p)) &&
                       (parameters.most_cosine == 1 || kernels().keeps_angles(link, origin, p, parameters.most_cosine));
  return is_kept ? p : origin;
}

Sweeper::Sweeper(TetMesh& mesh, const IdVector<VertexId, Mobility>& mobility, std::span<const VertexId> vertices,
                 Executor* executor)
    : mesh_(mesh), mobility_(mobility), executor_(executor) {
  const VertexStars stars(mesh);
  color(stars, vertices);
  stars_ = VertexStars(stars, sequence_);
}

void Sweeper::color(const VertexStars& stars, std::span<const VertexId> vertices) {
  IdVector<VertexId, std::uint64_t> bit(mesh_.n_vertices(), 0);  // of the color; 0: none
  std::vector<std::size_t> begin(kMostColors + 2, 0);
  const auto color_of = [&](VertexId v) { return static_cast<std::size_t>(std::countr_zero(bit[v])); };
  for (const VertexId v : vertices) {
    if (mobility_[v] == Mobility::none) continue;
    std::uint64_t taken = !mobility_[v].moves() ? 0 : (std::uint64_t{1} << kColorsOfFixed) - 1;
    for (const HalffaceId h : stars.link(v)) {
      for (const VertexId u : mesh_.vertices(h)) taken |= bit[u];
    }
    bit[v] = std::uint64_t{1} << std::min(std::countr_one(taken), kMostColors);
    ++begin[color_of(v) + 1];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  sequence_.resize(begin.back());
  end_.assign(begin.begin(), begin.end() - 1);
  for (const VertexId v : vertices) {
    if (bit[v] != 0) sequence_[end_[color_of(v)]++] = v;
  }
  const IdVector<VertexId, std::uint32_t> place = places_along_curve(mesh_, sequence_);
  or_serial(executor_).run(kMostColors, [&](std::size_t i) {
    const auto begin_of = [&](std::size_t c) { return sequence_.begin() + static_cast<std::ptrdiff_t>(begin[c]); };
    std::sort(begin_of(i), begin_of(i + 1),
              [&](VertexId a, VertexId b) { return std::pair(place[a], a) < std::pair(place[b], b); });
  });
}

bool Sweeper::sweep(const std::function<Step()>& new_step, const MustStop& must_stop) {
  std::size_t first = 0;
  for (std::size_t color = 0; color < end_.size(); ++color) {
    for (std::size_t last = first; first < end_[color]; first = last) {
      if (must_stop && must_stop(double(first) / double(sequence_.size()))) return false;
      last = std::min(end_[color], first + kVerticesPerLook);
      const std::size_t size = color < kMostColors ? kVerticesPerTask : last - first;
      or_serial(executor_).run(n_tasks(last - first, size), [&](std::size_t i) {
        improve(first + i * size, std::min(last, first + (i + 1) * size), new_step());
      });
    }
  }
  return true;
}

bool Sweeper::sweep(const SweepParameters& parameters, const MustStop& must_stop) {
  const auto new_step = [&]() -> Step {
    return [&, room = std::vector<LinkLanes>()](VertexId v, std::span<const HalffaceId> link) mutable {
      return improved(mesh_, link, mesh_.point(v), mobility_[v], parameters, room);
    };
  };
  return sweep(new_step, must_stop);
}

void Sweeper::improve(std::size_t first, std::size_t last, const Step& step) {
  const auto link = [&](std::size_t i) { return stars_.link(VertexId(std::min(i, last - 1))); };
  for (std::size_t i = first; i < last; ++i) {
    const VertexId soon = sequence_[std::min(i + kAhead, last - 1)];
    prefetch(&mesh_.point(soon));
    prefetch(&mobility_[soon]);
    for (const HalffaceId h : link(i + 2 * kAhead)) prefetch(&mesh_.corners(TetMesh::tetrahedron(h)));
    for (const HalffaceId h : link(i + kAhead)) {
      for (const VertexId u : mesh_.vertices(h)) prefetch(&mesh_.point(u));
    }
    const VertexId v = sequence_[i];
    mesh_.set_point(v, step(v, link(i)));
  }
}

bool is_exact(const WeightedPoint& p) {
  return is_exact_coordinate(p.x) && is_exact_coordinate(p.y) && is_exact_coordinate(p.z) && is_exact_weight(p.w);
}

bool is_good(const TetMesh& mesh, TetId t) {
  const auto [a, b, c, d] = mesh.points(t);
  return orientation(a.position(), b.position(), c.position(), d.position()) == Sign::positive &&
         is_well_centered(mesh, t);
}

namespace {

/// Calls use(t, energy, is_bad) for each tetrahedron of a block.
template <class Use>
void judge(const TetMesh& mesh, double gamma, std::size_t first, std::size_t last, const Use& use) {
  Lane energies;
  for (; first < last; first += kLanes) {
    const auto [inside, outside] = kernels().tetrahedra(lanes_of(mesh, first, last), gamma, energies);
    for (std::size_t i = 0; i < std::min(kLanes, last - first); ++i) {
      const TetId t(first + i);
      use(t, energies[i], (outside >> i & 1) != 0 || ((inside >> i & 1) == 0 && !is_well_centered(mesh, t)));
    }
  }
}

}  // namespace

MeshState state_of(const TetMesh& mesh, double gamma, Executor* executor) {
  const std::size_t n = mesh.n_tetrahedra();
  const auto sums = sums_of_blocks(n, 2, executor, [&](std::size_t b, std::span<double> of_block) {
    judge(mesh, gamma, b * kBlockSize, std::min(n, (b + 1) * kBlockSize), [&](TetId, double energy, bool bad) {
      of_block[0] += energy;
      of_block[1] += bad ? 1 : 0;
    });
  });
  return {sums[0], static_cast<std::size_t>(sums[1])};
}

std::vector<TetId> bad_tetrahedra(const TetMesh& mesh, Executor* executor) {
  const std::size_t n = mesh.n_tetrahedra();
  std::vector<std::vector<TetId>> of_blocks(n_tasks(n, kBlockSize));
  or_serial(executor).run(of_blocks.size(), [&](std::size_t b) {
    judge(mesh, 1, b * kBlockSize, std::min(n, (b + 1) * kBlockSize), [&](TetId t, double, bool bad) {
      if (bad) of_blocks[b].push_back(t);
    });
  });
  std::vector<TetId> all;
  for (const auto& block : of_blocks) all.insert(all.end(), block.begin(), block.end());
  return all;
}

}  // namespace temper::tets
