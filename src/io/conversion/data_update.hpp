// Data of points and cells that follow a changed mesh: once for triangles and tetrahedra.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "io/conversion/follow.hpp"
#include "io/conversion/known_arrays.hpp"
#include "io/conversion/quadrilaterals.hpp"
#include "io/text/failure.hpp"
#include "io/text/values.hpp"
#include "temper/detail/location.hpp"
#include "temper/detail/transfer.hpp"
#include "temper/io.hpp"

namespace temper::io {

/// The former point of each vertex in a file, invalid for a new vertex; empty: equal numbers.
using Former = IdVector<VertexId, VertexId>;

/// Says whether an array flags special points of the user's: a new point has none.
[[nodiscard]] bool is_flag(const DataArray& a);
/// The points that a file calls required: they must not move.
[[nodiscard]] std::vector<std::int32_t> required_points(const std::vector<DataArray>& point_data);

/// Linear between the corners that have a value (not NaN), if these have at least half of the shares; else NaN. So a
/// missing value stays missing, but spreads no farther than half-way to the next corners.
template <class AtPlace, class AtCorner>
double between_known(const AtPlace& place, const AtCorner& at_corner) {
  AtPlace known = place;
  known.n = 0;
  double sum = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(place.n); ++k) {
    if (std::isnan(at_corner(place.corners[k]))) continue;
    const auto to = static_cast<std::size_t>(known.n++);
    known.corners[to] = place.corners[k];
    known.shares[to] = place.shares[k];
    sum += place.shares[k];
  }
  if (known.n == 0 || (known.n < place.n && sum < 0.5)) return std::numeric_limits<double>::quiet_NaN();
  if (known.n < place.n) std::ranges::for_each(known.shares, [sum](double& share) { share /= sum; });
  return interpolated(known, [&](VertexId v) { return double{at_corner(v)}; });
}

/// The value at a place: the linear interpolation of floating numbers; the common value of integers at all corners, if
/// any.
template <class T, class AtPlace>
std::optional<T> value_at(const std::vector<T>& values, std::size_t n, std::size_t component, const AtPlace& place) {
  const auto at_corner = [&](VertexId v) { return values[n * v.index + component]; };
  if constexpr (std::is_floating_point_v<T>) {
    return static_cast<T>(between_known(place, at_corner));
  } else {
    const T first = at_corner(place.corners[0]);
    for (std::size_t k = 1; k < static_cast<std::size_t>(place.n); ++k) {
      if (at_corner(place.corners[k]) != first) return {};
    }
    return first;
  }
}

/// The warning that names data which are dropped; nothing if there are none.
[[nodiscard]] std::optional<std::string> warning_of_dropped(const std::vector<std::string>& names,
                                                            std::string_view why);

/// Says whether an array is conserved by these rules: its values are finite.
[[nodiscard]] bool is_conserved(const DataArray& array, const DataRules& rules);
/// The values of a conserved array on the new cells. The report gets how far the promises hold.
[[nodiscard]] Values conserved_values(const DataArray& array, const CellOverlaps& overlaps, DataReport& report);

/// What data need to know of a change.
struct WantedOfChange {
  bool places = false;           ///< of the vertices
  bool sources = false;          ///< of the cells
  bool vertex_overlaps = false;  ///< of power cells
  bool cell_overlaps = false;
  friend bool operator==(const WantedOfChange&, const WantedOfChange&) = default;
};

/// Where data at a change come from.
template <class AnyPlace>
struct FoundOfChange {
  IdVector<VertexId, AnyPlace> places;
  std::vector<std::size_t> sources;
  CellOverlaps vertex_overlaps, cell_overlaps;
};

/// Takes the data of a file from its former mesh to a new one, and reports it. A Change tells about the two:
///   - its type Found with places, sources, vertex_overlaps and cell_overlaps, and the constant `dimension` of the
///   cells
///   - mesh(): the new mesh
///   - former_corners(i): the points of cell i in the file, nothing if the file has fewer cells
///   - moved(v, was): the distance of a vertex from its place in the file; nothing if it has not moved
///   - has_other_weight(v, was): says whether the weight of a vertex is not that of the file
///   - find(former, wanted): the places of the vertices and the sources of the cells in the former mesh, and overlaps
template <class Change>
class DataUpdater {
 public:
  DataUpdater(MeshFile& file, const Change& change, const Former& former, const UpdateOptions& options)
      : file_(file),
        cells_(std::get<Change::dimension>(file.cells())),
        change_(change),
        former_(former),
        options_(options) {}

  DataReport update() {
    if (file_.point_data.empty() && cells_.data.empty()) return {};
    measure();
    name_cell_data();
    if (const WantedOfChange wanted = wanted_of_change(); wanted != WantedOfChange()) {
      auto found = change_.find(former_, wanted);
      if (!found) {
        drop_all(found.error().what());
        return std::move(report_);
      }
      found_ = *std::move(found);
      if (wanted.cell_overlaps || wanted.sources) update_cell_data();
    }
    update_point_data();
    return std::move(report_);
  }

 private:
  [[nodiscard]] const auto& mesh() const { return change_.mesh(); }
  [[nodiscard]] VertexId former(VertexId v) const { return former_.empty() ? v : former_[v]; }
  void measure() {
    std::vector<double> distances;
    for (const VertexId v : mesh().vertices()) {
      const VertexId was = former(v);
      ++(was.valid() ? report_.points : report_.points_inserted);
      const auto distance = was.valid() ? change_.moved(v, was) : std::nullopt;
      if (distance) distances.push_back(*distance);
      weights_changed_ = weights_changed_ || (was.valid() && change_.has_other_weight(v, was));
    }
    report_.points_moved = distances.size();
    report_.distance = spread(std::move(distances));
    report_.triangles = n_cells(mesh());
    for (const auto id : ids_of_cells(mesh())) report_.triangles_changed += is_same(id) ? 0 : 1;
  }
  /// Says whether a cell has the same corners as in the file, at the same places.
  template <class Id>
  [[nodiscard]] bool is_same(Id id) const {
    auto before = change_.former_corners(id.index);
    if (!before) return false;
    auto now = *before;
    for (std::size_t k = 0; k < now.size(); ++k) {
      const VertexId v = mesh().corners(id)[k], was = former(v);
      if (!was.valid() || change_.moved(v, was)) return false;
      now[k] = static_cast<std::int32_t>(was.index);
    }
    std::ranges::sort(*before);  // some were reversed
    std::ranges::sort(now);
    return *before == now;
  }
  /// Power cells change with weights, too, even if nothing has moved.
  [[nodiscard]] WantedOfChange wanted_of_change() const {
    const auto any_of = [](const std::vector<DataArray>& arrays, const auto& test) {
      return std::ranges::any_of(arrays, test);
    };
    const auto by_place = [this](const DataArray& a) { return interpolates(a); };
    const auto by_cell = [this](const DataArray& a) { return is_conserved(a, options_.rules); };
    const auto of_cells = [this](const DataArray& a) { return is_conserved(a, options_.cell_rules); };
    WantedOfChange wanted;
    wanted.places = (report_.points_inserted > 0 && !std::ranges::all_of(file_.point_data, by_cell)) ||
                    (report_.points_moved > 0 && any_of(file_.point_data, by_place));
    const bool cells_changed = report_.points_inserted + report_.points_moved + report_.triangles_changed > 0;
    wanted.vertex_overlaps = (cells_changed || weights_changed_) && any_of(file_.point_data, by_cell);
    if (report_.triangles_changed == 0) return wanted;
    wanted.cell_overlaps = any_of(cells_.data, of_cells);
    wanted.sources = !std::ranges::all_of(cells_.data, of_cells);
    return wanted;
  }
  /// Arrays that should be conserved, but are not finite, are interpolated.
  [[nodiscard]] bool interpolates(const DataArray& a) const {
    return options_.rules.of(a) != DataRule::keep && !is_conserved(a, options_.rules);
  }
  void warn_of_not_finite(const DataArray& a, const DataRules& rules, std::string_view instead) {
    if (rules.of(a) != DataRule::conserve || is_conserved(a, rules) || a.name == kCornerWeights) return;
    file_.warnings.push_back(
        text("'", a.name, "' has a value that is not finite, so it is ", instead, ", and its integrals change"));
  }
  void name_cell_data() {
    for (const DataArray& a : cells_.data) {
      if (a.name == kQuadrilateral) continue;
      (is_conserved(a, options_.cell_rules) ? report_.conserved_of_triangles : report_.of_triangles).push_back(a.name);
    }
  }
  void update_cell_data() {
    for (DataArray& a : cells_.data) {
      warn_of_not_finite(a, options_.cell_rules, "sampled");
      if (is_conserved(a, options_.cell_rules)) {
        a.values = conserved_values(a, found_.cell_overlaps, report_);
      } else {
        std::vector<DataArray> one = {std::move(a)};
        take_rows(one, found_.sources);
        a = std::move(one[0]);
      }
    }
  }
  /// Names each array in the report. Integers that differ around a new vertex are dropped, with a warning.
  void update_point_data() {
    std::vector<DataArray> left;
    for (DataArray& a : file_.point_data) {
      warn_of_not_finite(a, options_.rules, "interpolated");
      const bool conserves = is_conserved(a, options_.rules);
      const bool has_overlaps = found_.vertex_overlaps.n_cells > 0;  // else nothing has changed
      std::optional<Values> values =
          conserves && has_overlaps ? conserved_values(a, found_.vertex_overlaps, report_) : at_vertices(a);
      (!values           ? report_.dropped
       : conserves       ? report_.conserved
       : interpolates(a) ? report_.interpolated
                         : report_.kept)
          .push_back(a.name);
      if (values) left.push_back({std::move(a.name), a.components, *std::move(values)});
    }
    file_.point_data = std::move(left);
    if (auto warning = warning_of_dropped(report_.dropped, "integers differ around a new point"))
      file_.warnings.push_back(*std::move(warning));
  }
  [[nodiscard]] std::optional<Values> at_vertices(const DataArray& a) const {
    const bool stays = !interpolates(a) || found_.places.empty();
    const auto n = static_cast<std::size_t>(a.components);
    return std::visit(
        [&](const auto& values) -> std::optional<Values> {
          std::remove_cvref_t<decltype(values)> result;
          result.reserve(mesh().n_vertices() * n);
          for (const VertexId v : mesh().vertices()) {
            const VertexId was = former(v);
            for (std::size_t i = 0; i < n; ++i) {
              const auto value = stays && was.valid() ? std::optional(values[n * was.index + i])
                                 : is_flag(a)         ? std::optional(ElementOf<decltype(values)>())
                                                      : value_at(values, n, i, found_.places[v]);
              if (!value) return {};
              result.push_back(*value);
            }
          }
          return result;
        },
        a.values);
  }
  void drop_all(const std::string& why) {
    report_.of_triangles.clear(), report_.conserved_of_triangles.clear();
    for (auto* arrays : {&file_.point_data, &cells_.data}) {
      for (const DataArray& a : *arrays) report_.dropped.push_back(a.name);
      arrays->clear();
    }
    if (auto warning = warning_of_dropped(report_.dropped, why)) file_.warnings.push_back(*std::move(warning));
  }

  MeshFile& file_;
  Cells<Change::dimension>& cells_;
  const Change& change_;
  const Former& former_;
  const UpdateOptions& options_;
  typename Change::Found found_;  // what is not wanted is empty
  bool weights_changed_ = false;
  DataReport report_;
};

}  // namespace temper::io
