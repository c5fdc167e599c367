#include "io/formats/vtk/vtu_write.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "io/containers/vtu_codec.hpp"
#include "io/formats/format.hpp"

namespace temper::io {
namespace {

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

/// Block i of an array, compressed.
std::string packed_block(const VtkArray& a, std::size_t i, Redundancy redundancy) {
  const std::size_t each = info(a.scalar).bytes, block = kBlockBytes / each;
  const std::size_t first = i * block, n = std::min(block, a.n_values - first);
  std::vector<char> bytes(n * each);
  a.fill(first, n, bytes.data());
  return compress_block({bytes.data(), bytes.size()}, redundancy);
}

/// Strings of bytes repeat in point numbers and in coordinates of grids, but not in coordinates of other meshes.
Redundancy redundancy_of(const VtkArray& a) {
  if (a.scalar != Scalar::f64 && a.scalar != Scalar::f32) return Redundancy::strings;
  constexpr std::size_t kSample = std::size_t{1} << 14;
  const std::size_t each = info(a.scalar).bytes, n = std::min(kSample / each, a.n_values);
  std::vector<char> bytes(n * each);
  a.fill((a.n_values - n) / 2, n, bytes.data());  // the first points often are on the boundary, where zeros repeat
  return choose_redundancy({bytes.data(), bytes.size()});
}

class VtuWriter {
 public:
  VtuWriter(Output& out, Encoding encoding, Executor* executor) : out_(out), encoding_(encoding), executor_(executor) {}

  void write(const VtuPiece& piece) {
    out_.put("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"",
             std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian", "\" header_type=\"UInt64\"");
    if (encoding_ == Encoding::base64) out_.put(std::string_view(" compressor=\"vtkZLibDataCompressor\""));
    out_.put(">\n<UnstructuredGrid>\n", "");
    if (!piece.field_data.empty()) section("FieldData", piece.field_data, true);
    out_.put("<Piece NumberOfPoints=\"", piece.points.n_values / 3, "\" NumberOfCells=\"", piece.cells[1].n_values,
             "\">\n");
    section("Points", {piece.points});
    section("Cells", piece.cells);
    section("PointData", piece.point_data);
    section("CellData", piece.cell_data);
    out_.put("</Piece>\n</UnstructuredGrid>\n", "");
    if (encoding_ == Encoding::appended) appended();
    out_.put("</VTKFile>\n", "");
  }

 private:
  void section(std::string_view name, const std::vector<VtkArray>& arrays, bool field = false) {
    out_.put('<', name, ">\n");
    for (const VtkArray& a : arrays) array(a, field);
    out_.put("</", name, ">\n");
  }
  void array(const VtkArray& a, bool field) {
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
  void base64(const VtkArray& a) {
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
  void appended() {
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

  Output& out_;
  Encoding encoding_;
  Executor* executor_;
  std::vector<VtkArray> waiting_;  // for the appended section
  std::uint64_t offset_ = 0;
};

}  // namespace

void write_piece(Output& out, const VtuPiece& piece, Encoding encoding, Executor* executor) {
  VtuWriter(out, encoding, executor).write(piece);
}

void write_vtu(const WriteJob& job) {
  VtuPiece piece = {vtk_points(job), {vtk_connectivity(job), vtk_cell_ends(VtkCells(job)), vtk_cell_types(job)}};
  piece.field_data = vtk_field_data(job.file);
  piece.point_data = vtk_point_data(job);
  piece.cell_data = vtk_cell_data(job);
  if (job.triangle_quality) {
    for (VtkArray& array : vtk_quality(job)) piece.cell_data.push_back(std::move(array));
  }
  write_piece(job.outputs.open(job.path), piece, job.encoding.value_or(Encoding::base64), job.executor);
}

}  // namespace temper::io
