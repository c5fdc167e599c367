// Damaged files: every reader returns a mesh or an error, whatever the bytes are. Deterministic: the seeds are fixed.
// Run under the address and undefined-behavior sanitizers, this is where a reader that trusts a file shows.
#include <random>

#include "libraries.hpp"
#include "support.hpp"

namespace temper::io {
namespace {

struct Victim {
  std::string name, file;
  std::string content;
};

class Damage : public FileTest {
 protected:
  /// A small valid file of each format, in each encoding.
  std::vector<Victim> victims() const {
    std::vector<Victim> result;
    const auto add = [&](const char* name, const char* file, const WriteOptions& options) {
      const auto written = write(path(file), tamed(rich_sample()), options);
      ASSERT_TRUE(written) << written.error().what();
      result.push_back({name, file, slurp(path(file))});
    };
    add("vtu ascii", "a.vtu", {"vtu", Encoding::ascii});
    add("vtu base64", "b.vtu", {"vtu", Encoding::base64});
    add("vtu appended", "c.vtu", {"vtu", Encoding::appended});
    add("gmsh22 ascii", "a.msh", {"gmsh22", Encoding::ascii});
    add("gmsh22 binary", "b.msh", {"gmsh22", Encoding::appended});
    add("gmsh41 ascii", "c.msh", {"gmsh41", Encoding::ascii});
    add("gmsh41 binary", "d.msh", {"gmsh41", Encoding::appended});
    add("medit", "a.mesh", {"medit", {}});
    add("obj", "a.obj", {"obj", {}});
    add("triangle", "a.node", {"triangle", {}});
    add("vtk binary", "d.vtk", {"vtk", Encoding::appended});
    add("vtk51 ascii", "e.vtk", {"vtk51", Encoding::ascii});
    add("vtk51 binary", "f.vtk", {"vtk51", Encoding::appended});
    add("jigsaw", "e.msh", {"jigsaw", {}});
    add("ply ascii", "a.ply", {"ply", Encoding::ascii});
    add("ply binary", "b.ply", {"ply", Encoding::appended});
    add("off", "a.off", {"off", {}});
    add("adcirc", "a.14", {"adcirc", {}});
    add("mike", "c.mesh", {"mike", {}});
    add("selafin", "a.slf", {"selafin", {}});
    result.push_back({"selafin boundary", "a.cli", slurp(path("a.cli"))});
    result.push_back({"avs", "a.inp",
                      "4 3 2 1 0\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n1 7 tri 1 2 3\n2 8 tri 1 3 4\n3 9 line 1 2\n1 2\n"
                      "v, real\n1 0 1\n2 0 1\n3 0 1\n4 0 1\n1 1\ni, integer\n1 1\n2 2\n3 3\n"});
    result.push_back({"stl", "a.stl",
                      "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
                      "endfacet\nfacet normal 1 0 0\nouter loop\nvertex 0 1 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\n"
                      "endfacet\nendsolid s\n"});
    if (expects_netcdf()) {
      add("mpas", "a.nc", {"mpas", {}});
      add("ugrid", "b.nc", {"ugrid", {}});
    }
    result.push_back({"triangle ele", "a.ele", slurp(path("a.ele"))});
    result.push_back({"triangle poly", "a.poly", slurp(path("a.poly"))});
    result.push_back({"weights", "a.obj.weights.csv", slurp(path("a.obj.weights.csv"))});
    result.push_back(
        {"mfem", "b.mesh",
         "MFEM mesh v1.0\n\n# c\ndimension\n2\n\nelements\n2\n1 2 0 1 2\n1 2 0 2 3\n\nboundary\n1\n3 1 0 1\n\n"
         "vertices\n4\n2\n0 0\n1 0\n1 1\n0 1\n"});
    const std::string head = "# vtk DataFile Version 3.0\ntitle\n";
    const std::string cells = "CELLS 2 8\n3 0 1 2\n3 0 2 3\nCELL_TYPES 2\n5\n5\n";
    const std::string points = "POINTS 4 float\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
    result.push_back({"vtk ascii", "a.vtk",
                      head + "ASCII\nDATASET UNSTRUCTURED_GRID\n" + points + cells +
                          "POINT_DATA 4\nSCALARS s float 1\nLOOKUP_TABLE default\n1 2 3 4\nVECTORS v double\n1 2 3 4 5 "
                          "6 7 8 9 10 11 12\n"
                          "CELL_DATA 2\nFIELD f 2\na 1 2 int\n1 2\nb 2 2 float\n1 2 3 4\n"});
    result.push_back(
        {"vtk 5", "b.vtk",
         "# vtk DataFile Version 5.1\ntitle\nASCII\nDATASET UNSTRUCTURED_GRID\n" + points +
             "CELLS 3 6\nOFFSETS vtktypeint64\n0 3 6\nCONNECTIVITY vtktypeint64\n0 1 2 0 2 3\nCELL_TYPES 2\n5\n5\n"});
    result.push_back(
        {"vtk polydata", "c.vtk",
         head + "ASCII\nDATASET POLYDATA\n" + points + "POLYGONS 2 8\n3 0 1 2\n3 0 2 3\nLINES 1 4\n3 0 1 2\n"});
    return result;
  }
  /// The file to hand to read(): side files and segments are read with their mesh.
  static std::string entry(const std::string& file) {
    if (file == "a.poly") return "a.node";
    if (file == "a.cli") return "a.slf";
    if (file == "a.obj.weights.csv") return "a.obj";
    return file;
  }
  /// Reads; also makes the mesh when there is one. Fails only by crashing, hanging or an empty message.
  void survive(const Victim& victim, const std::string& bytes) const {
    spill(path(victim.file), bytes);
    const auto f = read(path(entry(victim.file)));
    if (!f) {
      ASSERT_FALSE(f.error().message.empty());
      return;
    }
    const auto made = make_mesh(*f);
    if (!made) return;
    const auto wrong = made->mesh.validate();
    ASSERT_FALSE(wrong) << *wrong;
  }
};

TEST_F(Damage, FilesCutAnywhereGiveAMeshOrAnError) {
  for (const Victim& victim : victims()) {
    const std::size_t step = std::max<std::size_t>(1, victim.content.size() / 100);
    int errors = 0, cuts = 0;
    for (std::size_t n = 0; n < victim.content.size(); n += step, ++cuts) {
      spill(path(victim.file), std::string_view(victim.content).substr(0, n));
      const auto f = read(path(entry(victim.file)));
      if (f) continue;
      ++errors;
      EXPECT_FALSE(f.error().message.empty()) << victim.name << " cut at " << n;
      EXPECT_FALSE(f.error().where.empty()) << victim.name << " cut at " << n;
    }
    EXPECT_GT(cuts, 30) << victim.name;
    EXPECT_GT(errors, cuts / 10) << victim.name;
    spill(path(victim.file), victim.content);
  }
}

TEST_F(Damage, FilesWithChangedBytesGiveAMeshOrAnError) {
  constexpr int kMutationsEach = 250;
  std::mt19937 random(20231121);  // NOLINT: the same damage on every run
  int total = 0;
  for (const Victim& victim : victims()) {
    for (int i = 0; i < kMutationsEach; ++i, ++total) {
      std::string bytes = victim.content;
      const int changes = 1 + static_cast<int>(random() % 4);
      for (int k = 0; k < changes; ++k) {
        const std::size_t at = random() % bytes.size();
        switch (random() % 5) {
          case 0:
            bytes[at] = static_cast<char>(random());
            break;
          case 1:
            bytes[at] = "0123456789-+.e \n\"<>$"[random() % 20];
            break;
          case 2:
            bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
            break;
          case 3:
            bytes.erase(at, 1 + random() % 8);
            break;
          default:
            bytes.insert(at, std::string(1 + random() % 3, "9-0\xff"[random() % 4]));
            break;
        }
        if (bytes.empty()) bytes = " ";
      }
      ASSERT_NO_FATAL_FAILURE(survive(victim, bytes)) << victim.name;
    }
    spill(path(victim.file), victim.content);
  }
  EXPECT_GE(total, 3000);
}

TEST_F(Damage, CountsLargerThanTheFileAreRefusedBeforeMemoryIsAskedFor) {
  // Each of these would ask for terabytes.
  const std::pair<const char*, std::string> kFiles[] = {
      {"a.vtk", "# vtk DataFile Version 3.0\nt\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 2000000000 double\n"},
      {"b.vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 2000000000 double\n"},
      {"a.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4000000000000 1 2\n2 1 0 4000000000000\n"},
      {"b.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4000000000000\n"},
      {"a.mesh", "MFEM mesh v1.0\ndimension\n2\nelements\n4000000000000\n"},
      {"b.mesh", "MeshVersionFormatted 2\nDimension 2\nCorners\n4000000000000\n"},
      {"a.node", "4000000000000 2 0 0\n"},
      {"c.msh", "MSHID=3;EUCLIDEAN-MESH\nNDIMS=2\nPOINT=4000000000000\n0;0;0\n"},
      {"d.msh", "MSHID=3;EUCLIDEAN-MESH\nNDIMS=2\nPOWER=4000000000000;1\n0\n"},
      {"a.off", "OFF\n4000000000000 1 0\n0 0 0\n"},
      {"a.ply", "ply\nformat binary_big_endian 1.0\nelement vertex 4000000000000\nproperty char x\nend_header\n0"},
      {"fort.14", "t\n1 4000000000000\n1 0 0 0\n"},
      {"c.mesh", "4000000000000 UTM-33\n1 0 0 0 0\n"},
      {"a.inp", "4000000000000 1 0 0 0\n1 0 0 0\n"},
      {"a.vtu",
       "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\"><UnstructuredGrid>"
       "<Piece NumberOfPoints=\"2000000000\" NumberOfCells=\"2000000000\"><Points>"
       "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0</DataArray></Points>"
       "<Cells/></Piece></UnstructuredGrid></VTKFile>"},
      {"b.vtu",
       "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
       "compressor=\"vtkZLibDataCompressor\"><UnstructuredGrid>"
       "<Piece NumberOfPoints=\"3\" NumberOfCells=\"1\"><Points>"
       "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"binary\">"
       "AQAAAAAAAAAAAAAAAAEAAAAAAAAAAAAACAAAAAAAAAA=eJwDAAAAAAE=</DataArray></Points>"
       "<Cells/></Piece></UnstructuredGrid></VTKFile>"}};
  make("a.ele", "1 3 0\n1 1 2 3\n");
  for (const auto& [file, content] : kFiles) {
    const auto f = read(make(file, content));
    ASSERT_FALSE(f) << file;
    EXPECT_TRUE(f.error().code == ErrorCode::truncated || f.error().code == ErrorCode::syntax ||
                f.error().code == ErrorCode::size_mismatch)
        << f.error().what();
  }
}

}  // namespace
}  // namespace temper::io
