// temper operators.
#include "temper/io.hpp"
#include "workshop.hpp"

namespace temper::test {
namespace {

class Dec : public Workshop {
 protected:
  /// No file is made or changed, and nothing is printed but the message.
  void expect_failure(const std::vector<std::string>& arguments, int code, const std::string& message) {
    const auto before = names();
    const auto outcome = temper(arguments);
    EXPECT_EQ(outcome.exit, code) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, message)) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(names(), before);
  }
};

TEST_F(Dec, WritesTheFormatsAskedForAndSaysWhatItWrote) {
  make_input();
  const auto all = temper_ok({"operators", "in.vtu", "-o", "all"});
  EXPECT_TRUE(contains(all.out, "wrote all/operators.npz"));
  EXPECT_TRUE(contains(all.out, "wrote all/dual_edges.vtu"));
  EXPECT_TRUE(all.out.starts_with("in.vtu: ") && contains(all.out, " coefficients are bad (negative): "));
  EXPECT_TRUE(contains(all.out, "Next: temper optimize IN -o OUT --for vertex")) << all.out;
  const auto json =
      nlohmann::json::parse(temper_ok({"operators", "in.vtu", "-o", "some", "--format", "vtu", "--json"}).out);
  EXPECT_EQ(json.at("files"), nlohmann::json({"some/dual.vtu", "some/dual_edges.vtu"}));
  const auto check = nlohmann::json::parse(temper_ok({"check", "in.vtu", "--json"}).out);
  for (const char* key : {"vertices", "triangles", "edges", "boundary_edges"})
    EXPECT_EQ(json.at(key), check.at(key)) << key;
  EXPECT_EQ(json.at("negative_star1"), check.at("non_regular_edges"));
  EXPECT_EQ(json.at("negative_boundary_star1"), check.at("negative_boundary_duals"));
  EXPECT_NEAR(json.at("star0_sum").get<double>(), json.at("area").get<double>(), 1e-12);
  EXPECT_NEAR(json.at("cell_area_sum").get<double>(), json.at("area").get<double>(), 1e-12);
}

TEST_F(Dec, AWellCenteredMeshGivesNoWarning) {
  write("a.mesh",
        "MeshVersionFormatted 2\nDimension 2\nVertices\n4\n0 0 0\n1 0 0\n0.5 0.9 0\n1.5 0.8 0\n"
        "Triangles\n2\n1 2 3 0\n2 4 3 0\nEnd\n");
  const auto outcome = temper_ok({"operators", "a.mesh", "-o", "out", "--format", "mtx"});
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(read("out/d0.mtx"),
            "%%MatrixMarket matrix coordinate real general\n"
            "% edges x vertices: -1 at the lower vertex, +1 at the higher\n5 4 10\n"
            "1 1 -1\n1 2 1\n2 1 -1\n2 3 1\n3 2 -1\n3 3 1\n4 2 -1\n4 4 1\n5 3 -1\n5 4 1\n");
}

TEST_F(Dec, TetrahedraHaveTheSameVerb) {
  // A regular tetrahedron in two regions of its two halves: the orthocenters are on the face between them.
  write("a.mesh",
        "MeshVersionFormatted 2\nDimension 3\nVertices\n5\n1 1 1 0\n1 -1 -1 0\n-1 1 -1 0\n-1 -1 1 0\n0 0 1 0\n"
        "Tetrahedra\n2\n1 2 3 5 1\n2 3 4 5 2\nEnd\n");
  const auto plain = temper_ok({"operators", "a.mesh", "-o", "all"});
  for (const char* said :
       {"faces                                            7", "wrote all/star3.npz", "wrote all/dual.vtu"})
    EXPECT_TRUE(contains(plain.out, said)) << plain.out;
  EXPECT_TRUE(contains(plain.out, "a.mesh: ") && contains(plain.out, " bad (negative): ")) << plain.out;
  const auto json = nlohmann::json::parse(
      temper_ok({"operators", "a.mesh", "-o", "k", "--coefficient", "1=2,2=3", "--format", "mtx", "--json"}).out);
  const auto check = nlohmann::json::parse(temper_ok({"check", "a.mesh", "--json"}).out);
  for (const char* key : {"vertices", "edges", "faces", "boundary_faces", "tetrahedra", "volume"})
    EXPECT_EQ(json.at(key), check.at(key)) << key;
  EXPECT_EQ(json.at("negative_star2"), check.at("non_regular_faces"));
  EXPECT_EQ(json.at("negative_boundary_star2"), check.at("negative_boundary_duals"));
  EXPECT_EQ(json.at("not_well_centered"), check.at("orthocenters_outside"));
  EXPECT_EQ(read("k/star1.mtx") == read("all/star1.mtx"), false);
  EXPECT_EQ(read("k/star2.mtx"), read("all/star2.mtx"));
  // Data of tetrahedra by name, beside a tagged face whose data have another length.
  io::MeshFile named = *io::read("a.mesh");
  named.tetrahedra.data = {{"k", 1, std::vector<double>{2, 3}}};
  named.triangles.add({0, 1, 4}, 7);
  ASSERT_TRUE(io::write("named.vtu", named));
  temper_ok({"operators", "named.vtu", "-o", "by_name", "--coefficient", "k", "--format", "mtx"});
  EXPECT_EQ(read("by_name/star1.mtx"), read("k/star1.mtx"));
  expect_failure({"operators", "a.mesh", "-o", "b", "--coefficient", "1=2"}, 2, "there is no value for region 2");
  expect_failure({"operators", "a.mesh", "-o", "b", "--coefficient", "k"}, 2, "no data 'k' of tetrahedra");
  expect_failure({"operators", "a.mesh", "-o", "b", "--tensor", "2,0,1"}, 2,
                 "a.mesh: --tensor: tetrahedra need 6 numbers KXX,KXY,KXZ,KYY,KYZ,KZZ, found 3");
  expect_failure({"operators", "a.mesh", "-o", "b", "--pinch-out", "1"}, 2, "--pinch-out is for triangles alone");
}

TEST_F(Dec, ACoefficientComesFromDataOrRegions) {
  const auto mesh = [this](const std::string& regions) {
    write("a.mesh",
          "MeshVersionFormatted 2\nDimension 2\nVertices\n4\n0 0 0\n1 0 0\n0.5 0.9 0\n1.5 0.8 0\nTriangles\n2\n" +
              regions + "End\n");
  };
  mesh("1 2 3 1\n2 4 3 2\n");
  temper_ok({"operators", "a.mesh", "-o", "plain", "--format", "mtx"});
  temper_ok({"operators", "a.mesh", "-o", "k", "--format", "npz,mtx", "--coefficient", "1=2,2=2"});
  EXPECT_EQ(read("k/star0.mtx"), read("plain/star0.mtx"));
  const auto line = [this](const std::string& file) {
    const std::string all = read(file);
    return std::stod(all.substr(all.rfind(' ')));
  };
  EXPECT_DOUBLE_EQ(line("k/star1.mtx"), 2 * line("plain/star1.mtx"));
  EXPECT_TRUE(contains(read("k/operators.npz"), "capacity.npy"));
  expect_failure({"operators", "a.mesh", "-o", "out", "--coefficient", "1=2"}, 2, "there is no value for region 2");
  expect_failure({"operators", "a.mesh", "-o", "out", "--coefficient", "1=2,2=2,3=1"}, 2, "the mesh has no region 3");
  expect_failure({"operators", "a.mesh", "-o", "out", "--coefficient", "1=2,2=0"}, 1,
                 "a.mesh:12: triangle 2 has the coefficient 0; expected a finite number above 0");
  expect_failure({"operators", "a.mesh", "-o", "out", "--coefficient", "k"}, 2, "there are no data 'k' of triangles");
}

TEST_F(Dec, LayersMakeColumns) {
  write("a.mesh",
        "MeshVersionFormatted 2\nDimension 2\nVertices\n4\n0 0 0\n1 0 0\n0.5 0.9 0\n1.5 0.8 0\n"
        "Triangles\n2\n1 2 3 0\n2 4 3 0\nEnd\n");
  write("l.csv", "vertex,top,bottom 1,bottom 2\n*,3,2,2\n4,3,2,1.5\n");
  const auto outcome =
      temper_ok({"operators", "a.mesh", "-o", "out", "--layers", "l.csv", "--format", "disv,tough", "--json"});
  EXPECT_EQ(outcome.err, "");
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json.at("files"), nlohmann::json({"out/mesh.disv", "out/mesh.disv.csv", "out/MESH", "out/MESH.csv"}));
  const auto& columns = json.at("columns");
  EXPECT_EQ(columns.at("active"), 5);
  EXPECT_EQ(columns.at("pinched_out"), 3);
  EXPECT_EQ(columns.at("horizontal_connections"), 5);
  EXPECT_EQ(columns.at("vertical_connections"), 1);
  EXPECT_NEAR(columns.at("volumes")[0].get<double>(), json.at("area").get<double>(), 1e-12);
  EXPECT_TRUE(contains(temper_ok({"operators", "a.mesh", "-o", "out", "--layers", "l.csv", "--pinch-out", "0.5"}).out,
                       "  pinched out                                    4"));
  EXPECT_TRUE(contains(temper_ok({"operators", "a.mesh", "-o", "out", "--pinch-out", "0.5"}).err,
                       "no effect without --layers"));
  write("bad.csv", "vertex,top,bottom 1\n*,3,2\n7,3,2\n");
  const auto bad = temper({"operators", "a.mesh", "-o", "new", "--layers", "bad.csv"});
  EXPECT_EQ(bad.exit, 1);
  EXPECT_TRUE(contains(bad.err, "bad.csv:3: a.mesh has no vertex 7 in a triangle")) << bad.err;
  EXPECT_FALSE(std::filesystem::exists("new"));
  shell("mkdir here && cp l.csv here/MESH");
  EXPECT_EQ(temper({"operators", "a.mesh", "-o", "here", "--layers", "here/MESH", "--format", "tough"}).exit, 2);
}

TEST_F(Dec, TrianglesMayBeTheCellsWithBarriersOnTheirEdges) {
  write("a.msh",
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n1 7 \"fault\"\n$EndPhysicalNames\n$Nodes\n4\n"
        "1 0 0 0\n2 1 0 0\n3 0.5 0.9 0\n4 1.5 0.8 0\n$EndNodes\n$Elements\n3\n"
        "1 1 2 7 7 2 3\n2 2 2 0 1 1 2 3\n3 2 2 0 1 2 4 3\n$EndElements\n");
  write("l.csv", "vertex,top,bottom 1,bottom 2\n*,3,2,1\n");
  const std::vector<std::string> all = {"operators", "a.msh",    "-o",   "out",   "--layers",
                                        "l.csv",     "--format", "disv", "--json"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), all.begin(), all.end());
    return more;
  };
  const auto json = nlohmann::json::parse(temper_ok(with({"--cells", "triangles", "--barriers", "fault=1e-6"})).out);
  EXPECT_EQ(json.at("files"), nlohmann::json({"out/mesh.disv", "out/mesh.disv.csv", "out/mesh.disv.hfb"}));
  EXPECT_EQ(json.at("columns").at("active"), 4);
  EXPECT_TRUE(contains(read("out/mesh.disv"), "NCPL 2\n  NVERT 4"));
  EXPECT_TRUE(contains(read("out/mesh.disv.hfb"), "MAXHFB 2\n"));
  EXPECT_TRUE(contains(read("out/mesh.disv.hfb"), "# fault\n  1 1 1 2 1e-06\n  2 1 2 2 1e-06\nEND PERIOD\n") ||
              contains(read("out/mesh.disv.hfb"), "# fault\n  1 2 1 1 1e-06\n  2 2 2 1 1e-06\nEND PERIOD\n"))
      << read("out/mesh.disv.hfb");
  expect_failure(with({"--barriers", "fault=1"}), 2,
                 "barrier 'fault': its line runs through the centers of power cells");
  expect_failure(with({"--cells", "triangles", "--barriers", "fault"}), 2,
                 "--barriers: expected NAME=NUMBER, found 'fault'");
  expect_failure(with({"--cells", "triangles", "--barriers", "river=1"}), 2,
                 "barrier 'river': no line inside the domain has this name or tag");
}

// A fault of three pieces is on faces of power cells: each is a barrier between two vertices.
TEST_F(Dec, BarriersOfPowerCellsAreOnLinesThatAreFaces) {
  write("o.geojson", R"({"type": "FeatureCollection", "crs": "EPSG:32632", "features": [)"
                     R"({"type": "Feature", "properties": {}, "geometry": {"type": "Polygon",)"
                     R"( "coordinates": [[[0, 0], [90, 0], [90, 60], [0, 60], [0, 0]]]}}, )"
                     R"({"type": "Feature", "properties": {"name": "fault"}, "geometry": {"type": "LineString",)"
                     R"( "coordinates": [[20, 20], [45, 30], [70, 30]]}}]})");
  temper_ok({"mesh", "o.geojson", "-o", "f.vtu", "--size", "12", "--faces", "fault", "--for", "vertex"});
  write("l.csv", "vertex,top,bottom 1\n*,1,0\n");
  const std::vector<std::string> all = {"operators", "f.vtu",    "-o",   "out",        "--layers",
                                        "l.csv",     "--format", "disv", "--barriers", "fault=1e-6"};
  temper_ok(all);
  const std::string hfb = read("out/mesh.disv.hfb");
  std::istringstream lines(hfb.substr(hfb.find("# fault\n") + 8));
  std::size_t rows = 0;
  for (std::string line; std::getline(lines, line) && line != "END PERIOD";) ++rows;
  EXPECT_GE(rows, 4U);
  EXPECT_TRUE(contains(hfb, "MAXHFB " + std::to_string(rows) + "\n"));
}

TEST_F(Dec, BadInputWritesNothing) {
  make_input();
  write("file", "");
  write("bad.mesh", "MeshVersionFormatted 2\nDimension 2\nVertices\n1\n0 0 0\nTriangles\n1\n1 2 3 0\nEnd\n");
  expect_failure({"operators", "bad.mesh", "-o", "out"}, 1, "bad.mesh:8: ");
  expect_failure({"operators", "in.vtu", "-o", "file"}, 1, "file: is not a folder; expected a folder, or a new name");
  expect_failure({"operators", "in.vtu", "-o", "no/such"}, 1, "no/such: cannot be made: No such file or directory");
  expect_failure({"operators", "in.vtu"}, 2, "--output");
  expect_failure({"operators", "in.vtu", "-o", "out", "--format", "npz,vtk"}, 2,
                 "'vtk' is none of npz, mtx, vtu, disv, disu, tough");
  expect_failure({"operators", "in.vtu", "-o", "out", "--format", "npz,"}, 2,
                 "'' is none of npz, mtx, vtu, disv, disu, tough");
  expect_failure({"operators", "in.vtu", "-o", "out", "--format", "disv"}, 2,
                 "disv, disu, tough and uge need --layers");
  expect_failure({"operators", "in.vtu", "-o", "out", "--layers", "no.csv"}, 1, "no.csv: ");
  expect_failure({"operators", "in.vtu", "-o", "out", "--layers", "file"}, 1, "file: the file is empty");
  shell("cp in.vtu dual.vtu");
  EXPECT_EQ(temper({"operators", "dual.vtu", "-o", "."}).exit, 2) << "it would be replaced";
  EXPECT_EQ(read("dual.vtu"), read("in.vtu"));
}

}  // namespace
}  // namespace temper::test
