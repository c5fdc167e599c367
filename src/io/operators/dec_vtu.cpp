// The dual for ParaView and similar programs: power cells as polygons, dual edges as lines between orthocenters.
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/containers/vtu_codec.hpp"
#include "io/formats/cells.hpp"
#include "io/formats/vtk/vtk_arrays.hpp"
#include "io/operators/dec_files.hpp"

namespace temper::io {
namespace {

// A VTU file of one piece, section by section. Every array is made block by block, and only the compressed blocks of
// one array are kept until its header is known.
//
//   VtuDocument vtu(out, Encoding::base64, executor);
//   vtu.fields(…);                        // may be left out
//   vtu.begin_piece(n_points, n_cells);
//   vtu.section("Points", {…});           // and Cells, PointData, CellData
//   vtu.finish();

class VtuDocument {
 public:
  /// Writes the part before all arrays. The executor's threads compress, when there is one.
  VtuDocument(Output& out, Encoding encoding, Executor* executor);
  /// Data of the file as a whole; without arrays nothing is written.
  void fields(const std::vector<VtkArray>& arrays);
  void begin_piece(std::size_t n_points, std::size_t n_cells);
  void section(std::string_view name, const std::vector<VtkArray>& arrays);
  /// The last call.
  void finish();

 private:
  void put_section(std::string_view name, const std::vector<VtkArray>& arrays, bool field);
  void array(const VtkArray& array, bool field);
  static std::string packed_block(const VtkArray& a, std::size_t i, Redundancy redundancy);
  static Redundancy redundancy_of(const VtkArray& a);
  void base64(const VtkArray& array);
  void appended();

  Output& out_;
  Encoding encoding_;
  Executor* executor_;
  std::vector<VtkArray> waiting_;  // for the appended section
  std::uint64_t offset_ = 0;
};

// --- arrays that are computed of operators or columns ---

/// An array of doubles, or of 32-bit integers.
template <class F>
[[nodiscard]] VtkArray dual_reals(std::string name, std::size_t n, F value) {
  return computed_vtk_array<double>(std::move(name), Scalar::f64, n, std::move(value));
}

template <class F>
[[nodiscard]] VtkArray dual_integers(std::string name, std::size_t n, F value) {
  return computed_vtk_array<std::int32_t>(std::move(name), Scalar::i32, n,
                                          [value](std::size_t i) { return static_cast<std::int32_t>(value(i)); });
}

/// The types of cells when all have the same type.
[[nodiscard]] inline VtkArray one_type(std::size_t n, int type) {
  return computed_vtk_array<std::uint8_t>("types", Scalar::u8, n,
                                          [type](std::size_t) { return static_cast<std::uint8_t>(type); });
}

// A block is compressed on its own, so that threads can share the work.
constexpr std::size_t kBlockBytes = kVtkBlockBytes;

std::string escaped(std::string_view name) {
  std::string result;
  for (const char c : name) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += static_cast<unsigned char>(c) < 32 ? ' ' : c;
    }
  }
  return result;
}

VtuDocument::VtuDocument(Output& out, Encoding encoding, Executor* executor)
    : out_(out), encoding_(encoding), executor_(executor) {
  out_.put("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"",
           std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian", "\" header_type=\"UInt64\"");
  if (encoding_ == Encoding::base64) out_.put(std::string_view(" compressor=\"vtkZLibDataCompressor\""));
  out_.put(">\n<UnstructuredGrid>\n", "");
}

void VtuDocument::fields(const std::vector<VtkArray>& arrays) {
  if (!arrays.empty()) put_section("FieldData", arrays, true);
}

void VtuDocument::begin_piece(std::size_t n_points, std::size_t n_cells) {
  out_.put("<Piece NumberOfPoints=\"", n_points, "\" NumberOfCells=\"", n_cells, "\">\n");
}

void VtuDocument::section(std::string_view name, const std::vector<VtkArray>& arrays) {
  put_section(name, arrays, false);
}

void VtuDocument::finish() {
  out_.put("</Piece>\n</UnstructuredGrid>\n", "");
  if (encoding_ == Encoding::appended) appended();
  out_.put("</VTKFile>\n", "");
}

void VtuDocument::put_section(std::string_view name, const std::vector<VtkArray>& arrays, bool field) {
  out_.put('<', name, ">\n");
  for (const VtkArray& a : arrays) array(a, field);
  out_.put("</", name, ">\n");
}

void VtuDocument::array(const VtkArray& a, bool field) {
  out_.put("<DataArray type=\"", info(a.scalar).vtu, "\" Name=\"", escaped(a.name), '"');
  // Left out when it is 1, as VTK does: some readers make a column of one otherwise.
  if (a.components > 1) out_.put(" NumberOfComponents=\"", a.components, '"');
  if (field) out_.put(" NumberOfTuples=\"", a.n_values / static_cast<std::size_t>(a.components), "\"");
  switch (encoding_) {
    case Encoding::ascii:
      out_.put(" format=\"ascii\">\n", "");
      put_ascii(out_, a);
      out_.put("</DataArray>\n", "");
      break;
    case Encoding::base64:
      out_.put(" format=\"binary\">\n", "");
      base64(a);
      out_.put("\n</DataArray>\n", "");
      break;
    case Encoding::appended:
      out_.put(" format=\"appended\" offset=\"", offset_, "\"/>\n");
      offset_ += sizeof(std::uint64_t) + a.bytes();
      waiting_.push_back(a);
      break;
  }
}

/// Block i of an array, compressed.
std::string VtuDocument::packed_block(const VtkArray& a, std::size_t i, Redundancy redundancy) {
  const std::size_t each = info(a.scalar).bytes, block = kBlockBytes / each;
  const std::size_t first = i * block, n = std::min(block, a.n_values - first);
  std::vector<char> bytes(n * each);
  a.fill(first, n, bytes.data());
  return compress_block({bytes.data(), bytes.size()}, redundancy);
}

/// Strings of bytes repeat in point numbers and in coordinates of grids, but not in coordinates of other meshes.
Redundancy VtuDocument::redundancy_of(const VtkArray& a) {
  if (a.scalar != Scalar::f64 && a.scalar != Scalar::f32) return Redundancy::strings;
  constexpr std::size_t kSample = std::size_t{1} << 14;
  const std::size_t each = info(a.scalar).bytes, n = std::min(kSample / each, a.n_values);
  std::vector<char> bytes(n * each);
  a.fill((a.n_values - n) / 2, n, bytes.data());  // the first points often are on the boundary, where zeros repeat
  return choose_redundancy({bytes.data(), bytes.size()});
}

void VtuDocument::base64(const VtkArray& a) {
  const std::size_t block = kBlockBytes / info(a.scalar).bytes;
  const std::size_t n = (a.n_values + block - 1) / block, rest = a.n_values % block;
  const Redundancy redundancy = redundancy_of(a);
  std::vector<std::string> packed(n);
  const auto pack = [&](std::size_t i) { packed[i] = packed_block(a, i, redundancy); };
  if (executor_ != nullptr) {
    executor_->run(n, pack);
  } else {
    for (std::size_t i = 0; i < n; ++i) pack(i);
  }
  std::vector<std::uint64_t> header = {n, kBlockBytes, rest * info(a.scalar).bytes};
  for (const std::string& p : packed) header.push_back(p.size());
  Base64Encoder encoder(out_);
  encoder.put({reinterpret_cast<const char*>(header.data()), header.size() * sizeof(std::uint64_t)});
  encoder.finish();
  for (const std::string& p : packed) encoder.put(p);
  encoder.finish();
}

void VtuDocument::appended() {
  out_.put("<AppendedData encoding=\"raw\">\n_", "");
  std::vector<char> buffer(kBlockBytes);
  for (const VtkArray& a : waiting_) {
    const std::size_t each = info(a.scalar).bytes;
    const std::size_t block = kBlockBytes / each;
    out_.put_raw(static_cast<std::uint64_t>(a.bytes()));
    for (std::size_t first = 0; first < a.n_values; first += block) {
      const std::size_t n = std::min(block, a.n_values - first);
      a.fill(first, n, buffer.data());
      out_.put(std::string_view(buffer.data(), n * each));
    }
  }
  out_.put("\n</AppendedData>\n", "");
}

}  // namespace

void write_vtu(const WriteJob& job) {
  const MeshFile& file = job.file;
  VtuDocument vtu(job.outputs.open(job.path), job.encoding.value_or(Encoding::base64), job.executor);
  vtu.fields(vtk_field_data(file));
  vtu.begin_piece(file.points.size(), VtkCells(job).size());
  vtu.section("Points", {vtk_points(job)});
  vtu.section("Cells", {vtk_connectivity(job), vtk_cell_ends(VtkCells(job)), vtk_cell_types(job)});
  vtu.section("PointData", vtk_point_data(job));
  std::vector<VtkArray> cell_data = vtk_cell_data(job);
  if (job.triangle_quality) {
    for (VtkArray& array : vtk_quality(job)) cell_data.push_back(std::move(array));
  }
  vtu.section("CellData", cell_data);
  vtu.finish();
}

namespace {

/// Three numbers per point; in the plane z is the mesh's.
VtkArray dual_points(const DecPositions& places, double z) {
  return computed_vtk_array<double>(
      "Points", Scalar::f64, 3 * places.size,
      [&places, z](std::size_t i) { return i % 3 < places.coordinates ? places.coordinate(i / 3, i % 3) : z; }, 3);
}

// A cell of several polygons has the same number, area and star on each of them.
void write_cells(const DecJob& job) {
  const PowerCells& cells = job.cells;
  const DecPositions places = corner_positions(cells);
  const std::size_t n = cells.n_polygons(), n_points = places.size;
  const auto owner = [&cells](std::size_t p) { return cells.vertices[p]; };
  VtuDocument vtu(job.open("dual.vtu"), Encoding::base64, job.options.executor);
  vtu.begin_piece(n_points, n);
  vtu.section("Points", {dual_points(places, job.options.z)});
  vtu.section("Cells", {dual_integers("connectivity", n_points, [](std::size_t i) { return i; }),
                        dual_integers("offsets", n, [&cells](std::size_t p) { return cells.starts[p + 1]; }),
                        one_type(n, kVtkPolygon)});
  vtu.section("PointData", {});
  vtu.section("CellData",
              {dual_integers("vertex", n, [owner](std::size_t p) { return owner(p).index; }),
               dual_reals("polygon_area", n, [&cells](std::size_t p) { return cells.polygon_areas[p]; }),
               dual_reals("area", n, [&cells, owner](std::size_t p) { return cells.areas[owner(p)]; }),
               dual_reals("star0", n, [&job, owner](std::size_t p) { return job.complex.star0[owner(p)]; }),
               dual_reals("weight", n, [&job, owner](std::size_t p) { return job.mesh.weight(owner(p)); })});
  vtu.finish();
}

// Points are the orthocenters, then the weighted midpoints. An interior line runs from the triangle on the left of its
// edge to the triangle on the right. A boundary line runs from the orthocenter to the midpoint.
void write_dual_edges(const DecJob& job) {
  const DecComplex& c = job.complex;
  const DecPositions orthocenters = orthocenter_positions(c), midpoints = midpoint_positions(c);
  const std::size_t n_triangles = orthocenters.size, n = c.edges.size(), n_points = n_triangles + n;
  const DecPositions places = {orthocenters.coordinates, n_points, [&](std::size_t i) {
                                 return i < n_triangles ? orthocenters.at(i) : midpoints.at(i - n_triangles);
                               }};
  const auto edge = [&c](std::size_t i) -> const DecEdge& { return c.edges[EdgeId(i)]; };
  const auto end = [edge, n_triangles](std::size_t i) -> std::size_t {
    const DecEdge& e = edge(i / 2);
    const TriangleId first = e.left.valid() ? e.left : e.right;
    if (i % 2 == 0) return first.index;
    return e.is_boundary() ? n_triangles + i / 2 : e.right.index;
  };
  VtuDocument vtu(job.open("dual_edges.vtu"), Encoding::base64, job.options.executor);
  vtu.begin_piece(n_points, n);
  vtu.section("Points", {dual_points(places, job.options.z)});
  vtu.section("Cells", {dual_integers("connectivity", 2 * n, end),
                        dual_integers("offsets", n, [](std::size_t i) { return 2 * (i + 1); }), one_type(n, kVtkLine)});
  vtu.section("PointData",
              {dual_integers("midpoint", n_points, [n_triangles](std::size_t i) { return i < n_triangles ? 0 : 1; }),
               dual_integers("element", n_points,
                             [n_triangles](std::size_t i) { return i < n_triangles ? i : i - n_triangles; })});
  vtu.section("CellData",
              {dual_integers("from", n, [edge](std::size_t i) { return edge(i).from.index; }),
               dual_integers("to", n, [edge](std::size_t i) { return edge(i).to.index; }),
               dual_integers("boundary", n, [edge](std::size_t i) { return edge(i).is_boundary() ? 1 : 0; }),
               dual_reals("length", n, [edge](std::size_t i) { return edge(i).length; }),
               dual_reals("dual_length", n, [edge](std::size_t i) { return edge(i).dual_length; }),
               dual_reals("star1", n, [&c](std::size_t i) { return c.star1[EdgeId(i)]; })});
  vtu.finish();
}

}  // namespace

void write_dec_vtu(const DecJob& job) {
  write_cells(job);
  write_dual_edges(job);
}

// columns.vtu: each active cell is a prism over its power cell, a VTK polyhedron; a cell of several polygons has one
// prism over each. Prisms share no points: their tops and bottoms are flat, at different heights than their neighbors'.

namespace {

VtkArray long_integers(std::string name, const std::vector<std::int64_t>& values) {
  return computed_vtk_array<std::int64_t>(std::move(name), Scalar::i64, values.size(),
                                          [&values](std::size_t i) { return values[i]; });
}

/// All prisms, in the order of polygons and, below each, of layers.
struct Prisms {
  std::vector<std::size_t> cells;                        // of the columns
  std::vector<std::size_t> polygons;                     // of the power cells
  std::vector<double> points;                            // three numbers each: of a prism the bottom, then the top
  std::vector<std::int64_t> ends, faces, ends_of_faces;  // as VTK has them

  void add(const PowerCells& power_cells, std::size_t polygon, const Columns& columns, std::size_t cell);
  [[nodiscard]] std::size_t size() const { return cells.size(); }
};

void Prisms::add(const PowerCells& power_cells, std::size_t polygon, const Columns& columns, std::size_t cell) {
  const std::size_t first = power_cells.starts[polygon], n = power_cells.starts[polygon + 1] - first;
  const auto bottom = [base = static_cast<std::int64_t>(points.size() / 3), n](std::size_t i) {
    return base + static_cast<std::int64_t>(i % n);
  };
  const auto top = [bottom, n](std::size_t i) { return bottom(i) + static_cast<std::int64_t>(n); };
  for (const double z : {columns.bottoms[cell], columns.tops[cell]}) {
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2 corner = power_cells.corners[first + i];
      points.insert(points.end(), {corner.x, corner.y, z});
    }
  }
  // Seen from outside, corners of faces are counter-clockwise.
  faces.push_back(static_cast<std::int64_t>(n + 2));
  faces.push_back(static_cast<std::int64_t>(n));
  for (std::size_t i = n; i-- > 0;) faces.push_back(bottom(i));
  faces.push_back(static_cast<std::int64_t>(n));
  for (std::size_t i = 0; i < n; ++i) faces.push_back(top(i));
  for (std::size_t i = 0; i < n; ++i) faces.insert(faces.end(), {4, bottom(i), bottom(i + 1), top(i + 1), top(i)});
  cells.push_back(cell);
  polygons.push_back(polygon);
  ends.push_back(static_cast<std::int64_t>(points.size() / 3));
  ends_of_faces.push_back(static_cast<std::int64_t>(faces.size()));
}

}  // namespace

void write_columns_vtu(const DecJob& job) {
  const Columns& c = *job.options.columns;
  Prisms prisms;
  for (std::size_t p = 0; p < job.cells.n_polygons(); ++p) {
    for (std::size_t layer = 0; layer < c.n_layers; ++layer) {
      const std::size_t cell = c.cell(job.cells.vertices[p], layer);
      if (c.is_active(cell)) prisms.add(job.cells, p, c, cell);
    }
  }
  const std::size_t n = prisms.size(), n_points = prisms.points.size() / 3;
  const auto thickness = [&](std::size_t i) { return c.tops[prisms.cells[i]] - c.bottoms[prisms.cells[i]]; };
  VtuDocument vtu(job.open("columns.vtu"), Encoding::base64, job.options.executor);
  vtu.begin_piece(n_points, n);
  vtu.section("Points", {computed_vtk_array<double>(
                            "Points", Scalar::f64, 3 * n_points, [&](std::size_t i) { return prisms.points[i]; }, 3)});
  vtu.section("Cells", {computed_vtk_array<std::int64_t>("connectivity", Scalar::i64, n_points,
                                                         [](std::size_t i) { return static_cast<std::int64_t>(i); }),
                        long_integers("offsets", prisms.ends), one_type(n, kVtkPolyhedron),
                        long_integers("faces", prisms.faces), long_integers("faceoffsets", prisms.ends_of_faces)});
  vtu.section("PointData", {});
  vtu.section("CellData", {dual_integers("vertex", n, [&](std::size_t i) { return c.vertex(prisms.cells[i]).index; }),
                           dual_integers("layer", n, [&](std::size_t i) { return c.layer(prisms.cells[i]) + 1; }),
                           dual_reals("thickness", n, thickness), dual_reals("volume", n, [&](std::size_t i) {
                             return job.cells.polygon_areas[prisms.polygons[i]] * thickness(i);
                           })});
  vtu.finish();
}

}  // namespace temper::io
