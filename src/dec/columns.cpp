// Columns: surfaces determine the cells; the faces of the power cells determine the neighbors, layer by layer.
#include "temper/detail/columns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.hpp"
#include "dec/accurate.hpp"

namespace temper {
namespace {

constexpr std::size_t kMostCells = (std::size_t{1} << 31) - 1;  // codes count them in 32 bits

/// "the top" or "bottom 2": names of surfaces as in the title line of a file.
std::string surface_name(std::size_t surface) { return surface == 0 ? "the top" : "bottom " + std::to_string(surface); }

class ColumnBuilder {
 public:
  ColumnBuilder(const Mesh& mesh, const PowerCells& cells, const Layers& layers, const ColumnOptions& options)
      : mesh_(mesh), cells_(cells), layers_(layers), options_(options) {}

  [[nodiscard]] std::optional<InputError> check(const DecComplex& complex) const;
  Columns build();
  [[nodiscard]] InputError error(ErrorCode code, VertexId v, const std::string& message) const {
    return {code, names().point_where(v.index), names().point(v.index) + ": " + message};
  }

 private:
  [[nodiscard]] const InputNames& names() const { return options_.names != nullptr ? *options_.names : counting_; }
  [[nodiscard]] std::optional<InputError> check_sizes() const;
  [[nodiscard]] std::optional<InputError> check_faces(const DecComplex& complex) const;
  [[nodiscard]] std::span<const double> surfaces(VertexId v) const {
    return std::span(layers_.surfaces).subspan(v.index * layers_.n_surfaces(), layers_.n_surfaces());
  }
  void add_column(VertexId v);
  [[nodiscard]] CellState state(VertexId v, std::size_t layer) const;
  void connect_layer(std::size_t layer);
  void connect_down(VertexId v, std::size_t layer);
  void connect_beside(const PowerFace& face, std::size_t layer);

  const Mesh& mesh_;
  const PowerCells& cells_;
  const Layers& layers_;
  const ColumnOptions& options_;
  const InputNames counting_;
  Columns c_;
};

std::optional<InputError> ColumnBuilder::check_sizes() const {
  const auto error = [](ErrorCode code, const std::string& message) { return InputError{code, "", message}; };
  const std::size_t n = mesh_.n_vertices(), layers = layers_.n_layers;
  const auto wrong = [&](const char* what, std::size_t expected, std::size_t found) {
    return error(ErrorCode::size_mismatch, std::string(what) + ": expected " + std::to_string(expected) + " numbers, " +
                                               "found " + std::to_string(found));
  };
  if (layers == 0) return error(ErrorCode::empty_input, "expected one layer or more, found none");
  if (n != 0 && layers > kMostCells / n) {
    return error(ErrorCode::unsupported, std::to_string(n) + " vertices in " + std::to_string(layers) +
                                             " layers are more than " + std::to_string(kMostCells) + " cells");
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

/// A flux between two vertices is for a whole face: the face must be between them, at a right angle.
std::optional<InputError> ColumnBuilder::check_faces(const DecComplex& complex) const {
  for (std::size_t e = 0; e < complex.edges.size(); ++e) {
    const DecEdge& edge = complex.edges[EdgeId(e)];
    if (edge.is_boundary() || complex.star1[EdgeId(e)] >= 0) continue;
    return error(ErrorCode::unsupported, edge.from,
                 "its edge to " + names().point(edge.to.index) +
                     " is not regular, so that faces of cells there are not at right angles to connections; "
                     "temper optimize makes meshes regular");
  }
  for (const PowerFace& face : cells_.faces) {
    for (const auto& [here, there] : {std::pair{face.first, face.second}, std::pair{face.second, face.first}}) {
      if (accurate::doubled_crossing(mesh_.point(here), mesh_.point(there)) > 0) continue;
      return error(ErrorCode::unsupported, here,
                   "the face of its cell to that of " + names().point(there.index) +
                       " is behind it, not between the two; temper optimize makes meshes where it is");
    }
  }
  return {};
}

std::optional<InputError> ColumnBuilder::check(const DecComplex& complex) const {
  if (auto fault = check_sizes()) return fault;
  for (const VertexId v : mesh_.vertices()) {
    if (const auto fault = fault_of_surfaces(surfaces(v))) return error(ErrorCode::invalid_option, v, *fault);
  }
  return check_faces(complex);
}

CellState ColumnBuilder::state(VertexId v, std::size_t layer) const {
  const double top = surfaces(v)[layer], bottom = surfaces(v)[layer + 1];
  const bool asked = layers_.active.empty() || layers_.active[v.index * layers_.n_layers + layer] != 0;
  if (!asked || std::isnan(top) || std::isnan(bottom) || !(c_.areas[v] > 0)) return CellState::inactive;
  return top - bottom > options_.pinch_out ? CellState::active : CellState::pinched_out;
}

void ColumnBuilder::add_column(VertexId v) {
  const auto given = surfaces(v);
  const auto first = std::find_if(given.begin(), given.end(), [](double z) { return !std::isnan(z); });
  double above = first == given.end() ? 0 : *first;
  for (std::size_t layer = 0; layer < layers_.n_layers; ++layer) {
    const std::size_t cell = c_.cell(v, layer);
    const double bottom = given[layer + 1];
    c_.tops[cell] = above;
    if (!std::isnan(bottom)) above = bottom;
    c_.bottoms[cell] = above;
    c_.states[cell] = state(v, layer);
    if (c_.is_active(cell)) c_.volumes[cell] = c_.areas[v] * (c_.tops[cell] - c_.bottoms[cell]);
  }
}

void ColumnBuilder::connect_down(VertexId v, std::size_t layer) {
  const std::size_t above = c_.cell(v, layer);
  if (!c_.is_active(above)) return;
  std::size_t below = above;
  do {
    below += c_.n_vertices;
  } while (below < c_.n_cells() && c_.states[below] == CellState::pinched_out);
  if (below >= c_.n_cells() || !c_.is_active(below)) return;
  ColumnConnection& down = c_.connections.emplace_back();
  down.first = static_cast<std::uint32_t>(above);
  down.second = static_cast<std::uint32_t>(below);
  down.is_vertical = true;
  down.first_distance = 0.5 * (c_.tops[above] - c_.bottoms[above]);
  down.second_distance = 0.5 * (c_.tops[below] - c_.bottoms[below]);
  down.area = c_.areas[v];
}

void ColumnBuilder::connect_beside(const PowerFace& face, std::size_t layer) {
  const std::size_t a = c_.cell(face.first, layer), b = c_.cell(face.second, layer);
  if (!c_.is_active(a) || !c_.is_active(b)) return;
  const WeightedPoint p = mesh_.point(face.first), q = mesh_.point(face.second);
  const double between = length(q.position() - p.position());
  ColumnConnection& beside = c_.connections.emplace_back();
  beside.first = static_cast<std::uint32_t>(a);
  beside.second = static_cast<std::uint32_t>(b);
  beside.first_distance = 0.5 * accurate::doubled_crossing(p, q) / between;
  beside.second_distance = 0.5 * accurate::doubled_crossing(q, p) / between;
  beside.width = face.width;
  const double share = beside.first_distance / between;
  const double thickness = (1 - share) * (c_.tops[a] - c_.bottoms[a]) + share * (c_.tops[b] - c_.bottoms[b]);
  beside.area = face.width * thickness;
}

/// In ascending order: for each cell its neighbors in its layer, then the cell below.
void ColumnBuilder::connect_layer(std::size_t layer) {
  auto face = cells_.faces.begin();
  for (const VertexId v : mesh_.vertices()) {
    for (; face != cells_.faces.end() && face->first == v; ++face) connect_beside(*face, layer);
    connect_down(v, layer);
  }
}

Columns ColumnBuilder::build() {
  const std::size_t n = mesh_.n_vertices() * layers_.n_layers;
  c_.n_vertices = mesh_.n_vertices();
  c_.n_layers = layers_.n_layers;
  c_.areas = cells_.areas;
  c_.states.resize(n);
  c_.tops.resize(n);
  c_.bottoms.resize(n);
  c_.volumes.resize(n, 0.0);
  for (const VertexId v : mesh_.vertices()) add_column(v);
  for (std::size_t layer = 0; layer < layers_.n_layers; ++layer) connect_layer(layer);
  return std::move(c_);
}

}  // namespace

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

Expected<Columns> columns(const Mesh& mesh, const DecComplex& complex, const PowerCells& cells, const Layers& layers,
                          const ColumnOptions& options) {
  if (auto error = expect_plane(mesh, "columns()")) return *std::move(error);
  ColumnBuilder builder(mesh, cells, layers, options);
  if (auto error = builder.check(complex)) return *std::move(error);
  Columns made = builder.build();
  if (std::none_of(made.states.begin(), made.states.end(), [](CellState s) { return s == CellState::active; }))
    return InputError{ErrorCode::empty_input, "", "no cell is active: all are inactive or pinched out"};
  return made;
}

}  // namespace temper
