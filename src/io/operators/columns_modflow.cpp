// Discretizations of MODFLOW 6. From DISV it computes connections itself, by the common corners of cells. DISU has
// explicit connections. (Langevin et al.: Documentation for the MODFLOW 6 groundwater flow model, USGS Techniques and
// Methods 6-A55; its input guide, mf6io.)
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "io/operators/dec_files.hpp"

namespace temper::io {
namespace {

// Coinciding corners differ by the rounding in different cells. Relative to a cell's size, and to its coordinates: some
// units in the last place.
constexpr double kSameCorner = 1e-9, kRounding = 0x1p-48;
constexpr double kDegrees = 180 / std::numbers::pi;

/// Corners of cells, each once, and for each vertex its polygon, clockwise for MODFLOW.
struct SharedCorners {
  std::vector<Vec2> corners;
  std::vector<std::vector<std::uint32_t>> polygons;
};

/// Numbers corners in their order; a corner near an earlier one is merged with it.
class CornerNumbers {
 public:
  /// `reach`: an upper bound of `near` in all calls of add().
  explicit CornerNumbers(double reach) : step_(4 * reach) {}
  std::uint32_t add(Vec2 at, double near) {
    const auto x = square(at.x), y = square(at.y);
    for (std::int64_t i = x - 1; i <= x + 1; ++i) {
      for (std::int64_t j = y - 1; j <= y + 1; ++j) {
        const auto [first, last] = squares_.equal_range(key(i, j));
        for (auto known = first; known != last; ++known) {
          if (length(corners[known->second] - at) <= near) return known->second;
        }
      }
    }
    const auto added = static_cast<std::uint32_t>(corners.size());
    squares_.emplace(key(x, y), added);
    corners.push_back(at);
    return added;
  }
  std::vector<Vec2> corners;

 private:
  [[nodiscard]] std::int64_t square(double x) const { return static_cast<std::int64_t>(std::floor(x / step_)); }
  /// Different squares may have one key: distances decide.
  [[nodiscard]] static std::uint64_t key(std::int64_t i, std::int64_t j) {
    return static_cast<std::uint64_t>(i) * 0x9e3779b97f4a7c15u + static_cast<std::uint64_t>(j);
  }
  double step_;
  std::unordered_multimap<std::uint64_t, std::uint32_t> squares_;
};

double reach_of(const PowerCells& cells, std::size_t polygon) {
  const auto first = cells.starts[polygon], last = cells.starts[polygon + 1];
  double size = 0, far = 0;
  for (std::size_t i = first; i < last; ++i) {
    size = std::max(size, length(cells.corners[i] - cells.corners[first]));
    far = std::max(far, length(cells.corners[i]));
  }
  return std::max(kSameCorner * size, kRounding * far);
}

SharedCorners share_corners(const PowerCells& cells, std::size_t n_vertices) {
  double reach = 0;
  for (std::size_t p = 0; p < cells.n_polygons(); ++p) reach = std::max(reach, reach_of(cells, p));
  CornerNumbers numbers(reach);
  SharedCorners shared;
  shared.polygons.resize(n_vertices);
  for (std::size_t p = 0; p < cells.n_polygons(); ++p) {
    const double near = reach_of(cells, p);
    auto& polygon = shared.polygons[cells.vertices[p].index];
    for (std::size_t i = cells.starts[p + 1]; i-- > cells.starts[p];) {
      const std::uint32_t corner = numbers.add(cells.corners[i], near);
      if (polygon.empty() || polygon.back() != corner) polygon.push_back(corner);
    }
    while (polygon.size() > 1 && polygon.front() == polygon.back()) polygon.pop_back();
  }
  shared.corners = std::move(numbers.corners);
  return shared;
}

/// The first vertex whose power cell is not one polygon.
std::optional<VertexId> not_one_polygon(const PowerCells& cells) {
  IdVector<VertexId, std::size_t> counts(cells.areas.size(), 0);
  for (const VertexId v : cells.vertices) ++counts[v];
  for (std::size_t v = 0; v < counts.size(); ++v) {
    if (counts[VertexId(v)] != 1) return VertexId(v);
  }
  return {};
}

/// An array of the file, ten numbers per line.
template <class F>
void put_array(Output& out, std::size_t n, F value) {
  constexpr std::size_t kInLine = 10;
  out.put("    INTERNAL FACTOR 1\n");
  for (std::size_t i = 0; i < n; ++i)
    out.put(i % kInLine == 0 ? "     " : "", ' ', value(i), (i + 1) % kInLine == 0 || i + 1 == n ? "\n" : "");
}

template <class F>
void put_array(Output& out, std::string_view name, std::size_t n, F value) {
  out.put("  ", name, '\n');
  put_array(out, n, value);
}

void put_vertices(Output& out, const SharedCorners& shared) {
  out.put("BEGIN VERTICES\n");
  for (std::size_t i = 0; i < shared.corners.size(); ++i)
    out.put("  ", i + 1, ' ', shared.corners[i].x, ' ', shared.corners[i].y, '\n');
  out.put("END VERTICES\n");
}

/// One row for each of n cells, of all layers or of one.
void put_cells(Output& out, const Mesh& mesh, const Columns& c, const SharedCorners& shared, std::size_t n) {
  out.put("BEGIN CELL2D\n");
  for (std::size_t cell = 0; cell < n; ++cell) {
    const VertexId v = c.vertex(cell);
    const auto& polygon = shared.polygons[v.index];
    out.put("  ", cell + 1, ' ', mesh.position(v).x, ' ', mesh.position(v).y, ' ', polygon.size());
    for (const std::uint32_t corner : polygon) out.put(' ', corner + 1);
    out.put('\n');
  }
  out.put("END CELL2D\n");
}

int idomain(CellState state) { return static_cast<int>(state); }

/// Connections in rows: for each cell itself, then its neighbors, ascending.
struct ConnectionRows {
  std::vector<std::size_t> starts;   // cells + 1
  std::vector<std::uint32_t> cells;  // one an entry
  std::vector<std::uint32_t> connections;

  explicit ConnectionRows(const Columns& c) : starts(c.n_cells() + 1, 0) {
    for (const ColumnConnection& connection : c.connections) {
      ++starts[connection.first + 1];
      ++starts[connection.second + 1];
    }
    for (std::size_t i = 0; i < c.n_cells(); ++i) starts[i + 1] += starts[i] + 1;
    cells.resize(starts.back());
    connections.resize(starts.back());
    std::vector<std::size_t> next(starts.begin(), starts.end() - 1);
    for (std::size_t i = 0; i < c.n_cells(); ++i) cells[next[i]++] = static_cast<std::uint32_t>(i);
    const auto add = [&](std::uint32_t to, std::uint32_t neighbor, std::size_t connection) {
      cells[next[to]] = neighbor;
      connections[next[to]++] = static_cast<std::uint32_t>(connection);
    };
    // Ascending in this order: for each cell first all lower neighbors, then all higher ones.
    for (std::size_t i = 0; i < c.connections.size(); ++i) add(c.connections[i].second, c.connections[i].first, i);
    for (std::size_t i = 0; i < c.connections.size(); ++i) add(c.connections[i].first, c.connections[i].second, i);
  }
};

/// The entries of a row for DISU. `of` is not called for the cell itself.
template <class F>
void put_connection_array(Output& out, std::string_view name, const Columns& c, const ConnectionRows& rows, F of) {
  std::size_t row = 0;
  put_array(out, name, rows.cells.size(), [&](std::size_t entry) {
    while (entry >= rows.starts[row + 1]) ++row;
    using Value = decltype(of(row, c.connections.front()));
    return entry == rows.starts[row] ? Value{} : of(row, c.connections[rows.connections[entry]]);
  });
}

void put_connections(Output& out, const Mesh& mesh, const Columns& c, const ConnectionRows& rows) {
  out.put("BEGIN CONNECTIONDATA\n");
  put_array(out, "IAC", c.n_cells(), [&](std::size_t i) { return rows.starts[i + 1] - rows.starts[i]; });
  put_array(out, "JA", rows.cells.size(), [&](std::size_t i) { return rows.cells[i] + 1; });
  put_connection_array(out, "IHC", c, rows,
                       [](std::size_t, const ColumnConnection& k) { return k.is_vertical ? 0 : 1; });
  put_connection_array(out, "CL12", c, rows, [](std::size_t row, const ColumnConnection& k) {
    return row == k.first ? k.first_distance : k.second_distance;
  });
  put_connection_array(out, "HWVA", c, rows,
                       [](std::size_t, const ColumnConnection& k) { return k.is_vertical ? k.area : k.width; });
  put_connection_array(out, "ANGLDEGX", c, rows, [&](std::size_t row, const ColumnConnection& k) {
    if (k.is_vertical) return 0.0;
    const Vec2 along = mesh.position(c.vertex(row == k.first ? k.second : k.first)) - mesh.position(c.vertex(row));
    const double angle = kDegrees * std::atan2(along.y, along.x);
    return angle < 0 ? angle + 360 : angle;
  });
  out.put("END CONNECTIONDATA\n");
}

constexpr std::string_view kOptions = "BEGIN OPTIONS\nEND OPTIONS\nBEGIN DIMENSIONS\n";

}  // namespace

void write_columns_disv(const DecJob& job) {
  const Columns& c = *job.options.columns;
  if (const auto v = not_one_polygon(job.cells)) {
    const InputNames counting;
    const InputNames& names = job.options.names != nullptr ? *job.options.names : counting;
    fail(ErrorCode::unsupported, "", "the power cell of ", names.point(v->index),
         " in the domain is not one polygon, which DISV needs. Next: write DISU");
  }
  const SharedCorners shared = share_corners(job.cells, c.n_vertices);
  Output& out = job.open("mesh.disv");
  out.put("# Power cells under layers. Cell n is that of the n-th vertex.\n", kOptions);
  out.put("  NLAY ", c.n_layers, "\n  NCPL ", c.n_vertices, "\n  NVERT ", shared.corners.size(),
          "\nEND DIMENSIONS\nBEGIN GRIDDATA\n");
  put_array(out, "TOP", c.n_vertices, [&](std::size_t i) { return c.tops[i]; });
  out.put("  BOTM LAYERED\n");
  for (std::size_t layer = 0; layer < c.n_layers; ++layer)
    put_array(out, c.n_vertices, [&](std::size_t i) { return c.bottoms[layer * c.n_vertices + i]; });
  out.put("  IDOMAIN LAYERED\n");
  for (std::size_t layer = 0; layer < c.n_layers; ++layer)
    put_array(out, c.n_vertices, [&](std::size_t i) { return idomain(c.states[layer * c.n_vertices + i]); });
  out.put("END GRIDDATA\n");
  put_vertices(out, shared);
  put_cells(out, job.mesh, c, shared, c.n_vertices);
  write_groups(job, "mesh.disv.csv", [&c](std::size_t cell) { return text(c.vertex(cell).index + 1); });
}

void write_columns_disu(const DecJob& job) {
  const Columns& c = *job.options.columns;
  const bool has_polygons = !not_one_polygon(job.cells);
  const SharedCorners shared = has_polygons ? share_corners(job.cells, c.n_vertices) : SharedCorners();
  const ConnectionRows rows(c);
  Output& out = job.open("mesh.disu");
  out.put("# Power cells under layers. Node n of a layer's is that of the n-th vertex; layers follow each other.\n",
          kOptions);
  out.put("  NODES ", c.n_cells(), "\n  NJA ", rows.cells.size(), '\n');
  if (has_polygons) out.put("  NVERT ", shared.corners.size(), '\n');
  out.put("END DIMENSIONS\nBEGIN GRIDDATA\n");
  put_array(out, "TOP", c.n_cells(), [&](std::size_t i) { return c.tops[i]; });
  put_array(out, "BOT", c.n_cells(), [&](std::size_t i) { return c.bottoms[i]; });
  put_array(out, "AREA", c.n_cells(), [&](std::size_t i) { return c.areas[c.vertex(i)]; });
  put_array(out, "IDOMAIN", c.n_cells(), [&](std::size_t i) { return c.is_active(i) ? 1 : 0; });
  out.put("END GRIDDATA\n");
  put_connections(out, job.mesh, c, rows);
  write_groups(job, "mesh.disu.csv", [](std::size_t cell) { return text(cell + 1); });
  if (!has_polygons) return;
  put_vertices(out, shared);
  put_cells(out, job.mesh, c, shared, c.n_cells());
}

}  // namespace temper::io
