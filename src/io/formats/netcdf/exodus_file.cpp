// Exodus II (Sandia report SAND92-2137), the meshes of MOOSE and Cubit. Numbers are from 1, those of elements count on
// from block to block.
//
//   connect1, connect2, …      nodes of the elements of a block; its attribute elem_type says their kind
//   eb_prop1  eb_names         number and name of each block: the region
//   elem_ss1 side_ss1, …       sides of elements: lines; ss_prop1 and ss_names have their tags and names
//   node_ns1, …                nodes: marked points; ns_prop1 and ns_names
//   vals_nod_var1, …           values at nodes for each time, of which the last counts; name_nod_var
//   vals_elem_var1eb1, …       values of the elements of a block; name_elem_var
#include <algorithm>
#include <array>
#include <limits>

#include "io/formats/netcdf/netcdf_extras.hpp"
#include "io/text/names.hpp"

namespace temper::io {
namespace {

class ExodusReader {
 public:
  ExodusReader(const NetcdfReader& in, const std::string& path) : in_(in), document_(new_document(path)) {}

  Document read() {
    document_.file.format = "ugrid";
    nodes();
    for (std::size_t b = 1; in_.find(text("connect", b)) != nullptr; ++b) block(b);
    document_.names->points = RunLength(1, document_.file.points.size());
    for (std::size_t s = 1; in_.find(text("elem_ss", s)) != nullptr; ++s) side_set(s);
    for (std::size_t s = 1; in_.find(text("node_ns", s)) != nullptr; ++s) node_set(s);
    data();
    return std::move(document_);
  }

 private:
  struct Element {
    std::array<std::int32_t, 4> corners = {};
    std::size_t n = 0;
    bool is_shell = false;  // its sides 1 and 2 are its faces
  };
  [[nodiscard]] const std::string& path() const { return document_.names->path; }
  void expect(bool good, std::string_view variable) const {
    if (!good) fail(ErrorCode::size_mismatch, path(), "variable ", variable, " has a wrong size");
  }
  void nodes() {
    const NetcdfVariable* const all = in_.find("coord");
    if (all != nullptr) expect(all->sizes.size() == 2 && all->sizes[0] >= 2, "coord");
    const auto values = all != nullptr ? to_doubles(in_.values(*all)) : std::vector<double>();
    const std::size_t n = all != nullptr ? all->sizes[1] : in_.variable("coordx").n_values();
    const auto axis = [&](std::size_t k) -> std::vector<double> {
      if (all != nullptr) {
        const auto first = values.begin() + static_cast<std::ptrdiff_t>(k * n);
        return k < all->sizes[0] ? std::vector(first, first + static_cast<std::ptrdiff_t>(n)) : std::vector<double>();
      }
      constexpr std::array kNames = {"coordx", "coordy", "coordz"};
      const NetcdfVariable* const v = in_.find(kNames.at(k));
      return v != nullptr ? to_doubles(in_.values(*v)) : std::vector<double>();
    };
    const auto x = axis(0), y = axis(1), z = axis(2);
    expect(y.size() == n, "coordy");
    expect(z.empty() || z.size() == n, "coordz");
    PlaneCheck plane(document_);
    for (std::size_t i = 0; i < n; ++i) {
      document_.file.points.push_back({x[i], y[i]});
      plane.add(i, z.empty() ? 0 : z[i]);
    }
  }

  /// The kind of elements is what their type begins with, as in TRI3, SHELL4 or BEAM2.
  void block(std::size_t number) {
    const NetcdfVariable& v = in_.variable(text("connect", number));
    expect(v.sizes.size() == 2, v.name);
    const std::string type = upper_case(in_.text_attribute(&v, "elem_type"));
    const std::size_t n = v.sizes[1];
    const auto is = [&](std::initializer_list<std::string_view> words) {
      return std::ranges::any_of(words, [&](std::string_view word) { return type.starts_with(word); });
    };
    const bool is_shell = is({"SHELL", "TRISHELL"}), is_face = is_shell || is({"TRI", "QUAD"});
    const bool is_known = (is_face && (n == 3 || n == 4)) || (n == 2 && is({"BAR", "BEAM", "TRUSS", "EDGE", "LINE"})) ||
                          (n == 1 && is({"SPHERE", "POINT", "CIRCLE"}));
    if (!is_known)
      refuse_element(path(), static_cast<std::int64_t>(elements_.size() + 1),
                     n == 4 && is({"TET"}) ? "tetrahedron" : text("cell of type ", type, " with ", n, " nodes"));
    const auto all = in_.integers(v);
    const std::int32_t tag = tag_of("eb", n >= 3 ? 2 : static_cast<int>(n) - 1, number);
    MeshFile& f = document_.file;
    for (std::size_t i = 0; i < v.sizes[0]; ++i) {
      Element& element = elements_.emplace_back();
      element.n = n, element.is_shell = is_shell;
      for (std::size_t k = 0; k < n; ++k)
        element.corners.at(k) = node(all[i * n + k], text("element ", elements_.size()));
      const auto [a, b, c, d] = element.corners;
      if (n >= 3) {
        document_.add_face({a, b, c}, n == 4 ? d : kNoCorner);
        document_.names->triangles.push_back(static_cast<std::int64_t>(elements_.size()));
        f.triangles.tags.push_back(tag);
      } else if (n == 2) {
        add_line(a, b, tag);
      } else {
        f.marked_points.add(a, tag);
      }
    }
    blocks_.push_back({n >= 3, v.sizes[0]});
  }
  void side_set(std::size_t number) {
    const auto elements = in_.integers(in_.variable(text("elem_ss", number)));
    const auto sides = in_.integers(in_.variable(text("side_ss", number)));
    expect(sides.size() == elements.size(), text("side_ss", number));
    const std::int32_t tag = tag_of("ss", 1, number);
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const bool exists = elements[i] >= 1 && elements[i] <= static_cast<std::int64_t>(elements_.size());
      const Element element = exists ? elements_[static_cast<std::size_t>(elements[i] - 1)] : Element();
      const std::int64_t side = sides[i] - (element.is_shell ? 2 : 0);
      if (element.n < 3 || side < 1 || side > static_cast<std::int64_t>(element.n))
        fail(ErrorCode::index_out_of_range, path(), "side set ", number, " has side ", sides[i], " of element ",
             elements[i], ", expected a side of a triangle or quadrilateral");
      const auto k = static_cast<std::size_t>(side - 1);
      add_line(element.corners.at(k), element.corners.at((k + 1) % element.n), tag);
    }
  }
  void node_set(std::size_t number) {
    const std::int32_t tag = tag_of("ns", 0, number);
    for (const std::int64_t point : in_.integers(in_.variable(text("node_ns", number)))) {
      document_.file.marked_points.add(node(point, text("node set ", number)), tag);
    }
  }
  void add_line(std::int32_t a, std::int32_t b, std::int32_t tag) { document_.file.lines.add({a, b}, tag); }
  [[nodiscard]] std::int32_t node(std::int64_t number, const std::string& user) const {
    const std::size_t n = document_.file.points.size();
    if (number < 1 || static_cast<std::uint64_t>(number) > n)
      fail(ErrorCode::index_out_of_range, path(), user, " uses vertex ", number, ", but the file has ", n,
           " vertices, numbered from 1");
    return static_cast<std::int32_t>(number - 1);
  }
  /// The number of a block or set, whose name is taken, too. Without numbers they count from 1.
  std::int32_t tag_of(std::string_view kind, std::int32_t dimension, std::size_t number) {
    const NetcdfVariable *const ids = in_.find(text(kind, "_prop1")), *const names = in_.find(text(kind, "_names"));
    const auto all = ids != nullptr ? in_.integers(*ids) : std::vector<std::int64_t>();
    const std::int64_t id = number <= all.size() ? all[number - 1] : static_cast<std::int64_t>(number);
    if (!std::in_range<std::int32_t>(id)) fail(ErrorCode::index_out_of_range, path(), kind, "_prop1 has ", id);
    const auto texts = names != nullptr ? in_.texts(*names) : std::vector<std::string>();
    const auto tag = static_cast<std::int32_t>(id);
    if (number <= texts.size() && !texts[number - 1].empty())
      document_.file.names.push_back({dimension, tag, texts[number - 1]});
    return tag;
  }

  /// The last time's values of a variable of n elements; NaN without the variable.
  [[nodiscard]] std::vector<double> last_values(const std::string& name, std::size_t n) {
    const NetcdfVariable* const v = in_.find(name);
    if (v == nullptr) {
      std::vector<double> missing(n, std::numeric_limits<double>::quiet_NaN());
      return missing;
    }
    expect(v->sizes.size() == 2 && v->sizes[1] == n && v->sizes[0] > 0, name);
    has_times_ = has_times_ || v->sizes[0] > 1;
    auto values = to_doubles(in_.values(*v));
    values.erase(values.begin(), values.end() - static_cast<std::ptrdiff_t>(n));
    return values;
  }
  [[nodiscard]] std::vector<std::string> names_of(const char* variable) const {
    const NetcdfVariable* const v = in_.find(variable);
    return v != nullptr ? in_.texts(*v) : std::vector<std::string>();
  }
  void data() {
    MeshFile& f = document_.file;
    const auto of_nodes = names_of("name_nod_var"), of_elements = names_of("name_elem_var");
    for (std::size_t i = 0; i < of_nodes.size(); ++i)
      f.point_data.push_back({of_nodes[i], 1, last_values(text("vals_nod_var", i + 1), f.points.size())});
    for (std::size_t i = 0; i < of_elements.size(); ++i) {
      std::vector<double> all;
      for (std::size_t b = 0; b < blocks_.size(); ++b) {
        if (!blocks_[b].has_faces) continue;
        const auto part = last_values(text("vals_elem_var", i + 1, "eb", b + 1), blocks_[b].n);
        all.insert(all.end(), part.begin(), part.end());
      }
      f.triangles.data.push_back({of_elements[i], 1, std::move(all)});
    }
    if (has_times_) f.warnings.push_back(text(path(), ": data of the last time are read, others are dropped"));
  }

  struct Block {
    bool has_faces = false;
    std::size_t n = 0;
  };
  const NetcdfReader& in_;
  Document document_;
  std::vector<Element> elements_;
  std::vector<Block> blocks_;
  bool has_times_ = false;
};

}  // namespace

Document read_exodus(const NetcdfReader& in, const std::string& path) { return ExodusReader(in, path).read(); }

}  // namespace temper::io
