// The content decides the format, and formats that temper does not read are named.
#include "support.hpp"
#include "support/lattice.hpp"
#include "temper/generate.hpp"

namespace temper::io {
namespace {

/// What the rows say, between separators.
std::string list_of(std::string_view Format::*column, const char* separator, bool written_only) {
  std::string list;
  for (const Format& f : formats()) {
    if (f.writes || !written_only) list += (list.empty() ? "" : separator) + std::string(f.*column);
  }
  return list;
}

TEST(Formats, HaveDistinctNamesAndASuffix) {
  std::vector<std::string_view> names;
  for (const Format& f : formats()) {
    EXPECT_EQ(std::count(names.begin(), names.end(), f.name), 0) << f.name;
    names.push_back(f.name);
    EXPECT_TRUE(f.suffixes.starts_with('.')) << f.name;
    EXPECT_FALSE(f.description.empty());
  }
  for (const char* name : {"vtu",   "gmsh22", "gmsh41",  "medit",  "triangle", "obj",    "vtk",    "vtk51",
                           "mfem",  "jigsaw", "ply",     "off",    "adcirc",   "vtkhdf", "mpas",   "ugrid",
                           "fesom", "esri",   "geotiff", "ncgrid", "mike",     "avs",    "selafin"}) {
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
  }
}

TEST(Formats, AreInTheDocumentation) {
  const std::string docs = slurp(TEMPER_SOURCE_DIR "/docs/reference/formats/index.md");
  for (const Format& f : formats()) {
    EXPECT_NE(docs.find("| `" + std::string(f.name) + "` | "), std::string::npos) << f.name;
  }
}

TEST_F(FileTest, AFileOfNoneOfTheFormatsSaysWhichThereAre) {
  const auto result = read(make("m.mesh", "once upon a time\n"));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::syntax);
  EXPECT_EQ(plain(result.error().what()),
            "m.mesh: is none of the formats that temper reads: " + list_of(&Format::description, ", ", false));
}

TEST_F(FileTest, TheContentDecidesTheFormatAndNotTheSuffix) {
  const MeshFile f = sample();
  for (const Format& each : formats()) {
    if (!writes_planes(each) || each.name == "triangle") continue;
    const std::string format(each.name);
    ASSERT_TRUE(write(path("mesh.stl"), needs_netcdf(each) ? tamed(f) : f, {format, {}})) << format;
    const auto g = read(path("mesh.stl"));
    ASSERT_TRUE(g) << g.error().what();
    EXPECT_EQ(g->format, format);
    EXPECT_EQ(g->triangles.corners, f.triangles.corners);
  }
}

TEST_F(FileTest, FormatsThatAreRecognizedButNotReadAreNamed) {
  const std::pair<const char*, const char*> kCases[] = {
      {"(0 \"made by someone\")\n(2 2)\n", "a Fluent mesh, which temper does not read; meshio converts it"},
      {"4 2 4\n0 0 1\n1 0 1\n",
       "a FreeFem mesh, which temper does not read. Next: savemesh with a name that ends with .mesh writes medit"},
      {"$NOD\n3\n", "a Gmsh mesh of version 1, which temper does not read. Next: gmsh IN -save -format msh41 -o OUT"},
      {"$MeshFormat\n4 0 8\n$EndMeshFormat\n",
       "a Gmsh mesh of another version than 2 and 4.1, which temper does not read. Next: gmsh IN -save -format msh41 "
       "-o OUT"},
      {"MFEM NURBS mesh v1.0\n",
       "an MFEM mesh of another version than v1.0, which temper does not read. Next: in MFEM's mesh-explorer, c sets "
       "the "
       "order to 1 and V saves it as VTK"},
      {"<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\">\n",
       "a VTK XML file of another type than UnstructuredGrid, which temper does not read"},
      {"*HEADING\n", "an Abaqus input file, which temper does not read; meshio converts it"},
      {"% by hand\nNDIME= 2\nNELEM= 1\n", "an SU2 mesh, which temper does not read; meshio converts it"},
      {"SOL 101\nCEND\nBEGIN BULK\nGRID,1\n",
       "a Nastran bulk data file, which temper does not read; meshio converts it"},
      {"title = \"flow\"\n", "a Tecplot file, which temper does not read; meshio converts it"},
      {"DHI_DFS_ MIKE Zero - this file contains binary data, do not edit\x1a",
       "a dfsu file of DHI, which temper does not read. Next: mikeio.read(IN).geometry.to_mesh(OUT) in Python"},
      {"    -1\n  2411\n         1\n",
       "a universal file of I-DEAS, which temper does not read. Next: gmsh IN -save -format msh41 -o OUT"},
      {"/COM,ANSYS RELEASE 19.2\n/PREP7\n",
       "an archive of Ansys (CDB), which temper does not read. Next: mapdl_archive.Archive(IN).grid.save(OUT) in "
       "Python, "
       "where OUT ends with .vtu"},
      {"/*---*\\\nFoamFile\n{\n", "an OpenFOAM file, which temper does not read. Next: foamToVTK"},
      {"@(#)ADF Database Version B02012>",
       "a CGNS file in ADF, which temper does not read. Next: adf2hdf IN OUT, then meshio"},
      {"\x1f\x8b\x08\x00zipped", "a compressed file, which temper does not read"}};
  for (const auto& [content, name] : kCases) {
    const auto f = read(make("mesh.msh", content));
    ASSERT_FALSE(f) << content;
    EXPECT_EQ(f.error().code, ErrorCode::unsupported);
    EXPECT_EQ(plain(f.error().what()), "mesh.msh: is " + std::string(name));
  }
}

TEST_F(FileTest, BinaryFormatsThatAreNotReadAreNamedByTheirSizes) {
  const std::string title(80, 't');
  const auto named = [&](const std::string& content, const std::string& name) {
    const auto f = read(make("mesh.bin", content));
    return !f && plain(f.error().what()).starts_with("mesh.bin: is " + name);
  };
  const std::string none = "none of the formats";
  const std::string length("\0\0\0\x50", 4), eight("\0\0\0\x8", 4);
  EXPECT_TRUE(named(length + title + eight + eight, none)) << "no records of Selafin";
}

TEST_F(FileTest, ColumnsOfNumbersAreNoMeshOfFreefem) {
  for (const char* columns : {"1.5 2.5 3.5\n4.5 5.5 6.5\n", "1 2 3\n4.5 5.5 6.5\n", "-1 2 3\n4 5 6\n"}) {
    const auto f = read(make("m.xyz", columns));
    ASSERT_FALSE(f);
    EXPECT_EQ(plain(f.error().what()).find("m.xyz: is none of the formats"), 0u) << f.error().what();
  }
}

TEST_F(FileTest, MeshesOfTetgenAreRefusedWhereTrianglesAreExpected) {
  const auto refused = [&](const char* name, const char* content) {
    const auto f = read(make(name, content));
    if (!f) return plain(f.error().what());
    MeshFile file = *f;
    EXPECT_EQ(project(file, "none").error().what(), expect_triangles(*f).error().what());
    const auto made = make_mesh(*f);
    return made ? std::string() : plain(made.error().what());
  };
  EXPECT_EQ(refused("m.1.node", "# made by hand\n4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n"),
            "m.1.node: is the points of a mesh of Triangle or TetGen; its elements are expected in m.1.ele, which does "
            "not exist");
  EXPECT_EQ(refused("m.1.ele", "1 4 0\n1 1 2 3 4\n"),
            "m.1.ele:2: has 1 tetrahedron; expected a mesh of triangles. Next: temper check, convert, draw, explain, "
            "optimize, weights, operators and errors take tetrahedra");
  EXPECT_EQ(refused("m.1.ele", "1 3 0\n1 1 2 3\n"),
            "m.1.ele:1: has elements of 3 corners, and points of dimension 3; expected tetrahedra of 4");
}

TEST_F(FileTest, AnOutputWithoutAKnownSuffixSaysWhichThereAre) {
  const auto result = write(path("mesh.xyz"), sample());
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::invalid_option);
  EXPECT_EQ(plain(result.error().what()), "mesh.xyz: the suffix names no format that temper writes; expected one of " +
                                              list_of(&Format::suffixes, " ", true) + ", or a format");
}

TEST_F(FileTest, AFormatThatIsOnlyReadCannotBeWritten) {
  const auto result = write(path("mesh.mesh"), sample(), {"mfem", {}});
  ASSERT_FALSE(result);
  EXPECT_EQ(plain(result.error().what()),
            "mesh.mesh: cannot be written as 'mfem'; expected one of " + list_of(&Format::name, ", ", true));
}

TEST_F(FileTest, AFileWhoseArraysDoNotFitIsRefusedBeforeAnythingIsWritten) {
  MeshFile f = sample();
  f.weights.pop_back();
  const auto result = write(path("mesh.vtu"), f);
  ASSERT_FALSE(result);
  EXPECT_EQ(plain(result.error().what()),
            "mesh.vtu: the mesh to be written has another number of weights than of points");
  EXPECT_TRUE(files().empty());
}

// --- weights beside the mesh ---------------------------------------------------------------------------------

TEST_F(FileTest, FormatsWithoutAPlaceForWeightsPutThemBesideWithAWarning) {
  for (const char* name : {"m.mesh", "m.obj"}) {
    const auto warnings = write(path(name), sample());
    ASSERT_TRUE(warnings);
    const std::string expected =
        std::string(name) + ": the format has no place for weights; they are in " + name + ".weights.csv";
    const auto said =
        std::count_if(warnings->begin(), warnings->end(), [&](const std::string& w) { return plain(w) == expected; });
    EXPECT_EQ(said, 1);
    EXPECT_TRUE(slurp(path(std::string(name) + ".weights.csv")).starts_with("point,weight\n1,0\n2,-0\n"));
  }
}

class FilesOfAMesh : public FileTest {
 protected:
  /// Writes the file to a folder of its own; the paths of what is there then.
  std::vector<std::string> write_alone(const MeshFile& file, const Format& format, const std::string& name) const {
    std::filesystem::remove_all(path("alone"));
    std::filesystem::create_directory(path("alone"));
    const auto written = write(path("alone/" + name), file, {std::string(format.name), {}});
    EXPECT_TRUE(written) << written.error().what();
    std::vector<std::string> all;
    for (const auto& entry : std::filesystem::directory_iterator(path("alone"))) all.push_back(entry.path().string());
    return sorted(all);
  }
  static std::vector<std::string> sorted(std::vector<std::string> all) {
    for (std::string& file : all) std::replace(file.begin(), file.end(), '\\', '/');
    std::sort(all.begin(), all.end());
    return all;
  }
};

TEST_F(FilesOfAMesh, ThatAreWrittenAreThoseThatAreReadAndWereSaidBefore) {
  MeshFile globe = from_mesh(*icosahedral({.level = 1}));
  globe.weights.assign(globe.points.size(), 1e6);
  globe.point_data = {{"depth", 1, std::vector<double>(globe.points.size(), -4000)}};
  globe.field_data = {{"levels", 1, std::vector<double>{0, -10, -5000}}};
  std::size_t most = 0;
  for (const Format& format : formats()) {
    const bool plane = writes_planes(format);
    if (!plane && format.name != "fesom") continue;
    SCOPED_TRACE(format.name);
    const std::string name = "m" + std::string(format.suffixes.substr(0, format.suffixes.find(' ')));
    const std::vector<std::string> there = write_alone(plane ? tamed(sample()) : globe, format, name);
    EXPECT_EQ(sorted(files_to_read(path("alone/" + name))), there);
    const auto said = files_to_write(path("alone/" + name), std::string(format.name));
    ASSERT_TRUE(said);
    for (const std::string& file : there) EXPECT_NE(std::find(said->begin(), said->end(), file), said->end()) << file;
    most = std::max(most, there.size());
  }
  EXPECT_EQ(most, 4u) << "FESOM has three, and weights beside them";
}

TEST_F(FilesOfAMesh, AreFoundFromEitherOfThemAndWithoutOneThereIsThePathAlone) {
  const auto all = [&](const std::string& name) { return sorted(files_to_read(path(name))); };
  ASSERT_TRUE(write(path("m.node"), sample()));
  EXPECT_EQ(all("m.ele"), all("m.node"));
  EXPECT_EQ(all("m.node"), (std::vector{path("m.ele"), path("m.node"), path("m.poly")}));
  make("m.edge", "0 1\n");
  EXPECT_EQ(all("m.node").size(), 3u) << "segments of .poly are taken first";
  make("m.vtu.weights.csv", "point,weight\n");
  EXPECT_EQ(all("m.vtu"), std::vector{path("m.vtu")});
  make("m.txt", "no mesh");
  EXPECT_EQ(all("m.txt"), std::vector{path("m.txt")});
  EXPECT_EQ(files_to_read("/dev/stdin"), std::vector<std::string>{"/dev/stdin"});
}

TEST_F(FileTest, WeightsOfCornersComeBackFromEachFormatOrFromBesideIt) {
  const Mesh mesh = test::lattice({.n = 4});
  std::vector<double> weights;
  for (const HalfedgeId h : mesh.halfedges()) weights.push_back(0.1 * h.index + 1.0 / 3);
  std::size_t formats_tried = 0;
  for (const Format& format : formats()) {
    if (!format.writes || !format.holds_planes) continue;
    MeshFile file = from_mesh(mesh);
    set_corner_weights(file, weights);
    const std::string name = path("m" + std::string(format.suffixes.substr(0, format.suffixes.find(' '))));
    WriteOptions options;
    options.format = format.name;
    ASSERT_TRUE(write(name, file, options)) << format.name;
    const auto back = read(name);
    ASSERT_TRUE(back) << format.name << ": " << back.error().what();
    const auto loaded = make_mesh(*back);
    ASSERT_TRUE(loaded);
    const std::vector<double> found = corner_weights_of(*back, *loaded);
    ASSERT_EQ(found.size(), weights.size()) << format.name;
    // Formats may begin a triangle with another corner.
    for (const HalfedgeId h : loaded->mesh.halfedges()) {
      const HalfedgeId was = mesh.find_halfedge(loaded->mesh.origin(h), loaded->mesh.target(h));
      ASSERT_TRUE(was.valid()) << format.name;
      EXPECT_EQ(found[h.index], weights[was.index]) << format.name;
    }
    ++formats_tried;
  }
  EXPECT_GT(formats_tried, 10U);
}

TEST_F(FileTest, AnOldSideFileDoesNotGiveItsWeightsToANewMesh) {
  MeshFile f = sample();
  ASSERT_TRUE(write(path("m.obj"), f));
  f.weights.clear();
  ASSERT_TRUE(write(path("m.obj"), f));
  const auto g = read(path("m.obj"));
  ASSERT_TRUE(g) << g.error().what();
  for (const double w : g->weights) EXPECT_EQ(w, 0);
}

TEST_F(FileTest, ASideFileThatDoesNotFitIsNamed) {
  make("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::pair<const char*, const char*> kCases[] = {
      {"point,weight\n1,0\n2,0\n", "m.obj.weights.csv:4: has 2 weights, but m.obj has 3 points"},
      {"point,weight\n1,0\n2,0\n3,0\n4,0\n", "m.obj.weights.csv:5: has more weights than m.obj has points (3)"},
      {"point,weight\n1,0\n3,0\n2,0\n", "m.obj.weights.csv:3: expected the weight of point 2, found point 3"},
      {"point,weight\n1,0\n2,x\n3,0\n", "m.obj.weights.csv:3: expected a weight, found 'x'"},
      {"point,weight\n1,0\n2,nan\n3,0\n", "m.obj.weights.csv:3: point 2 has weight nan, expected a finite number"},
      {"1,0\n2,0\n3,0\n", "m.obj.weights.csv:1: expected the title line 'point,weight', found '1'"}};
  for (const auto& [content, message] : kCases) {
    make("m.obj.weights.csv", content);
    const auto f = read(path("m.obj"));
    ASSERT_FALSE(f) << content;
    EXPECT_EQ(plain(f.error().what()), message);
  }
}

TEST_F(FileTest, ACornerFileThatDoesNotFitIsNamed) {
  make("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string file = "m.obj.corner_weights.csv", title = "triangle,first,second,third\n";
  const std::pair<std::string, std::string> kCases[] = {
      {"triangle,first,third\n", ":1: expected 'second' in the title line, found 'third'"},
      {title + "1,0,0,x\n", ":2: expected a weight, found 'x'"},
      {title + "1,0,0,nan\n", ":2: triangle 1 has weight nan, expected a finite number"},
      {title + "1,0,0,0\n2,0,0,0\n", ":3: has more rows than m.obj has cells (1)"}};
  for (const auto& [content, message] : kCases) {
    make(file.c_str(), content);
    const auto f = read(path("m.obj"));
    ASSERT_FALSE(f) << content;
    EXPECT_EQ(plain(f.error().what()), file + message);
  }
  make(file.c_str(), title);
  EXPECT_TRUE(read(path("m.obj"))->triangles.data.empty()) << "it replaces an old one";
}

}  // namespace
}  // namespace temper::io
