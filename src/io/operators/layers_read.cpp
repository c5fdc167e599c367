// Layers as a CSV file: temper/detail/dec_io.hpp has an example.
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "io/disk/files.hpp"
#include "io/text/file_names.hpp"
#include "io/text/scanner.hpp"
#include "temper/detail/dec_io.hpp"

namespace temper::io {
namespace {

constexpr std::size_t kMostCells = (std::size_t{1} << 31) - 1;  // as columns() has it

std::ptrdiff_t offset(VertexId v, std::size_t each) { return static_cast<std::ptrdiff_t>(v.index * each); }

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t at = 0; at != std::string_view::npos;) {
    const std::size_t comma = line.find(',', at);
    fields.push_back(trimmed(line.substr(at, comma == std::string_view::npos ? comma : comma - at)));
    at = comma == std::string_view::npos ? comma : comma + 1;
  }
  return fields;
}

/// The vertices of a mesh by the numbers of its file.
class VertexLookup {
 public:
  VertexLookup(const MeshFile& file, const LoadedMesh& loaded)
      : loaded_(loaded), numbers_(numbers_of(file)), lookup_(numbers_) {}
  [[nodiscard]] std::optional<VertexId> find(std::int64_t number) const {
    const auto point = lookup_.find(number);
    if (!point || *point >= loaded_.vertex_of_point.size() || loaded_.vertex_of_point[*point] < 0) return {};
    return VertexId(static_cast<std::size_t>(loaded_.vertex_of_point[*point]));
  }
  /// The numbers of the first points whose vertices are marked, for a message.
  [[nodiscard]] std::string numbers_where(const IdVector<VertexId, char>& marked) const {
    constexpr std::size_t kShown = 3;
    std::size_t n = 0;
    std::string shown;
    for (std::size_t point = 0; point < loaded_.vertex_of_point.size(); ++point) {
      const std::int32_t v = loaded_.vertex_of_point[point];
      if (v < 0 || marked[VertexId(static_cast<std::size_t>(v))] == 0) continue;
      if (n++ < kShown) shown += text(shown.empty() ? "" : ", ", numbers_[static_cast<std::int64_t>(point)]);
    }
    return n <= kShown ? shown : text(shown, " and ", n - kShown, " others");
  }

 private:
  static RunLength numbers_of(const MeshFile& file) {
    const auto* known = dynamic_cast<const FileNames*>(file.numbering.get());
    return known != nullptr ? known->points : RunLength(0, file.points.size());
  }

  const LoadedMesh& loaded_;
  RunLength numbers_;
  NumberLookup lookup_;
};

class LayersReader {
 public:
  LayersReader(const Source& source, const MeshFile& file, const LoadedMesh& loaded)
      : scanner_(source.path, source.bytes),
        mesh_path_(file.path),
        n_vertices_(loaded.mesh.n_vertices()),
        vertices_(file, loaded) {}
  Layers read() {
    read_titles();
    if (layers_.n_layers > kMostCells / std::max<std::size_t>(n_vertices_, 1))
      fail_line(ErrorCode::unsupported, layers_.n_layers, " layers are too many for ", n_vertices_, " vertices");
    while (next_line()) read_row();
    if (!begun_) begin_rows();
    check_all_given();
    return std::move(layers_);
  }

 private:
  /// The next line that is neither empty nor a comment.
  bool next_line() {
    while (scanner_.remaining() > 0) {
      line_ = scanner_.line();
      const std::string_view content = scanner_.rest_of_line();
      if (content.empty() || content.front() == '#') continue;
      fields_ = fields_of(content);
      return true;
    }
    return false;
  }
  template <class... Parts>
  [[noreturn]] void fail_line(ErrorCode code, const Parts&... message) const {
    fail(code, text(scanner_.path(), ":", line_), message...);
  }
  template <class... Parts>
  [[noreturn]] void fail_field(ErrorCode code, std::size_t column, const Parts&... message) const {
    fail_line(code, "column ", column + 1, " (", in_quotes(titles_[column]), "), ", row_, ": ", message...);
  }
  void read_titles() {
    if (!next_line())
      fail(ErrorCode::empty_input, scanner_.path(), "expected a title line 'vertex,top,bottom 1', found none");
    for (const std::string_view title : fields_) titles_.emplace_back(title);
    const auto expect = [&](std::size_t column, bool good, std::string_view expected) {
      const std::string found = column < titles_.size() ? in_quotes(titles_[column]) : "the end of the line";
      if (!good)
        fail_line(ErrorCode::syntax, "column ", column + 1, ": expected the title ", expected, ", found ", found);
    };
    const auto begins = [&](std::size_t column, std::string_view word) {
      return column < titles_.size() && titles_[column].starts_with(word);
    };
    expect(0, begins(0, "vertex"), "'vertex'");
    expect(1, begins(1, "top"), "'top'");
    std::size_t column = 2;
    while (begins(column, "bottom")) ++column;
    layers_.n_layers = column - 2;
    expect(column, layers_.n_layers > 0, "'bottom 1'");
    has_active_ = column < titles_.size();
    if (has_active_) expect(column, begins(column, "active"), "'bottom' or 'active'");
    while (begins(column, "active")) ++column;
    expect(column, column == titles_.size() && column == n_columns(),
           has_active_ ? text("'active' for each of ", layers_.n_layers, " layers, and no other")
                       : "'bottom' or 'active'");
  }
  void read_row() {
    const bool common = fields_[0] == "*";
    row_ = common ? "row *" : text("vertex ", fields_[0]);
    if (fields_.size() != n_columns())
      fail_line(ErrorCode::syntax, row_, ": expected ", n_columns(), " columns, found ", fields_.size());
    const VertexId v = common ? VertexId() : vertex();
    if (common && (has_common_ || begun_))
      fail_line(ErrorCode::syntax, "the row * has to come once, before all others");
    if (!common && !begun_) begin_rows();
    if (!common && line_of_[v] != 0)
      fail_line(ErrorCode::duplicate_point, row_, " has its row in line ", line_of_[v], " already");
    std::vector<double> heights;
    std::vector<std::uint8_t> active;
    for (std::size_t i = 0; i < layers_.n_surfaces(); ++i) heights.push_back(height(1 + i));
    for (std::size_t i = 0; has_active_ && i < layers_.n_layers; ++i)
      active.push_back(activity(1 + layers_.n_surfaces() + i));
    if (const auto fault = fault_of_surfaces(heights)) fail_line(ErrorCode::invalid_option, row_, ": ", *fault);
    if (common) {
      has_common_ = true;
      common_heights_ = std::move(heights);
      common_active_ = std::move(active);
      return;
    }
    line_of_[v] = line_;
    std::copy(heights.begin(), heights.end(), layers_.surfaces.begin() + offset(v, layers_.n_surfaces()));
    std::copy(active.begin(), active.end(), layers_.active.begin() + offset(v, has_active_ ? layers_.n_layers : 0));
  }
  /// A number of the row, or of the row * if the field is empty.
  [[nodiscard]] double height(std::size_t column) const {
    const std::string_view field = fields_[column];
    if (field.empty()) {
      if (has_common_) return common_heights_[column - 1];
      fail_field(ErrorCode::syntax, column, "is empty, and there is no row * with its default");
    }
    double value = 0;
    const auto [end, error] = read_number(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size())
      fail_field(ErrorCode::syntax, column, "expected a height, found ", in_quotes(field));
    if (std::isinf(value))
      fail_field(ErrorCode::not_finite, column, "expected a height or nan, found ", in_quotes(field));
    return value;
  }
  [[nodiscard]] std::uint8_t activity(std::size_t column) const {
    const std::string_view field = fields_[column];
    if (field.empty()) {
      if (has_common_) return common_active_[column - 1 - layers_.n_surfaces()];
      fail_field(ErrorCode::syntax, column, "is empty, and there is no row * with its default");
    }
    if (field != "0" && field != "1")
      fail_field(ErrorCode::syntax, column, "expected 0 or 1, found ", in_quotes(field));
    return field == "1" ? 1 : 0;
  }
  [[nodiscard]] VertexId vertex() const {
    const std::string_view field = fields_[0];
    std::int64_t number = 0;
    const auto [end, error] = read_number(field.data(), field.data() + field.size(), number);
    if (error != std::errc() || end != field.data() + field.size())
      fail_line(ErrorCode::syntax, "column 1 ('vertex'): expected the number of a vertex, or *, found ",
                in_quotes(field));
    const auto v = vertices_.find(number);
    if (!v) fail_line(ErrorCode::index_out_of_range, mesh_path_, " has no vertex ", number, " in a triangle");
    return *v;
  }
  /// Gives all vertices the values of the row *, if there is one.
  void begin_rows() {
    begun_ = true;
    line_of_.assign(n_vertices_, 0);
    layers_.surfaces.resize(n_vertices_ * layers_.n_surfaces());
    if (has_active_) layers_.active.resize(n_vertices_ * layers_.n_layers);
    if (!has_common_) return;
    for (std::size_t i = 0; i < layers_.surfaces.size(); ++i)
      layers_.surfaces[i] = common_heights_[i % layers_.n_surfaces()];
    for (std::size_t i = 0; i < layers_.active.size(); ++i) layers_.active[i] = common_active_[i % layers_.n_layers];
  }
  void check_all_given() const {
    if (has_common_) return;
    IdVector<VertexId, char> missing(n_vertices_, 0);
    std::size_t n = 0;
    for (std::size_t v = 0; v < n_vertices_; ++v) {
      if (line_of_[VertexId(v)] != 0) continue;
      missing[VertexId(v)] = 1;
      ++n;
    }
    if (n == 0) return;
    fail(ErrorCode::size_mismatch, scanner_.path(), "has no row for ", n == 1 ? "vertex " : "vertices ",
         vertices_.numbers_where(missing), " of ", mesh_path_, ", and no row * with their default");
  }
  [[nodiscard]] std::size_t n_columns() const {
    return 1 + layers_.n_surfaces() + (has_active_ ? layers_.n_layers : 0);
  }

  Scanner scanner_;
  const std::string& mesh_path_;
  const std::size_t n_vertices_;
  const VertexLookup vertices_;
  std::size_t line_ = 0;                  // of the row at hand
  std::vector<std::string_view> fields_;  // of that row
  std::string row_;                       // "vertex 17"
  std::vector<std::string> titles_;
  bool has_active_ = false, has_common_ = false, begun_ = false;
  std::vector<double> common_heights_;  // of the row *
  std::vector<std::uint8_t> common_active_;
  IdVector<VertexId, std::size_t> line_of_;  // 0: none
  Layers layers_;
};

}  // namespace

Expected<Layers> read_layers(const std::string& path, const MeshFile& file, const LoadedMesh& loaded) {
  return guarded<Layers>(path, [&] {
    const Source source = load(path);
    return LayersReader(source, file, loaded).read();
  });
}

}  // namespace temper::io
