#include "io/formats/raster.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "io/text/names.hpp"
#include "io/text/scanner.hpp"

namespace temper::io {
namespace {

constexpr std::size_t kMostPoints = 4'000'000;
constexpr double kTurn = 360, kPole = 90;

/// A column or row: its coordinate, and its index in the file.
struct Line {
  double at;
  std::size_t index;
};
using Lines = std::vector<Line>;

/// Ascending; of lines at one place the first. `turn`: longitudes move by whole turns to this one.
Lines ascending(const std::vector<double>& values, const std::optional<double>& turn, const std::string& path) {
  Lines lines;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) fail(ErrorCode::not_finite, path, "a column or row of the raster is at no number");
    lines.push_back({turn ? values[i] - kTurn * std::round((values[i] - *turn) / kTurn) : values[i], i});
  }
  std::stable_sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) { return a.at < b.at; });
  const auto same = [](const Line& a, const Line& b) { return a.at == b.at; };
  lines.erase(std::unique(lines.begin(), lines.end(), same), lines.end());
  return lines;
}

/// Keeps the lines between low and high, and two more on each side: if none is there, the nearest two.
void crop(Lines& lines, double low, double high) {
  constexpr std::ptrdiff_t kMore = 2;
  const auto before = [](const Line& line, double at) { return line.at < at; };
  const auto first = std::lower_bound(lines.begin(), lines.end(), low, before);
  const auto last = std::lower_bound(lines.begin(), lines.end(), high, before);
  const auto from = first - std::min(kMore, first - lines.begin()), to = last + std::min(kMore, lines.end() - last);
  lines = Lines(from, to);
}

class RasterMesh {
 public:
  RasterMesh(Raster raster, const Source& source)
      : raster_(std::move(raster)), source_(source), document_(new_document(source.path)) {}

  Document make() {
    choose_lines();
    thin();
    points();
    triangles();
    for (std::size_t k = 0; k < raster_.data.size(); ++k)
      document_.file.point_data.push_back({raster_.data[k].name, 1, std::move(values_[k])});
    if (raster_.degrees) document_.file.points_in = DegreePoints{};
    document_.names->points = RunLength(0, document_.file.points.size());
    document_.names->triangles = RunLength(0, document_.file.triangles.size());
    return std::move(document_);
  }

 private:
  static constexpr std::int32_t kNoPoint = -1;

  void choose_lines() {
    const std::string& path = source_.path;
    const auto& window = source_.window;
    std::optional<double> turn;
    if (window && raster_.degrees) turn = 0.5 * ((*window)[0].x + (*window)[1].x);
    columns_ = ascending(raster_.x, turn, path);
    rows_ = ascending(raster_.y, {}, path);
    if (window) {
      crop(columns_, (*window)[0].x, (*window)[1].x);
      crop(rows_, (*window)[0].y, (*window)[1].y);
    } else if (raster_.degrees && columns_.size() > 2) {
      const double span = columns_.back().at - columns_.front().at;
      const double step = span / static_cast<double>(columns_.size() - 1);
      if (std::abs(span - kTurn) < 0.5 * step) columns_.pop_back();  // the first column again
      is_closed_ = span > kTurn - 1.5 * step;
    }
    if (columns_.size() < 2 || rows_.size() < 2) {
      fail(ErrorCode::empty_input, path, "the raster has ", columns_.size(), " times ", rows_.size(),
           " points; expected two or more columns and rows");
    }
  }

  /// The number of lines that become one.
  void thin() {
    const auto n = static_cast<double>(columns_.size()) * static_cast<double>(rows_.size());
    block_ = static_cast<std::size_t>(std::ceil(std::sqrt(n / static_cast<double>(kMostPoints))));
    block_ = std::max<std::size_t>(block_, 1);
    if (block_ == 1) return;
    document_.file.warnings.push_back(text(source_.path, ": the raster has ", columns_.size(), " times ", rows_.size(),
                                           " points; means of ", block_, " times ", block_, " are used"));
  }

  [[nodiscard]] static std::size_t blocks(std::size_t lines, std::size_t block) { return (lines + block - 1) / block; }
  /// The mean coordinate of a block.
  [[nodiscard]] double place(const Lines& lines, std::size_t i) const {
    const std::size_t end = std::min(lines.size(), (i + 1) * block_);
    double sum = 0;
    for (std::size_t k = i * block_; k < end; ++k) sum += lines[k].at;
    return sum / static_cast<double>(end - i * block_);
  }
  /// The mean of the values of a block that are numbers, or NaN.
  [[nodiscard]] double value(const std::vector<double>& values, std::size_t column, std::size_t row) const {
    double sum = 0;
    std::size_t n = 0;
    for (std::size_t j = row * block_; j < std::min(rows_.size(), (row + 1) * block_); ++j) {
      for (std::size_t i = column * block_; i < std::min(columns_.size(), (column + 1) * block_); ++i) {
        const double one = values[rows_[j].index * raster_.x.size() + columns_[i].index];
        if (!std::isfinite(one)) continue;
        sum += one;
        ++n;
      }
    }
    return n == 0 ? std::numeric_limits<double>::quiet_NaN() : sum / static_cast<double>(n);
  }

  void points() {
    nx_ = blocks(columns_.size(), block_);
    ny_ = blocks(rows_.size(), block_);
    point_.assign(nx_ * ny_, kNoPoint);
    values_.resize(raster_.data.size());
    std::vector<double> here(raster_.data.size());
    for (std::size_t j = 0; j < ny_; ++j) {
      const double y = place(rows_, j);
      const bool pole = is_closed_ && std::abs(y) == kPole;
      for (std::size_t i = 0; i < nx_; ++i) {
        if (pole && i > 0) {
          point_[j * nx_ + i] = point_[j * nx_];
          continue;
        }
        for (std::size_t k = 0; k < here.size(); ++k)
          here[k] = value(std::get<std::vector<double>>(raster_.data[k].values), i, j);
        if (std::none_of(here.begin(), here.end(), [](double v) { return std::isfinite(v); })) continue;
        point_[j * nx_ + i] = static_cast<std::int32_t>(document_.file.points.size());
        document_.file.points.push_back({place(columns_, i), y});
        for (std::size_t k = 0; k < here.size(); ++k) values_[k].push_back(here[k]);
      }
    }
  }

  //   d --- c     Each cell has the triangles abc and acd; without one of its corners it has the other three.
  //   |   / |
  //   | /   |
  //   a --- b
  void triangles() {
    for (std::size_t j = 0; j + 1 < ny_; ++j) {
      for (std::size_t i = 0; i + (is_closed_ ? 0 : 1) < nx_; ++i) {
        const std::size_t right = (i + 1) % nx_;
        const std::int32_t a = point_[j * nx_ + i], b = point_[j * nx_ + right], c = point_[(j + 1) * nx_ + right],
                           d = point_[(j + 1) * nx_ + i];
        if (a == kNoPoint || c == kNoPoint) {
          triangle(a, b, d), triangle(b, c, d);
        } else {
          triangle(a, b, c), triangle(a, c, d);
        }
      }
    }
    if (document_.file.triangles.empty())
      fail(ErrorCode::empty_input, source_.path, "the raster has no three neighbors with values");
  }
  void triangle(std::int32_t a, std::int32_t b, std::int32_t c) {
    if (std::min({a, b, c}) == kNoPoint || a == b || b == c || c == a) return;  // equal at a pole
    document_.file.triangles.corners.push_back({a, b, c});
  }

  Raster raster_;
  const Source& source_;
  Document document_;
  Lines columns_, rows_;
  bool is_closed_ = false;
  std::size_t block_ = 1, nx_ = 0, ny_ = 0;
  std::vector<std::int32_t> point_;
  std::vector<std::vector<double>> values_;
};

// ESRI ASCII grid: a header of names and numbers, then rows from north to south.
//
//   ncols 4
//   nrows 3
//   xllcorner 0          or xllcenter: the corner, or the center, of the cell in the lower left
//   yllcorner 0          or yllcenter
//   cellsize 50          or dx and dy
//   NODATA_value -9999   may be left out
//   1 2 3 4 …

bool is_header_name(std::string_view name) {
  constexpr std::array<std::string_view, 10> kNames = {
      "ncols", "nrows", "xllcorner", "yllcorner", "xllcenter", "yllcenter", "cellsize", "dx", "dy", "nodata_value"};
  return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

class EsriReader {
 public:
  explicit EsriReader(Source& source) : source_(source), scanner_(source.path, source.bytes) {}

  Raster read() {
    while (!scanner_.at_end() && !looks_like_number(scanner_.peek())) header();
    const std::size_t columns = size("ncols"), rows = size("nrows");
    scanner_.check_room(std::uint64_t{columns} * rows, "values", 2);
    Raster raster;
    raster.degrees = source_.raster_in_degrees;
    raster.x = places("x", columns);
    raster.y = places("y", rows);
    std::reverse(raster.y.begin(), raster.y.end());  // the first row is the northernmost
    const auto given = numbers_.find("nodata_value");
    const double missing = given != numbers_.end() ? given->second : -9999;
    std::vector<double> values;
    values.reserve(columns * rows);
    for (std::size_t i = 0; i < columns * rows; ++i) {
      const double value = scanner_.real("a value of the grid");
      values.push_back(value == missing ? std::numeric_limits<double>::quiet_NaN() : value);
    }
    if (!scanner_.at_end())
      scanner_.fail_here(ErrorCode::size_mismatch, "expected the end of the file after ", rows, " rows of ", columns,
                         " values");
    raster.data.push_back({"value", 1, std::move(values)});
    return raster;
  }

 private:
  void header() {
    const std::string name = lower_case(scanner_.word("a name"));
    if (!is_header_name(name))
      scanner_.fail_here(ErrorCode::syntax, "expected a name of the header of an ESRI ASCII grid, found ",
                         in_quotes(name));
    numbers_[name] = scanner_.real("a number");
  }

  [[nodiscard]] double number(const std::string& name) const {
    const auto found = numbers_.find(name);
    if (found == numbers_.end()) fail(ErrorCode::syntax, source_.path, "the header has no ", name);
    return found->second;
  }

  [[nodiscard]] std::size_t size(const std::string& name) const {
    const double n = number(name);
    if (!(n >= 1 && n == std::floor(n) && n <= 1e9))
      fail(ErrorCode::syntax, source_.path, "expected a whole number as ", name, ", found ", n);
    return static_cast<std::size_t>(n);
  }

  /// Centers of cells along an axis.
  [[nodiscard]] std::vector<double> places(const std::string& axis, std::size_t n) const {
    const double cell = number(numbers_.contains("cellsize") ? "cellsize" : "d" + axis);
    if (!(cell > 0 && std::isfinite(cell)))
      fail(ErrorCode::syntax, source_.path, "expected cells of a size above 0, found ", cell);
    const bool centered = numbers_.contains(axis + "llcenter");
    const double first = centered ? number(axis + "llcenter") : number(axis + "llcorner") + 0.5 * cell;
    std::vector<double> at(n);
    for (std::size_t i = 0; i < n; ++i) at[i] = first + static_cast<double>(i) * cell;
    return at;
  }

  Source& source_;
  Scanner scanner_;
  std::map<std::string, double> numbers_;
};

}  // namespace

Document mesh_of_raster(Raster raster, const Source& source) { return RasterMesh(std::move(raster), source).make(); }

bool sniff_esri_ascii(std::string_view head) {
  Scanner scanner("", head);
  return !scanner.at_end() && is_header_name(lower_case(scanner.peek()));
}

Document read_esri_ascii(Source& source) { return mesh_of_raster(EsriReader(source).read(), source); }

}  // namespace temper::io
