#include "io/conversion/data_update.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

#include "io/conversion/globe.hpp"
#include "io/conversion/quadrilaterals.hpp"
#include "io/text/failure.hpp"
#include "io/text/file_names.hpp"
#include "io/text/values.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/detail/location.hpp"
#include "temper/io.hpp"

namespace temper::io {
namespace {

Values at_triangles(const DataArray& a, const IdVector<TriangleId, TriangleId>& sources) {
  const auto n = static_cast<std::ptrdiff_t>(a.components);
  return std::visit(
      [&](const auto& values) -> Values {
        std::remove_cvref_t<decltype(values)> result;
        result.reserve(sources.size() * static_cast<std::size_t>(n));
        for (const TriangleId t : sources) {
          const auto first = values.begin() + n * static_cast<std::ptrdiff_t>(t.index);
          result.insert(result.end(), first, first + n);
        }
        return result;
      },
      a.values);
}

class DataUpdater {
 public:
  DataUpdater(MeshFile& file, const Mesh& mesh, const Former& former, const UpdateOptions& options)
      : file_(file), mesh_(mesh), former_(former), options_(options) {}

  DataReport update() {
    if (file_.point_data.empty() && file_.triangles.data.empty()) return {};
    measure();
    if (needs_places()) {
      if (const Expected<void> found = find_sources(); !found) {
        drop_all(found.error().what());
        return std::move(report_);
      }
    }
    update_point_data(
        file_, mesh_, options_.rules, [this](VertexId v) { return former(v); }, places_, report_);
    update_cells();
    return std::move(report_);
  }

 private:
  [[nodiscard]] VertexId former(VertexId v) const { return former_.empty() ? v : former_[v]; }
  void measure() {
    std::vector<double> distances;
    for (const VertexId v : mesh_.vertices()) {
      const VertexId was = former(v);
      report_.points += was.valid() ? 1 : 0;
      report_.points_inserted += was.valid() ? 0 : 1;
      if (was.valid() && distance_from_before(v) > 0) distances.push_back(distance_from_before(v));
    }
    report_.points_moved = distances.size();
    report_.distance = spread(std::move(distances));
    report_.triangles = mesh_.n_triangles();
    for (const TriangleId t : mesh_.triangles()) report_.triangles_changed += is_same(t) ? 0 : 1;
  }
  /// The distance of an old vertex from its place in the file.
  [[nodiscard]] double distance_from_before(VertexId v) const {
    const std::size_t was = former(v).index;
    const Space& space = mesh_.space();
    const WeightedPoint now = mesh_.point(v), before = as_point(position_of(file_, was));
    return space.same_place(space.in_domain(before), now) ? 0 : distance(space, before, space.image(now, before));
  }
  /// Says whether triangle t has the same corners as in the file, at the same places.
  [[nodiscard]] bool is_same(TriangleId t) const {
    if (t.index >= file_.triangles.size()) return false;
    auto before = file_.triangles[t.index];
    std::array<std::int32_t, 3> now = {};
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId v = mesh_.corners(t)[k], was = former(v);
      if (!was.valid() || distance_from_before(v) > 0) return false;
      now[k] = static_cast<std::int32_t>(was.index);
    }
    std::sort(before.begin(), before.end());  // clockwise ones were reversed
    std::sort(now.begin(), now.end());
    return before == now;
  }
  [[nodiscard]] bool needs_places() const {
    if (report_.points_inserted > 0 || (report_.triangles_changed > 0 && !file_.triangles.data.empty())) return true;
    return report_.points_moved > 0 &&
           std::any_of(file_.point_data.begin(), file_.point_data.end(),
                       [this](const DataArray& a) { return options_.rules.of(a) == DataRule::interpolate; });
  }
  [[nodiscard]] Expected<void> find_sources() {
    MeshInput input;
    input.space = mesh_.space();
    input.points = file_.points;
    input.sphere_points = sphere_places(file_);
    input.triangles = file_.triangles;
    input.regions = file_.triangles.tags;
    input.executor = options_.executor;
    const Expected<BuiltMesh> before = Mesh::build(input);
    if (!before) return before.error();
    places_ = positions_of_vertices(before->mesh, mesh_, former_, options_.executor);
    if (!file_.triangles.data.empty()) sources_ = sources_of_triangles(before->mesh, mesh_, places_, options_.executor);
    return {};
  }
  void update_cells() {
    for (DataArray& a : file_.triangles.data) {
      if (a.name != kQuadrilateral) report_.of_triangles.push_back(a.name);
      if (!sources_.empty()) a.values = at_triangles(a, sources_);
    }
  }
  void drop_all(const std::string& why) {
    for (auto* arrays : {&file_.point_data, &file_.triangles.data}) {
      for (const DataArray& a : *arrays) report_.dropped.push_back(a.name);
      arrays->clear();
    }
    if (auto warning = warning_of_dropped(report_.dropped, why)) file_.warnings.push_back(*std::move(warning));
  }

  MeshFile& file_;
  const Mesh& mesh_;
  const Former& former_;
  const UpdateOptions& options_;
  IdVector<VertexId, Place> places_;          // in the former mesh; empty: not needed
  IdVector<TriangleId, TriangleId> sources_;  // triangles of the former mesh; empty: unchanged
  DataReport report_;
};

}  // namespace

bool is_flag(const DataArray& a) { return a.name == "medit:corner" || a.name == "medit:required"; }

std::vector<std::int32_t> required_points(const std::vector<DataArray>& point_data) {
  const DataArray* const required = find(point_data, "medit:required");
  const auto* const flags = required == nullptr ? nullptr : std::get_if<std::vector<std::uint8_t>>(&required->values);
  std::vector<std::int32_t> points;
  for (std::size_t p = 0; flags != nullptr && p < flags->size(); ++p) {
    if ((*flags)[p] != 0) points.push_back(static_cast<std::int32_t>(p));
  }
  return points;
}

void take_rows(std::vector<DataArray>& arrays, const std::vector<std::size_t>& indices) {
  RunLength rows;
  for (const std::size_t i : indices) rows.push_back(static_cast<std::int64_t>(i));
  for (DataArray& a : arrays) a.values = gather(a.values, a.components, rows);
}

std::optional<std::string> warning_of_dropped(const std::vector<std::string>& names, std::string_view why) {
  std::string all;
  for (const std::string& name : names) all += text(all.empty() ? "" : ", ", name);
  if (all.empty()) return {};
  return text("data are dropped, because ", why, ": ", all);
}

bool is_weighted(const MeshFile& file) {
  return std::ranges::any_of(file.weights, [](double w) { return w != 0; });
}

void drop_zero_weights(MeshFile& file) {
  if (!is_weighted(file)) std::vector<double>().swap(file.weights);
}

DataReport update_data(MeshFile& file, const Mesh& mesh, const Former& former, const UpdateOptions& options) {
  return DataUpdater(file, mesh, former, options).update();
}

namespace {

InputError wrong_rule(std::string message) { return {ErrorCode::invalid_option, {}, std::move(message)}; }

std::optional<DataRule> rule_named(std::string_view name) {
  if (name == "interpolate") return DataRule::interpolate;
  if (name == "keep") return DataRule::keep;
  return {};
}

std::string names_of(const std::vector<DataArray>& arrays) {
  std::string names;
  for (const DataArray& a : arrays) names += text(names.empty() ? "" : ", ", a.name);
  return names.empty() ? "none" : names;
}

}  // namespace

DataRule DataRules::of(const DataArray& array) const {
  if (!is_floating(array.values)) return DataRule::keep;
  const auto found = exceptions.find(array.name);
  return found == exceptions.end() ? rule : found->second;
}

Expected<DataRules> parse_data_rules(std::span<const std::string> words) {
  DataRules rules;
  std::optional<DataRule> of_all;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    const std::optional<DataRule> rule = rule_named(std::string_view(word).substr(0, equals));
    if (!rule || equals + 1 == word.size()) {
      return wrong_rule(text("'", word, "' is not interpolate, keep, interpolate=NAME or keep=NAME"));
    }
    const bool contradicts = equals == std::string::npos
                                 ? of_all.value_or(*rule) != *rule
                                 : rules.exceptions.emplace(word.substr(equals + 1), *rule).first->second != *rule;
    if (contradicts) return wrong_rule(text("'", word, "' contradicts what was said before it"));
    if (equals == std::string::npos) of_all = rule;
  }
  rules.rule = of_all.value_or(DataRule::interpolate);
  return rules;
}

Expected<void> check_data_rules(const DataRules& rules, const std::vector<DataArray>& point_data) {
  for (const auto& [name, rule] : rules.exceptions) {
    const DataArray* array = find(point_data, name);
    if (array == nullptr)
      return wrong_rule(text("there is no point data '", name, "'; there are: ", names_of(point_data)));
    if (rule == DataRule::interpolate && !is_floating(array->values)) {
      return wrong_rule(text("point data '", name, "' are integers (", type_name(array->values),
                             "), which stay with their points: only floating point data are interpolated"));
    }
  }
  return {};
}

namespace {

using Vertices = IdVector<VertexId, VertexId>;

/// Inserted vertices in a row along the boundary or a constrained line, between two of the file's.
struct Chain {
  VertexId a, b;
  std::vector<VertexId> inside;  ///< from a to b
};

/// The other ends of boundary and constrained edges at v.
std::vector<VertexId> along_lines(const Mesh& mesh, VertexId v) {
  std::vector<VertexId> ends;
  for (const HalfedgeId h : mesh.star(v)) {
    if (mesh.is_unflippable(h)) ends.push_back(mesh.target(h));
    if (mesh.is_boundary(Mesh::prev(h))) ends.push_back(mesh.opposite(h));
  }
  return ends;
}

class Chains {
 public:
  Chains(const Mesh& mesh, const Vertices& vertices) : mesh_(mesh), vertices_(vertices), seen_(vertices.size(), 0) {
    for (const VertexId v : mesh.vertices()) {
      if (inserted(v) && seen_[v] == 0) follow(v);
    }
  }

  [[nodiscard]] const std::vector<Chain>& all() const { return chains_; }
  /// The shortest chain from a to b, starting at a; empty when there is none.
  [[nodiscard]] std::vector<VertexId> between(VertexId a, VertexId b) const {
    const Chain* shortest = nullptr;
    double least = std::numeric_limits<double>::infinity();
    const auto [first, last] = by_ends_.equal_range(std::minmax(a, b));
    for (auto found = first; found != last; ++found) {
      const double length = length_of(chains_[found->second]);
      if (length < least) shortest = &chains_[found->second];
      least = std::min(least, length);
    }
    if (shortest == nullptr) return {};
    std::vector<VertexId> inside = shortest->inside;
    if (shortest->a != a) std::reverse(inside.begin(), inside.end());
    return inside;
  }

 private:
  [[nodiscard]] bool inserted(VertexId v) const { return !vertices_[v].valid(); }

  void follow(VertexId v) {
    const std::vector<VertexId> ends = along_lines(mesh_, v);
    if (ends.size() != 2) return;
    Chain chain;
    chain.a = walk(v, ends[0], chain.inside);
    std::reverse(chain.inside.begin(), chain.inside.end());
    chain.inside.push_back(v);
    seen_[v] = 1;
    chain.b = walk(v, ends[1], chain.inside);
    if (inserted(chain.a) || inserted(chain.b)) return;
    by_ends_.emplace(std::minmax(chain.a, chain.b), chains_.size());
    chains_.push_back(std::move(chain));
  }

  /// Walks past `at`, coming from `from`, to the first vertex that is not inserted within a line.
  VertexId walk(VertexId from, VertexId at, std::vector<VertexId>& passed) {
    while (inserted(at) && seen_[at] == 0) {
      const std::vector<VertexId> ends = along_lines(mesh_, at);
      if (ends.size() != 2) break;
      seen_[at] = 1;
      passed.push_back(at);
      from = std::exchange(at, ends[0] == from ? ends[1] : ends[0]);
    }
    return at;
  }

  [[nodiscard]] double length_of(const Chain& chain) const {
    double sum = 0;
    WeightedPoint last = mesh_.point(chain.a);
    const auto add = [&](VertexId v) {
      const WeightedPoint next = mesh_.point(v, last);
      sum += length(next.position() - last.position());
      last = next;
    };
    for (const VertexId v : chain.inside) add(v);
    add(chain.b);
    return sum;
  }

  const Mesh& mesh_;
  const Vertices& vertices_;
  IdVector<VertexId, std::uint8_t> seen_;
  std::vector<Chain> chains_;
  std::multimap<std::pair<VertexId, VertexId>, std::size_t> by_ends_;
};

VertexId id(std::int32_t p) { return VertexId(static_cast<std::size_t>(p)); }
std::int32_t point(VertexId v) { return static_cast<std::int32_t>(v.index); }

bool is_edge(const Mesh& mesh, VertexId a, VertexId b) {
  return mesh.find_halfedge(a, b).valid() || mesh.find_halfedge(b, a).valid();
}

void cut_edges(MeshFile& file, const Mesh& mesh, const Chains& chains) {
  std::vector<std::array<std::int32_t, 2>> lines;
  std::vector<std::size_t> from;  // which line each is a piece of
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    const VertexId a = id(file.lines[i][0]), b = id(file.lines[i][1]);
    VertexId last = a;
    if (!is_edge(mesh, a, b)) {
      for (const VertexId v : chains.between(a, b)) {
        lines.push_back({point(std::exchange(last, v)), point(v)});
        from.push_back(i);
      }
    }
    lines.push_back({point(last), point(b)});
    from.push_back(i);
  }
  file.lines.corners = std::move(lines);
  file.lines.tags = at(file.lines.tags, from);
  take_rows(file.lines.data, from);
}

void mark_new_points(MeshFile& file, const Mesh& mesh, const Chains& chains) {
  std::map<VertexId, std::size_t> mark_of;
  for (std::size_t i = 0; i < file.marked_points.size(); ++i) mark_of.emplace(id(file.marked_points[i]), i);
  std::vector<std::size_t> from(file.marked_points.size());
  for (std::size_t i = 0; i < from.size(); ++i) from[i] = i;
  for (const Chain& chain : chains.all()) {
    const auto a = mark_of.find(chain.a), b = mark_of.find(chain.b);
    if (a == mark_of.end() || b == mark_of.end() || !mesh.is_boundary(chain.inside.front())) continue;
    if (file.marked_points.tags[a->second] != file.marked_points.tags[b->second]) continue;
    for (const VertexId v : chain.inside) {
      file.marked_points.corners.push_back(point(v));
      from.push_back(a->second);
    }
  }
  file.marked_points.tags = at(file.marked_points.tags, from);
  take_rows(file.marked_points.data, from);
}

}  // namespace

void split_lines(MeshFile& file, const Mesh& mesh, const Vertices& vertices) {
  if (std::all_of(vertices.begin(), vertices.end(), [](VertexId v) { return v.valid(); })) return;
  const Chains chains(mesh, vertices);
  cut_edges(file, mesh, chains);
  const bool marks_all_of_the_boundary = file.format == "triangle" || file.format == "medit";
  if (marks_all_of_the_boundary) mark_new_points(file, mesh, chains);
}

}  // namespace temper::io
