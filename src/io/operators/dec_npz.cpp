// Operators for NumPy and SciPy: every array in operators.npz, and each matrix in the format of scipy.sparse.save_npz.
#include <bit>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string_view>
#include <type_traits>
#include <vector>

#include "io/containers/zip_writer.hpp"
#include "io/operators/dec_files.hpp"

namespace temper::io {
namespace {

// --- .npz: a zip archive of .npy arrays (format 1.0: numpy.lib.format), none of them pickled ---

class NpzWriter {
 public:
  explicit NpzWriter(Output& out) : zip_(out) {}
  /// An array, rows first; the number of values is the product of `shape`.
  template <class T>
  void add(std::string_view name, const std::vector<T>& values, const std::vector<std::size_t>& shape) {
    static_assert(std::is_arithmetic_v<T>);
    constexpr char kKind = std::is_floating_point_v<T> ? 'f' : std::is_signed_v<T> ? 'i' : 'u';
    add_bytes(name, kKind, sizeof(T), {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)}, shape);
  }
  template <class T>
  void add(std::string_view name, const std::vector<T>& values) {
    add(name, values, {values.size()});
  }
  /// Text, as an array of no dimension.
  void add_text(std::string_view name, std::string_view text) { add_bytes(name, 'S', text.size(), text, {}); }
  void finish() { zip_.finish(); }

 private:
  void add_bytes(std::string_view name, char kind, std::size_t bytes_each, std::string_view bytes,
                 const std::vector<std::size_t>& shape);
  ZipWriter zip_;
};

/// Magic, version, length and the dictionary, padded so that the numbers start at a multiple of 64 bytes.
std::string npy_header(char kind, std::size_t bytes_each, const std::vector<std::size_t>& shape) {
  const char order = bytes_each == 1 || kind == 'S' ? '|' : std::endian::native == std::endian::little ? '<' : '>';
  std::string sizes;
  for (const std::size_t n : shape) sizes += text(n, ", ");
  if (shape.size() > 1) sizes.resize(sizes.size() - 2);  // Python writes `(3, 2)`, but `(3, )`
  std::string dictionary = text("{'descr': '", std::string_view(&order, 1), std::string_view(&kind, 1), bytes_each,
                                "', 'fortran_order': False, 'shape': (", sizes, "), }");
  constexpr std::size_t kStart = 10, kAlign = 64;
  while ((kStart + dictionary.size() + 1) % kAlign != 0) dictionary += ' ';
  dictionary += '\n';
  std::string header = "\x93NUMPY";
  header += '\x01';
  header += '\x00';
  header += static_cast<char>(dictionary.size() & 0xff);
  header += static_cast<char>(dictionary.size() >> 8);
  return header + dictionary;
}

void NpzWriter::add_bytes(std::string_view name, char kind, std::size_t bytes_each, std::string_view bytes,
                          const std::vector<std::size_t>& shape) {
  const std::string header = npy_header(kind, bytes_each, shape);
  zip_.add(text(name, ".npy"), {header, bytes});
}

// --- operators ---

std::int32_t signed_index(std::uint32_t index, bool valid) { return valid ? static_cast<std::int32_t>(index) : -1; }

/// Values of the edges, `width` in each row.
template <class T, class F>
std::vector<T> of_edges(const DecComplex& c, std::size_t width, F value) {
  std::vector<T> result;
  result.reserve(width * c.edges.size());
  for (const DecEdge& edge : c.edges) {
    for (std::size_t k = 0; k < width; ++k) result.push_back(value(edge, k));
  }
  return result;
}

/// Places as rows: x and y in the plane, x, y and z on the sphere.
void add_positions(NpzWriter& npz, std::string_view name, const DecPositions& places) {
  std::vector<double> values;
  values.reserve(places.coordinates * places.size);
  for (std::size_t i = 0; i < places.size; ++i) {
    for (std::size_t k = 0; k < places.coordinates; ++k) values.push_back(places.coordinate(i, k));
  }
  npz.add(name, values, {places.size, places.coordinates});
}

void add_mesh(NpzWriter& npz, const DecJob& job) {
  const Mesh& mesh = job.mesh;
  std::vector<double> weights;
  std::vector<std::int64_t> points;
  for (const VertexId v : mesh.vertices()) {
    weights.push_back(mesh.weight(v));
    points.push_back(static_cast<std::int64_t>(job.options.points.empty() ? v.index : job.options.points[v.index]));
  }
  std::vector<std::int32_t> corners, regions;
  for (const TriangleId t : mesh.triangles()) {
    for (const VertexId v : mesh.corners(t)) corners.push_back(static_cast<std::int32_t>(v.index));
    regions.push_back(mesh.region(t));
  }
  add_positions(npz, "vertices", vertex_positions(mesh));
  npz.add("weights", weights);
  npz.add("points", points);
  npz.add("triangles", corners, {mesh.n_triangles(), 3});
  npz.add("regions", regions);
  if (mesh.space().radius() > 0) npz.add("sphere_radius", std::vector<double>{mesh.space().radius()}, {});
  const Vec2 period = mesh.space().period();
  if (mesh.space().is_periodic()) npz.add("plane_period", std::vector<double>{period.x, period.y});
}

void add_edges(NpzWriter& npz, const DecComplex& c) {
  const std::size_t n = c.edges.size();
  npz.add(
      "edges",
      of_edges<std::int32_t>(
          c, 2, [](const DecEdge& e, std::size_t k) { return signed_index(k == 0 ? e.from.index : e.to.index, true); }),
      {n, 2});
  npz.add("edge_triangles",
          of_edges<std::int32_t>(c, 2,
                                 [](const DecEdge& e, std::size_t k) {
                                   const TriangleId t = k == 0 ? e.left : e.right;
                                   return signed_index(t.index, t.valid());
                                 }),
          {n, 2});
  npz.add("edge_lengths", of_edges<double>(c, 1, [](const DecEdge& e, std::size_t) { return e.length; }));
  npz.add("edge_crossings", of_edges<double>(c, 1, [](const DecEdge& e, std::size_t) { return e.crossing; }));
  npz.add(
      "edge_heights",
      of_edges<double>(c, 2, [](const DecEdge& e, std::size_t k) { return k == 0 ? e.left_height : e.right_height; }),
      {n, 2});
  add_positions(npz, "edge_midpoints", midpoint_positions(c));
  npz.add("dual_lengths", of_edges<double>(c, 1, [](const DecEdge& e, std::size_t) { return e.dual_length; }));
}

// Doubles, not bytes: products of matrices keep the type, and d0ᵀ d0 may not fit a byte.
std::vector<double> as_doubles(const std::vector<std::int8_t>& signs) { return {signs.begin(), signs.end()}; }

void add_matrices(NpzWriter& npz, const DecComplex& c) {
  for (const auto& [name, matrix] : {std::pair{"d0", &c.d0}, std::pair{"d1", &c.d1}}) {
    npz.add(text(name, "_indptr"), matrix->starts);
    npz.add(text(name, "_indices"), matrix->columns);
    npz.add(text(name, "_data"), as_doubles(matrix->signs));
  }
  npz.add("star0", c.star0.raw());
  npz.add("star1", c.star1.raw());
  npz.add("star2", c.star2.raw());
  npz.add("transmissibility", c.transmissibility.raw());
  if (!c.coefficient.empty()) {
    npz.add("coefficient", c.coefficient.raw());
    npz.add("capacity", c.capacity.raw());
  }
}

void add_cells(NpzWriter& npz, const PowerCells& cells) {
  std::vector<std::int32_t> owners;
  for (const VertexId v : cells.vertices) owners.push_back(static_cast<std::int32_t>(v.index));
  npz.add("cell_vertices", owners);
  npz.add("cell_starts", std::vector<std::int64_t>(cells.starts.begin(), cells.starts.end()));
  add_positions(npz, "cell_corners", corner_positions(cells));
  npz.add("cell_polygon_areas", cells.polygon_areas);
  npz.add("cell_areas", cells.areas.raw());
}

void write_csr(const DecJob& job, std::string_view name, const IncidenceMatrix& matrix,
               const std::vector<double>& values) {
  NpzWriter npz(job.open(name));
  npz.add("indices", matrix.columns);
  npz.add("indptr", matrix.starts);
  npz.add_text("format", "csr");
  npz.add("shape", std::vector<std::int64_t>{static_cast<std::int64_t>(matrix.n_rows()),
                                             static_cast<std::int64_t>(matrix.n_columns)});
  npz.add("data", values);
  npz.finish();
}

void write_diagonal(const DecJob& job, std::string_view name, const std::vector<double>& values) {
  IncidenceMatrix pattern;
  pattern.n_columns = values.size();
  pattern.starts.resize(values.size() + 1);
  pattern.columns.resize(values.size());
  std::iota(pattern.starts.begin(), pattern.starts.end(), 0);
  std::iota(pattern.columns.begin(), pattern.columns.end(), 0);
  write_csr(job, name, pattern, values);
}

}  // namespace

void write_dec_npz(const DecJob& job) {
  const DecComplex& c = job.complex;
  NpzWriter npz(job.open("operators.npz"));
  add_mesh(npz, job);
  add_edges(npz, c);
  add_matrices(npz, c);
  add_positions(npz, "orthocenters", orthocenter_positions(c));
  npz.add("triangle_areas", c.areas.raw());
  add_cells(npz, job.cells);
  npz.finish();
  write_csr(job, "d0.npz", c.d0, as_doubles(c.d0.signs));
  write_csr(job, "d1.npz", c.d1, as_doubles(c.d1.signs));
  write_diagonal(job, "star0.npz", c.star0.raw());
  write_diagonal(job, "star1.npz", c.star1.raw());
  write_diagonal(job, "star2.npz", c.star2.raw());
}

}  // namespace temper::io
