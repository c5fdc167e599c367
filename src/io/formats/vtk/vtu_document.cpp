#include "io/formats/vtk/vtu_document.hpp"

#include <bit>
#include <cstring>

#include "io/formats/vtk/triangle_quality.hpp"
#include "io/formats/vtk/vtk_arrays.hpp"

namespace temper::io {

namespace {

// A block is compressed on its own: what threads share out.
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

}  // namespace

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

/// Strings of bytes come again in numbers of points and in the coordinates of grids, but not in those of other meshes.
Redundancy VtuDocument::redundancy_of(const VtkArray& a) {
  if (a.scalar != Scalar::f64 && a.scalar != Scalar::f32) return Redundancy::strings;
  const std::size_t each = info(a.scalar).bytes, n = std::min(kBlockBytes / each, a.n_values);
  std::vector<char> bytes(n * each);
  a.fill(0, n, bytes.data());
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

void write_vtu(const WriteJob& job) {
  const MeshFile& file = job.file;
  VtuDocument vtu(job.outputs.open(job.path), job.encoding.value_or(Encoding::base64), job.executor);
  vtu.fields(vtk_field_data(file));
  vtu.begin_piece(file.points.size(), n_vtk_cells(file));
  vtu.section("Points", {vtk_points(file)});
  const VtkArray ends = vtk_cell_ends(file.triangles.size(), file.lines.size(), file.marked_points.size());
  vtu.section("Cells", {vtk_connectivity(file), ends, vtk_cell_types(file)});
  vtu.section("PointData", vtk_point_data(job));
  std::vector<VtkArray> cell_data = vtk_cell_data(job);
  if (job.triangle_quality) {
    for (VtkArray& array : vtk_triangle_quality(job)) cell_data.push_back(std::move(array));
  }
  vtu.section("CellData", cell_data);
  vtu.finish();
}

}  // namespace temper::io
