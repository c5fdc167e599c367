// VTU, VTK's XML format for unstructured grids: the native format of temper.
//
// The file is parsed in place: one buffer holds the text, and base64 is decoded over it. Each array is unpacked once,
// and freed as soon as its numbers are in their final place. The reader takes all number types, ASCII, base64 and
// appended data (raw or base64), with zlib or without, in either byte order.
#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <pugixml.hpp>

#include "io/containers/vtu_codec.hpp"
#include "io/formats/cells.hpp"
#include "io/formats/format.hpp"
#include "io/formats/vtk/vtk_arrays.hpp"
#include "io/text/scanner.hpp"

namespace temper::io {

bool sniff_vtu(std::string_view head) {
  const std::size_t file = head.find("<VTKFile");
  return file != std::string_view::npos && head.find("UnstructuredGrid", file) != std::string_view::npos &&
         head.find("PUnstructuredGrid", file) == std::string_view::npos;
}

namespace {

/// Removes the arrays that write_vtu makes from the mesh itself.
void forget_quality(pugi::xml_node cell_data) {
  const auto array_of = [&](std::string_view name) {
    return cell_data.find_child_by_attribute("DataArray", "Name", std::string(name).c_str());
  };
  const auto type_of = [&](std::string_view name) -> std::optional<TypeOfArray> {
    const pugi::xml_node array = array_of(name);
    const auto scalar = scalar_of_vtu(array.attribute("type").value());
    if (!scalar) return std::nullopt;
    return TypeOfArray{*scalar, array.attribute("NumberOfComponents").as_int(1) > 1 ? 2 : 1};
  };
  for (const QualityArray& row : quality_among(type_of)) cell_data.remove_child(array_of(row.name));
}

class VtuReader {
 public:
  explicit VtuReader(Source& source) : source_(source), document_(new_document(source.path)) {}
  Document read() {
    parse();
    const pugi::xml_node root = xml_.child("VTKFile");
    if (!root) fail(ErrorCode::syntax, source_.path, "expected the element VTKFile");
    read_attributes(root);
    const pugi::xml_node grid = root.child("UnstructuredGrid");
    if (!grid) fail(ErrorCode::truncated, source_.path, "the element UnstructuredGrid is missing");
    read_field_data(grid);
    const pugi::xml_node piece = single_piece(grid);
    n_points_ = count_attribute(piece, "NumberOfPoints");
    n_cells_ = count_attribute(piece, "NumberOfCells");
    document_.names->points = RunLength(0, n_points_);
    read_cells(piece);  // first, since their numbers take the most memory
    read_points(piece);
    read_point_data(piece);
    take_physical_names(document_);
    take_period(document_);
    return std::move(document_);
  }

 private:
  void parse() {
    cut_off_appended_data();
    std::string& xml = head_.empty() ? source_.bytes : head_;
    // No entity or line end conversion is needed: names are plain and numbers are ours to split.
    const auto result = xml_.load_buffer_inplace(xml.data(), xml.size(), pugi::parse_minimal | pugi::parse_escapes,
                                                 pugi::encoding_utf8);
    if (result) return list_offsets();
    const auto at = static_cast<std::size_t>(std::max<std::ptrdiff_t>(result.offset, 0));
    const bool cut = at + 1 >= xml.size() || result.status == pugi::status_end_element_mismatch;
    fail(cut ? ErrorCode::truncated : ErrorCode::syntax, source_.path,
         cut ? "the XML is incomplete: " : "the XML is damaged: ", result.description(), ", at byte ", at);
  }
  void cut_off_appended_data() {
    const std::string_view all = source_.bytes;
    const std::size_t tag = all.find("<AppendedData");
    if (tag == std::string_view::npos) return;
    const std::size_t close = all.find('>', tag);
    const std::size_t mark = close == std::string_view::npos ? close : all.find('_', close);
    if (mark == std::string_view::npos) fail(ErrorCode::truncated, source_.path, "the appended data are missing");
    const std::string_view attributes = all.substr(tag, close - tag);
    appended_is_base64_ = attributes.find("base64") != std::string_view::npos;
    appended_ = all.substr(mark + 1);
    head_ = text(all.substr(0, tag), "</VTKFile>");
  }
  void list_offsets() {
    if (!appended_is_base64_) return;
    for (const pugi::xpath_node& array : xml_.select_nodes("//DataArray[@offset]"))
      offsets_.push_back(array.node().attribute("offset").as_ullong());
    std::sort(offsets_.begin(), offsets_.end());
  }
  void read_attributes(const pugi::xml_node& root) {
    const std::string_view type = root.attribute("type").value();
    if (type != "UnstructuredGrid") {
      fail(ErrorCode::unsupported, source_.path, "is a VTK XML file of type ", in_quotes(type),
           "; temper reads UnstructuredGrid");
    }
    const std::string_view header = root.attribute("header_type").as_string("UInt32");
    if (header != "UInt32" && header != "UInt64") {
      fail(ErrorCode::unsupported, source_.path, "header_type is ", in_quotes(header), "; expected UInt32 or UInt64");
    }
    header_bytes_ = header == "UInt64" ? 8 : 4;
    const std::string_view compressor = root.attribute("compressor").value();
    if (!compressor.empty() && compressor != "vtkZLibDataCompressor") {
      fail(ErrorCode::unsupported, source_.path, "is compressed with ", in_quotes(compressor),
           "; temper reads vtkZLibDataCompressor. Next: write it with that, or without compression");
    }
    compressed_ = !compressor.empty();
    const std::string_view order = root.attribute("byte_order").as_string("LittleEndian");
    if (order != "LittleEndian" && order != "BigEndian") {
      fail(ErrorCode::syntax, source_.path, "byte_order is ", in_quotes(order), "; expected LittleEndian or BigEndian");
    }
    swap_ = (order == "BigEndian") != (std::endian::native == std::endian::big);
  }
  pugi::xml_node single_piece(const pugi::xml_node& grid) {
    pugi::xml_node found;
    int pieces = 0;
    for (const pugi::xml_node piece : grid.children("Piece")) {
      if (piece.attribute("NumberOfCells").as_llong() == 0 && found) continue;
      if (!found || found.attribute("NumberOfCells").as_llong() == 0) {
        found = piece;
        pieces = 1;
      } else {
        ++pieces;
      }
    }
    if (!found) fail(ErrorCode::truncated, source_.path, "the element Piece is missing");
    if (pieces > 1) {
      fail(ErrorCode::unsupported, source_.path, "has ", pieces, " pieces; temper reads one: merge them first");
    }
    return found;
  }
  std::size_t count_attribute(const pugi::xml_node& piece, const char* name) {
    const std::string_view value = trimmed(piece.attribute(name).value());
    std::int64_t n = -1;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), n);
    if (error != std::errc() || end != value.data() + value.size() || n < 0 ||
        n > std::numeric_limits<std::int32_t>::max()) {
      fail(ErrorCode::syntax, where(piece), name, " is ", in_quotes(value), "; expected a number");
    }
    return static_cast<std::size_t>(n);
  }
  void read_points(const pugi::xml_node& piece) {
    const pugi::xml_node node = piece.child("Points").child("DataArray");
    if (!node) fail(ErrorCode::truncated, source_.path, "the array of points is missing");
    DataArray points = array(node);
    if (points.components != 3 || size(points.values) != 3 * n_points_) {
      fail(ErrorCode::size_mismatch, where(node), "the array of points has ", size(points.values), " values, expected ",
           n_points_, " times 3");
    }
    MeshFile& f = document_.file;
    f.points.reserve(n_points_);
    PlaneCheck plane(document_);
    std::visit(
        [&](const auto& v) {
          for (std::size_t i = 0; i < n_points_; ++i) {
            f.points.push_back({static_cast<double>(v[3 * i]), static_cast<double>(v[3 * i + 1])});
            plane.add(i, static_cast<double>(v[3 * i + 2]));
          }
        },
        points.values);
  }
  void read_cells(const pugi::xml_node& piece) {
    const pugi::xml_node cells = piece.child("Cells");
    CellSorter sorter(document_, source_.allocation);
    {
      const auto connectivity = integers(cells, "connectivity");
      DataArray offsets = array_of(cells, "offsets");
      if (const auto* ends = std::get_if<std::vector<std::int32_t>>(&offsets.values)) {
        sort_cells(sorter, cells, connectivity, *ends);
      } else if (const auto long_ends = to_int64(std::move(offsets.values))) {
        sort_cells(sorter, cells, connectivity, *long_ends);
      } else {
        fail(ErrorCode::index_out_of_range, where(cells.find_child_by_attribute("DataArray", "Name", "offsets")),
             "the array 'offsets' has a value that is no integer of 64 bits");
      }
    }
    forget_quality(piece.child("CellData"));
    sorter.distribute(arrays(piece.child("CellData"), n_cells_, "cell data"));
  }
  void read_point_data(const pugi::xml_node& piece) {
    take_point_data(document_, arrays(piece.child("PointData"), n_points_, "point data"));
  }
  void read_field_data(const pugi::xml_node& grid) {
    for (const pugi::xml_node node : grid.child("FieldData").children("DataArray")) {
      if (std::string_view(node.attribute("type").value()) == "String") {
        document_.file.warnings.push_back(
            text(source_.path, ": field data ", in_quotes(node.attribute("Name").value()), " is text and is dropped"));
        continue;
      }
      document_.file.field_data.push_back(array(node));
    }
  }

  DataArray array(const pugi::xml_node& node) {
    DataArray result;
    result.name = node.attribute("Name").value();
    result.components = std::max(1, node.attribute("NumberOfComponents").as_int(1));
    const std::string_view type = node.attribute("type").value();
    const auto scalar = scalar_of_vtu(type);
    if (!scalar)
      fail(ErrorCode::unsupported, where(node), "array ", in_quotes(result.name), " has the type ", in_quotes(type));
    result.values = values(node, *scalar, result.name);
    if (size(result.values) % static_cast<std::size_t>(result.components) != 0) {
      fail(ErrorCode::size_mismatch, where(node), "array ", in_quotes(result.name), " has ", size(result.values),
           " values, not a multiple of its ", result.components, " components");
    }
    return result;
  }
  std::vector<DataArray> arrays(const pugi::xml_node& parent, std::size_t tuples, std::string_view kind) {
    std::vector<DataArray> result;
    for (const pugi::xml_node node : parent.children()) {
      const std::string_view tag = node.name();
      if (tag != "DataArray" && tag != "Array") continue;
      if (tag == "Array" || std::string_view(node.attribute("type").value()) == "String") {
        document_.file.warnings.push_back(
            text(source_.path, ": ", kind, " ", in_quotes(node.attribute("Name").value()), " is text and is dropped"));
        continue;
      }
      result.push_back(array(node));
      const DataArray& last = result.back();
      const std::size_t expected = tuples * static_cast<std::size_t>(last.components);
      if (size(last.values) == expected) continue;
      fail(ErrorCode::size_mismatch, where(node), kind, " ", in_quotes(last.name), " has ", size(last.values),
           " values, expected ", tuples, " times ", last.components);
    }
    return result;
  }
  Values values(const pugi::xml_node& node, Scalar scalar, const std::string& name) {
    const std::string_view format = node.attribute("format").as_string("ascii");
    if (format == "ascii") return ascii(node, scalar);
    const Packing packing{text(source_.path, ": array ", in_quotes(name)), header_bytes_, compressed_, swap_};
    if (format == "binary") return inline_binary(node, scalar, packing);
    if (format == "appended") return appended(node, scalar, packing);
    fail(ErrorCode::syntax, where(node), "array ", in_quotes(name), " has the format ", in_quotes(format),
         "; expected ascii, binary or appended");
  }
  Values ascii(const pugi::xml_node& node, Scalar scalar) {
    Scanner scanner(source_.path, node.child_value());
    const std::string expected = text("a number of array ", in_quotes(node.attribute("Name").value()));
    return with_scalar(scalar, [&](auto zero) -> Values {
      using T = decltype(zero);
      std::vector<T> result;
      // Counting the gaps first costs a few milliseconds and saves doubling.
      const std::string_view all = trimmed(scanner.tail());
      const auto gaps = std::count_if(all.begin(), all.end(), [](char c) { return c == ' ' || c == '\n'; });
      result.reserve(all.empty() ? 0 : static_cast<std::size_t>(gaps) + 1);
      try {
        while (!scanner.at_end()) result.push_back(scanner.number<T>(expected));
      } catch (const Failure& failure) {
        fail(failure.error.code, text(source_.path, ":", line_of(node) + scanner.line() - 1), failure.error.message);
      }
      return result;
    });
  }
  Values inline_binary(const pugi::xml_node& node, Scalar scalar, const Packing& packing) {
    const std::string_view packed = trimmed(node.child_value());
    std::string& buffer = head_.empty() ? source_.bytes : head_;
    char* out = buffer.data() + (packed.empty() ? 0 : packed.data() - buffer.data());
    const auto bytes = decode_base64(packed, out);
    if (!bytes) fail(ErrorCode::syntax, packing.where, "has a character that is not base64");
    return unpack({out, *bytes}, scalar, packing, source_.allocation, source_.executor);
  }
  Values appended(const pugi::xml_node& node, Scalar scalar, const Packing& packing) {
    const std::string_view attribute = node.attribute("offset").value();
    std::uint64_t offset = 0;
    const auto [end, error] = std::from_chars(attribute.data(), attribute.data() + attribute.size(), offset);
    if (error != std::errc() || end == attribute.data()) {
      fail(ErrorCode::syntax, packing.where, "has the offset ", in_quotes(attribute));
    }
    if (offset > appended_.size()) {
      fail(ErrorCode::truncated, packing.where, "starts at byte ", offset, " of the appended data, which have only ",
           appended_.size());
    }
    const std::string_view from = appended_.substr(static_cast<std::size_t>(offset));
    if (!appended_is_base64_) return unpack(from, scalar, packing, source_.allocation, source_.executor);
    // Base64 ends at the start of the next array. More text behind it does no harm, as the header gives the decoder the
    // length. Not in place: two arrays may share their bytes.
    const std::string_view only = from.substr(0, from.find('<'));
    const auto next = std::upper_bound(offsets_.begin(), offsets_.end(), offset);
    const auto most = static_cast<std::size_t>(
        next == offsets_.end() ? only.size() : std::min<std::uint64_t>(only.size(), *next - offset));
    source_.allocation.take(most, 1, packing.where);
    std::string bytes(most, '\0');
    const auto n = decode_base64(trimmed(only.substr(0, most)), bytes.data());
    if (!n) fail(ErrorCode::syntax, packing.where, "has a character that is not base64");
    return unpack(std::string_view(bytes).substr(0, *n), scalar, packing, source_.allocation, source_.executor);
  }
  DataArray array_of(const pugi::xml_node& cells, const char* name) {
    const pugi::xml_node node = cells.find_child_by_attribute("DataArray", "Name", name);
    if (!node) fail(ErrorCode::truncated, source_.path, "the array ", in_quotes(name), " of the cells is missing");
    return array(node);
  }
  std::vector<std::int32_t> integers(const pugi::xml_node& cells, const char* name) {
    DataArray found = array_of(cells, name);
    if (auto* same = std::get_if<std::vector<std::int32_t>>(&found.values)) return std::move(*same);
    auto converted = to_int32(found.values);
    if (!converted) {
      fail(ErrorCode::index_out_of_range, where(cells.find_child_by_attribute("DataArray", "Name", name)), "the array ",
           in_quotes(name), " has a value beyond 32 bits");
    }
    return std::move(*converted);
  }
  /// Three points per triangle overflow 32 bits long before the number of triangles does.
  template <class Integer>
  void sort_cells(CellSorter& sorter, const pugi::xml_node& cells, const std::vector<std::int32_t>& connectivity,
                  const std::vector<Integer>& ends) {
    const auto types = integers(cells, "types");
    if (ends.size() != n_cells_ || types.size() != n_cells_) {
      fail(ErrorCode::size_mismatch, where(cells), "has ", ends.size(), " offsets and ", types.size(),
           " types, expected ", n_cells_, " of each");
    }
    sorter.reserve(n_cells_);
    Integer start = 0;
    for (std::size_t i = 0; i < n_cells_; ++i) {
      const Integer end = ends[i];
      if (end < start || static_cast<std::size_t>(end) > connectivity.size()) {
        fail(ErrorCode::index_out_of_range, source_.path, "element ", i, " ends at ", end, " of ", connectivity.size(),
             " connectivity values, and starts at ", start);
      }
      sorter.add(types[i], connectivity.data() + start, static_cast<std::size_t>(end - start), source_.path);
      start = end;
    }
  }

  // The document shrinks as it is parsed in place, so lines are counted in the file itself, and only for an error.
  [[nodiscard]] std::size_t line_of(const pugi::xml_node& node) const {
    const auto offset = static_cast<std::size_t>(std::max<std::ptrdiff_t>(node.offset_debug(), 0));
    try {
      const Source again = load(source_.path);
      const auto end = again.bytes.begin() + static_cast<std::ptrdiff_t>(std::min(offset, again.bytes.size()));
      return 1 + static_cast<std::size_t>(std::count(again.bytes.begin(), end, '\n'));
    } catch (const Failure&) {
      return 1;
    }
  }
  [[nodiscard]] std::string where(const pugi::xml_node& node) const { return text(source_.path, ":", line_of(node)); }

  Source& source_;
  Document document_;
  pugi::xml_document xml_;
  std::string head_;           // the XML before appended data
  std::string_view appended_;  // what follows its underscore
  bool appended_is_base64_ = false;
  std::vector<std::uint64_t> offsets_;  // of all arrays in appended base64, in order
  std::size_t header_bytes_ = 4;
  bool compressed_ = false, swap_ = false;
  std::size_t n_points_ = 0, n_cells_ = 0;
};

}  // namespace

Document read_vtu(Source& source) { return VtuReader(source).read(); }

}  // namespace temper::io
