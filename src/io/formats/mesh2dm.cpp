// 2DM of SMS, for ADH, SRH-2D, HYDRO_AS-2D and others: a card on each line (SMS user manual, "2D Mesh Files *.2dm").
//
//   MESH2D
//   E3T 1  1 2 3  7            a triangle: its number, its nodes counter-clockwise, its material: the region
//   E4Q 2  2 4 5 3  7          a quadrilateral
//   ND 1  0.0 0.0 -5.2         a node: its number, x, y, and z: the elevation of the bed, positive up
//   NS 1 2 -3 4 "inflow"       a string of nodes ends with a negative node; its number and its name may follow: lines
//
// A string may continue on the next NS line. z is data: see ReadOptions::flat. SCHISM has depths there, positive down:
// see ReadOptions::positive.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "io/conversion/globe.hpp"
#include "io/formats/boundary_codes.hpp"
#include "io/text/names.hpp"
#include "io/text/scanner.hpp"

namespace temper::io {

bool sniff_2dm(std::string_view head) { return head.starts_with("MESH2D"); }

namespace {

class Reader2dm {
 public:
  explicit Reader2dm(Source& source) : scanner_(source.path, source.bytes), document_(new_document(source.path)) {}

  Document read() {
    while (!scanner_.at_end()) card(scanner_.word("a card"));
    MeshFile& f = document_.file;
    const NumberLookup lookup(document_.names->points);
    if (const auto twice = lookup.duplicate()) fail(ErrorCode::syntax, scanner_.path(), "has node ", *twice, " twice");
    for (std::size_t t = 0; t < corners_.size(); ++t) {
      const auto corner = [&](std::size_t k) {
        return index(lookup, corners_[t][k], document_.names->triangle(t), document_.names->triangle_where(t));
      };
      document_.add_face({corner(0), corner(1), corner(2)}, corners_[t][3] == kNoNode ? kNoCorner : corner(3));
    }
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      auto& line = f.lines.corners.emplace_back();
      for (std::size_t k = 0; k < 2; ++k)
        line[k] = index(lookup, ends_[i][k], "a node string", at_line(scanner_.path(), document_.names->line_lines, i));
    }
    heights();
    if (!dropped_.empty())
      f.warnings.push_back(text(scanner_.path(), ": cards are dropped: ", list_of({dropped_.begin(), dropped_.end()})));
    return std::move(document_);
  }

 private:
  void card(std::string_view name) {
    if (name == "ND") return node();
    if (name == "E3T" || name == "E4Q") return face(name == "E3T" ? 3 : 4);
    if (name == "NS") return node_string();
    constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kOther = {
        {{"E6T", "quadratic triangle"},
         {"E8Q", "quadratic quadrilateral"},
         {"E9Q", "quadratic quadrilateral"},
         {"E3L", "quadratic line"}}};
    for (const auto& [other, kind] : kOther) {
      if (name == other) refuse_element(scanner_.where(), scanner_.number<std::int64_t>("a number"), kind);
    }
    constexpr std::array kKnown = {"MESH2D", "MESHNAME", "NUM_MATERIALS_PER_ELEM"};
    if (std::ranges::find(kKnown, name) == kKnown.end()) dropped_.insert(name);
    scanner_.next_line();
  }
  void node() {
    document_.names->points.push_back(scanner_.number<std::int64_t>("the number of a node"));
    document_.names->point_lines.push_back(static_cast<std::int64_t>(scanner_.line()));
    const double x = scanner_.real("the x coordinate of a node");
    document_.file.points.push_back({x, scanner_.real("the y coordinate of a node")});
    z_.push_back(scanner_.real("the z coordinate of a node"));
    scanner_.next_line();
  }
  void face(std::size_t n) {
    document_.names->triangles.push_back(scanner_.number<std::int64_t>("the number of an element"));
    document_.names->triangle_lines.push_back(static_cast<std::int64_t>(scanner_.line()));
    auto& corners = corners_.emplace_back();
    corners.fill(kNoNode);
    for (std::size_t k = 0; k < n; ++k) corners[k] = scanner_.number<std::int64_t>("a node of an element");
    document_.file.triangles.tags.push_back(scanner_.more_on_line() ? scanner_.integer("the material of an element")
                                                                    : 0);
    scanner_.next_line();
  }
  /// All lines of a string: its nodes, of which the last is negative, then its number and its name if they are there.
  void node_string() {
    MeshFile& f = document_.file;
    std::optional<std::int64_t> last;
    const std::size_t first_line = ends_.size();
    for (bool ended = false; !ended;) {
      if (last && !scanner_.more_on_line()) {
        if (scanner_.peek() != "NS")
          scanner_.fail_here(ErrorCode::syntax, "expected the end of a node string, a negative node");
        static_cast<void>(scanner_.word("NS"));
      }
      const auto node = scanner_.number<std::int64_t>("a node of a node string");
      ended = node < 0;
      if (node == std::numeric_limits<std::int64_t>::min()) scanner_.fail_here(ErrorCode::syntax, "has no node ", node);
      if (last) {
        ends_.push_back({*last, std::abs(node)});
        document_.names->line_lines.push_back(static_cast<std::int64_t>(scanner_.line()));
      }
      last = std::abs(node);
    }
    if (last_tag_ < std::numeric_limits<std::int32_t>::max()) ++last_tag_;
    std::int32_t tag = last_tag_;
    const bool has_number = scanner_.more_on_line() && looks_like_number(scanner_.peek());
    if (has_number) tag = scanner_.integer("the number of a node string");
    last_tag_ = std::max(last_tag_, tag);
    if (scanner_.more_on_line()) {
      std::string_view name = scanner_.rest_of_line();
      if (name.size() > 1 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
      f.names.push_back({1, tag, std::string(name)});
    }
    f.lines.tags.resize(f.lines.tags.size() + ends_.size() - first_line, tag);
  }
  [[nodiscard]] std::int32_t index(const NumberLookup& lookup, std::int64_t number, const std::string& element,
                                   const std::string& where) const {
    if (const auto found = lookup.find(number)) return static_cast<std::int32_t>(*found);
    fail(ErrorCode::index_out_of_range, where, element, " uses vertex ", number, ", but the file has ",
         document_.file.points.size(), " vertices and not this one");
  }
  void heights() {
    MeshFile& f = document_.file;
    for (std::size_t i = 0; i < z_.size(); ++i) {
      if (!std::isfinite(z_[i]))
        fail(ErrorCode::not_finite, document_.names->point_where(i), document_.names->point(i), " has z = ", z_[i],
             ", expected a finite number");
    }
    document_.may_be_degrees = true;
    if (std::ranges::all_of(z_, [](double z) { return z == 0; })) return;
    f.z_is_data = true;
    f.point_data.push_back({std::string(kHeight), 1, std::move(z_)});
  }

  Scanner scanner_;
  Document document_;
  static constexpr std::int64_t kNoNode = std::numeric_limits<std::int64_t>::min();
  std::vector<std::array<std::int64_t, 4>> corners_;  // numbers of nodes, which may follow
  std::vector<std::array<std::int64_t, 2>> ends_;
  std::vector<double> z_;
  std::int32_t last_tag_ = 0;
  std::set<std::string_view> dropped_;
};

void write_strings(const WriteJob& job, Output& out) {
  const MeshFile& f = job.file;
  std::map<std::int32_t, std::vector<std::array<std::int32_t, 2>>> lines;  // of each tag
  for (std::size_t i = 0; i < f.lines.size(); ++i) lines[f.lines.tags[i]].push_back(f.lines[i]);
  std::vector<PhysicalName> lost;
  std::map<std::int32_t, std::string> names;
  for (const PhysicalName& n : f.names) {
    const bool written = n.dimension == 1 && lines.contains(n.tag) && names.emplace(n.tag, job.written(n.name)).second;
    if (!written) lost.push_back(n);
  }
  for (const auto& [tag, edges] : lines) {
    for (const NodeString& nodes : node_strings(edges)) {
      constexpr std::size_t kNodesALine = 10;
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const bool ends = i + 1 == nodes.size();
        out.put(i % kNodesALine == 0 ? "NS " : " ", ends ? -(nodes[i] + 1) : nodes[i] + 1);
        if (!ends && (i + 1) % kNodesALine == 0) out.put('\n');
      }
      out.put(' ', tag);
      if (const auto name = names.find(tag); name != names.end()) out.put(" \"", name->second, '"');
      out.put('\n');
    }
  }
  warn_of_names(job, lost);
}

}  // namespace

Document read_2dm(Source& source) { return Reader2dm(source).read(); }

void write_2dm(const WriteJob& job) {
  const MeshFile& f = job.file;
  Output& out = job.outputs.open(job.path);
  out.put("MESH2D\n", "");
  for (std::size_t t = 0; t < f.triangles.size(); ++t) {
    const auto [a, b, c] = f.triangles[t];
    const bool is_triangle = t < job.n_triangles();
    out.put(is_triangle ? "E3T " : "E4Q ", t + 1, ' ', a + 1, ' ', b + 1, ' ', c + 1, ' ');
    if (!is_triangle) out.put(job.fourth_corners[t - job.n_triangles()] + 1, ' ');
    out.put(f.triangles.tags.empty() ? 0 : f.triangles.tags[t], '\n');
  }
  for (std::size_t i = 0; i < f.points.size(); ++i) {
    const double z = job.heights.empty() ? f.z() : job.heights[i];
    out.put("ND ", i + 1, ' ', f.points[i].x, ' ', f.points[i].y, ' ', z, '\n');
  }
  write_strings(job, out);
}

}  // namespace temper::io
