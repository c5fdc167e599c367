// Wavefront OBJ: v, f, l and p; everything about texture and shading is ignored.
//
// Vertices count from 1; negative numbers count back from the last one. A group line `g` starts a region or a tag.
//   g region_7 inlet     temper's own: the number, then its physical name if there is one (line_…, point_… likewise)
//   g inlet              any other name: numbered from 1 in the order of appearance, the name becomes a physical name
#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "io/conversion/globe.hpp"
#include "io/formats/format.hpp"
#include "io/text/names.hpp"
#include "io/text/scanner.hpp"

namespace temper::io {

bool sniff_obj(std::string_view head) {
  Scanner scanner("", head, '#');
  constexpr std::array<std::string_view, 9> kFirst = {"v", "vn", "vt", "o", "g", "mtllib", "usemtl", "s", "f"};
  const std::string_view word = scanner.peek();
  return std::find(kFirst.begin(), kFirst.end(), word) != kFirst.end();
}

namespace {

constexpr std::array<std::string_view, 3> kGroupPrefix = {"point_", "line_", "region_"};

class ObjReader {
 public:
  explicit ObjReader(Source& source)
      : scanner_(source.path, source.bytes, '#'), document_(new_document(source.path)), plane_(document_) {}
  Document read() {
    while (!scanner_.at_end()) statement(scanner_.word("a statement"));
    if (!has_regions_) document_.file.triangles.tags.clear();
    if (!ignored_.empty()) {
      std::string names;
      for (const std::string& name : ignored_) names += text(names.empty() ? "" : ", ", name);
      document_.file.warnings.push_back(text(scanner_.path(), ": statements that are no mesh are dropped: ", names));
    }
    FileNames& names = *document_.names;
    names.triangles = RunLength(1, document_.file.triangles.size());
    names.lines = RunLength(1, document_.file.lines.size());
    return std::move(document_);
  }

 private:
  void statement(std::string_view word) {
    if (word == "v") return vertex();
    if (word == "f") return face();
    if (word == "l") return line();
    if (word == "g") return group();
    if (word == "p") {
      while (scanner_.more_on_line()) {
        document_.file.marked_points.add(index(), tags_[0]);
        keep_name(0);
      }
      return;
    }
    constexpr std::array<std::string_view, 12> kIgnored = {"vt",     "vn", "vp",  "o",      "s",      "usemtl",
                                                           "mtllib", "fo", "lod", "usemap", "maplib", "bevel"};
    if (std::find(kIgnored.begin(), kIgnored.end(), word) == kIgnored.end()) {
      scanner_.fail_here(ErrorCode::syntax, "expected a statement of OBJ, found ", in_quotes(word));
    }
    ignore(word);
    scanner_.next_line();
  }
  void ignore(std::string_view word) {
    if (std::find(ignored_.begin(), ignored_.end(), word) == ignored_.end()) ignored_.emplace_back(word);
  }
  void vertex() {
    FileNames& names = *document_.names;
    const double x = scanner_.real("the x coordinate of a vertex");
    names.points.push_back(static_cast<std::int64_t>(document_.file.points.size()) + 1);
    names.point_lines.push_back(static_cast<std::int64_t>(scanner_.line()));
    document_.file.points.push_back({x, scanner_.real("the y coordinate of a vertex")});
    const double z = scanner_.more_on_line() ? scanner_.real("the z coordinate of a vertex") : 0;
    plane_.add(document_.file.points.size() - 1, z);
    if (scanner_.more_on_line()) ignore("numbers after z");
    while (scanner_.more_on_line()) static_cast<void>(scanner_.real("a color"));
  }
  void face() {
    MeshFile& f = document_.file;
    std::array<std::int32_t, 4> corners = {};
    std::size_t n = 0;
    const auto text_line = static_cast<std::int64_t>(scanner_.line());
    for (; scanner_.more_on_line(); ++n) {
      const std::int32_t p = index();
      if (n < 4) corners[n] = p;
    }
    if (n != 3 && n != 4) {
      fail(n > 4 ? ErrorCode::unsupported : ErrorCode::syntax, text(scanner_.path(), ":", text_line), "face ",
           f.triangles.size() + 1, " has ", n, " corners; temper reads triangles and quadrilaterals");
    }
    document_.add_face({corners[0], corners[1], corners[2]}, n == 4 ? corners[3] : kNoCorner);
    f.triangles.tags.push_back(tags_[2]);
    document_.names->triangle_lines.push_back(text_line);
    has_regions_ = has_regions_ || in_region_ || tags_[2] != 0;
    keep_name(2);
  }
  void line() {
    MeshFile& f = document_.file;
    std::int32_t last = -1;
    while (scanner_.more_on_line()) {
      const std::int32_t p = index();
      if (last >= 0) {
        f.lines.add({last, p}, tags_[1]);
        document_.names->line_lines.push_back(static_cast<std::int64_t>(scanner_.line()));
        keep_name(1);
      }
      last = p;
    }
  }
  void group() {
    const std::string_view all = scanner_.more_on_line() ? scanner_.rest_of_line() : std::string_view{};
    const std::size_t blank = all.find(' ');
    const std::string_view first = all.substr(0, blank);
    group_name_.clear();
    tags_ = {0, 0, 0};
    in_region_ = false;
    if (first.empty() || first == "default") return;
    for (std::size_t dimension = 0; dimension < 3; ++dimension) {
      if (!first.starts_with(kGroupPrefix[dimension])) continue;
      const std::string_view number = first.substr(kGroupPrefix[dimension].size());
      std::int32_t& tag = tags_[dimension];
      if (const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), tag);
          error != std::errc() || end != number.data() + number.size()) {
        tag = 0;
        continue;
      }
      if (blank != std::string_view::npos) group_name_ = all.substr(blank + 1);
      in_region_ = dimension == 2;
      return;
    }
    group_name_ = all;
    const auto known = tag_of_name_.find(group_name_);
    const std::int32_t tag = known != tag_of_name_.end() ? known->second : ++last_number_;
    tags_ = {tag, tag, tag};
  }
  // An index is 12, 12/3, 12//4, 12/3/4, or negative: only the vertex matters.
  std::int32_t index() {
    const std::string_view word = scanner_.word("a vertex number");
    const std::string_view number = word.substr(0, word.find('/'));
    std::int32_t value = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (error != std::errc() || end != number.data() + number.size()) {
      scanner_.fail_here(ErrorCode::syntax, "expected a vertex number, found ", in_quotes(word));
    }
    const auto so_far = static_cast<std::int32_t>(document_.file.points.size());
    if (value == 0 || -std::int64_t{value} > so_far) {
      scanner_.fail_here(ErrorCode::index_out_of_range, "uses vertex ", value, ", but ", so_far,
                         " vertices came before, numbered from 1 (or -1, backwards)");
    }
    return value > 0 ? value - 1 : so_far + value;
  }
  void keep_name(int dimension) {
    if (group_name_.empty()) return;
    const std::int32_t tag = tags_[static_cast<std::size_t>(dimension)];
    if (!named_.emplace(dimension, tag).second) return;
    document_.file.names.push_back({dimension, tag, group_name_});
    tag_of_name_.emplace(group_name_, tag);
  }

  Scanner scanner_;
  Document document_;
  PlaneCheck plane_;
  std::string group_name_;                        // physical name of the current group, or empty
  std::array<std::int32_t, 3> tags_ = {0, 0, 0};  // of the current group, by dimension
  std::int32_t last_number_ = 0;
  std::map<std::string, std::int32_t> tag_of_name_;  // of the names that are kept
  std::set<std::pair<int, std::int32_t>> named_;     // dimension and tag of each
  bool in_region_ = false;                           // the current group is temper's own `g region_…`, maybe of tag 0
  bool has_regions_ = false;
  std::vector<std::string> ignored_;
};

// --- writing ---------------------------------------------------------------------------------------------

/// Writes elements of one dimension after the other, each under the group line of its tag.
class ObjWriter {
 public:
  explicit ObjWriter(const WriteJob& job) : job_(job), file_(job.file), out_(job.outputs.open(job.path)) {
    for (const PhysicalName& n : file_.names) name_of_.emplace(std::pair(n.dimension, n.tag), n.name);
  }

  void write() {
    const MeshFile& f = file_;
    for (std::size_t i = 0; i < f.points.size(); ++i) {
      const Vec3 p = job_.place(i);
      out_.put("v ", p.x, ' ', p.y, ' ', p.z, '\n');
    }
    for (std::size_t i = 0; i < f.triangles.size(); ++i) {
      if (!f.triangles.tags.empty()) group(2, f.triangles.tags[i]);
      const auto& t = f.triangles[i];
      out_.put("f ", t[0] + 1, ' ', t[1] + 1, ' ', t[2] + 1, '\n');
    }
    for (std::size_t i = 0; i < f.lines.size(); ++i) {
      group(1, f.lines.tags[i]);
      out_.put("l ", f.lines[i][0] + 1, ' ', f.lines[i][1] + 1, '\n');
    }
    for (std::size_t i = 0; i < f.marked_points.size(); ++i) {
      group(0, f.marked_points.tags[i]);
      out_.put("p ", f.marked_points[i] + 1, '\n');
    }
    warn_of_unused_names();
  }

 private:
  using Group = std::pair<int, std::int32_t>;  // dimension and tag

  /// The group line, when the previous element was in another group.
  void group(int dimension, std::int32_t tag) {
    const Group next(dimension, tag);
    if (last_ == next) return;
    last_ = next;
    used_.insert(next);
    out_.put("g ", kGroupPrefix[static_cast<std::size_t>(dimension)], tag);
    if (const auto name = name_of_.find(next); name != name_of_.end()) out_.put(' ', name->second);
    out_.put('\n');
  }

  void warn_of_unused_names() {
    std::vector<std::string_view> unused;
    for (const PhysicalName& n : file_.names) {
      if (!used_.contains({n.dimension, n.tag})) unused.push_back(n.name);
    }
    if (!unused.empty()) job_.warn("physical names of nothing are not written: ", list_of(unused));
  }

  const WriteJob& job_;
  const MeshFile& file_;
  Output& out_;
  std::map<Group, std::string_view> name_of_;
  std::optional<Group> last_;
  std::set<Group> used_;
};

}  // namespace

Document read_obj(Source& source) { return ObjReader(source).read(); }

void write_obj(const WriteJob& job) { ObjWriter(job).write(); }

}  // namespace temper::io
