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

/// An array of edges or faces, `width` values in each row.
template <class T, class Elements, class F>
void add_rows(NpzWriter& npz, std::string_view name, const Elements& elements, std::size_t width, F value) {
  std::vector<T> values;
  values.reserve(width * elements.size());
  for (const auto& element : elements) {
    for (std::size_t k = 0; k < width; ++k) values.push_back(static_cast<T>(value(element, k)));
  }
  npz.add(name, values, {elements.size(), width});
}
/// A number of each edge or face.
template <class Elements, class Struct>
void add_numbers(NpzWriter& npz, std::string_view name, const Elements& elements, double Struct::*member) {
  std::vector<double> values;
  values.reserve(elements.size());
  for (const Struct& element : elements) values.push_back(element.*member);
  npz.add(name, values);
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

/// Weights of the vertices, and the triangles or tetrahedra.
template <class AnyMesh, class Elements>
void add_mesh(NpzWriter& npz, const DecFolder& folder, const AnyMesh& mesh, std::string_view name,
              const Elements& elements) {
  constexpr std::size_t kCorners = std::tuple_size_v<std::remove_cvref_t<decltype(mesh.corners(*elements.begin()))>>;
  std::vector<double> weights;
  std::vector<std::int64_t> points;
  for (const VertexId v : mesh.vertices()) {
    weights.push_back(mesh.weight(v));
    const std::span<const std::size_t> in_file = folder.options.points;
    points.push_back(static_cast<std::int64_t>(in_file.empty() ? v.index : in_file[v.index]));
  }
  std::vector<std::int32_t> corners, regions;
  for (const auto t : elements) {
    for (const VertexId v : mesh.corners(t)) corners.push_back(static_cast<std::int32_t>(v.index));
    regions.push_back(mesh.region(t));
  }
  npz.add("weights", weights);
  npz.add("points", points);
  npz.add(name, corners, {elements.size(), kCorners});
  npz.add("regions", regions);
}

void add_space(NpzWriter& npz, const Mesh& mesh) {
  if (mesh.space().radius() > 0) npz.add("sphere_radius", std::vector<double>{mesh.space().radius()}, {});
  const Vec2 period = mesh.space().period();
  if (mesh.space().is_periodic()) npz.add("plane_period", std::vector<double>{period.x, period.y});
}

std::int32_t end_of(const auto& edge, std::size_t k) {
  return signed_index(k == 0 ? edge.from.index : edge.to.index, true);
}

void add_edges(NpzWriter& npz, const DecComplex& c, bool have_places = true) {
  add_rows<std::int32_t>(npz, "edges", c.edges, 2, [](const DecEdge& e, std::size_t k) { return end_of(e, k); });
  add_rows<std::int32_t>(npz, "edge_triangles", c.edges, 2, [](const DecEdge& e, std::size_t k) {
    const TriangleId t = k == 0 ? e.left : e.right;
    return signed_index(t.index, t.valid());
  });
  add_numbers(npz, "edge_lengths", c.edges, &DecEdge::length);
  add_numbers(npz, "edge_crossings", c.edges, &DecEdge::crossing);
  add_rows<double>(npz, "edge_heights", c.edges, 2,
                   [](const DecEdge& e, std::size_t k) { return k == 0 ? e.left_height : e.right_height; });
  if (have_places) add_positions(npz, "edge_midpoints", midpoint_positions(c));
  add_numbers(npz, "dual_lengths", c.edges, &DecEdge::dual_length);
}

void add_edges(NpzWriter& npz, const tets::DecComplex& c) {
  using Edge = tets::DecEdge;
  add_rows<std::int32_t>(npz, "edges", c.edges, 2, [](const Edge& e, std::size_t k) { return end_of(e, k); });
  std::vector<std::uint8_t> on_boundary;
  for (const Edge& e : c.edges) on_boundary.push_back(e.is_boundary ? 1 : 0);
  npz.add("edge_on_boundary", on_boundary);
  add_numbers(npz, "edge_lengths", c.edges, &Edge::length);
  add_numbers(npz, "edge_crossings", c.edges, &Edge::crossing);
  add_positions(npz, "edge_midpoints", midpoint_positions(c));
  add_numbers(npz, "dual_areas", c.edges, &Edge::dual_area);
}

void add_faces(NpzWriter& npz, const tets::DecComplex& c) {
  using Face = tets::DecFace;
  add_rows<std::int32_t>(npz, "faces", c.faces, 3, [](const Face& f, std::size_t k) { return f.vertices[k].index; });
  add_rows<std::int32_t>(npz, "face_tetrahedra", c.faces, 2, [](const Face& f, std::size_t k) {
    const tets::TetId t = k == 0 ? f.behind : f.ahead;
    return signed_index(t.index, t.valid());
  });
  add_numbers(npz, "face_areas", c.faces, &Face::area);
  add_rows<double>(npz, "face_heights", c.faces, 2,
                   [](const Face& f, std::size_t k) { return k == 0 ? f.behind_height : f.ahead_height; });
  add_positions(npz, "face_orthocenters", face_orthocenter_positions(c));
  add_numbers(npz, "dual_lengths", c.faces, &Face::dual_length);
}

// Doubles, not bytes: products of matrices keep the type, and d0ᵀ d0 may not fit a byte.
std::vector<double> as_doubles(const std::vector<std::int8_t>& signs) { return {signs.begin(), signs.end()}; }

template <class Complex>
void add_matrices(NpzWriter& npz, const DecMatrices& matrices, const Complex& c) {
  for (const auto& [name, is, matrix] : matrices.incidence) {
    npz.add(text(name, "_indptr"), matrix.starts);
    npz.add(text(name, "_indices"), matrix.columns);
    npz.add(text(name, "_data"), as_doubles(matrix.signs));
  }
  for (const auto& [name, is, values] : matrices.stars) npz.add(name, values);
  npz.add(matrices.transmissibility.name, matrices.transmissibility.values);
  if (!c.half_transmissibility.empty()) npz.add("half_transmissibility", c.half_transmissibility.raw());
  if (!c.coefficient.empty()) {
    npz.add("coefficient", c.coefficient.raw());
    npz.add("capacity", c.capacity.raw());
  }
  if constexpr (requires { c.half_transmissibility; }) {
    if (!c.half_transmissibility.empty()) npz.add("half_transmissibility", c.half_transmissibility.raw());
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

void write_csr(Output& out, const IncidenceMatrix& matrix, const std::vector<double>& values) {
  NpzWriter npz(out);
  npz.add("indices", matrix.columns);
  npz.add("indptr", matrix.starts);
  npz.add_text("format", "csr");
  npz.add("shape", std::vector<std::int64_t>{static_cast<std::int64_t>(matrix.n_rows()),
                                             static_cast<std::int64_t>(matrix.n_columns)});
  npz.add("data", values);
  npz.finish();
}

/// The row pattern of a diagonal matrix.
IncidenceMatrix diagonal_pattern(std::size_t n) {
  IncidenceMatrix pattern;
  pattern.n_columns = n;
  pattern.starts.resize(n + 1);
  pattern.columns.resize(n);
  std::iota(pattern.starts.begin(), pattern.starts.end(), 0);
  std::iota(pattern.columns.begin(), pattern.columns.end(), 0);
  return pattern;
}

/// Each matrix in a file of its own.
void write_matrices(const DecFolder& folder, const DecMatrices& matrices) {
  for (const auto& [name, is, matrix] : matrices.incidence)
    write_csr(folder.open(text(name, ".npz")), matrix, as_doubles(matrix.signs));
  for (const auto& [name, is, values] : matrices.stars)
    write_csr(folder.open(text(name, ".npz")), diagonal_pattern(values.size()), values);
}

}  // namespace

void write_dec_npz(const DecJob& job) {
  const DecComplex& c = job.complex;
  const DecMatrices matrices = matrices_of(c);
  NpzWriter npz(job.open("operators.npz"));
  add_positions(npz, "vertices", job.positions());
  add_mesh(npz, job, job.mesh, "triangles", job.mesh.triangles());
  add_space(npz, job.mesh);
  add_edges(npz, c);
  add_matrices(npz, matrices, c);
  add_positions(npz, "orthocenters", orthocenter_positions(c));
  npz.add("triangle_areas", c.areas.raw());
  add_cells(npz, job.cells);
  npz.finish();
  write_matrices(job, matrices);
}

void write_dec_npz(const IntrinsicDecJob& job) {
  const DecComplex& c = job.complex;
  const DecMatrices matrices = matrices_of(c);
  const Mesh& mesh = job.mesh.connectivity();
  NpzWriter npz(job.open("operators.npz"));
  add_mesh(npz, job, mesh, "triangles", mesh.triangles());
  add_edges(npz, c, false);
  add_matrices(npz, matrices, c);
  npz.add("triangle_areas", c.areas.raw());
  npz.finish();
  write_matrices(job, matrices);
}

void write_dec_npz(const TetDecJob& job) {
  const tets::DecComplex& c = job.complex;
  const DecMatrices matrices = matrices_of(c);
  NpzWriter npz(job.open("operators.npz"));
  add_positions(npz, "vertices", vertex_positions(job.mesh));
  add_mesh(npz, job, job.mesh, "tetrahedra", job.mesh.tetrahedra());
  add_edges(npz, c);
  add_faces(npz, c);
  add_matrices(npz, matrices, c);
  add_positions(npz, "orthocenters", orthocenter_positions(c));
  npz.add("tetrahedron_volumes", c.volumes.raw());
  npz.finish();
  write_matrices(job, matrices);
}

}  // namespace temper::io
