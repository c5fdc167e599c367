// Files made to hurt: nothing under a megabyte takes more than five seconds or a gigabyte to be read and made a mesh
// of, nor to be written in any format. Each runs in a process of its own, which the system stops when it takes more.
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>
#include <zlib.h>

#include <cmath>

#include "support.hpp"
#include "support/sanitizers.hpp"

namespace temper::io {
namespace {

// What they hold to is measured on files of nearly a megabyte, in the optimized build. Sanitizers, which take ten times
// as long, look for other things, and find them in a small part of that.
constexpr std::size_t kShare = TEMPER_SANITIZED ? 256 : 1;
constexpr int kSeconds = TEMPER_SANITIZED ? 40 : 5;
constexpr long kKilobytes = TEMPER_SANITIZED ? 1L << 22 : 1L << 20;
constexpr std::size_t kMegabyte = 1 << 20;

struct Hostile {
  std::string name, file;
  std::string (*content)();
};

std::string repeated(std::string_view piece, std::size_t n) {
  std::string all;
  for (std::size_t i = 0; i < n; ++i) all += piece;
  return all;
}
/// piece(i) for each i, up to about so many bytes.
template <class Piece>
std::string filled(std::size_t bytes, Piece piece) {
  std::string all;
  for (std::size_t i = 0; all.size() < bytes; ++i) all += piece(i);
  return all;
}
std::string number(std::size_t i) { return std::to_string(i); }

std::string ply(const std::string& properties, std::size_t n_values, const std::string& more = "") {
  std::string rows;
  for (const char* xy : {"0 0", "1 0", "0 1"}) rows += xy + repeated(" 0", n_values) + "\n";
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n" + properties +
         "element face 1\n" + "property list uchar int vertex_indices\n" + more + "end_header\n" + rows + "3 0 1 2\n";
}
std::string ply_of_one_name() { return ply(repeated("property char a\n", 40000 / kShare), 40000 / kShare); }
std::string ply_of_many_names() {
  const std::size_t n = 35000 / kShare;
  std::string properties;
  for (std::size_t i = 0; i < n; ++i) properties += "property char a" + number(i) + "\n";
  return ply(properties, n);
}
std::string ply_of_many_elements() {
  return ply("", 0, filled(900000 / kShare, [](std::size_t i) { return "element e" + number(i) + " 0\n"; }));
}
std::string ply_of_many_declared_arrays() {
  return ply(
      repeated("property char a_0\n", 12000 / kShare), 12000 / kShare,
      filled(500000 / kShare, [](std::size_t i) { return "comment temper array vertex " + number(i + 2) + " a\n"; }));
}

const std::string kVtk =
    "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 3 double\n0 0 0 1 0 0 0 1 0\n";
std::string vtk_of_one_name() {
  return kVtk + "CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n5\nPOINT_DATA 3\n" +
         repeated("SCALARS a char\n0 0 0\n", 20000 / kShare);
}
std::string vtk_of_a_long_line_with_data() {
  const std::size_t n = 200000 / kShare;
  return kVtk + "CELLS 2 " + number(n + 5) + "\n3 0 1 2\n" + number(n) + repeated(" 0", n) +
         "\nCELL_TYPES 2\n5 4\nCELL_DATA 2\n" + repeated("SCALARS a double\n0 0\n", 20000 / kShare);
}

const std::string kVtuPoints =
    "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 "
    "0</DataArray></Points><Cells><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray>"
    "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3</DataArray><DataArray type=\"UInt8\" Name=\"types\" "
    "format=\"ascii\">5</DataArray></Cells>";
std::string vtu(const std::string& attributes, const std::string& fields, const std::string& encoding,
                const std::string& appended) {
  return "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\" " + attributes +
         "><UnstructuredGrid><FieldData>" + fields + "</FieldData><Piece NumberOfPoints=\"3\" NumberOfCells=\"1\">" +
         kVtuPoints + "</Piece></UnstructuredGrid><AppendedData encoding=\"" + encoding + "\">_" + appended +
         "</AppendedData></VTKFile>";
}
std::string field(std::size_t offset) {
  return "<DataArray type=\"UInt8\" Name=\"a\" format=\"appended\" offset=\"" + number(offset) + "\"/>";
}
std::string vtu_of_many_offsets() {
  const std::size_t n = 11000 / kShare;
  std::string fields;
  for (std::size_t i = 0; i < n; ++i) fields += field(12 * i);
  return vtu("", fields, "base64", repeated("AwAAAGFiYw==", n));
}
std::string vtu_of_one_offset() {
  return vtu("", repeated(field(0), 8000 / kShare), "base64", repeated("AwAAAGFiYw==", 30000 / kShare));
}
std::string vtu_of_one_large_array_many_times() {
  const std::uint32_t n = 400000 / kShare;
  std::string bytes(4 + n, '\0');
  std::memcpy(bytes.data(), &n, 4);
  return vtu("", repeated(field(0), 8000 / kShare), "raw", bytes);
}
std::string words(std::initializer_list<std::uint32_t> values) {
  std::string bytes;
  for (const std::uint32_t v : values) bytes.append(reinterpret_cast<const char*>(&v), 4);
  return bytes;
}
constexpr const char* kZlib = "compressor=\"vtkZLibDataCompressor\"";
std::string vtu_of_zeros() {
  const std::uint32_t block = 1 << 20, n = 900;
  const std::vector<Bytef> zeros(block);
  std::vector<Bytef> packed(compressBound(block));
  uLongf size = packed.size();
  compress2(packed.data(), &size, zeros.data(), block, 9);
  std::string all = words({n, block, block});
  for (std::uint32_t i = 0; i < n; ++i) all += words({static_cast<std::uint32_t>(size)});
  const std::string one(reinterpret_cast<const char*>(packed.data()), size);
  return vtu(kZlib, field(0), "raw", all + repeated(one, n));
}
std::string vtu_of_blocks_of_nothing() {
  const std::uint32_t n = 250000 / kShare;
  return vtu(kZlib, field(0), "raw", words({n, 64000, 64000}) + std::string(std::size_t{4} * n, '\0'));
}
std::string vtu_nested() {
  return repeated("<a>", 140000 / kShare).insert(0, "<VTKFile type=\"UnstructuredGrid\">") +
         repeated("</a>", 140000 / kShare) + "</VTKFile>";
}

std::string gmsh(std::size_t n_points, const std::string& data) {
  std::string points;
  for (std::size_t i = 1; i <= n_points; ++i)
    points += number(i) + (i == 2 ? " 1 0 0\n" : i == 3 ? " 0 1 0\n" : " 0 0 0\n");
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + number(n_points) + "\n" + points +
         "$EndNodes\n$Elements\n1\n1 2 2 0 0 1 2 3\n$EndElements\n" + data;
}
std::string gmsh_of_empty_node_data() {
  return gmsh(60000 / kShare, repeated("$NodeData\n1\n\"a\"\n0\n3\n0\n64\n0\n$EndNodeData\n", 2000 / kShare));
}
std::string gmsh_of_many_node_data() {
  return gmsh(3, repeated("$NodeData\n1\n\"a\"\n0\n3\n0\n1\n0\n$EndNodeData\n", 22000 / kShare));
}
std::string gmsh_of_many_sections() { return gmsh(3, repeated("$X\n$EndX\n", 100000 / kShare)); }

std::string medit_of_many_flags() {
  const std::size_t n = 60000 / kShare;
  return "MeshVersionFormatted 2\nDimension 2\nVertices\n" + number(n) + "\n" + repeated("0 0 0\n", n) +
         repeated("Corners\n1\n1\n", 40000 / kShare) + "Triangles\n1\n1 2 3 0\nEnd\n";
}
std::string obj_of_many_groups() {
  return "v 0 0 0\nv 1 0 0\nv 0 1 0\n" +
         filled(900000 / kShare, [](std::size_t i) { return "g a" + number(i) + "\nf 1 2 3\n"; });
}
std::string obj_of_many_used_names() {
  return "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n" +
         filled(900000 / kShare, [](std::size_t i) { return "g a" + number(i) + "\nl 1 2\n"; });
}
/// Triangles around one vertex, each edge there a line.
std::string obj_of_a_fan_with_lines() {
  const std::size_t n = 20000 / kShare;
  std::string vertices = "v 0 0\n", faces, lines;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = 6 * static_cast<double>(i) / static_cast<double>(n);
    vertices += "v " + std::to_string(std::cos(t)) + " " + std::to_string(std::sin(t)) + "\n";
    if (i + 1 < n) faces += "f 1 " + number(i + 2) + " " + number(i + 3) + "\n";
    lines += "l 1 " + number(i + 2) + "\n";
  }
  return vertices + faces + lines;
}
std::string fort14_of_many_levees() {
  const std::size_t n = 40000 / kShare;
  return "t\n1 3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n1 3 1 2 3\n0\n0\n" + number(n) + "\n" + number(2 * n) + "\n" +
         repeated("2 3\n1 0 0\n2 0 0\n", n);
}
std::string jigsaw_of_many_sections() {
  return "MSHID=3;EUCLIDEAN-MESH\nNDIMS=2\nPOINT=3\n0;0;0\n1;0;0\n0;1;0\nTRIA3=1\n0;1;2;0\n" +
         filled(900000 / kShare, [](std::size_t i) { return "X" + number(i) + "=1\n0\n"; });
}

void big_endian(std::string& bytes, std::uint32_t value) {
  for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(value >> shift & 0xff);
}
void netcdf_name(std::string& bytes, std::string_view name) {
  big_endian(bytes, static_cast<std::uint32_t>(name.size()));
  bytes += name;
  bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
}
/// A classic file whose thousands of variables are all the same bytes.
std::string netcdf_of_variables_in_one_place() {
  const std::uint32_t n = 5000 / kShare, points = 100000;
  std::string bytes = std::string("CDF\1", 4);
  big_endian(bytes, 0);
  big_endian(bytes, 10), big_endian(bytes, 3);  // dimensions
  netcdf_name(bytes, "nCells"), big_endian(bytes, points);
  netcdf_name(bytes, "nVertices"), big_endian(bytes, 1);
  netcdf_name(bytes, "vertexDegree"), big_endian(bytes, 3);
  big_endian(bytes, 0), big_endian(bytes, 0);       // no attributes
  big_endian(bytes, 11), big_endian(bytes, n + 3);  // variables
  const auto variable = [&](const std::string& name, std::initializer_list<std::uint32_t> dimensions,
                            std::uint32_t type) {
    netcdf_name(bytes, name);
    big_endian(bytes, static_cast<std::uint32_t>(dimensions.size()));
    for (const std::uint32_t d : dimensions) big_endian(bytes, d);
    big_endian(bytes, 0), big_endian(bytes, 0);
    big_endian(bytes, type), big_endian(bytes, points), big_endian(bytes, 400000);
  };
  constexpr std::uint32_t kByte = 1, kInt = 4;
  variable("xCell", {0}, kByte), variable("yCell", {0}, kByte), variable("cellsOnVertex", {1, 2}, kInt);
  for (std::uint32_t i = 0; i < n; ++i) variable("v" + number(i), {0}, kByte);
  bytes.resize(510000, '\1');
  return bytes;
}

const std::vector<Hostile>& hostile_files() {
  static const std::vector<Hostile> kFiles = {
      {"ply_of_one_name", "m.ply", ply_of_one_name},
      {"ply_of_many_names", "m.ply", ply_of_many_names},
      {"ply_of_many_elements", "m.ply", ply_of_many_elements},
      {"ply_of_many_declared_arrays", "m.ply", ply_of_many_declared_arrays},
      {"vtk_of_one_name", "m.vtk", vtk_of_one_name},
      {"vtk_of_a_long_line_with_data", "m.vtk", vtk_of_a_long_line_with_data},
      {"vtu_of_many_offsets", "m.vtu", vtu_of_many_offsets},
      {"vtu_of_one_offset", "m.vtu", vtu_of_one_offset},
      {"vtu_of_one_large_array_many_times", "m.vtu", vtu_of_one_large_array_many_times},
      {"vtu_of_zeros", "m.vtu", vtu_of_zeros},
      {"vtu_of_blocks_of_nothing", "m.vtu", vtu_of_blocks_of_nothing},
      {"vtu_nested", "m.vtu", vtu_nested},
      {"gmsh_of_empty_node_data", "m.msh", gmsh_of_empty_node_data},
      {"gmsh_of_many_node_data", "m.msh", gmsh_of_many_node_data},
      {"gmsh_of_many_sections", "m.msh", gmsh_of_many_sections},
      {"medit_of_many_flags", "m.mesh", medit_of_many_flags},
      {"obj_of_many_groups", "m.obj", obj_of_many_groups},
      {"obj_of_many_used_names", "m.obj", obj_of_many_used_names},
      {"obj_of_a_fan_with_lines", "m.obj", obj_of_a_fan_with_lines},
      {"fort14_of_many_levees", "m.14", fort14_of_many_levees},
      {"jigsaw_of_many_sections", "m.jigsaw.msh", jigsaw_of_many_sections},
      {"netcdf_of_variables_in_one_place", "m.nc", netcdf_of_variables_in_one_place},
      {"geojson_of_empty_arrays", "o.geojson",
       [] { return "{\"type\":\"Polygon\",\"coordinates\":[" + repeated("[],", 330000 / kShare) + "[]]}"; }},
      {"geojson_of_many_members", "o.geojson",
       [] {
         return "{\"type\":\"Polygon\"," + repeated("\"a\":1,", 150000 / kShare) +
                "\"coordinates\":[[[0,0],[1,0],[0,1],[0,0]]]}";
       }},
      {"geojson_of_many_rings", "o.geojson",
       [] {
         return "{\"type\":\"Polygon\",\"coordinates\":[" + repeated("[[0,0],[1,0],[0,1],[0,0]],", 38000 / kShare) +
                "[[0,0],[1,0],[0,1],[0,0]]]}";
       }},
      {"poly_of_many_holes", "o.poly",
       [] {
         const std::size_t n = 80000 / kShare;
         return "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n3 0\n1 1 2\n2 2 3\n3 3 1\n" + number(n) + "\n" +
                repeated("1 0.1 0.1\n", n);
       }},
      {"jigsaw_of_many_parts", "o.msh", [] {
         return "MSHID=3;EUCLIDEAN-MESH\nNDIMS=2\nPOINT=3\n0;0;0\n1;0;0\n0;1;0\nEDGE2=3\n0;1;0\n1;2;0\n2;0;0\nBOUND=" +
                number(70000 / kShare) + "\n" +
                filled(800000 / kShare, [](std::size_t i) { return number(i) + ";0;20\n"; });
       }}};
  return kFiles;
}

class HostileFiles : public FileTest, public ::testing::WithParamInterface<std::size_t> {
 protected:
  const Hostile& hostile() const { return hostile_files()[GetParam()]; }
};

/// Limits the seconds of a processor that the process may take from now on. (RLIMIT_CPU counts whole seconds, so it
/// would leave up to one second less.)
void limit_seconds() {
  const itimerval seconds = {{0, 0}, {kSeconds, 0}};
  setitimer(ITIMER_PROF, &seconds, nullptr);
}

/// What a user would do with the file, whatever comes of it. Each command has its own limit.
void read_and_write(const std::string& path, const std::string& out) {
  limit_seconds();
  if (path.find("/o.") != std::string::npos) {
    static_cast<void>(read_outline(path));
    return;
  }
  const auto f = read(path);
  if (!f) return;
  static_cast<void>(make_mesh(*f));
  for (const Format& format : formats()) {
    limit_seconds();
    if (format.writes) static_cast<void>(write(out, *f, {std::string(format.name), {}}));
  }
}

TEST_P(HostileFiles, TakeNoMoreThanFiveSecondsAndAGigabyte) {
  const std::string in = make(hostile().file, hostile().content());
  ASSERT_LE(std::filesystem::file_size(in), kMegabyte);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    read_and_write(in, path("out"));
    _exit(0);
  }
  int status = 0;
  rusage used = {};
  ASSERT_EQ(wait4(child, &status, 0, &used), child);
  EXPECT_TRUE(WIFEXITED(status)) << "took more than " << kSeconds << " s, or crashed: signal " << WTERMSIG(status);
  EXPECT_LE(used.ru_maxrss, kKilobytes);
  RecordProperty("milliseconds", static_cast<int>(used.ru_utime.tv_sec * 1000 + used.ru_utime.tv_usec / 1000));
}

INSTANTIATE_TEST_SUITE_P(All, HostileFiles, ::testing::Range(std::size_t{0}, hostile_files().size()),
                         [](const auto& each) { return hostile_files()[each.param].name; });

}  // namespace
}  // namespace temper::io
