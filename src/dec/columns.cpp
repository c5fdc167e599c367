// Columns: surfaces determine the cells; the faces seen from above determine the neighbors, layer by layer.
#include "temper/detail/columns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "base/text.hpp"

namespace temper {
namespace {

constexpr std::size_t kMostCells = (std::size_t{1} << 31) - 1;  // codes count them in 32 bits

/// "the top" or "bottom 2": names of surfaces as in the title line of a file.
std::string surface_name(std::size_t surface) { return surface == 0 ? "the top" : "bottom " + std::to_string(surface); }

class ColumnBuilder {
 public:
  ColumnBuilder(CellPolygons plan, const Layers& layers, const ColumnOptions& options)
      : layers_(layers), options_(options) {
    c_.plan = std::move(plan);
  }

  [[nodiscard]] std::optional<InputError> check(const DecComplex& complex) const;
  Columns build();

 private:
  [[nodiscard]] InputError error(ErrorCode code, std::size_t column, const std::string& message) const {
    const std::string where = is_of_vertices() ? names().point_where(column) : names().triangle_where(column);
    return {code, where, name(column) + ": " + message};
  }
  [[nodiscard]] bool is_of_vertices() const { return c_.plan.of == CellsOf::vertices; }
  [[nodiscard]] std::string name(std::size_t column) const {
    return is_of_vertices() ? names().point(column) : names().triangle(column);
  }
  [[nodiscard]] const InputNames& names() const { return options_.names != nullptr ? *options_.names : counting_; }
  [[nodiscard]] std::optional<InputError> check_sizes() const;
  [[nodiscard]] std::optional<InputError> check_edges(const DecComplex& complex) const;
  [[nodiscard]] std::optional<InputError> check_faces() const;
  [[nodiscard]] std::span<const double> surfaces(std::size_t column) const {
    return std::span(layers_.surfaces).subspan(column * layers_.n_surfaces(), layers_.n_surfaces());
  }
  void add_column(std::size_t column);
  [[nodiscard]] CellState state(std::size_t column, std::size_t layer) const;
  void connect_layer(std::size_t layer);
  void connect_down(std::size_t column, std::size_t layer);
  void connect_beside(const CellFace& face, std::size_t layer);

  const Layers& layers_;
  const ColumnOptions& options_;
  const InputNames counting_;
  Columns c_;
};

std::optional<InputError> ColumnBuilder::check_sizes() const {
  const auto error = [](ErrorCode code, const std::string& message) { return InputError{code, "", message}; };
  const std::size_t n = c_.n_columns(), layers = layers_.n_layers;
  const auto wrong = [&](const char* what, std::size_t expected, std::size_t found) {
    return error(ErrorCode::size_mismatch, std::string(what) + ": expected " + std::to_string(expected) + " numbers, " +
                                               "found " + std::to_string(found));
  };
  if (layers == 0) return error(ErrorCode::empty_input, "expected one layer or more, found none");
  if (n != 0 && layers > kMostCells / n) {
    return error(ErrorCode::unsupported, std::to_string(n) + (is_of_vertices() ? " vertices" : " triangles") + " in " +
                                             std::to_string(layers) + " layers are more than " +
                                             std::to_string(kMostCells) + " cells");
  }
  if (layers_.surfaces.size() != n * layers_.n_surfaces())
    return wrong("surfaces", n * layers_.n_surfaces(), layers_.surfaces.size());
  if (!layers_.active.empty() && layers_.active.size() != n * layers)
    return wrong("active", n * layers, layers_.active.size());
  if (!(options_.pinch_out >= 0) || !std::isfinite(options_.pinch_out))
    return error(ErrorCode::invalid_option,
                 "pinch_out: expected a length, 0 or more, found " + to_text(options_.pinch_out));
  return {};
}

/// Faces of power cells at an edge that is not regular are not at right angles to it.
std::optional<InputError> ColumnBuilder::check_edges(const DecComplex& complex) const {
  for (std::size_t e = 0; e < complex.edges.size(); ++e) {
    const DecEdge& edge = complex.edges[EdgeId(e)];
    if (edge.is_boundary() || complex.star1[EdgeId(e)] >= 0) continue;
    return error(ErrorCode::unsupported, edge.from.index,
                 "its edge to " + name(edge.to.index) +
                     " is not regular, so that faces of cells there are not at right angles to connections; "
                     "temper optimize makes meshes regular");
  }
  return {};
}

/// A flux between two centers is for a whole face: the face must be between them.
std::optional<InputError> ColumnBuilder::check_faces() const {
  for (const CellFace& face : c_.plan.faces) {
    for (const auto& [here, there, distance] : {std::tuple{face.first, face.second, face.first_distance},
                                                std::tuple{face.second, face.first, face.second_distance}}) {
      if (distance > 0) continue;
      if (is_of_vertices()) {
        return error(ErrorCode::unsupported, here,
                     "the face of its cell to that of " + name(there) +
                         " is behind it, not between the two; temper optimize makes meshes where it is");
      }
      return error(ErrorCode::unsupported, here,
                   "its orthocenter is not on its side of the edge to " + name(there) +
                       ", so that the edge is not between the two centers. Next: temper optimize --for cell");
    }
  }
  return {};
}

std::optional<InputError> ColumnBuilder::check(const DecComplex& complex) const {
  if (auto fault = check_sizes()) return fault;
  for (std::size_t i = 0; i < c_.n_columns(); ++i) {
    if (const auto fault = fault_of_surfaces(surfaces(i))) return error(ErrorCode::invalid_option, i, *fault);
  }
  if (is_of_vertices()) {
    if (auto fault = check_edges(complex)) return fault;
  }
  return check_faces();
}

CellState ColumnBuilder::state(std::size_t column, std::size_t layer) const {
  const double top = surfaces(column)[layer], bottom = surfaces(column)[layer + 1];
  const bool asked = layers_.active.empty() || layers_.active[column * layers_.n_layers + layer] != 0;
  if (!asked || std::isnan(top) || std::isnan(bottom) || !(c_.plan.areas[column] > 0)) return CellState::inactive;
  return top - bottom > options_.pinch_out ? CellState::active : CellState::pinched_out;
}

void ColumnBuilder::add_column(std::size_t column) {
  const auto given = surfaces(column);
  const auto first = std::find_if(given.begin(), given.end(), [](double z) { return !std::isnan(z); });
  double above = first == given.end() ? 0 : *first;
  for (std::size_t layer = 0; layer < layers_.n_layers; ++layer) {
    const std::size_t cell = c_.cell(column, layer);
    const double bottom = given[layer + 1];
    c_.tops[cell] = above;
    if (!std::isnan(bottom)) above = bottom;
    c_.bottoms[cell] = above;
    c_.states[cell] = state(column, layer);
    if (c_.is_active(cell)) c_.volumes[cell] = c_.plan.areas[column] * (c_.tops[cell] - c_.bottoms[cell]);
  }
}

void ColumnBuilder::connect_down(std::size_t column, std::size_t layer) {
  const std::size_t above = c_.cell(column, layer);
  if (!c_.is_active(above)) return;
  std::size_t below = above;
  do {
    below += c_.n_columns();
  } while (below < c_.n_cells() && c_.states[below] == CellState::pinched_out);
  if (below >= c_.n_cells() || !c_.is_active(below)) return;
  ColumnConnection& down = c_.connections.emplace_back();
  down.first = static_cast<std::uint32_t>(above);
  down.second = static_cast<std::uint32_t>(below);
  down.is_vertical = true;
  down.first_distance = 0.5 * (c_.tops[above] - c_.bottoms[above]);
  down.second_distance = 0.5 * (c_.tops[below] - c_.bottoms[below]);
  down.area = c_.plan.areas[column];
}

void ColumnBuilder::connect_beside(const CellFace& face, std::size_t layer) {
  const std::size_t a = c_.cell(face.first, layer), b = c_.cell(face.second, layer);
  if (!c_.is_active(a) || !c_.is_active(b)) return;
  ColumnConnection& beside = c_.connections.emplace_back();
  beside.first = static_cast<std::uint32_t>(a);
  beside.second = static_cast<std::uint32_t>(b);
  beside.first_distance = face.first_distance;
  beside.second_distance = face.second_distance;
  beside.width = face.width;
  const double share = face.first_distance / length(c_.plan.centers[face.second] - c_.plan.centers[face.first]);
  const double thickness = (1 - share) * (c_.tops[a] - c_.bottoms[a]) + share * (c_.tops[b] - c_.bottoms[b]);
  beside.area = face.width * thickness;
}

/// In ascending order: for each cell its neighbors in its layer, then the cell below.
void ColumnBuilder::connect_layer(std::size_t layer) {
  auto face = c_.plan.faces.begin();
  for (std::size_t i = 0; i < c_.n_columns(); ++i) {
    for (; face != c_.plan.faces.end() && face->first == i; ++face) connect_beside(*face, layer);
    connect_down(i, layer);
  }
}

Columns ColumnBuilder::build() {
  const std::size_t n = c_.n_columns() * layers_.n_layers;
  c_.n_layers = layers_.n_layers;
  c_.states.resize(n);
  c_.tops.resize(n);
  c_.bottoms.resize(n);
  c_.volumes.resize(n, 0.0);
  for (std::size_t i = 0; i < c_.n_columns(); ++i) add_column(i);
  for (std::size_t layer = 0; layer < layers_.n_layers; ++layer) connect_layer(layer);
  return std::move(c_);
}

}  // namespace

Layers layers_of_triangles(const Mesh& mesh, const Layers& at_vertices) {
  Layers layers = {at_vertices.n_layers, {}, {}};
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    const std::size_t n = at_vertices.n_surfaces();
    for (std::size_t i = 0; i < n; ++i) {
      const auto z = [&](VertexId v) { return at_vertices.surfaces[v.index * n + i]; };
      layers.surfaces.push_back((z(a) + z(b) + z(c)) / 3);
    }
    for (std::size_t i = 0; i < at_vertices.n_layers && !at_vertices.active.empty(); ++i) {
      const auto is_active = [&](VertexId v) { return at_vertices.active[v.index * at_vertices.n_layers + i]; };
      layers.active.push_back(is_active(a) != 0 && is_active(b) != 0 && is_active(c) != 0 ? 1 : 0);
    }
  }
  return layers;
}

std::optional<std::string> fault_of_surfaces(std::span<const double> surfaces) {
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::size_t above = kNone;  // the last existing one
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (std::isnan(surfaces[i])) continue;
    if (std::isinf(surfaces[i])) return surface_name(i) + " is infinite, expected a height";
    if (above != kNone && surfaces[i] > surfaces[above]) {
      return surface_name(i) + " is " + to_text(surfaces[i]) + ", higher than " + surface_name(above) + ", which is " +
             to_text(surfaces[above]);
    }
    above = i;
  }
  return {};
}

Expected<Columns> columns(const Mesh& mesh, const DecComplex& complex, CellPolygons plan, const Layers& layers,
                          const ColumnOptions& options) {
  if (auto error = expect_plane(mesh, "columns()")) return *std::move(error);
  ColumnBuilder builder(std::move(plan), layers, options);
  if (auto error = builder.check(complex)) return *std::move(error);
  Columns made = builder.build();
  if (std::none_of(made.states.begin(), made.states.end(), [](CellState s) { return s == CellState::active; }))
    return InputError{ErrorCode::empty_input, "", "no cell is active: all are inactive or pinched out"};
  return made;
}

}  // namespace temper
