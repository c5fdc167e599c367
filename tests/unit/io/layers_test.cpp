// Layers as files: what is read, what is refused, and what MODFLOW and TOUGH find in theirs.
// (tests/python/test_columns.py reads whole files by readers of its own.)
#include "support.hpp"
#include "temper/detail/dec_io.hpp"

namespace temper::io {
namespace {

constexpr std::string_view kMesh =
    "MeshVersionFormatted 2\nDimension 2\nVertices\n5\n0 0 0\n9 9 0\n1 0 0\n0.5 0.9 0\n1.5 0.8 0\n"
    "Triangles\n2\n1 3 4 0\n3 5 4 0\nEnd\n";  // point 2 is in no triangle

class LayerFiles : public FileTest {
 protected:
  void SetUp() override {
    FileTest::SetUp();
    file_ = *read(make("a.mesh", kMesh));
    loaded_.emplace(*make_mesh(file_));
  }
  [[nodiscard]] Expected<Layers> layers(std::string_view text) const {
    return read_layers(make("l.csv", text), file_, *loaded_);
  }
  void expect_error(std::string_view text, const std::string& message) const {
    const auto read = layers(text);
    EXPECT_EQ(read ? "nothing" : plain(read.error().what()), message) << text;
  }
  [[nodiscard]] Expected<std::vector<std::string>> write(const Layers& layers, const std::vector<DecFormat>& formats,
                                                         CellsOf of = CellsOf::vertices) const {
    const Mesh& mesh = loaded_->mesh;
    const DecComplex complex = dec_operators(mesh);
    const PowerCells cells = power_cells(mesh, complex);
    const auto made = columns(mesh, complex, cell_polygons(mesh, complex, of), layers);
    if (!made) return made.error();
    const std::vector<GroupCell> groups = cells_of_groups(file_, *loaded_, mesh, of);
    return write_dec(path("out"), mesh, complex, cells,
                     {.formats = formats, .columns = &*made, .groups = groups, .barriers = barriers_});
  }
  MeshFile file_;
  std::optional<LoadedMesh> loaded_;
  std::vector<Barrier> barriers_;
};

TEST_F(LayerFiles, RowsGoToTheVerticesThatTheirNumbersName) {
  const auto read =
      layers("# a comment\nvertex, top, bottom 1, bottom 2\r\n\n4, 3, 2, 1\n1,10,9,8\n5,0.5e1,4,nan\n3,7,6,5\n");
  ASSERT_TRUE(read) << read.error().what();
  EXPECT_EQ(read->n_layers, 2u);
  EXPECT_TRUE(read->active.empty());
  ASSERT_EQ(read->surfaces.size(), 12u);
  EXPECT_TRUE(std::isnan(read->surfaces[11]));
  EXPECT_EQ(std::vector<double>(read->surfaces.begin(), read->surfaces.end() - 1),
            (std::vector<double>{10, 9, 8, 7, 6, 5, 3, 2, 1, 5, 4}));
}

TEST_F(LayerFiles, TheRowOfAllGivesWhatOthersLeaveOut) {
  const auto read = layers("vertex,top,bottom,active\n*,2,1,1\n3,,0.5,0\n");
  ASSERT_TRUE(read) << read.error().what();
  EXPECT_EQ(read->surfaces, (std::vector<double>{2, 1, 2, 0.5, 2, 1, 2, 1}));
  EXPECT_EQ(read->active, (std::vector<std::uint8_t>{1, 0, 1, 1}));
  EXPECT_EQ(layers("vertex,top,bottom\n*,2,1")->surfaces.size(), 8u) << "constants alone";
}

TEST_F(LayerFiles, ErrorsNameLineColumnAndVertex) {
  expect_error("", "l.csv: the file is empty");
  expect_error("# nothing\n", "l.csv: expected a title line 'vertex,top,bottom 1', found none");
  expect_error("point,top,bottom\n", "l.csv:1: column 1: expected the title 'vertex', found 'point'");
  expect_error("vertex,top\n", "l.csv:1: column 3: expected the title 'bottom 1', found the end of the line");
  expect_error("vertex,top,bottom,depth\n",
               "l.csv:1: column 4: expected the title 'bottom' or 'active', found 'depth'");
  expect_error(
      "vertex,top,bottom 1,bottom 2,active 1\n",
      "l.csv:1: column 6: expected the title 'active' for each of 2 layers, and no other, found the end of the line");
  expect_error("vertex,top,bottom\n1,3\n", "l.csv:2: vertex 1: expected 3 columns, found 2");
  expect_error("vertex,top,bottom\n*,2,1\n\n3,abc,1\n",
               "l.csv:4: column 2 ('top'), vertex 3: expected a height, found 'abc'");
  expect_error("vertex,top,bottom\n3,2,\n",
               "l.csv:2: column 3 ('bottom'), vertex 3: is empty, and there is no row * with its default");
  expect_error("vertex,top,bottom\n3,2,inf\n",
               "l.csv:2: column 3 ('bottom'), vertex 3: expected a height or nan, found 'inf'");
  expect_error("vertex,top,bottom,active\n3,2,1,yes\n",
               "l.csv:2: column 4 ('active'), vertex 3: expected 0 or 1, found 'yes'");
  expect_error("vertex,top,bottom 1,bottom 2\n3,2,1,1.5\n",
               "l.csv:2: vertex 3: bottom 2 is 1.5, higher than bottom 1, which is 1");
  expect_error("vertex,top,bottom\n2,2,1\n", "l.csv:2: a.mesh has no vertex 2 in a triangle");
  expect_error("vertex,top,bottom\nv3,2,1\n",
               "l.csv:2: column 1 ('vertex'): expected the number of a vertex, or *, found 'v3'");
  expect_error("vertex,top,bottom\n3,2,1\n3,2,1\n", "l.csv:3: vertex 3 has its row in line 2 already");
  expect_error("vertex,top,bottom\n3,2,1\n*,2,1\n", "l.csv:3: the row * has to come once, before all others");
  expect_error("vertex,top,bottom\n3,2,1\n",
               "l.csv: has no row for vertices 1, 4, 5 of a.mesh, and no row * with their default");
}

TEST_F(LayerFiles, FormatsOfColumnsWantColumnsAndWriteNothingWithout) {
  const Mesh& mesh = loaded_->mesh;
  const DecComplex complex = dec_operators(mesh);
  const auto written =
      write_dec(path("out"), mesh, complex, power_cells(mesh, complex), {.formats = {DecFormat::disv}});
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().what(), "formats disv, disu, tough and uge need layers");
  EXPECT_FALSE(std::filesystem::exists(path("out")));
}

TEST_F(LayerFiles, EveryFormatMakesTheFilesItNames) {
  for (const DecFormat format : {DecFormat::vtu, DecFormat::disv, DecFormat::disu, DecFormat::tough, DecFormat::uge}) {
    const auto written = write(*layers("vertex,top,bottom\n*,2,1\n"), {format});
    ASSERT_TRUE(written) << written.error().what();
    const auto names = dec_file_names(format, DecKind::columns);
    ASSERT_EQ(written->size(), names.size());
    for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ((*written)[i], path("out") + "/" + std::string(names[i]));
  }
}

TEST_F(LayerFiles, AVertexWithoutACellHasNoneAndDisvNoPlaceForIt) {
  const std::vector<Vec2> points = {{0, 0}, {1, 0}, {0.5, 0.8}};
  const std::vector<std::array<std::int32_t, 3>> triangles = {{0, 1, 2}};
  const std::vector<double> weights = {0, 1.2, 0.5};  // the cell of vertex 0 is outside of the triangle
  const Mesh mesh = Mesh::build({.points = points, .weights = weights, .triangles = triangles})->mesh;
  const DecComplex complex = dec_operators(mesh);
  const PowerCells cells = power_cells(mesh, complex);
  ASSERT_EQ(cells.areas[VertexId(0)], 0);
  const auto made = columns(mesh, complex, cell_polygons(mesh, cells), {1, {1, 0, 1, 0, 1, 0}, {}});
  ASSERT_TRUE(made) << made.error().what();
  EXPECT_EQ(made->states[0], CellState::inactive);
  const auto disv = write_dec(path("out"), mesh, complex, cells, {.formats = {DecFormat::disv}, .columns = &*made});
  ASSERT_FALSE(disv);
  EXPECT_EQ(disv.error().what(),
            "the power cell of point 0 in the domain is not one polygon, which DISV needs. Next: write DISU");
  EXPECT_FALSE(std::filesystem::exists(path("out")));
  ASSERT_TRUE(write_dec(path("out"), mesh, complex, cells, {.formats = {DecFormat::disu}, .columns = &*made}));
  const std::string disu = slurp(path("out/mesh.disu"));
  EXPECT_NE(disu.find("  IDOMAIN\n    INTERNAL FACTOR 1\n      0 1 1\n"), std::string::npos) << disu;
  EXPECT_EQ(disu.find("VERTICES"), std::string::npos);
}

TEST_F(LayerFiles, TrianglesAreCellsOfDisvWithOrthocentersAndVerticesOfTheMesh) {
  ASSERT_EQ(loaded_->mesh.n_triangles(), 2u);
  const Layers layers = layers_of_triangles(loaded_->mesh, *this->layers("vertex,top,bottom\n*,2,1\n"));
  const auto written = write(layers, {DecFormat::disv}, CellsOf::triangles);
  ASSERT_TRUE(written) << written.error().what();
  const std::string disv = slurp(path("out/mesh.disv"));
  EXPECT_TRUE(
      disv.starts_with("# Triangles under layers, with orthocenters as centers. Cell n is the n-th triangle.\n"));
  EXPECT_NE(disv.find("  NLAY 1\n  NCPL 2\n  NVERT 4\n"), std::string::npos) << disv;
  const std::size_t cells = disv.find("BEGIN CELL2D\n  1 ");
  ASSERT_NE(cells, std::string::npos);
  std::istringstream rows(disv.substr(cells + std::string_view("BEGIN CELL2D\n").size()));
  std::size_t cell = 0, n = 0;
  Vec2 center;
  rows >> cell >> center.x >> center.y >> n;
  EXPECT_EQ(center, dec_operators(loaded_->mesh).orthocenters[TriangleId(0)]);
  EXPECT_EQ(n, 3u);
}

TEST_F(LayerFiles, BarriersHaveARowInEachLayerThatBothCellsAreActiveIn) {
  barriers_ = {{"fault", 1, 0, 1e-6}, {"fault", 1, 2, 1e-6}, {"", 0, 2, -0.5}};
  ASSERT_TRUE(write(*layers("vertex,top,bottom 1,bottom 2,active 1,active 2\n*,2,1,0,1,1\n1,,,,0,1\n"),
                    {DecFormat::disv, DecFormat::disu}));
  const std::string head =
      "# Horizontal flow barriers: two cells, and the hydraulic characteristic of the barrier between them.\n"
      "BEGIN OPTIONS\nEND OPTIONS\nBEGIN DIMENSIONS\n  MAXHFB 4\nEND DIMENSIONS\nBEGIN PERIOD 1\n";
  EXPECT_EQ(slurp(path("out/mesh.disv.hfb")), head +
                                                  "# fault\n  2 2 2 1 1e-06\n  1 2 1 3 1e-06\n  2 2 2 3 1e-06\n"
                                                  "  2 1 2 3 -0.5\nEND PERIOD\n");
  EXPECT_EQ(slurp(path("out/mesh.disu.hfb")),
            head + "# fault\n  6 5 1e-06\n  2 3 1e-06\n  6 7 1e-06\n  5 7 -0.5\nEND PERIOD\n");
}

TEST_F(LayerFiles, ABarrierNeedsTwoNeighborsAndAFiniteNumber) {
  const auto layers_given = *layers("vertex,top,bottom\n*,2,1\n");
  const auto message = [&](const Barrier& barrier) {
    barriers_ = {barrier};
    const auto written = write(layers_given, {DecFormat::disv});
    return written ? "nothing" : plain(written.error().what());
  };
  EXPECT_EQ(message({"fault", 0, 0, 1}),
            "barrier 'fault': the cell of point 0 and the cell of point 0 have no common face; expected two neighbors");
  EXPECT_EQ(message({"", 0, 1, HUGE_VAL}), "a barrier: expected a finite hydraulic characteristic, found inf");
  EXPECT_FALSE(std::filesystem::exists(path("out")));
}

TEST_F(LayerFiles, BarriersOfLinesAreBetweenTheTrianglesOnTheirTwoSides) {
  MeshFile file = file_;
  const Mesh& mesh = loaded_->mesh;
  HalfedgeId inner;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_boundary(h)) inner = h;
  }
  const auto point = [&](VertexId v) {
    for (std::size_t p = 0; p < file.points.size(); ++p) {
      if (loaded_->vertex_of_point[p] == static_cast<std::int32_t>(v.index)) return static_cast<std::int32_t>(p);
    }
    return -1;
  };
  file.lines.add({point(mesh.origin(inner)), point(mesh.target(inner))}, 9);
  file.names = {{1, 9, "fault"}};
  const std::vector<std::pair<std::string, double>> by_name = {{"fault", 2}}, by_tag = {{"9", 2}},
                                                    unknown = {{"river", 2}};
  for (const auto& asked : {by_name, by_tag}) {
    const auto made = barriers_of_lines(file, *loaded_, mesh, asked, CellsOf::triangles);
    ASSERT_TRUE(made) << made.error().what();
    ASSERT_EQ(made->size(), 1u);
    EXPECT_EQ(std::min(made->front().first, made->front().second), 0u);
    EXPECT_EQ(std::max(made->front().first, made->front().second), 1u);
    EXPECT_EQ(made->front().characteristic, 2);
  }
  EXPECT_EQ(barriers_of_lines(file, *loaded_, mesh, unknown, CellsOf::triangles).error().what(),
            "barrier 'river': no line inside the domain has this name or tag");
}

TEST_F(LayerFiles, ToughHasFixedColumnsAndAllDigitsThatTheyHold) {
  ASSERT_TRUE(write(*layers("vertex,top,bottom 1,bottom 2\n*,1e6,0,-0.25\n3,1e6,1e6,-0.25\n"), {DecFormat::tough}));
  std::istringstream lines(slurp(path("out/MESH")));
  std::vector<std::string> all;
  for (std::string line; std::getline(lines, line);) all.push_back(line);
  ASSERT_EQ(all.size(), 1u + 7 + 1 + 1 + 2 + 5 + 3 + 1);
  EXPECT_EQ(all[0], "ELEME");
  EXPECT_EQ(all[1].substr(0, 20), "AAA10              1");
  for (std::size_t i = 1; i <= 7; ++i) EXPECT_EQ(all[i].size(), 80u) << all[i];
  EXPECT_EQ(all[1].substr(50), "0.000000000.00000000500000.000");
  EXPECT_EQ(all[8], "");
  EXPECT_EQ(all[9], "CONNE");
  EXPECT_EQ(all[10].substr(0, 30), "AAA10AAA12                   1");
  for (std::size_t i = 10; i + 1 < all.size(); ++i) EXPECT_EQ(all[i].size(), 70u) << all[i];
  EXPECT_EQ(all.back(), "");
}

TEST_F(LayerFiles, PflotranHasActiveCellsAndThePlacesWhereTheLinesOfCentersCrossFaces) {
  ASSERT_TRUE(write(*layers("vertex,top,bottom 1,bottom 2\n*,2,0,-1\n3,2,2,-1\n"), {DecFormat::uge}));
  std::istringstream in(slurp(path("out/mesh.uge")));
  std::string word;
  std::size_t n = 0;
  in >> word >> n;
  EXPECT_EQ(word, "CELLS");
  EXPECT_EQ(n, 7u) << "one of eight is pinched out";
  std::vector<Vec3> centers(n);
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t number = 0;
    double volume = 0;
    in >> number >> centers[i].x >> centers[i].y >> centers[i].z >> volume;
    EXPECT_EQ(number, i + 1);
    EXPECT_GT(volume, 0);
  }
  in >> word >> n;
  EXPECT_EQ(word, "CONNECTIONS");
  EXPECT_EQ(n, 10u);
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t a = 0, b = 0;
    Vec3 face;
    double area = 0;
    in >> a >> b >> face.x >> face.y >> face.z >> area;
    const Vec3 from = centers.at(a - 1), to = centers.at(b - 1);
    EXPECT_NEAR(length(face - from) + length(to - face), length(to - from), 1e-12) << a << " " << b;
    EXPECT_GT(area, 0);
  }
  EXPECT_TRUE(in.good());
}

}  // namespace
}  // namespace temper::io
