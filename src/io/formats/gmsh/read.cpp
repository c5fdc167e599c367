// Gmsh MSH 2 and 4.1, ASCII and binary, either byte order.
//
// A physical tag is the region of a triangle or tetrahedron, or the tag of a line or point. The number of the geometric
// entity is kept as data gmsh:geometrical. NodeData and ElementData become data; the NodeData "weight" are the weights.
// Elements are sorted by their numbers: Gmsh gave them in this order, and other programs count by it. Those of higher
// order are read by their corners.
//
// The first physical group of an entity is the region, or the tag. Lines, points and tagged faces are there once more
// for each further group, as version 2 lists them. Further groups of cells are data gmsh:physical:TAG, 1 inside. Cells
// with different sets of groups are different regions, so that the boundary of each group stays. If sets have one first
// group, only one of them keeps its tag, and the data gmsh:physical:first have it for all.
//
// A partition divides entities into parts, and adds entities between the parts. A part belongs to its parent again; its
// number is the data gmsh:partition. Elements between parts are left out. So are ghosts, the cells of other parts in
// the file of one part.
//
//     surface 1, curve 5 |  gmsh    surface 3 of 1 | curve 8 of 1, | surface 4 of 1     (dimension 2 of 2, 1 of 2, …)
//                        |  ---->   curve 9 of 5   | not of a curve| curve 10 of 5
#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "io/formats/gmsh/gmsh.hpp"
#include "io/formats/gmsh/higher_order.hpp"
#include "io/formats/gmsh/reader.hpp"

namespace temper::io {
namespace {

std::string_view mesh_format_version(std::string_view head) {
  Scanner comments("", head, '#');
  comments.skip_space();
  head = comments.tail();
  const std::size_t at = head.find("$MeshFormat");
  if (at == std::string_view::npos || !head.starts_with('$')) return {};
  std::string_view rest = head.substr(at + std::string_view("$MeshFormat").size());
  const std::size_t first = rest.find_first_not_of(" \t\r\n");
  return first == std::string_view::npos ? std::string_view{} : rest.substr(first, 8);
}

class GmshReader {
 public:
  explicit GmshReader(Source& source) : in_(source), document_(new_document(source.path)) {}
  Document read() {
    while (!in_.scanner.at_end()) {
      if (in_.scanner.peek().starts_with('#')) {
        in_.scanner.next_line();
        continue;
      }
      const std::string name(in_.scanner.word("a section"));
      if (!name.starts_with('$'))
        in_.scanner.fail_here(ErrorCode::syntax, "expected a section ($…), found ", in_quotes(name));
      section(name.substr(1));
    }
    if (!has_nodes_) in_.scanner.fail_truncated("the section $Nodes");
    if (!data_) in_.scanner.fail_truncated("the section $Elements");
    finish();
    return std::move(document_);
  }

 private:
  void section(const std::string& name) {
    if (name == "MeshFormat") {
      mesh_format();
    } else if (name == "PhysicalNames") {
      physical_names();
    } else if ((name == "Entities" || name == "PartitionedEntities") && in_.is_version4) {
      entities_.read(in_, name == "PartitionedEntities", named_);
    } else if (name == "Nodes" || (name == "ParametricNodes" && !in_.is_version4)) {
      in_.is_version4 ? nodes_4() : nodes_2(name == "ParametricNodes");
      finish_nodes();
    } else if (name == "Elements") {
      if (!has_nodes_) in_.scanner.fail_here(ErrorCode::syntax, "expected $Nodes before $Elements");
      in_.is_version4 ? elements_4() : elements_2();
      finish_elements();
    } else if (name == "NodeData" || name == "ElementData") {
      if (!data_) in_.scanner.fail_here(ErrorCode::syntax, "expected $Nodes and $Elements before $", name);
      data_->read(name);
    } else {
      skip(name);
      return;
    }
    const std::string_view end = in_.scanner.word(text("$End", name));
    if (end != text("$End", name))
      fail(ErrorCode::syntax, in_.where(), "expected $End", name, ", found ", in_quotes(end));
  }
  void mesh_format() {
    const std::string version(in_.scanner.word("the version"));
    in_.is_version4 = version == "4.1";
    if (!in_.is_version4 && !version.starts_with('2')) {
      in_.scanner.fail_here(ErrorCode::unsupported, "is Gmsh MSH ", in_quotes(version), "; temper reads 2 and 4.1");
    }
    const std::int32_t type = in_.scanner.integer("the file type");
    const std::int32_t data_size = in_.scanner.integer("the data size");
    if (type != 0 && type != 1) in_.scanner.fail_here(ErrorCode::syntax, "expected file type 0 or 1, found ", type);
    if (data_size != 8) in_.scanner.fail_here(ErrorCode::unsupported, "has data of ", data_size, " bytes; expected 8");
    document_.file.format = in_.is_version4 ? "gmsh41" : "gmsh22";
    if (type == 0) return;
    in_.scanner.next_line();
    in_.is_binary = true;
    const auto one = in_.get<std::int32_t>("the number 1 in binary");
    if (one == 1) return;
    in_.is_swapped = true;
    if (one != 0x01000000) fail(ErrorCode::syntax, in_.scanner.path(), "expected the number 1 in binary, found ", one);
  }
  // Since version 2.1 `dimension tag "name"`, in 2.0 `tag "name"`.
  void physical_names() {
    const std::size_t n = in_.scanner.count("physical names", 4);
    for (std::size_t i = 0; i < n; ++i) {
      PhysicalName name;
      name.dimension = in_.scanner.integer("the dimension of a physical name");
      if (!in_.is_version4 && in_.scanner.more_on_line() && in_.scanner.peek().starts_with('"')) {
        name.tag = std::exchange(name.dimension, 0);
        name.name = in_.quoted_string();
        names_without_dimension_.push_back(std::move(name));
        continue;
      }
      name.tag = in_.scanner.integer("the tag of a physical name");
      name.name = in_.quoted_string();
      named_.emplace(name.dimension, name.tag);
      document_.file.names.push_back(std::move(name));
    }
  }
  /// A name without a dimension is for all dimensions whose elements carry its tag.
  void settle_names() {
    MeshFile& f = document_.file;
    const auto tags = std::apply(
        [](const auto&... cells) { return std::array{std::set(cells.tags.begin(), cells.tags.end())...}; }, f.cells());
    for (const PhysicalName& name : names_without_dimension_) {
      bool used = false;
      for (const std::int32_t dimension : {0, 1, 2, 3}) {
        if (!tags[static_cast<std::size_t>(dimension)].contains(name.tag)) continue;
        f.names.push_back({dimension, name.tag, name.name});
        used = true;
      }
      if (used) continue;
      f.warnings.push_back(text(in_.scanner.path(), ": the physical name ", in_quotes(name.name), " of tag ", name.tag,
                                " is dropped: it has no dimension, and no element has the tag"));
    }
  }
  void nodes_2(bool parametric) {
    const std::size_t n = in_.scanner.count("nodes", in_.is_binary ? 28 : 8);
    in_.begin_numbers();
    document_.file.points.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
      const auto number = in_.get<std::int32_t>("the number of a node");
      document_.names->points.push_back(number);
      if (!in_.is_binary) document_.names->point_lines.push_back(static_cast<std::int64_t>(in_.scanner.line()));
      const double x = in_.get<double>("the x coordinate of a node");
      const double y = in_.get<double>("the y coordinate of a node");
      add_node(x, y, in_.get<double>("the z coordinate of a node"));
      if (!parametric) continue;
      const auto dimension = in_.get<std::int32_t>("the dimension of an entity");
      in_.get<std::int32_t>("the tag of an entity");
      const int n_parameters = dimension == 1 || dimension == 2 ? dimension : 0;
      for (int k = 0; k < n_parameters; ++k) in_.get<double>("a parameter of a node");
    }
  }
  void nodes_4() {
    in_.begin_numbers();
    const std::size_t n_blocks = in_.get_count("blocks of nodes", 8, 20);
    const std::size_t total = in_.get_count("nodes", 8, 32);
    in_.get<std::uint64_t>("the least number of a node");
    in_.get<std::uint64_t>("the largest number of a node");
    document_.file.points.reserve(total);
    for (std::size_t b = 0; b < n_blocks; ++b) {
      const auto dimension = in_.get<std::int32_t>("the dimension of an entity");
      in_.get<std::int32_t>("the tag of an entity");
      const bool parametric = in_.get<std::int32_t>("0 or 1: parametric") != 0;
      const std::size_t n = in_.get_count("nodes", 8, 32);
      for (std::size_t i = 0; i < n; ++i) {
        document_.names->points.push_back(static_cast<std::int64_t>(in_.get<std::uint64_t>("the number of a node")));
      }
      for (std::size_t i = 0; i < n; ++i) {
        const double x = in_.get<double>("the x coordinate of a node");
        if (!in_.is_binary) document_.names->point_lines.push_back(static_cast<std::int64_t>(in_.scanner.line()));
        const double y = in_.get<double>("the y coordinate of a node");
        add_node(x, y, in_.get<double>("the z coordinate of a node"));
        for (int k = 0; parametric && k < dimension; ++k) in_.get<double>("a parameter of a node");
      }
    }
  }
  void elements_2() {
    const std::size_t n = in_.scanner.count("elements", in_.is_binary ? 12 : 8);
    in_.begin_numbers();
    std::int32_t type = 0, n_tags = 0;
    std::int32_t left_in_block = in_.is_binary ? 0 : std::numeric_limits<std::int32_t>::max();
    for (std::size_t i = 0; i < n; ++i) {
      if (left_in_block == 0) {
        type = in_.get<std::int32_t>("the type of elements");
        left_in_block = in_.get<std::int32_t>("the number of elements of a block");
        n_tags = in_.get<std::int32_t>("the number of tags");
        if (left_in_block <= 0) fail(ErrorCode::syntax, in_.where(), "a block has ", left_in_block, " elements");
      }
      const auto number = in_.get<std::int32_t>("the number of an element");
      if (!in_.is_binary) {
        type = in_.get<std::int32_t>("the type of an element");
        n_tags = in_.get<std::int32_t>("the number of tags");
      } else {
        --left_in_block;
      }
      if (n_tags < 0) fail(ErrorCode::syntax, in_.where(), "element ", number, " has ", n_tags, " tags");
      add_element(type, number, membership_2(type, n_tags));
    }
  }
  /// Tags: physical, entity, number of partitions, these; a negative one has the element as a ghost. Before
  /// version 2.2: physical, entity, partition.
  Membership membership_2(std::int32_t type, std::int32_t n_tags) {
    Membership of;
    int n_partitions = 0;
    for (std::int32_t k = 0; k < n_tags; ++k) {
      const auto tag = in_.get<std::int32_t>("a tag of an element");
      if (k == 0) of.physical = tag;
      if (k == 1) of.entity = tag;
      if (k == 3 || (k == 2 && n_tags == 3)) of.partition = tag;
      if (k >= 3 && tag > 0) ++n_partitions;
    }
    const std::int32_t dimension = gmsh_dimension(type);
    of.of_partition_alone = n_partitions > 1 && dimension < 2 && !named_.contains({dimension, of.physical});
    return of;
  }
  void elements_4() {
    in_.begin_numbers();
    const std::size_t n_blocks = in_.get_count("blocks of elements", 8, 20);
    in_.get_count("elements", 4, 16);
    in_.get<std::uint64_t>("the least number of an element");
    in_.get<std::uint64_t>("the largest number of an element");
    for (std::size_t b = 0; b < n_blocks; ++b) {
      const auto dimension = in_.get<std::int32_t>("the dimension of an entity");
      const auto entity = in_.get<std::int32_t>("the tag of an entity");
      const auto type = in_.get<std::int32_t>("the type of elements");
      const std::size_t n = in_.get_count("elements", 4, 16);
      const Membership of = entities_.of(dimension, entity);
      for (std::size_t i = 0; i < n; ++i) {
        const auto number = static_cast<std::int64_t>(in_.get<std::uint64_t>("the number of an element"));
        add_element(type, number, of);
      }
    }
  }
  void skip(const std::string& name) {
    const std::string at = in_.where();
    if (!in_.scanner.until(text("$End", name))) in_.scanner.fail_truncated(text("$End", name));
    if (name != "Comments" && name != "Entities")
      document_.file.warnings.push_back(text(at, ": section $", name, " is dropped"));
  }
  template <int dimension>
  static void hand_over(Elements<dimension + 1>& elements, Cells<dimension>& cells) {
    if constexpr (dimension == 0) {
      for (const auto& [node] : elements.nodes) cells.corners.push_back(node);
    } else {
      cells.corners = std::move(elements.nodes);
    }
    cells.tags = std::move(elements.physical);
    if (std::ranges::any_of(elements.geometrical, [](std::int32_t e) { return e != 0; }))
      cells.data.push_back({std::string(kGmshEntity), 1, std::move(elements.geometrical)});
  }
  template <int dimension>
  static void hand_over_cells(Elements<dimension + 1>& elements, Cells<dimension>& cells) {
    if (std::ranges::any_of(elements.partitions, [](std::int32_t p) { return p != 0; }))
      cells.data.push_back({std::string(kGmshPartition), 1, std::move(elements.partitions)});
    hand_over(elements, cells);
    // No physical group at all: no regions.
    if (std::ranges::count(cells.tags, 0) == std::ssize(cells.tags)) cells.tags.clear();
  }
  void finish() {
    settle_groups(elements_, document_, in_.allocation);
    MeshFile& f = document_.file;
    document_.fourth_corners = std::move(elements_.triangles.fourth_corners);
    hand_over_cells(elements_.triangles, f.triangles);
    hand_over_cells(elements_.tets, f.tetrahedra);
    hand_over(elements_.lines, f.lines);
    hand_over(elements_.points, f.marked_points);
    settle_names();

    FileNames& names = *document_.names;
    names.triangles = std::move(elements_.triangles.numbers);
    names.lines = std::move(elements_.lines.numbers);
    names.tetrahedra = std::move(elements_.tets.numbers);
    if (!in_.is_binary) {
      names.tetrahedron_lines = std::move(elements_.tets.text_lines);
      names.triangle_lines = std::move(elements_.triangles.text_lines);
      names.line_lines = std::move(elements_.lines.text_lines);
    }
    if (!between_corners_.empty()) drop_nodes_between_corners(document_, between_corners_);
    if (elements_.n_of_partition > 0) {
      f.warnings.push_back(text(in_.scanner.path(), ": ", elements_.n_of_partition,
                                elements_.n_of_partition == 1 ? " element" : " elements", " that the partition added ",
                                elements_.n_of_partition == 1 ? "is" : "are", " left out"));
    }
  }

  void add_node(double x, double y, double z) {
    MeshFile& f = document_.file;
    f.points.push_back({x, y});
    PlaneCheck(document_).add(f.points.size() - 1, z);
  }
  void finish_nodes() {
    if (has_nodes_) {
      fail(ErrorCode::syntax, in_.where(),
           "has two sections $Nodes; expected one mesh. Next: append views of Gmsh with PostProcessing.SaveMesh = 0");
    }
    has_nodes_ = true;
    nodes_.emplace(document_.names->points);
    if (const auto twice = nodes_->duplicate()) {
      fail(ErrorCode::syntax, in_.where(), "node number ", *twice, " is given twice");
    }
  }
  void add_element(std::int32_t type, std::int64_t number, const Membership& of) {
    if (!of.further.empty()) in_.allocation.take(of.further.size(), 1, in_.where());
    const auto line = static_cast<std::int64_t>(in_.scanner.line());
    const GmshElementType kind = gmsh_element_type(type);
    n_others_ = kind.others;
    switch (kind.linear) {
      case kGmshTetrahedron: {
        const auto corners = nodes_of<4>("tetrahedron", number);
        return of.of_partition_alone ? leave_out(number) : elements_.tets.add(corners, of, number, line);
      }
      case kGmshTriangle: {
        const auto corners = nodes_of<3>("triangle", number);
        return of.of_partition_alone ? leave_out(number) : elements_.triangles.add(corners, of, number, line);
      }
      case kGmshQuadrilateral: {
        const auto [a, b, c, d] = nodes_of<4>("quadrilateral", number);
        Membership of_face = of;
        of_face.fourth_corner = d;
        return of.of_partition_alone ? leave_out(number) : elements_.triangles.add({a, b, c}, of_face, number, line);
      }
      case kGmshLine: {
        auto ends = nodes_of<2>("line", number);
        if (of.is_reversed) std::swap(ends[0], ends[1]);
        return of.of_partition_alone ? leave_out(number) : elements_.lines.add(ends, of, number, line);
      }
      case kGmshPoint: {
        const auto point = nodes_of<1>("point element", number);
        return of.of_partition_alone ? leave_out(number) : elements_.points.add(point, of, number, line);
      }
      default:
        refuse_element(in_.where(), number, gmsh_element_name(type), KindsOfCells::all);
    }
  }
  void leave_out(std::int64_t number) {
    elements_.left_out.push_back(number);
    ++elements_.n_of_partition;
  }
  template <std::size_t N>
  [[nodiscard]] std::array<std::int32_t, N> nodes_of(std::string_view kind, std::int64_t element) {
    std::array<std::int32_t, N> nodes;
    for (std::int32_t& node : nodes) node = node_index(kind, element);
    for (std::int32_t i = 0; i < n_others_; ++i) {
      between_corners_.resize(document_.file.points.size());
      between_corners_[static_cast<std::size_t>(node_index(kind, element))] = true;
    }
    return nodes;
  }
  [[nodiscard]] std::int32_t node_index(std::string_view kind, std::int64_t element) {
    const std::int64_t number = in_.is_version4
                                    ? static_cast<std::int64_t>(in_.get<std::uint64_t>("the number of a node"))
                                    : in_.get<std::int32_t>("the number of a node");
    const auto index = nodes_->find(number);
    if (index) return static_cast<std::int32_t>(*index);
    const std::size_t n = document_.file.points.size();
    const bool contiguous = document_.names->points.counts_from(1);
    fail(ErrorCode::index_out_of_range, in_.where(), kind, " ", element, " uses vertex ", number, ", but the file has ",
         contiguous ? text(n, " vertices, numbered from 1") : "no vertex of that number");
  }
  void finish_elements() {
    if (data_) fail(ErrorCode::syntax, in_.where(), "has two sections $Elements");
    elements_.finish(in_.is_version4);
    data_.emplace(in_, document_, *nodes_, elements_);
  }
  GmshSource in_;
  Document document_;
  bool has_nodes_ = false;
  std::optional<NumberLookup> nodes_;
  GmshEntities entities_;
  std::vector<PhysicalName> names_without_dimension_;
  NamedGroups named_;
  GmshElements elements_;
  std::optional<GmshData> data_;  // when all elements are there
  std::int32_t n_others_ = 0;     // nodes of an element after its corners
  std::vector<bool> between_corners_;
};

}  // namespace

bool sniff_gmsh22(std::string_view head) { return mesh_format_version(head).starts_with("2"); }
bool sniff_gmsh41(std::string_view head) { return mesh_format_version(head).starts_with("4.1"); }

Document read_gmsh(Source& source) { return GmshReader(source).read(); }

}  // namespace temper::io
