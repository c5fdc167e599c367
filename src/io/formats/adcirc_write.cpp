// Writes ADCIRC's fort.14. Lines on the boundary become strings of nodes, with the domain on the left. If the lines
// have the data adcirc:rows, they come from such a file, and its strings come back as they were. If the name of their
// tag is not the name of a boundary, they become land boundaries of type 0 (mainland). Then an edge with several tags
// is in one boundary only: in those of its tags that are named so, or else in that of its first tag.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "io/conversion/bed.hpp"
#include "io/formats/adcirc.hpp"
#include "io/formats/boundary_codes.hpp"
#include "io/text/values.hpp"

namespace temper::io {

namespace {

/// A boundary in the form that is written.
struct AdcircString {
  AdcircBoundary kind;
  std::int32_t tag = 0;
  NodeString nodes;
};

/// A line with its data adcirc:rows.
struct RowsOfLine {
  DirectedEdge line = {};
  double first = 0, second = 0;
  bool is_of_string = false;

  [[nodiscard]] bool are_valid() const {
    constexpr double kMost = 16;  // a damaged file may have any number
    return first >= 1 && second >= 1 && first <= kMost && second <= kMost;
  }
};

/// The lines in their order. A node between two lines has as many rows as both say: an inserted one has a single row.
std::vector<NodeString> strings_as_read(const std::vector<RowsOfLine>& lines) {
  std::vector<NodeString> strings;
  std::size_t before = 0;  // rows of the last node, as the line before has them
  for (const RowsOfLine& of : lines) {
    if (!of.is_of_string) continue;
    const auto first = static_cast<std::size_t>(of.first), second = static_cast<std::size_t>(of.second);
    if (strings.empty() || strings.back().back() != of.line[0])
      strings.emplace_back(first, of.line[0]);
    else if (before > first)
      strings.back().resize(strings.back().size() - (before - first));
    strings.back().insert(strings.back().end(), second, of.line[1]);
    before = second;
  }
  return strings;
}

class AdcircWriter {
 public:
  explicit AdcircWriter(const WriteJob& job) : job_(job), file_(job.file), out_(job.outputs.open(job.path)) {
    for (const PhysicalName& n : file_.names) {
      if (n.dimension == 1) names_.emplace(n.tag, n.name);
    }
  }
  void write() {
    collect_levees();
    collect_boundaries();
    title();
    nodes();
    const MeshFile& f = file_;
    for (std::size_t i = 0; i < f.triangles.size(); ++i) {
      const auto& t = f.triangles[i];
      const bool is_triangle = i < job_.n_triangles();
      out_.put(i + 1, is_triangle ? " 3 " : " 4 ", t[0] + 1, ' ', t[1] + 1, ' ', t[2] + 1);
      if (!is_triangle) out_.put(' ', job_.fourth_corners[i - job_.n_triangles()] + 1);
      out_.put('\n');
    }
    if (const std::size_t n = job_.fourth_corners.size(); n > 0 && !job_.path.ends_with(".gr3"))
      job_.warn(n, n == 1 ? " quadrilateral is" : " quadrilaterals are",
                " written, which SCHISM reads; ADCIRC reads triangles alone");
    boundaries(true);
    boundaries(false);
    warn_of_lost();
  }

 private:
  void title() {
    const DataArray* array = find(file_.field_data, kAdcircTitle);
    const auto* bytes = array == nullptr ? nullptr : std::get_if<std::vector<std::uint8_t>>(&array->values);
    std::string line = bytes == nullptr ? "" : std::string(bytes->begin(), bytes->end());
    for (char& c : line) c = c == '\n' || c == '\r' ? ' ' : c;
    out_.put(line, '\n');
    out_.put(file_.triangles.size(), ' ', file_.points.size(), '\n');
  }
  void nodes() {
    const DataArray* array = find(file_.point_data, kDepth);
    const bool has_depth = array != nullptr && array->components == 1;
    const auto depths = has_depth ? to_doubles(Values(array->values)) : std::vector<double>(file_.points.size());
    const std::map<std::int32_t, std::int32_t> nodes = nodes_of_partners();
    for (std::size_t i = 0; i < file_.points.size(); ++i) {
      const auto node = nodes.find(static_cast<std::int32_t>(i));
      const Vec2 place = file_.points[node == nodes.end() ? i : static_cast<std::size_t>(node->second)];
      out_.put(i + 1, ' ', place.x, ' ', place.y, ' ', depths[i], '\n');
    }
    const auto missing = std::ranges::count_if(depths, [](double depth) { return std::isnan(depth); });
    if (missing > 0) job_.warn(missing, " points have no depth, which is written as nan");
  }
  /// The nodes to whose places the partners of vertical element walls return.
  [[nodiscard]] std::map<std::int32_t, std::int32_t> nodes_of_partners() const {
    std::map<std::int32_t, std::int32_t> nodes;
    for (const AdcircString& s : strings_) {
      if (s.kind.open || s.kind.type != kAdcircWall) continue;
      for (const std::int32_t p : s.nodes) nodes.emplace(file_.marked_points[*levee(s, p) + 1], p);
    }
    return nodes;
  }
  void collect_boundaries() {
    const MeshFile& f = file_;
    if (f.lines.empty()) return;
    const auto boundary = boundary_edges(job_.measured);
    const std::set<std::int32_t> as_read = collect_strings_as_read();
    std::vector<std::pair<DirectedEdge, std::int32_t>> lines;  // on the boundary, and their tags
    std::map<DirectedEdge, std::int32_t> first_tag;            // named as a boundary if one is
    std::size_t inside = 0;
    for (std::size_t i = 0; i < f.lines.size(); ++i) {
      const auto [a, b] = f.lines[i];
      const std::int32_t tag = f.lines.tags[i];
      const bool forward = boundary.contains({a, b});
      if (!forward && !boundary.contains({b, a})) {
        inside += as_read.contains(tag) ? 0 : 1;
        continue;
      }
      const DirectedEdge edge = forward ? DirectedEdge{a, b} : DirectedEdge{b, a};
      lines.emplace_back(edge, tag);
      const auto [known, is_new] = first_tag.emplace(edge, tag);
      if (!is_new && !named_kind(known->second) && named_kind(tag)) known->second = tag;
    }
    if (inside > 0)
      job_.warn(inside, " lines that are not on the boundary are not written: fort.14 has no place for them");
    std::vector<std::int32_t> tags;  // in the order of their first line
    std::map<std::int32_t, std::vector<DirectedEdge>> edges;
    std::map<std::int32_t, std::size_t> lost;
    for (const auto& [edge, tag] : lines) {
      if (as_read.contains(tag)) continue;
      if (tag != first_tag[edge] && !named_kind(tag)) {
        ++lost[tag];
        continue;
      }
      auto& list = edges[tag];
      if (list.empty()) tags.push_back(tag);
      list.push_back(edge);
    }
    for (const auto& [tag, n] : lost) {
      job_.warn("tag ", tag, described(tag), " is not written for ", n, n == 1 ? " edge" : " edges",
                " of another boundary: fort.14 has an edge in one boundary");
    }
    for (const std::int32_t tag : tags) {
      const AdcircBoundary kind = kind_of(tag);
      for (NodeString& nodes : node_strings(edges[tag])) strings_.push_back({kind, tag, std::move(nodes)});
    }
    for (AdcircString& s : strings_) levee_string(s);
  }
  /// Strings of those boundaries whose lines all have the data adcirc:rows; returns their tags.
  std::set<std::int32_t> collect_strings_as_read() {
    const MeshFile& f = file_;
    const DataArray* array = find(f.lines.data, kAdcircRows);
    if (array == nullptr || array->components != kAdcircRowNumbers) return {};
    const std::vector<double> numbers = to_doubles(Values(array->values));
    std::map<std::int32_t, std::vector<RowsOfLine>> lines;
    std::vector<std::int32_t> tags;  // in the order of their first line
    for (std::size_t i = 0; i < f.lines.size(); ++i) {
      auto& list = lines[f.lines.tags[i]];
      if (list.empty()) tags.push_back(f.lines.tags[i]);
      const double* const rows = &numbers[i * static_cast<std::size_t>(kAdcircRowNumbers)];
      list.push_back({f.lines[i], rows[0], rows[1], rows[2] != 0});
    }
    std::erase_if(tags, [&](std::int32_t tag) {
      return !named_kind(tag) || !std::ranges::all_of(lines[tag], &RowsOfLine::are_valid);
    });
    for (const std::int32_t tag : tags) {
      for (NodeString& nodes : strings_as_read(lines[tag]))
        strings_.push_back({*named_kind(tag), tag, std::move(nodes)});
    }
    return {tags.begin(), tags.end()};
  }
  /// The kind that a name of the tag says, if one does.
  [[nodiscard]] std::optional<AdcircBoundary> named_kind(std::int32_t tag) const {
    const auto [first, last] = names_.equal_range(tag);
    for (auto named = first; named != last; ++named) {
      if (const auto kind = adcirc_boundary(named->second)) return kind;
    }
    return {};
  }
  /// ", NAME" if the tag has one.
  [[nodiscard]] std::string described(std::int32_t tag) const {
    const auto named = names_.find(tag);
    return named == names_.end() ? std::string() : text(", ", named->second);
  }
  AdcircBoundary kind_of(std::int32_t tag) {
    if (const auto kind = named_kind(tag)) return *kind;
    job_.warn("lines with tag ", tag, described(tag),
              " are written as land boundaries of type 0; the name 'open boundary 1' or 'land boundary 1, type 20' "
              "would say otherwise");
    return {};
  }
  void collect_levees() {
    const MeshFile& f = file_;
    const DataArray* side_data = find(f.marked_points.data, kPairSide);
    const DataArray* levee_data = find(f.marked_points.data, kAdcircLevee);
    if (side_data == nullptr || levee_data == nullptr || levee_data->components != kAdcircLeveeNumbers) return;
    const auto sides = to_int32(side_data->values);
    if (!sides || side_data->components != 1) return;
    levee_numbers_ = to_doubles(Values(levee_data->values));
    for (std::size_t i = 0; i < f.marked_points.size(); ++i) {
      if ((*sides)[i] != 0) continue;
      const TagAndNode node(f.marked_points.tags[i], f.marked_points[i]);
      const bool has_partner =
          i + 1 < f.marked_points.size() && f.marked_points.tags[i + 1] == node.first && (*sides)[i + 1] == 1;
      levees_.emplace(node, i);
      if (has_partner) paired_levees_.emplace(node, i);
    }
  }
  /// The marked point that is this node of the string, when it has a levee.
  [[nodiscard]] const std::size_t* levee(const AdcircString& string, std::int32_t node) const {
    const auto& levees = adcirc_row(string.kind).paired ? paired_levees_ : levees_;
    const auto found = levees.find({string.tag, node});
    return found == levees.end() ? nullptr : &found->second;
  }
  void boundaries(bool open) {
    std::size_t n = 0, n_nodes = 0;
    for (const AdcircString& s : strings_) {
      if (s.kind.open != open) continue;
      ++n;
      n_nodes += s.nodes.size() * (adcirc_row(s.kind).paired ? 2 : 1);
    }
    const char* which = open ? "open" : "land";
    out_.put(n, " = number of ", which, " boundaries\n", n_nodes, " = number of ", which, " boundary nodes\n");
    std::size_t number = 0;
    for (const AdcircString& s : strings_) {
      if (s.kind.open != open) continue;
      out_.put(s.nodes.size(), ' ', s.kind.type, " = number of nodes and type of ", which, " boundary ", ++number,
               '\n');
      const AdcircRow row = adcirc_row(s.kind);
      for (const std::int32_t p : s.nodes) {
        out_.put(p + 1);
        if (row.numbers > 0) {
          const std::size_t at = *levee(s, p);
          if (row.paired) out_.put(' ', file_.marked_points[at + 1] + 1);
          for (int k = 0; k < row.numbers; ++k)
            out_.put(' ',
                     levee_numbers_[at * static_cast<std::size_t>(kAdcircLeveeNumbers) + static_cast<std::size_t>(k)]);
        }
        out_.put('\n');
      }
    }
  }
  /// A boundary whose nodes have lost their levees is written without levees.
  void levee_string(AdcircString& string) {
    const AdcircRow row = adcirc_row(string.kind);
    if (row.numbers == 0) return;
    const auto has_levee = [&](std::int32_t p) { return levee(string, p) != nullptr; };
    if (std::all_of(string.nodes.begin(), string.nodes.end(), has_levee)) return;
    constexpr std::int32_t kNatural = 20, kTypesOfOneKind = 10;
    const std::int32_t type =
        string.kind.type == kAdcircWall ? kNatural : string.kind.type - string.kind.type % kTypesOfOneKind;
    job_.warn("a boundary of type ", string.kind.type, " has nodes without their levee and is written as type ", type);
    string.kind.type = type;
  }
  void warn_of_lost() const {
    const MeshFile& f = file_;
    std::vector<PhysicalName> names;
    for (const PhysicalName& n : f.names) {
      const bool numbered = n.name.starts_with("open boundary ") || n.name.starts_with("land boundary ");
      if (n.dimension != 1 || !numbered || !adcirc_boundary(n.name)) names.push_back(n);
    }
    warn_of_names(job_, names);
    const bool levees = find(f.marked_points.data, kPairSide) != nullptr;
    if (!f.marked_points.empty() && !levees) job_.warn("marked points are not written, fort.14 has no place for them");
  }

  const WriteJob& job_;
  const MeshFile& file_;
  Output& out_;
  std::multimap<std::int32_t, std::string_view> names_;  // of lines, by tag
  std::vector<AdcircString> strings_;
  using TagAndNode = std::pair<std::int32_t, std::int32_t>;
  std::map<TagAndNode, std::size_t> levees_, paired_levees_;  // marked points
  std::vector<double> levee_numbers_;                         // of all marked points
};

}  // namespace

// Files of the VTK family have the data of levees and strings on all their cells.
bool adcirc_keeps(Content of, const DataArray& array) {
  if (of == kPointData) return array.name == kDepth;
  if (of == kFieldData) return array.name == kAdcircTitle;
  return array.name == kAdcircLevee || array.name == kPairSide || array.name == kAdcircRows;
}

void write_adcirc(const WriteJob& job) { AdcircWriter(job).write(); }

}  // namespace temper::io
