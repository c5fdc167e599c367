// The messages for files that are wrong: each names the file, the line, the element in the file's own numbers, what was
// expected and what was found. tests/unit/io/messages.md shows these messages; the last test keeps it so.
#include "support.hpp"

namespace temper::io {
namespace {

struct Bad {
  std::string name;  // of the test
  std::string file;
  std::string content;
  ErrorCode code;
  std::string message;  // with the folder taken out
};

std::string medit(const std::string& vertices, const std::string& rest) {
  return "MeshVersionFormatted 2\nDimension 2\nVertices\n" + vertices + rest + "End\n";
}
const std::string kSquare = "4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

const std::vector<Bad>& bad_files() {
  static const std::vector<Bad> kBad = {
      {"empty_file", "m.mesh", "", ErrorCode::empty_input, "m.mesh: the file is empty"},
      {"truncated_medit", "m.mesh", "MeshVersionFormatted 2\nDimension 2\nVertices\n4\n0 0 0\n1 0 0\n1 1",
       ErrorCode::truncated, "m.mesh:4: announces 4 vertices, but only 16 bytes follow"},
      {"truncated_inside_a_row", "m.mesh",
       "MeshVersionFormatted 2\nDimension 2\nVertices\n3\n0 0 0\n1 0 0\n0 1 0\nTriangles\n1\n    1   2",
       ErrorCode::truncated, "m.mesh:10: the file ends where a vertex number was expected"},
      {"truncated_gmsh", "m.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 0 0\n$EndNodes\n",
       ErrorCode::truncated, "m.msh:8: the file ends where the section $Elements was expected"},
      {"absurd_count", "m.mesh", "MeshVersionFormatted 2\nDimension 2\nVertices\n99999999999\n0 0 0\n",
       ErrorCode::truncated, "m.mesh:4: announces 99999999999 vertices, but only 7 bytes follow"},
      {"negative_count", "m.mesh", "MeshVersionFormatted 2\nDimension 2\nVertices\n-4\n0 0 0\n", ErrorCode::syntax,
       "m.mesh:4: expected the number of vertices, found -4"},
      {"a_word_for_a_number", "m.mesh", medit("3\n0 0 0\n1 zero 0\n0 1 0\n", "Triangles\n1\n1 2 3 0\n"),
       ErrorCode::syntax, "m.mesh:6: expected the y coordinate of a vertex, found 'zero'"},
      {"index_out_of_range", "coast.msh",
       "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n$Elements\n1\n12 2 2 0 "
       "1 1 2 305\n"
       "$EndElements\n",
       ErrorCode::index_out_of_range,
       "coast.msh:12: triangle 12 uses vertex 305, but the file has 3 vertices, numbered from 1"},
      {"medit_index_out_of_range", "m.mesh", medit(kSquare, "Triangles\n2\n1 2 3 0\n1 3 5 0\n"),
       ErrorCode::index_out_of_range,
       "m.mesh:12: triangle 2 uses vertex 5, but the file has 4 vertices, numbered from 1"},
      {"index_zero_where_one_is_first", "m.mesh", medit(kSquare, "Triangles\n1\n0 1 2 0\n"),
       ErrorCode::index_out_of_range,
       "m.mesh:11: triangle 1 uses vertex 0, but the file has 4 vertices, numbered from 1"},
      {"negative_index", "m.mesh", medit(kSquare, "Triangles\n1\n1 2 -3 0\n"), ErrorCode::index_out_of_range,
       "m.mesh:11: triangle 1 uses vertex -3, but the file has 4 vertices, numbered from 1"},
      {"line_index_out_of_range", "m.mesh", medit(kSquare, "Edges\n1\n1 9 0\nTriangles\n1\n1 2 3 0\n"),
       ErrorCode::index_out_of_range, "m.mesh:11: line 1 uses vertex 9, but the file has 4 vertices, numbered from 1"},
      {"not_a_number", "m.mesh", medit("3\n0 0 0\n1 nan 0\n0 1 0\n", "Triangles\n1\n1 2 3 0\n"), ErrorCode::not_finite,
       "m.mesh:6: point 2 has coordinates (1, nan), expected finite numbers. Next: give its place"},
      {"infinity", "m.mesh", medit("3\n0 0 0\n1 0 0\n0 1e999 0\n", "Triangles\n1\n1 2 3 0\n"), ErrorCode::not_finite,
       "m.mesh:7: point 3 has coordinates (0, inf), expected finite numbers. Next: give its place"},
      {"duplicate_points", "m.mesh",
       medit("5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 0\n", "Triangles\n2\n1 2 3 0\n5 3 4 0\n"), ErrorCode::duplicate_point,
       "m.mesh:9: point 1 and point 5 are both at (0, 0); expected distinct points"},
      {"zero_area", "m.mesh", medit("4\n0 0 0\n1 0 0\n1 1 0\n2 0 0\n", "Triangles\n2\n1 2 3 0\n1 2 4 0\n"),
       ErrorCode::zero_area,
       "m.mesh:12: triangle 2 has zero area: its corners point 1, point 2 and point 4 are collinear"},
      {"repeated_vertex", "m.mesh", medit(kSquare, "Triangles\n2\n1 2 3 0\n1 3 3 0\n"), ErrorCode::zero_area,
       "m.mesh:12: triangle 2 has zero area: it uses point 3 more than once"},
      {"two_triangles_on_one_side", "m.mesh",
       medit("4\n0 0 0\n1 0 0\n0 1 0\n0.2 2 0\n", "Triangles\n2\n1 2 3 0\n1 2 4 0\n"), ErrorCode::overlap,
       "m.mesh:12: triangle 1 and triangle 2 lie on the same side of the edge from point 1 to point 2"},
      {"three_triangles_on_one_edge", "m.mesh",
       medit("5\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n1 2 0\n", "Triangles\n3\n1 2 3 0\n1 2 4 0\n1 2 5 0\n"),
       ErrorCode::non_manifold_edge,
       "m.mesh:14: the edge from point 1 to point 2 belongs to 3 triangles (triangle 1 and triangle 3 among them); "
       "expected at most 2"},
      {"bow_tie", "m.mesh", medit("5\n0 0 0\n1 0 0\n0 1 0\n-1 0 0\n0 -1 0\n", "Triangles\n2\n1 2 3 0\n1 4 5 0\n"),
       ErrorCode::non_manifold_vertex,
       "m.mesh:5: the mesh touches itself at point 1: its triangles are not one fan around it"},
      {"not_planar", "m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0.5\nf 1 2 3\n", ErrorCode::not_planar,
       "m.obj:3: point 3 has z = 0.5, but point 1 has z = 0; expected a mesh in a plane of constant x, y or z, or on a "
       "sphere "
       "around the origin. Next: --flat takes z as data of a mesh of the plane (flat=True in Python)"},
      {"quadrilateral_in_medit", "m.mesh", medit(kSquare, "Triangles\n0\nQuadrilaterals\n1\n1 2 3 4 0\n"),
       ErrorCode::unsupported,
       "m.mesh:13: element 1 is a quadrilateral; in this format temper reads linear triangles and tetrahedra, with "
       "lines and points as tags. Next: write meshes of quadrilaterals as VTU or Gmsh"},
      {"tetrahedron_in_gmsh", "m.msh",
       "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 1 1 0\n$EndNodes\n$Elements\n2\n"
       "1 2 2 0 1 1 2 3\n2 4 2 0 1 1 2 3 4\n$EndElements\n",
       ErrorCode::unsupported,
       "m.msh:14: has 1 tetrahedron; expected a mesh of triangles. Next: temper check, convert, draw, explain, "
       "optimize, weights, operators and errors take tetrahedra"},
      {"quadratic_triangle_in_vtk", "m.vtk",
       "# vtk DataFile Version 2.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 float\n0 0 0 1 0 0 0 1 0 .5 0 0 .5 "
       ".5 0 0 .5 0\n"
       "CELLS 1 7\n6 0 1 2 3 4 5\nCELL_TYPES 1\n22\n",
       ErrorCode::unsupported,
       "m.vtk:8: element 0 is a quadratic triangle; temper reads linear triangles, quadrilaterals and tetrahedra, with "
       "lines and points as tags. Next: write linear elements"},
      {"square_in_mfem", "m.mesh",
       "MFEM mesh v1.0\ndimension\n2\nelements\n1\n1 3 0 1 2 3\nboundary\n0\nvertices\n4\n2\n0 0\n1 0\n1 1\n0 1\n",
       ErrorCode::unsupported,
       "m.mesh:6: element 0 is a quadrilateral; in this format temper reads linear triangles, with lines and points as "
       "tags. Next: write meshes of quadrilaterals as VTU or Gmsh"},
      {"polygon_in_obj", "m.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0.5 0\nf 1 2 3 4 5\n",
       ErrorCode::unsupported, "m.obj:6: face 1 has 5 corners; temper reads triangles and quadrilaterals"},
      {"no_triangles", "m.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\n", ErrorCode::empty_input,
       "m.obj: the file has no triangles or tetrahedra"},
      {"outline_for_a_mesh", "m.msh", "MSHID=3;EUCLIDEAN-MESH\nNDIMS=2\nPOINT=2\n0;0;0\n1;0;0\nEDGE2=1\n0;1;0\n",
       ErrorCode::empty_input, "m.msh: the file has no triangles: it is an outline, for `temper mesh` to mesh"},
      {"triangles_alone", "m.mesh", "2\n 1 2 3\n 1 3 4\n", ErrorCode::unsupported,
       "m.mesh: has triangles without points, as in files of METIS and FESOM. temper reads files of FESOM: expected a "
       "name that ends with elem2d.out, and the points in nod2d.out beside it"},
      {"ele_without_node", "m.ele", "1 3 0\n1 1 2 3\n", ErrorCode::not_found,
       "m.ele: is the elements of a mesh of Triangle or TetGen; its points are expected in m.node, which does not "
       "exist"}};
  return kBad;
}

class BadInput : public FileTest, public ::testing::WithParamInterface<Bad> {};

TEST_P(BadInput, IsNamed) {
  const Bad& bad = GetParam();
  const std::string file = make(bad.file, bad.content);
  InputError error;
  if (const auto read_file = read(file); !read_file) {
    error = read_file.error();
  } else {
    const auto made = make_mesh(*read_file);
    ASSERT_FALSE(made) << "was accepted";
    error = made.error();
  }
  EXPECT_EQ(error.code, bad.code) << error.what();
  EXPECT_EQ(plain(error.what()), bad.message);
}

INSTANTIATE_TEST_SUITE_P(Files, BadInput, ::testing::ValuesIn(bad_files()),
                         [](const auto& each) { return each.param.name; });

TEST_F(FileTest, ErrorsOfTheMeshSpeakTheNumbersOfTheFile) {
  const auto message_of = [&](const std::string& content) {
    const auto f = read(make("m.mesh", content));
    EXPECT_TRUE(f) << f.error().what();
    const auto made = make_mesh(*f);
    EXPECT_FALSE(made);
    return plain(made ? "" : made.error().what());
  };
  const std::string duplicate =
      message_of(medit("5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 0\n", "Triangles\n2\n1 2 3 0\n5 3 4 0\n"));
  EXPECT_NE(duplicate.find("point 5"), std::string::npos) << duplicate;
  const std::string flat = message_of(medit("4\n0 0 0\n1 0 0\n1 1 0\n2 0 0\n", "Triangles\n2\n1 2 3 0\n1 2 4 0\n"));
  EXPECT_TRUE(flat.starts_with("m.mesh:12: triangle 2 ")) << flat;
  const std::string fan =
      message_of(medit("5\n0 0 0\n1 0 0\n0 1 0\n-1 0 0\n0 -1 0\n", "Triangles\n2\n1 2 3 0\n1 4 5 0\n"));
  EXPECT_NE(fan.find("point 1"), std::string::npos) << fan;
}

TEST_F(FileTest, MissingFilesAndDirectoriesAreNamed) {
  const auto missing = read(path("nothing.msh"));
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::not_found);
  EXPECT_EQ(plain(missing.error().what()), "nothing.msh: cannot be read: No such file or directory");
  std::filesystem::create_directory(path("folder"));
  const auto folder = read(path("folder"));
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.error().code, ErrorCode::not_found);
  EXPECT_EQ(plain(folder.error().what()), "folder: is a directory, not a mesh file");
}

TEST_F(FileTest, TheMessagesInTheDocumentationAreThoseThatUsersSee) {
  const std::string docs = slurp(TEMPER_SOURCE_DIR "/tests/unit/io/messages.md");
  int checked = 0;
  for (const Bad& bad : bad_files()) {
    EXPECT_NE(docs.find(bad.message), std::string::npos)
        << bad.name << " is not in tests/unit/io/messages.md: " << bad.message;
    ++checked;
  }
  EXPECT_GT(checked, 20);
}

}  // namespace
}  // namespace temper::io
