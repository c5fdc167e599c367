// temper draw, convert and example.
#include <algorithm>
#include <filesystem>
#include <utility>

#include "temper/io.hpp"
#include "temper/quality.hpp"
#include "workshop.hpp"

namespace temper::test {
namespace {

class Draw : public Workshop {};
class Convert : public Workshop {};
class Example : public Workshop {};

TEST_F(Draw, WritesOnePanelOrTwo) {
  make_input("a.vtu");
  temper_ok({"draw", "a.vtu", "-o", "one.svg"});
  temper_ok({"draw", "a.vtu", "--before", "a.vtu", "-o", "two.svg"});
  const std::string one = read("one.svg"), two = read("two.svg");
  EXPECT_TRUE(contains(one, "<svg"));
  EXPECT_TRUE(contains(one, "</svg>"));
  EXPECT_GT(two.size(), one.size());
  EXPECT_EQ(names(), (std::vector<std::string>{"a.vtu", "one.svg", "two.svg"}));
}

TEST_F(Draw, RefusesTheNameOfAPictureThatItDoesNotWrite) {
  make_input("a.vtu");
  for (const std::vector<std::string>& words : {std::vector<std::string>{"draw", "a.vtu", "-o", "a.jpg"},
                                                {"optimize", "a.vtu", "-o", "b.vtu", "--write", "a.TIFF"}}) {
    const Outcome outcome = temper(words);
    EXPECT_EQ(outcome.exit, 2);
    EXPECT_TRUE(contains(outcome.err, ".svg")) << outcome.err;
  }
  EXPECT_EQ(names(), std::vector<std::string>{"a.vtu"});
}

TEST_F(Draw, EveryOptionChangesThePicture) {
  write("a.mesh",
        "MeshVersionFormatted 2\nDimension 2\nVertices\n6\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0.5 0.2 0\n0.5 0.2001 0\n"
        "Triangles\n6\n1 2 5 1\n2 6 5 1\n1 5 6 1\n2 3 6 2\n3 4 6 2\n4 1 6 2\nEnd\n");
  write("a.mesh.weights.csv", "point,weight\n1,0\n2,0.01\n3,0\n4,-0.01\n5,0\n6,0\n");
  const std::vector<std::vector<std::string>> options = {
      {"--no-primal"},         {"--color", "angle"}, {"--no-dual"},         {"--color", "none"},
      {"--no-rings"},          {"--weights"},        {"--numbers"},         {"--zoom", "0,0,0.5,0.5"},
      {"--width", "300"},      {"--title", "a < b"}, {"--tensor", "4,0,1"}, {"--cells", "power"},
      {"--cells", "triangles"}};
  temper_ok({"draw", "a.mesh", "-o", "plain.svg"});
  const std::string plain = read("plain.svg");
  for (const auto& option : options) {
    std::vector<std::string> arguments = {"draw", "a.mesh", "-o", "other.svg"};
    arguments.insert(arguments.end(), option.begin(), option.end());
    temper_ok(arguments);
    EXPECT_NE(read("other.svg"), plain) << option.front();
  }
  EXPECT_TRUE(contains(shell("temper draw a.mesh --title 'a < b' -o /dev/stdout").out, "a &lt; b"));
}

TEST_F(Draw, CellsAreFilledByRegionAndTheLegendNamesThem) {
  write("a.msh",
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 2 \"clay\"\n$EndPhysicalNames\n$Nodes\n5\n"
        "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0.5 0.5 0\n$EndNodes\n$Elements\n4\n"
        "1 2 2 1 1 1 2 5\n2 2 2 1 1 2 3 5\n3 2 2 2 2 3 4 5\n4 2 2 2 2 4 1 5\n$EndElements\n");
  temper_ok({"draw", "a.msh", "-o", "p.svg", "--cells", "power"});
  const std::string svg = read("p.svg");
  EXPECT_TRUE(contains(svg, ">region 1</text>"));
  EXPECT_TRUE(contains(svg, ">clay</text>"));
  std::size_t n = 0;
  for (std::size_t at = svg.find("class=\"region\""); at != std::string::npos;
       at = svg.find("class=\"region\"", at + 1))
    ++n;
  EXPECT_EQ(n, 2u) << "a path for each region";
  EXPECT_FALSE(contains(svg, "class=\"margin\""));
  EXPECT_FALSE(contains(svg, "class=\"primal\"")) << "of the edges only the boundary and lines";
  EXPECT_TRUE(contains(svg, "class=\"constrained\""));
  EXPECT_EQ(temper({"draw", "a.msh", "-o", "p.svg", "--cells", "power", "--color", "angle"}).exit, 2);
}

TEST_F(Draw, LinesOnFacesOfPowerCellsHaveTheirNames) {
  write("o.geojson", R"({"type": "FeatureCollection", "crs": "EPSG:32632", "features": [)"
                     R"({"type": "Feature", "properties": {}, "geometry": {"type": "Polygon",)"
                     R"( "coordinates": [[[0, 0], [90, 0], [90, 60], [0, 60], [0, 0]]]}}, )"
                     R"({"type": "Feature", "properties": {"name": "river"}, "geometry": {"type": "LineString",)"
                     R"( "coordinates": [[20, 50], [70, 50]]}}, )"
                     R"({"type": "Feature", "properties": {"name": "fault"}, "geometry": {"type": "LineString",)"
                     R"( "coordinates": [[20, 20], [45, 30], [70, 30]]}}]})");
  temper_ok({"mesh", "o.geojson", "-o", "f.vtu", "--size", "12", "--faces", "fault", "--for", "vertex"});
  temper_ok({"draw", "f.vtu", "-o", "p.svg", "--cells", "power"});
  const std::string svg = read("p.svg");
  EXPECT_TRUE(contains(svg, "class=\"face\"") && contains(svg, ">fault</text>")) << svg;
  EXPECT_FALSE(contains(svg, ">river</text>")) << "a line on edges of triangles";
  temper_ok({"draw", "f.vtu", "-o", "t.svg", "--cells", "triangles"});
  EXPECT_FALSE(contains(read("t.svg"), "class=\"face\""));
}

TEST_F(Draw, TheSuffixTellsTheFormat) {
  make_input("a.vtu");
  for (const auto& [name, begin] :
       {std::pair("p.png", "\x89PNG\r\n"), std::pair("p.pdf", "%PDF-"), std::pair("p.svg", "<svg")}) {
    temper_ok({"draw", "a.vtu", "-o", name});
    const std::string first = read(name);
    EXPECT_TRUE(first.starts_with(begin)) << name;
    temper_ok({"draw", "a.vtu", "-o", name});
    EXPECT_EQ(read(name), first) << name;
  }
  temper_ok({"optimize", "a.vtu", "-o", "b.vtu", "--write", "both.png"});
  EXPECT_TRUE(read("both.png").starts_with("\x89PNG"));
  EXPECT_EQ(temper({"draw", "a.vtu", "-o", "p.jpg"}).exit, 2);

  write("kept.png", "mine");
  const Outcome outcome = shell("temper=$(command -v temper); PATH=/nowhere \"$temper\" draw a.vtu -o kept.png");
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_TRUE(contains(outcome.err, "kept.png: cannot be written: rsvg-convert is not there"));
  EXPECT_EQ(read("kept.png"), "mine");
}

TEST_F(Draw, ColorsAreMeasuresOrDataOfTheFile) {
  make_input("a.vtu");
  for (const TriangleValue& value : triangle_values()) {
    temper_ok({"draw", "a.vtu", "-o", "p.svg", "--color", std::string(value.name)});
    EXPECT_TRUE(contains(read("p.svg"), "class=\"value\"")) << value.name;
  }
  const Outcome outcome = temper({"draw", "a.vtu", "-o", "q.svg", "--color", "color"});
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_TRUE(contains(outcome.err, "a.vtu: --color: there are no numbers 'color'; there are quality, angle"));
  EXPECT_FALSE(exists("q.svg"));
  // Data of points are their mean over the corners: 3 and 6 here.
  write("p.vtk",
        "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0 1 0 0 1 1 0 0 1 0\n"
        "CELLS 2 8\n3 0 1 2\n3 0 2 3\nCELL_TYPES 2\n5\n5\nPOINT_DATA 4\nSCALARS depth double 1\n"
        "LOOKUP_TABLE default\n0 0 9 9\n");
  temper_ok({"draw", "p.vtk", "-o", "p.svg", "--color", "depth"});
  EXPECT_TRUE(contains(read("p.svg"), "depth: 3 to 6"));
}

TEST_F(Draw, TetrahedraAreCutByThePlaneThatTheUserNames) {
  make_tetrahedra();
  temper_ok({"draw", "two.mesh", "-o", "middle.svg"});
  EXPECT_TRUE(contains(read("middle.svg"), "</tspan> of 2 tetrahedra bad at y = 0.85<"));  // across the shortest side
  temper_ok({"draw", "two.mesh", "-o", "z.svg", "--cut", "z=0.5", "--before", "two.mesh", "--title", "A <cut>"});
  EXPECT_TRUE(contains(read("z.svg"), "</tspan> of 1 tetrahedra bad at z = 0.5<"));
  EXPECT_TRUE(contains(read("z.svg"), ">A &lt;cut&gt;</text>"));
  make_input("a.vtu");
  const std::vector<std::pair<std::vector<std::string>, std::string>> refused = {
      {{"two.mesh", "--cut", "w=1"}, "--cut: expected x=VALUE, y=VALUE, z=VALUE or one of x, y, z, found 'w=1'"},
      {{"two.mesh", "--cut", "x=one"}, "--cut: expected a number after '=', found 'x=one'"},
      {{"two.mesh", "--cut", "x=2.5"}, "the plane x=2.5 misses the mesh, which has x from 0 to 2. Next: x=1"},
      {{"two.mesh", "--no-dual"}, "two.mesh has tetrahedra, and --no-dual is for triangles alone"},
      {{"two.mesh", "--color", "angle"}, "--color angle is for triangles alone"},
      {{"a.vtu", "--cut", "x"}, "a.vtu has triangles, and --cut is for tetrahedra alone. Next: leave it out"}};
  for (const auto& [words, message] : refused) {
    std::vector<std::string> all = {"draw", "-o", "none.svg"};
    all.insert(all.end(), words.begin(), words.end());
    const Outcome outcome = temper(all);
    EXPECT_EQ(outcome.exit, 2);
    EXPECT_TRUE(contains(outcome.err, message)) << outcome.err;
  }
  const Outcome mixed = temper({"draw", "two.mesh", "-o", "none.svg", "--before", "a.vtu"});
  EXPECT_EQ(mixed.exit, 1);
  EXPECT_TRUE(contains(mixed.err, "a.vtu: expected tetrahedra, as in two.mesh, found triangles"));
  EXPECT_FALSE(exists("none.svg"));
}

TEST_F(Convert, GoesThereAndBack) {
  make_input("a.vtu");
  const nlohmann::json before = numbers_of("a.vtu");
  for (const char* path : {"b.msh", "b.vtu", "b.mesh"}) {
    temper_ok({"convert", "a.vtu", "-o", path});
    EXPECT_EQ(numbers_of(path), before) << path;
  }
}

TEST_F(Convert, TetrahedraGoThroughOtherFormatsAndBack) {
  const std::string medit =
      "MeshVersionFormatted 2\nDimension 3\n\nVertices\n5\n0 0 0 7\n2 0 0 0\n1 1.7 0 0\n1 0.6 1.6 0\n1 0.6 -0.3 9\n"
      "\nEdges\n1\n1 4 5\n\nTriangles\n1\n1 2 3 6\n\nTetrahedra\n2\n1 2 3 4 1\n1 3 2 5 2\n\nEnd\n";
  write("a.mesh", medit);
  const char* from = "a.mesh";
  for (const char* to : {"b.vtu", "c.msh", "d.msh2", "e.vtk", "f.node", "g.mesh"}) {
    temper_ok({"convert", from, "-o", to});
    from = to;
  }
  EXPECT_EQ(read("g.mesh"), medit);
  // The second tetrahedron gets its own copy of a point, which a tagged face has too.
  std::string cracked = medit;
  cracked.replace(cracked.find("\n5\n"), 3, "\n6\n");
  cracked.replace(cracked.find("\nEdges"), 0, "1 1.7 1e-9 0\n").replace(cracked.find("1 3 2 5 2"), 9, "1 6 2 5 2");
  cracked.replace(cracked.find("1 2 3 6"), 7, "1 2 6 6");
  write("cracked.mesh", cracked);
  EXPECT_EQ(temper_ok({"convert", "cracked.mesh", "-o", "x.mesh", "--merge", "1e-8"}).out, "1 point merged\n");
  EXPECT_EQ(read("x.mesh"), medit);
  const Outcome far = temper({"convert", "cracked.mesh", "-o", "y.mesh", "--merge", "1.99"});
  EXPECT_EQ(far.exit, 1);
  EXPECT_TRUE(contains(far.err, "makes two corners of tetrahedron 1 one; expected less than its edges")) << far.err;
  const Outcome planar = temper({"convert", "a.mesh", "-o", "x.off"});
  EXPECT_EQ(planar.exit, 1);
  EXPECT_TRUE(contains(planar.err, "x.off: OFF is not written with tetrahedra; expected one of vtu, gmsh41, gmsh22"));
}

TEST_F(Convert, ANameMayHaveAsManyBytesAsTheFileSystemAllows) {
  make_input();
  const std::string longest = std::string(251, 'x') + ".vtu";
  temper_ok({"convert", "in.vtu", "-o", longest});
  EXPECT_EQ(read(longest), read("in.vtu"));
  const Outcome beyond = temper({"optimize", "none.vtu", "-o", "x" + longest});
  EXPECT_EQ(beyond.exit, 1);
  EXPECT_TRUE(contains(beyond.err, "File name too long")) << "before the input is read";
}

TEST_F(Convert, DashIsStandardInputAndOutput) {
  make_input("a.vtu");
  temper_ok({"convert", "a.vtu", "-o", "b.msh"});
  const Outcome piped =
      shell("temper convert - -o - --format gmsh41 < a.vtu | temper optimize - -o - --format vtu > c.vtu");
  EXPECT_EQ(piped.exit, 0) << piped.err;
  EXPECT_TRUE(contains(
      piped.err, "bad triangles                             72             0"));  // what is said leaves the mesh alone
  temper_ok({"optimize", "b.msh", "-o", "d.vtu"});
  EXPECT_EQ(numbers_of("c.vtu"), numbers_of("d.vtu"));
  EXPECT_TRUE(contains(shell("temper check - < c.vtu").out, "/dev/stdin: "));
}

TEST_F(Convert, NothingIsPutBesideAStream) {
  make_input("a.vtu");
  temper_ok({"optimize", "a.vtu", "-o", "weighted.vtu"});
  for (const char* where : {" > b.obj", " | cat > b.obj"}) {
    const Outcome piped = shell(std::string("temper convert weighted.vtu -o - --format obj") + where);
    EXPECT_EQ(piped.exit, 0) << piped.err;
    EXPECT_TRUE(contains(piped.err, "a stream has no file next to it")) << piped.err;
    const Outcome several = shell(std::string("temper convert weighted.vtu -o - --format triangle") + where);
    EXPECT_TRUE(contains(several.err, "Triangle is several files; expected the name of a file, found a stream"))
        << several.err;
  }
  EXPECT_FALSE(std::filesystem::exists("/dev/stdout.weights.csv"));
}

TEST_F(Convert, FormatAndEncodingAreAsAsked) {
  make_input("a.vtu");
  temper_ok({"convert", "a.vtu", "-o", "ascii.vtu", "--encoding", "ascii"});
  EXPECT_TRUE(contains(read("ascii.vtu"), "format=\"ascii\""));
  temper_ok({"convert", "a.vtu", "-o", "no-suffix", "--format", "gmsh22"});
  EXPECT_EQ(read("no-suffix").rfind("$MeshFormat\n2.2", 0), 0u);
}

TEST_F(Convert, CellsGoIntoFilesOfPolygonsAndNoMeshIntoThese) {
  make_input("a.vtu");
  temper_ok({"convert", "a.vtu", "-o", "cells.geojson", "--cells", "power"});
  const auto check = nlohmann::json::parse(temper_ok({"check", "a.vtu", "--json"}).out);
  const auto cells = read_json("cells.geojson");
  EXPECT_EQ(cells.at("features").size(), check.at("vertices"));
  temper_ok({"convert", "a.vtu", "-o", "triangles.geojson", "--cells", "triangles"});
  EXPECT_EQ(read_json("triangles.geojson").at("features").size(), check.at("triangles"));
  temper_ok({"convert", "a.vtu", "-o", "cells", "--cells", "power", "--format", "gpkg"});
  EXPECT_TRUE(read("cells").starts_with("SQLite format 3"));
  temper_ok({"optimize", "a.vtu", "-o", "optimized.geojson", "--cells", "power", "--quiet"});
  const auto refused = temper({"convert", "a.vtu", "-o", "mesh.geojson"});
  EXPECT_EQ(refused.exit, 2);
  EXPECT_TRUE(contains(refused.err, "GeoJSON holds polygons of cells. Next: --cells power")) << refused.err;
  EXPECT_EQ(temper({"convert", "a.vtu", "-o", "cells.msh", "--cells", "power"}).exit, 2);
  make_tetrahedra("two.mesh");
  const auto tetrahedra = temper({"convert", "two.mesh", "-o", "cells.vtu", "--cells", "power"});
  EXPECT_EQ(tetrahedra.exit, 2);
  EXPECT_TRUE(contains(tetrahedra.err, "triangles alone")) << tetrahedra.err;
  EXPECT_FALSE(exists("mesh.geojson") || exists("cells.msh") || exists("cells.vtu"));
}

TEST_F(Convert, ReplacesItsOwnInput) {
  make_input("a.vtu");
  const std::string before = temper_ok({"check", "a.vtu", "--json"}).out;
  temper_ok({"convert", "a.vtu", "-o", "a.vtu", "--encoding", "ascii"});
  EXPECT_EQ(temper_ok({"check", "a.vtu", "--json"}).out, before);
}

TEST_F(Example, ListNamesEveryExampleAndEachCanBeMade) {
  const std::string list = temper_ok({"example", "--list"}).out;
  int made = 0;
  for (const char* name : {"sparse-horseshoe", "horseshoe", "triangle", "random", "sheared-grid", "annulus", "airfoil",
                           "polygon", "letter-a", "wedge", "graded", "icosahedral", "random-sphere", "graded-sphere",
                           "random-periodic", "periodic-hexagons"}) {
    EXPECT_TRUE(contains(list, name));
    temper_ok({"example", name, "-o", "a.vtu"});
    EXPECT_EQ(temper({"check", "a.vtu", "--require", "inverted=0"}).exit, 0) << name;
    ++made;
  }
  EXPECT_EQ(made, std::count(list.begin(), list.end(), '\n'));
}

TEST_F(Example, ParametersArriveAndOptionsMayComeFirst) {
  temper_ok({"example", "-o", "a.vtu", "sheared-grid", "--nx", "3", "--ny", "2"});
  EXPECT_EQ(temper({"check", "a.vtu", "--require", "vertices=12,triangles=12"}).exit, 0);
  temper_ok({"example", "horseshoe", "--a", "7", "--b", "9", "--x", "1,2", "--y", "1,4", "-o", "h.vtu"});
  EXPECT_EQ(temper({"check", "h.vtu", "--require", "vertices=63,triangles=96"}).exit, 0);
  temper_ok({"example", "random", "--vertices", "200", "--polygon", "0,0,2,0,2,1,0,1", "-o", "r.vtu"});
  EXPECT_EQ(temper({"check", "r.vtu", "--require", "vertices=200,regions=1"}).exit, 0);
}

TEST_F(Example, PeriodicPlanesGoThroughTheVerbsThatTakeThem) {
  temper_ok({"example", "random-periodic", "--vertices", "200", "--period", "2,1", "-o", "in.vtu"});
  temper_ok({"optimize", "in.vtu", "-o", "out.vtu", "--write", "both.svg", "--quiet"});
  EXPECT_EQ(temper({"check", "out.vtu", "--require", "well_centered_fraction=1,boundary_edges=0"}).exit, 0);
  EXPECT_TRUE(contains(read("both.svg"), "class=\"period\""));
  temper_ok({"optimize", "in.vtu", "-o", "traced.vtu", "--write", "t.jsonl", "--quiet"});
  temper_ok({"paper", "replay", "in.vtu", "t.jsonl", "-o", "again.vtu"});
  EXPECT_EQ(read("again.vtu"), read("traced.vtu"));
  temper_ok({"operators", "out.vtu", "-o", "operators"});
  temper_ok({"convert", "out.vtu", "-o", "out.mpas.nc"});
  EXPECT_EQ(temper({"check", "out.mpas.nc", "--require", "well_centered_fraction=1,boundary_edges=0"}).exit, 0);
  const Outcome off = temper({"convert", "out.vtu", "-o", "out.off"});
  EXPECT_EQ(off.exit, 1);
  EXPECT_TRUE(
      contains(off.err, "the plane is periodic, which OFF has no place for; expected one of vtu, vtkhdf, mpas"));
  EXPECT_FALSE(exists("out.off"));
  using Words = std::vector<std::string>;
  for (const Words& words :
       {Words{"explain", "in.vtu"}, Words{"weights", "in.vtu", "-o", "w.vtu", "--connectivity", "search"},
        Words{"optimize", "in.vtu", "-o", "w.vtu", "--write", "w.html"}}) {
    const Outcome refused = temper(words);
    EXPECT_EQ(refused.exit, 1);
    EXPECT_TRUE(contains(refused.err, "the mesh is in a periodic plane, but ")) << refused.err;
    EXPECT_FALSE(exists("w.vtu"));
  }
}

TEST_F(Example, ParametersThatMakeNoMeshAreNamed) {
  EXPECT_EQ(temper({"example", "random", "--polygon", "0,0,1,1,1,0,0,1", "-o", "r.vtu"}).exit, 2);
  EXPECT_EQ(temper({"example", "annulus", "--inner", "2", "--outer", "1", "-o", "r.vtu"}).exit, 2);
  EXPECT_FALSE(exists("r.vtu"));
}

TEST_F(Draw, SpheresAreDrawnFromWhereOneLooks) {
  temper_ok({"example", "random-sphere", "--vertices", "200", "-o", "in.vtu"});
  temper_ok({"optimize", "in.vtu", "-o", "out.vtu", "--write", "both.svg", "--quiet"});
  EXPECT_TRUE(contains(read("both.svg"), "class=\"limb\""));
  temper_ok({"draw", "out.vtu", "-o", "front.svg"});
  temper_ok({"draw", "out.vtu", "-o", "same.svg", "--view", "0,0"});
  temper_ok({"draw", "out.vtu", "-o", "back.svg", "--view=-180,0", "--color", "quality"});
  EXPECT_EQ(read("front.svg"), read("same.svg"));
  EXPECT_NE(read("front.svg"), read("back.svg"));
  temper_ok({"draw", "out.vtu", "--before", "in.vtu", "-o", "both.svg"});

  temper_ok({"example", "annulus", "-o", "flat.vtu"});
  EXPECT_TRUE(contains(temper({"draw", "out.vtu", "-o", "x.svg", "--view", "0,91"}).err, "a latitude from -90 to 90"));
  EXPECT_TRUE(
      contains(temper({"draw", "flat.vtu", "-o", "x.svg", "--view", "0,0"}).err, "expected a mesh of the sphere"));
  const Outcome mixed = temper({"draw", "out.vtu", "--before", "flat.vtu", "-o", "x.svg"});
  EXPECT_EQ(mixed.exit, 1);
  EXPECT_TRUE(contains(mixed.err, "flat.vtu: is a mesh of the plane, but out.vtu is a mesh of the sphere"));
  EXPECT_FALSE(exists("x.svg"));
}

TEST_F(Convert, MergesPointsThatACheckNames) {
  write("in.off",
        "OFF\n8 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n1.000000001 0 0\n2 0 0\n2 1 0\n1.000000001 1 0\n"
        "3 0 1 2\n3 0 2 3\n3 4 5 6\n3 4 6 7\n");
  const std::string crack = temper_ok({"check", "in.off"}).err;
  EXPECT_TRUE(contains(crack, "2 pairs of boundary points are")) << crack;
  EXPECT_TRUE(contains(crack, "at (1, 0); the widest is 1e-09")) << crack;
  EXPECT_TRUE(contains(crack, "temper convert in.off --merge 1e-08 -o OUT")) << crack;
  EXPECT_TRUE(contains(temper_ok({"convert", "in.off", "--merge", "1e-08", "-o", "out.off"}).out, "2 points merged"));
  EXPECT_TRUE(contains(read("out.off"), "6 4"));
  EXPECT_EQ(temper_ok({"check", "out.off"}).err, "");
  EXPECT_TRUE(contains(temper({"convert", "in.off", "--merge", "1", "-o", "o.off"}).err, "two corners of triangle 0"));
}

// Point 4 is on the edge of the square above it, in a triangle of zero area; point 7 is on the boundary.
TEST_F(Convert, FlipsTrianglesOfZeroAreaAwayAsTheErrorSays) {
  write("in.off",
        "OFF\n8 7 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0.5 1 0\n1 2 0\n0 2 0\n0.5 0 0\n"
        "3 0 7 2\n3 7 1 2\n3 0 2 3\n3 3 2 4\n3 4 2 5\n3 3 4 6\n3 0 7 1\n");
  const Outcome flat = temper({"check", "in.off"});
  EXPECT_EQ(flat.exit, 1);
  EXPECT_TRUE(contains(flat.err, "triangle 3 has zero area")) << flat.err;
  EXPECT_TRUE(contains(flat.err, "Next: flip such triangles away with temper convert in.off --flip-flat -o OUT"));
  EXPECT_EQ(temper_ok({"convert", "in.off", "--flip-flat", "-o", "out.off"}).out, "2 triangles flipped away\n");
  EXPECT_TRUE(contains(read("out.off"), "OFF\n8 6 "));  // the triangle on the boundary is dropped
  temper_ok({"check", "out.off"});
  temper_ok({"optimize", "out.off", "-o", "best.vtu", "--quiet"});
  EXPECT_EQ(temper_ok({"convert", "out.off", "--flip-flat", "-o", "same.off"}).out, "0 triangles flipped away\n");
  EXPECT_EQ(read("same.off"), read("out.off"));
}

// Rounding has put point 4 below the edge of its triangle.
TEST_F(Convert, FlipsTrianglesAwayThatRoundingHasTurnedOver) {
  write("in.off",
        "OFF\n7 5 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n1 1.9 0\n2 3 0\n0 3 0\n"
        "3 0 1 2\n3 0 2 3\n3 3 2 4\n3 4 2 5\n3 3 4 6\n");
  const Outcome folded = temper({"check", "in.off"});
  EXPECT_TRUE(contains(folded.err, "if rounding has turned a triangle over, flip it away with temper convert in.off "))
      << folded.err;
  EXPECT_EQ(temper_ok({"convert", "in.off", "--flip-flat", "-o", "out.off"}).out, "1 triangle flipped away\n");
  EXPECT_TRUE(contains(temper_ok({"check", "out.off"}).out, "7 vertices, 5 triangles"));
}

// Two rows of points that rounding has put on one line, as in coordinates of UTM with seven digits.
TEST_F(Convert, FlipsStripsWithoutAreaAwayWithTheirLinesAndRegions) {
  write("in.mesh",
        "MeshVersionFormatted 2\nDimension 2\nVertices\n9\n0 0 0\n4 0 0\n8 0 0\n2 1 0\n6 1 0\n0 1 0\n8 1 0\n"
        "4 1 0\n4 3 0\nEdges\n2\n4 5 7\n6 4 5\n"
        "Triangles\n9\n1 2 4 1\n2 5 4 1\n2 3 5 1\n1 4 6 1\n3 7 5 1\n4 5 8 2\n6 4 8 2\n8 5 7 2\n6 8 9 3\n"
        "End\n");
  const Outcome before = temper({"check", "in.mesh"});
  EXPECT_TRUE(contains(before.err, "has zero area")) << before.err;
  EXPECT_EQ(temper_ok({"convert", "in.mesh", "--flip-flat", "-o", "out.mesh"}).out, "3 triangles flipped away\n");
  temper_ok({"check", "out.mesh"});
  const io::MeshFile file = *io::read("out.mesh");
  EXPECT_EQ(file.lines.tags, (std::vector<std::int32_t>{7, 7, 5})) << "point 8 is on the first line";
  EXPECT_EQ(std::ranges::count(file.triangles.tags, 3), 2) << "the halves of the triangle above";
  EXPECT_EQ(std::ranges::count(file.triangles.tags, 2), 0) << "regions without area are gone";
}

TEST_F(Convert, MergeDropsTrianglesThatHaveTwoCornersAtOnePlace) {
  write("in.off", "OFF\n5 3 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n2 2 0\n3 0 1 2\n3 0 2 4\n3 0 4 3\n");
  EXPECT_TRUE(contains(temper({"convert", "in.off", "--flip-flat", "-o", "out.off"}).err,
                       "in.off: triangle 1 has two corners at x = 2, y = 2. Next: add --merge 0"));
  const Outcome merged = temper_ok({"convert", "in.off", "--merge", "0", "-o", "out.off"});
  EXPECT_EQ(merged.out, "1 point merged\n");
  EXPECT_TRUE(contains(merged.err, "in.off: 1 triangle is dropped: two corners are at one place")) << merged.err;
  temper_ok({"check", "out.off"});
}

TEST_F(Convert, MergesPointsAtOnePlaceAsTheErrorSays) {
  write("in.off",
        "OFF\n8 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n1 0 0\n2 0 0\n2 1 0\n1 1 0\n3 0 1 2\n3 0 2 3\n3 4 5 6\n3 4 6 7\n");
  const Outcome doubled = temper({"check", "in.off"});
  EXPECT_EQ(doubled.exit, 1);
  EXPECT_TRUE(contains(doubled.err, "point 1 and point 4 are both at (1, 0)")) << doubled.err;
  EXPECT_TRUE(contains(doubled.err, "Next: join them with temper convert in.off --merge 0 -o OUT")) << doubled.err;
  temper_ok({"convert", "in.off", "--merge", "0", "-o", "out.off"});
  EXPECT_EQ(temper_ok({"check", "out.off"}).err, "");
}

}  // namespace
}  // namespace temper::test
