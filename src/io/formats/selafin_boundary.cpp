// The boundary file of TELEMAC (.cli), beside the mesh: a line for each node of the boundary.
//
//   LIHBOR LIUBOR LIVBOR  HBOR UBOR VBOR AUBOR  LITBOR  TBOR ATBOR BTBOR  node  number along the boundary
//
// The three first are the code of the node: 2 2 2 is a wall, 4 5 5 has a given discharge, 5 4 4 a given level. Its tag
// is 100 LIHBOR + 10 LIUBOR + LIVBOR. (TELEMAC-2D user manual, "The boundary conditions file".)
#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "io/formats/selafin.hpp"
#include "io/text/scanner.hpp"
#include "io/text/values.hpp"

namespace temper::io {
namespace {

constexpr CodeRules kSelafinCodes = {.wall = 222, .name = "open boundary, code "};
using BoundaryNumbers = std::array<double, kSelafinBoundaryNumbers>;
/// Of a node that nothing is said of: no values, and LITBOR of a wall, as in nearly all files.
constexpr BoundaryNumbers kUsualNumbers = {0, 0, 0, 0, 2, 0, 0, 0};

struct BoundaryRow {
  std::int32_t code = kSelafinCodes.wall;
  BoundaryNumbers numbers = {};
};

std::map<std::int32_t, BoundaryRow> read_rows(Scanner& scanner, std::size_t n_points) {
  std::map<std::int32_t, BoundaryRow> rows;
  while (!scanner.at_end()) {
    BoundaryRow row;
    row.code = 0;
    for (const std::string_view name : {"LIHBOR", "LIUBOR", "LIVBOR"}) {
      const std::int32_t code = scanner.integer(name);
      if (code < 0 || code > 9)
        scanner.fail_here(ErrorCode::syntax, "expected a code of one digit as ", name, ", found ", code);
      row.code = 10 * row.code + code;
    }
    for (double& number : row.numbers) number = scanner.real("a number of a boundary node");
    const auto node = scanner.number<std::int64_t>("the number of a boundary node");
    if (node < 1 || static_cast<std::size_t>(node) > n_points)
      scanner.fail_here(ErrorCode::index_out_of_range, "is of node ", node, ", but the mesh has ", n_points,
                        " nodes. Next: remove or rename this file if it belongs to another mesh");
    if (!rows.emplace(static_cast<std::int32_t>(node - 1), row).second)
      scanner.fail_here(ErrorCode::syntax, "is of node ", node, ", which an earlier line has, too");
    scanner.next_line();
  }
  return rows;
}

/// Marks nodes with unusual numbers, and adds the numbers of all marked points.
void take_numbers(MeshFile& f, const std::map<std::int32_t, BoundaryRow>& rows) {
  std::vector<bool> is_marked(f.points.size());
  for (const std::int32_t p : f.marked_points) is_marked[static_cast<std::size_t>(p)] = true;
  bool is_unusual = false;
  for (const auto& [node, row] : rows) {
    if (row.numbers == kUsualNumbers) continue;
    is_unusual = true;
    if (is_marked[static_cast<std::size_t>(node)]) continue;
    f.marked_points.add(node, row.code);
  }
  if (!is_unusual) return;
  std::vector<double> values;
  for (const std::int32_t p : f.marked_points) {
    const BoundaryNumbers& numbers = rows.at(p).numbers;
    values.insert(values.end(), numbers.begin(), numbers.end());
  }
  f.marked_points.data.push_back({std::string(kSelafinBoundary), kSelafinBoundaryNumbers, std::move(values)});
}

/// The numbers of marked points that have some.
std::map<std::int32_t, BoundaryNumbers> marked_numbers(const MeshFile& f) {
  std::map<std::int32_t, BoundaryNumbers> all;
  const DataArray* const array = find(f.marked_points.data, kSelafinBoundary);
  if (array == nullptr || array->components != kSelafinBoundaryNumbers) return all;
  const std::vector<double> values = to_doubles(Values(array->values));
  for (std::size_t i = 0; i < f.marked_points.size(); ++i) {
    BoundaryNumbers numbers;
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i * numbers.size()), numbers.size(), numbers.begin());
    all.emplace(f.marked_points[i], numbers);
  }
  return all;
}

}  // namespace

std::string selafin_boundary_path(const std::string& path) {
  const std::size_t dot = path.rfind('.'), slash = path.find_last_of("/\\");
  const bool has_suffix = dot != std::string::npos && (slash == std::string::npos || dot > slash + 1);
  const std::string boundary = path.substr(0, has_suffix ? dot : path.size()) + ".cli";
  return boundary == path ? path + ".cli" : boundary;
}

void read_selafin_boundary(Document& document) {
  MeshFile& f = document.file;
  const std::string path = selafin_boundary_path(document.names->path);
  if (is_stream(document.names->path) || !exists(path)) return;
  const Source source = load(path);
  Scanner scanner(path, source.bytes);
  const auto rows = read_rows(scanner, f.points.size());
  std::vector<std::int32_t> codes(f.points.size());
  for (const DirectedEdge& edge : boundary_edges(f)) {
    for (const std::int32_t p : edge) codes[static_cast<std::size_t>(p)] = kSelafinCodes.wall;
  }
  for (const auto& [node, row] : rows) codes[static_cast<std::size_t>(node)] = row.code;
  take_codes(document, codes, kSelafinCodes);
  take_numbers(f, rows);
}

void write_selafin_boundary(const WriteJob& job, const std::set<DirectedEdge>& edges, const NodeString& nodes) {
  std::vector<std::int32_t> codes = codes_to_write(job, edges, kSelafinCodes);
  const auto numbers = marked_numbers(job.file);
  Output& out = job.outputs.open(selafin_boundary_path(job.path));
  std::set<std::int32_t> lost;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    std::int32_t& code = codes[static_cast<std::size_t>(nodes[i])];
    if (code < 0 || code > 999) lost.insert(std::exchange(code, kSelafinCodes.wall));
    out.put(code / 100, ' ', code / 10 % 10, ' ', code % 10);
    const auto marked = numbers.find(nodes[i]);
    for (const double number : marked == numbers.end() ? kUsualNumbers : marked->second) out.put(' ', number);
    out.put(' ', nodes[i] + 1, ' ', i + 1, '\n');
    code = 0;
  }
  for (const std::int32_t tag : lost)
    job.warn("tag ", tag, " is no code of TELEMAC: its nodes are walls, 222. Expected three digits, such as 455");
  const auto inside = std::ranges::count_if(codes, [](std::int32_t code) { return code != 0; });
  if (inside > 0)
    job.warn(inside, " marked points that are not on the boundary are not written: ", job.row.description,
             " has no place for them");
}

}  // namespace temper::io
