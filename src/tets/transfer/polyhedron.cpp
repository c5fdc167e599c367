#include "tets/transfer/polyhedron.hpp"

#include "base/assert.hpp"

namespace temper::tets {

std::size_t Polyhedron::turn(std::uint32_t corner, std::uint32_t from) const {
  const auto& next = corners_[corner].next;
  const std::size_t edge = next[0] == from ? 0 : next[1] == from ? 1 : 2;
  TEMPER_ASSERT(next[edge] == from);
  return (edge + 1) % 3;
}

bool Polyhedron::cut(const HalfSpace& space) {
  const auto n = static_cast<std::uint32_t>(corners_.size());
  sides_.resize(n);
  bool any_in = false, any_out = false;
  for (std::uint32_t c = 0; c < n; ++c) {
    sides_[c] = space.side(corners_[c].at);
    (sides_[c] < 0 ? any_out : any_in) = true;
  }
  if (!any_out) return false;
  if (!any_in) {
    corners_.clear();
    return true;
  }
  for (std::uint32_t c = 0; c < n; ++c) {
    for (std::size_t k = 0; k < 3 && sides_[c] >= 0; ++k) {
      const std::uint32_t out = corners_[c].next[k];
      if (sides_[out] >= 0) continue;
      const Vec3 from = corners_[c].at, along = corners_[out].at - from;
      const auto made = static_cast<std::uint32_t>(corners_.size());
      corners_.push_back({from + (sides_[c] / (sides_[c] - sides_[out])) * along, {c, 0, 0}});
      corners_[c].next[k] = made;
      sides_.push_back(0);
    }
  }
  join_new_corners(n);
  drop_outside(n);
  return true;
}

/// From each new corner along its face, over corners that stay, to the next new one.
void Polyhedron::join_new_corners(std::uint32_t first) {
  for (auto start = first; start < corners_.size(); ++start) {
    std::uint32_t from = start, here = corners_[start].next[0];
    while (here < first) {
      const std::uint32_t to = corners_[here].next[turn(here, from)];
      from = here, here = to;
    }
    corners_[start].next[2] = here;
    corners_[here].next[1] = start;
  }
}

void Polyhedron::drop_outside(std::uint32_t first) {
  numbers_.resize(corners_.size());
  std::uint32_t kept = 0;
  for (std::uint32_t c = 0; c < corners_.size(); ++c) {
    if (c < first && sides_[c] < 0) continue;
    numbers_[c] = kept;
    corners_[kept++] = corners_[c];
  }
  corners_.resize(kept);
  for (Corner& corner : corners_) {
    for (std::uint32_t& next : corner.next) next = numbers_[next];
  }
}

/// Each face as a fan around its first corner, seen from the first corner of all.
double Polyhedron::volume() const {
  if (corners_.empty()) return 0;
  const Vec3 origin = corners_[0].at;
  std::vector<std::array<bool, 3>> seen(corners_.size());
  double sum = 0;
  for (std::uint32_t start = 0; start < corners_.size(); ++start) {
    for (std::size_t edge = 0; edge < 3; ++edge) {
      if (seen[start][edge]) continue;
      std::uint32_t from = start;
      std::size_t along = edge;
      while (!seen[from][along]) {
        seen[from][along] = true;
        const std::uint32_t to = corners_[from].next[along];
        sum += dot(corners_[start].at - origin, cross(corners_[to].at - origin, corners_[from].at - origin));
        along = turn(to, from), from = to;
      }
    }
  }
  return sum / 6;
}

}  // namespace temper::tets
