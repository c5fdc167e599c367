// The .mesh of MIKE 21 and MIKE 3 FM: nodes with codes, then triangles and quadrilaterals (DHI, "Scientific
// documentation of flexible mesh").
//
//   100079 1000 12 UTM-33        item and unit of z (bathymetry in meters), nodes, projection; before 2012: 12 UTM-33
//   1 0.5 0.25 -3.5 1            a node: number, x, y, z of the bed, positive up, code
//   9 4 25                       elements, most nodes of one, type: 21 of triangles, 25 with quadrilaterals
//   1 11 8 10 12                 an element: number, nodes counter-clockwise; of a triangle the fourth node is 0
//
// Code 0 is inside, 1 is land, and larger codes are boundaries with water. See boundary_codes.hpp.
#include <algorithm>
#include <array>
#include <cmath>

#include "io/formats/boundary_codes.hpp"
#include "io/text/scanner.hpp"
#include "io/text/values.hpp"

namespace temper::io {
namespace {

constexpr std::string_view kMikeProjection = "mike:projection";  // field data: bytes
constexpr std::string_view kMikeItem = "mike:item";              // field data: item and unit of z; 0 in an old file
constexpr std::int32_t kBathymetry = 100079, kMeter = 1000;
constexpr std::string_view kMikeDegrees = "LONG/LAT", kMikeLocal = "NON-UTM";
constexpr CodeRules kMikeCodes = {.wall = 1, .name = "open boundary, code "};

bool is_digits(std::string_view word) {
  return !word.empty() && word.find_first_not_of("0123456789") == std::string_view::npos;
}

/// The numbers before the projection: three, or one in an old file. Another number: this is no header.
std::size_t numbers_of_header(std::string_view line) {
  Scanner scanner("", line);
  std::size_t n = 0;
  while (is_digits(scanner.peek())) {
    static_cast<void>(scanner.word("a number"));
    ++n;
  }
  return scanner.peek().empty() ? 0 : n;
}

class MikeReader {
 public:
  explicit MikeReader(Source& source) : scanner_(source.path, source.bytes), document_(new_document(source.path)) {}

  Document read() {
    const std::size_t n = header();
    std::vector<std::int32_t> codes(n);
    document_.file.points.reserve(n);
    std::vector<double> z(n);
    for (std::size_t i = 0; i < n; ++i) node(z[i], codes[i]);
    elements();
    if (!scanner_.at_end())
      scanner_.fail_here(ErrorCode::syntax, "expected the end of the file after ", document_.file.triangles.size(),
                         " elements, found ", in_quotes(scanner_.peek()));
    take_codes(document_, codes, kMikeCodes);
    if (std::ranges::any_of(z, [](double height) { return height != 0; })) {
      document_.file.z_is_data = true;
      document_.file.positive = Positive::up;
      document_.file.point_data.push_back({std::string(kHeight), 1, std::move(z)});
    }
    return std::move(document_);
  }

 private:
  /// Returns the number of nodes. What the writer gives to other meshes, too, needs no data.
  std::size_t header() {
    MeshFile& f = document_.file;
    std::vector<std::int32_t> item = {0, 0};
    if (numbers_of_header(scanner_.tail().substr(0, scanner_.tail().find('\n'))) == 3)
      item = {scanner_.integer("the item of z"), scanner_.integer("the unit of z")};
    if (item[1] != kMeter && item[1] != 0)
      f.warnings.push_back(text(scanner_.where(), ": z has the unit ", item[1], " of DHI, not meters (", kMeter, ")"));
    if (item != std::vector{kBathymetry, kMeter}) f.field_data.push_back({std::string(kMikeItem), 1, std::move(item)});
    const std::size_t n = scanner_.count("nodes", 10);
    const std::string_view projection = scanner_.rest_of_line();
    if (projection == kMikeDegrees || projection.starts_with("GEOGCS[")) f.points_in = DegreePoints{};
    if (projection != kMikeLocal)
      f.field_data.push_back(
          {std::string(kMikeProjection), 1, std::vector<std::uint8_t>(projection.begin(), projection.end())});
    return n;
  }
  void node(double& z, std::int32_t& code) {
    FileNames& names = *document_.names;
    names.points.push_back(scanner_.number<std::int64_t>("the number of a node"));
    names.point_lines.push_back(static_cast<std::int64_t>(scanner_.line()));
    const double x = scanner_.real("the x coordinate of a node");
    document_.file.points.push_back({x, scanner_.real("the y coordinate of a node")});
    z = scanner_.real("the z coordinate of a node");
    if (!std::isfinite(z))
      scanner_.fail_here(ErrorCode::not_finite, "node ",
                         names.points[static_cast<std::int64_t>(names.points.size()) - 1], " has z = ", z,
                         ", expected a finite number");
    code = scanner_.integer("the code of a node");
    if (scanner_.more_on_line())
      scanner_.fail_here(ErrorCode::syntax, "expected a node of five numbers: number, x, y, z and code");
  }
  void elements() {
    const NumberLookup nodes(document_.names->points);
    if (const auto twice = nodes.duplicate()) fail(ErrorCode::syntax, scanner_.path(), "has node ", *twice, " twice");
    const std::size_t n = scanner_.count("elements", 8);
    const std::int32_t most = scanner_.integer("the number of nodes of an element");
    const std::int32_t type = scanner_.integer("the type of elements");
    constexpr std::int32_t kTriangleType = 21, kMixedType = 25;
    if ((type != kTriangleType && type != kMixedType) || most < 3 || most > 4)
      scanner_.fail_here(ErrorCode::unsupported, "has elements of type ", type, " with ", most,
                         " nodes; expected type 21 of triangles, or 25 of triangles and quadrilaterals");
    for (std::size_t i = 0; i < n; ++i) element(nodes);
  }
  void element(const NumberLookup& nodes) {
    FileNames& names = *document_.names;
    const auto number = scanner_.number<std::int64_t>("the number of an element");
    names.triangles.push_back(number);
    names.triangle_lines.push_back(static_cast<std::int64_t>(scanner_.line()));
    std::array<std::int32_t, 4> corners = {0, 0, 0, kNoCorner};
    std::size_t n = 0;
    for (; n < 3 || scanner_.more_on_line(); ++n) {
      const auto node = scanner_.number<std::int64_t>("a node of an element");
      if (n > 3) scanner_.fail_here(ErrorCode::syntax, "element ", number, " has more than four nodes");
      if (n == 3 && node == 0) continue;
      const auto found = nodes.find(node);
      if (!found)
        scanner_.fail_here(ErrorCode::index_out_of_range, "element ", number, " uses node ", node,
                           ", but the file has ", document_.file.points.size(), " nodes and not this one");
      corners[n] = static_cast<std::int32_t>(*found);
    }
    document_.add_face({corners[0], corners[1], corners[2]}, corners[3]);
  }

  Scanner scanner_;
  Document document_;
};

/// The first line: item and unit unless the file was an old one, the number of nodes, the projection.
std::string mike_header(const MeshFile& f) {
  const DataArray* const projection = find(f.field_data, kMikeProjection);
  const auto* const bytes =
      projection == nullptr ? nullptr : std::get_if<std::vector<std::uint8_t>>(&projection->values);
  const DataArray* const item = find(f.field_data, kMikeItem);
  std::vector<std::int32_t> numbers =
      item == nullptr ? std::vector<std::int32_t>{} : to_int32(item->values).value_or(std::vector<std::int32_t>{});
  if (numbers.size() != 2) numbers = {kBathymetry, kMeter};
  const std::string before = numbers[0] == 0 ? "" : text(numbers[0], " ", numbers[1], " ");
  const std::string name = bytes == nullptr ? std::string(f.degrees() != nullptr ? kMikeDegrees : kMikeLocal)
                                            : std::string(bytes->begin(), bytes->end());
  return text(before, f.points.size(), " ", name, "\n");
}

}  // namespace

bool sniff_mike(std::string_view head) {
  const std::size_t end = head.find('\n');
  if (end == std::string_view::npos) return false;
  const std::size_t numbers = numbers_of_header(head.substr(0, end));
  if (numbers != 1 && numbers != 3) return false;
  Scanner scanner("", head.substr(end + 1));
  if (!is_digits(scanner.peek())) return false;
  std::size_t words = 0;
  for (; scanner.more_on_line(); ++words) {
    if (!looks_like_number(scanner.word("a number"))) return false;
  }
  return words == 5;
}

Document read_mike(Source& source) { return MikeReader(source).read(); }

bool mike_keeps(Content of, const DataArray& array) {
  if (of == kPointData) return array.name == kHeight;
  return of == kFieldData && (array.name == kMikeProjection || array.name == kMikeItem);
}

void write_mike(const WriteJob& job) {
  const MeshFile& f = job.file;
  const std::vector<std::int32_t> codes = codes_to_write(job, boundary_edges(job.measured), kMikeCodes);
  Output& out = job.outputs.open(job.path);
  out.put(mike_header(f), "");
  for (std::size_t i = 0; i < f.points.size(); ++i) {
    const double z = job.heights.empty() ? f.z() : job.heights[i];
    out.put(i + 1, ' ', f.points[i].x, ' ', f.points[i].y, ' ', z, ' ', codes[i], '\n');
  }
  const bool has_quadrilaterals = !job.fourth_corners.empty();
  out.put(f.triangles.size(), has_quadrilaterals ? " 4 25\n" : " 3 21\n");
  for (std::size_t t = 0; t < f.triangles.size(); ++t) {
    const auto [a, b, c] = f.triangles[t];
    out.put(t + 1, ' ', a + 1, ' ', b + 1, ' ', c + 1);
    if (has_quadrilaterals) out.put(' ', t < job.n_triangles() ? 0 : job.fourth_corners[t - job.n_triangles()] + 1);
    out.put('\n');
  }
}

}  // namespace temper::io
