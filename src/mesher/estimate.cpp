// Cells of the inside, the triangles of the outline at first, are halved where the sizes in them differ most.
#include "mesher/estimate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "temper/detail/geometry.hpp"
#include "topology/locate.hpp"

namespace temper::mesher {
namespace {

// Measured: the largest resident set of `temper mesh` over the number of triangles is 150 to 180 bytes for 230,000 to
// 13 million triangles, in the plane and on the sphere, and 246 bytes with a long coast. Arrays that grow by doubling
// make the difference.
constexpr double kBytesPerTriangle = 250;
constexpr double kBytesOfProgram = 60e6;  // libraries, and buffers that do not grow with the mesh

class Counter {
 public:
  Counter(const Triangulated& outline, const Areas& areas, const GradedSize& size, double per_triangle)
      : surface_(size.surface()), outline_(outline), areas_(areas), size_(size), per_triangle_(per_triangle) {}

  double run(bool has_field, Deadline& deadline) {
    for (const TriangleId t : outline_.mesh.triangles()) {
      if (outline_.area[t] != kOutside) add(cell_of(t));
    }
    if (!std::isfinite(total_)) return total_;
    // A field may be small where no corner is, so the first cells are small.
    constexpr double kCellsOfField = 20'000, kMostCells = 300'000;  // a second, and 50 MB
    constexpr double kGoodEnough = 0.05, kNever = -1;
    if (has_field) {
      const auto smaller = [this](const Cell& a, const Cell& b) { return extent(a) < extent(b); };
      halve_first(smaller, kCellsOfField, kNever, deadline);
    }
    halve_first([](const Cell& a, const Cell& b) { return a.doubt < b.doubt; }, kMostCells, kGoodEnough, deadline);
    return total_;
  }

 private:
  struct Cell {
    std::array<Vec3, 3> corners;
    std::array<double, 3> sizes;
    std::int32_t area = 0;
    double triangles = 0, doubt = 0;
  };

  [[nodiscard]] double size_at(Vec3 p, std::int32_t area) const {
    return std::min(size_(p), areas_.areas[static_cast<std::size_t>(area)].size);
  }
  /// The area of a cell.
  [[nodiscard]] double extent(const Cell& cell) const {
    const auto [a, b, c] = cell.corners;
    const double extent = std::abs(surface_.extent(surface_.vertex(a), surface_.vertex(b), surface_.vertex(c)));
    const double radius = surface_.is_plane() ? 0 : surface_.space().radius();
    return surface_.is_plane() ? 0.5 * extent : extent * radius * radius;
  }

  [[nodiscard]] Cell cell_of(TriangleId t) const {
    Cell cell;
    cell.area = outline_.area[t];
    const auto corners = outline_.mesh.corners(t);
    for (std::size_t k = 0; k < 3; ++k) {
      cell.corners[k] = surface_.place(outline_.mesh.point(corners[k]));
      cell.sizes[k] = size_at(cell.corners[k], cell.area);
    }
    return cell;
  }

  /// Says whether the corners show that the size of a place is between two sizes: sizes change by at most the grade.
  [[nodiscard]] bool is_surely_between(const Cell& cell, Vec3 place, double least, double largest) const {
    constexpr double kRounding = 1 + 1e-9;
    if (size_.has_field()) return false;
    double low = 0, high = largest;
    for (std::size_t k = 0; k < 3; ++k) {
      const double change = kRounding * size_.grade() * length(place - cell.corners[k]);
      low = std::max(low, cell.sizes[k] - change);
      high = std::min(high, cell.sizes[k] + change);
    }
    return low >= kRounding * least && kRounding * high <= largest;
  }

  /// Between the least and the largest size s and l the integral of 1/size² is 1/(s l) per area if the size grows from
  /// a side, and less if it grows from a corner.
  void add(Cell cell) {
    const auto [a, b, c] = cell.corners;
    const Vec3 middle = surface_.below((1.0 / 3) * (a + b + c));
    auto [least, largest] = std::minmax({cell.sizes[0], cell.sizes[1], cell.sizes[2]});
    if (!is_surely_between(cell, middle, least, largest)) {
      const double size = size_at(middle, cell.area);
      least = std::min(least, size);
      largest = std::max(largest, size);
    }
    constexpr double kMuch = 1.5;
    cell.triangles = count_in(extent(cell), std::sqrt(least) * std::sqrt(largest));
    cell.doubt = largest > kMuch * least ? cell.triangles * std::min(1.0, std::log(largest / least)) : 0;
    total_ += cell.triangles;
    doubt_ += cell.doubt;
    cells_.push_back(cell);
  }

  /// Halves cells in an order, the greatest first, until there are `most`, or only a part `enough` is in doubt.
  template <class Order>
  void halve_first(const Order& order, double most, double enough, Deadline& deadline) {
    constexpr double kLeastCells = 1000;
    constexpr double kMuchLess = 0.1;  // of a sum: rounding counts in the difference
    std::make_heap(cells_.begin(), cells_.end(), order);
    double before = total_;
    const auto are_enough = [&] {
      return static_cast<double>(cells_.size()) > std::min(most, kLeastCells + per_triangle_ * total_);
    };
    constexpr int kAtATime = 16;  // halvings, before the deadline is asked
    for (int i = 1; !cells_.empty() && !are_enough() && doubt_ > enough * total_; ++i) {
      if (i % kAtATime == 0 && deadline.asked_to_stop()) break;
      std::pop_heap(cells_.begin(), cells_.end(), order);
      const Cell cell = cells_.back();
      cells_.pop_back();
      total_ -= cell.triangles;
      doubt_ -= cell.doubt;
      for (const Cell& half : halves(cell)) {
        add(half);
        std::push_heap(cells_.begin(), cells_.end(), order);
      }
      if (total_ < kMuchLess * before) before = sum_up();
    }
    sum_up();
  }
  double sum_up() {
    total_ = doubt_ = 0;
    for (const Cell& cell : cells_) total_ += cell.triangles, doubt_ += cell.doubt;
    return total_;
  }

  /// The halves of a cell, divided at the middle of its longest side.
  [[nodiscard]] std::array<Cell, 2> halves(const Cell& cell) const {
    std::size_t longest = 0;
    const auto side = [&](std::size_t k) { return squared_length(cell.corners[(k + 1) % 3] - cell.corners[k]); };
    for (const std::size_t k : {std::size_t{1}, std::size_t{2}}) {
      if (side(k) > side(longest)) longest = k;
    }
    const std::size_t next = (longest + 1) % 3;
    const Vec3 middle = surface_.below(0.5 * (cell.corners[longest] + cell.corners[next]));
    const double size = size_at(middle, cell.area);
    std::array<Cell, 2> result = {cell, cell};
    result[0].corners[longest] = result[1].corners[next] = middle;
    result[0].sizes[longest] = result[1].sizes[next] = size;
    return result;
  }

  const Surface& surface_;
  const Triangulated& outline_;
  const Areas& areas_;
  const GradedSize& size_;
  double per_triangle_;
  std::vector<Cell> cells_;
  double total_ = 0, doubt_ = 0;
};

}  // namespace

double count_in(double area, double size) {
  constexpr double kOfSquare = 0.4330127018922193;  // √3/4: the area of the triangle of edge 1
  return area / size / size / kOfSquare;            // the square of a tiny size would be 0
}

double count_triangles(const Triangulated& outline, const Areas& areas, const GradedSize& size, double per_triangle,
                       Deadline& deadline) {
  return Counter(outline, areas, size, per_triangle).run(size.has_field(), deadline);
}

double count_field(const Surface& surface, const Triangulated& outline, const WantedSize& wanted, Deadline& deadline) {
  const Mesh& mesh = wanted.field->mesh();
  double triangles = 0, area = 0, inside = 0;
  const auto area_of = [&](const Mesh& of, TriangleId t) {
    const auto [a, b, c] = of.corners(t);
    const Vec3 p = surface.place(of.point(a));
    return 0.5 * length(cross(surface.place(of.point(b)) - p, surface.place(of.point(c)) - p));
  };
  for (const TriangleId t : outline.mesh.triangles()) {
    if (outline.area[t] != kOutside) inside += area_of(outline.mesh, t);
  }
  TriangleId near(0);
  for (const TriangleId t : mesh.triangles()) {
    if (deadline.asked_to_stop()) break;
    const auto [a, b, c] = mesh.corners(t);
    const Vec3 middle =
        (1.0 / 3) * (surface.place(mesh.point(a)) + surface.place(mesh.point(b)) + surface.place(mesh.point(c)));
    const Location at = locate(outline.mesh, surface.vertex(surface.below(middle)), near);
    if (at.kind == Location::Kind::outside) continue;
    near = at.triangle;
    if (outline.area[at.triangle] == kOutside) continue;
    const double size = (wanted.field->at(a) + wanted.field->at(b) + wanted.field->at(c)) / 3;
    triangles += count_in(area_of(mesh, t), std::min(size, wanted.most));
    area += area_of(mesh, t);
  }
  return area > inside ? triangles * (inside / area) : triangles;
}

MeshEstimate estimate_of(double triangles) { return {triangles, kBytesOfProgram + kBytesPerTriangle * triangles}; }

double triangles_within(std::uint64_t bytes) {
  return std::max(0.0, (static_cast<double>(bytes) - kBytesOfProgram) / kBytesPerTriangle);
}

}  // namespace temper::mesher

namespace temper {

namespace {

// Beyond these numbers only the power of ten matters, and at the end not even that.
std::string power_text(double value) { return std::isfinite(value) ? rounded(value, 2) : "1e+300 or more"; }

}  // namespace

std::string MeshEstimate::triangles_text() const {
  if (triangles < 1e6) return std::to_string(std::llround(triangles));
  if (triangles < 1e9) return rounded(triangles / 1e6, 3) + " million";
  return triangles < 1e12 ? rounded(triangles / 1e9, 3) + " billion" : power_text(triangles);
}

std::string MeshEstimate::memory_text() const {
  constexpr std::array<const char*, 3> kUnits = {" MB", " GB", " TB"};
  double rest = bytes / 1e6;
  for (const char* unit : kUnits) {
    if (rest < 1e3) return rounded(rest, rest < 100 ? 2 : 3) + unit;
    rest /= 1e3;
  }
  return power_text(bytes) + " bytes";
}

}  // namespace temper
