// Discretizations of MODFLOW 6. From DISV it computes connections itself, by the common corners of cells. DISU has
// explicit connections. (Langevin et al.: Documentation for the MODFLOW 6 groundwater flow model, USGS Techniques and
// Methods 6-A55; its input guide, mf6io.)
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "io/operators/dec_files.hpp"

namespace temper::io {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

/// The first cell that is not one polygon.
std::optional<std::size_t> not_one_polygon(const CellPolygons& plan) {
  std::vector<std::size_t> counts(plan.n_cells(), 0);
  for (const std::uint32_t cell : plan.cells) ++counts[cell];
  const auto found = std::ranges::find_if(counts, [](std::size_t n) { return n != 1; });
  if (found == counts.end()) return {};
  return static_cast<std::size_t>(found - counts.begin());
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

void put_vertices(Output& out, const CellPolygons& plan) {
  out.put("BEGIN VERTICES\n");
  for (std::size_t i = 0; i < plan.points.size(); ++i)
    out.put("  ", i + 1, ' ', plan.points[i].x, ' ', plan.points[i].y, '\n');
  out.put("END VERTICES\n");
}

/// One row for each of n cells, of all layers or of one. MODFLOW has corners clockwise.
void put_cells(Output& out, const Columns& c, std::size_t n) {
  out.put("BEGIN CELL2D\n");
  for (std::size_t cell = 0; cell < n; ++cell) {
    const auto polygon = c.plan.polygon(c.column(cell));  // each cell has one
    const Vec2 center = c.plan.centers[c.column(cell)];
    out.put("  ", cell + 1, ' ', center.x, ' ', center.y, ' ', polygon.size());
    for (std::size_t i = polygon.size(); i-- > 0;) out.put(' ', polygon[i] + 1);
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

void put_connections(Output& out, const Columns& c, const ConnectionRows& rows) {
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
    const Vec2 along = c.plan.centers[c.column(row == k.first ? k.second : k.first)] - c.plan.centers[c.column(row)];
    const double angle = kDegrees * std::atan2(along.y, along.x);
    return angle < 0 ? angle + 360 : angle;
  });
  out.put("END CONNECTIONDATA\n");
}

constexpr std::string_view kOptions = "BEGIN OPTIONS\nEND OPTIONS\nBEGIN DIMENSIONS\n";

/// The first line of a file: what its cells are, with a sentence for each kind of them.
void put_title(Output& out, const Columns& c, std::string_view of_vertices, std::string_view of_triangles) {
  const bool power = c.plan.of == CellsOf::vertices;
  out.put(power ? "# Power cells under layers. " : "# Triangles under layers, with orthocenters as centers. ",
          power ? of_vertices : of_triangles, '\n');
}

}  // namespace

void write_columns_disv(const DecJob& job) {
  const Columns& c = *job.options.columns;
  if (const auto cell = not_one_polygon(c.plan)) {
    const InputNames counting;
    const InputNames& names = job.options.names != nullptr ? *job.options.names : counting;
    fail(ErrorCode::unsupported, "", "the power cell of ", names.point(*cell),
         " in the domain is not one polygon, which DISV needs. Next: write DISU");
  }
  const std::size_t n = c.n_columns();
  Output& out = job.open("mesh.disv");
  put_title(out, c, "Cell n is that of the n-th vertex.", "Cell n is the n-th triangle.");
  out.put(kOptions, "  NLAY ", c.n_layers, "\n  NCPL ", n, "\n  NVERT ", c.plan.points.size(),
          "\nEND DIMENSIONS\nBEGIN GRIDDATA\n");
  put_array(out, "TOP", n, [&](std::size_t i) { return c.tops[i]; });
  out.put("  BOTM LAYERED\n");
  for (std::size_t layer = 0; layer < c.n_layers; ++layer)
    put_array(out, n, [&](std::size_t i) { return c.bottoms[c.cell(i, layer)]; });
  out.put("  IDOMAIN LAYERED\n");
  for (std::size_t layer = 0; layer < c.n_layers; ++layer)
    put_array(out, n, [&](std::size_t i) { return idomain(c.states[c.cell(i, layer)]); });
  out.put("END GRIDDATA\n");
  put_vertices(out, c.plan);
  put_cells(out, c, n);
  write_groups(job, "mesh.disv.csv", [&c](std::size_t cell) { return text(c.column(cell) + 1); });
  write_barriers(job, "mesh.disv.hfb",
                 [&c](std::size_t cell) { return text(c.layer(cell) + 1, " ", c.column(cell) + 1); });
}

void write_columns_disu(const DecJob& job) {
  const Columns& c = *job.options.columns;
  const bool has_polygons = !not_one_polygon(c.plan);
  const ConnectionRows rows(c);
  Output& out = job.open("mesh.disu");
  put_title(out, c, "Node n of a layer's is that of the n-th vertex; layers follow each other.",
            "Node n of a layer's is the n-th triangle; layers follow each other.");
  out.put(kOptions, "  NODES ", c.n_cells(), "\n  NJA ", rows.cells.size(), '\n');
  if (has_polygons) out.put("  NVERT ", c.plan.points.size(), '\n');
  out.put("END DIMENSIONS\nBEGIN GRIDDATA\n");
  put_array(out, "TOP", c.n_cells(), [&](std::size_t i) { return c.tops[i]; });
  put_array(out, "BOT", c.n_cells(), [&](std::size_t i) { return c.bottoms[i]; });
  put_array(out, "AREA", c.n_cells(), [&](std::size_t i) { return c.plan.areas[c.column(i)]; });
  put_array(out, "IDOMAIN", c.n_cells(), [&](std::size_t i) { return c.is_active(i) ? 1 : 0; });
  out.put("END GRIDDATA\n");
  put_connections(out, c, rows);
  write_groups(job, "mesh.disu.csv", [](std::size_t cell) { return text(cell + 1); });
  write_barriers(job, "mesh.disu.hfb", [](std::size_t cell) { return text(cell + 1); });
  if (!has_polygons) return;
  put_vertices(out, c.plan);
  put_cells(out, c, c.n_cells());
}

}  // namespace temper::io
