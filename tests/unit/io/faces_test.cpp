// Faces on lines in files: formats with data of lines keep them, and the others warn.
#include <gtest/gtest.h>

#include <map>

#include "support.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/mesher.hpp"
#include "temper/optimize.hpp"

namespace temper::io {
namespace {

constexpr std::int32_t kFault = 5;

OutlineMesh valley() {
  Outline o;
  o.points = {{0, 0}, {10, 0}, {10, 6}, {0, 6}, {2, 2}, {5, 2.5}, {8, 5}};
  for (std::int32_t i = 0; i < 4; ++i) o.segments.push_back({{i, (i + 1) % 4}, 1});
  for (std::int32_t i = 4; i < 6; ++i) o.segments.push_back({{i, i + 1}, kFault, LineKind::faces});
  o.groups = {{1, kFault, "fault"}};
  MesherOptions options;
  options.size = 0.8;
  const auto made = mesh_outline(o, options);
  EXPECT_TRUE(made) << made.error().what();
  return made ? *made : OutlineMesh();
}

/// Ends of all duals that are faces, in the order of edges by their vertices.
std::vector<std::array<Vec2, 2>> faces_of(const Mesh& mesh) {
  std::vector<std::array<Vec2, 2>> faces;
  const auto center = [&](HalfedgeId h) {
    const auto [a, b, c] = mesh.points(Mesh::triangle(h));
    return orthocenter(a, b, c);
  };
  for (const VertexId v : mesh.vertices()) {
    std::map<VertexId, HalfedgeId> to;
    for (const HalfedgeId h : mesh.star(v)) {
      if (mesh.is_face(h) && v < mesh.target(h)) to.emplace(mesh.target(h), h);
    }
    for (const auto& [end, h] : to) faces.push_back({center(h), center(mesh.twin(h))});
  }
  return faces;
}

/// Equal except for rounding: corners of a triangle may be in another order.
void expect_equal(const std::vector<std::array<Vec2, 2>>& found, const std::vector<std::array<Vec2, 2>>& wanted,
                  const std::string& what) {
  ASSERT_EQ(found.size(), wanted.size()) << what;
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (std::size_t k = 0; k < 2; ++k) EXPECT_LT(length(found[i].at(k) - wanted[i].at(k)), 1e-12) << what << " " << i;
  }
}

std::vector<std::string> formats_with_faces() {
  std::vector<std::string> names = {"vtu", "gmsh22", "gmsh41", "vtk", "vtk51"};
  if (!netcdf_version().empty()) names.emplace_back("ugrid");
  if (!hdf5_version().empty()) names.emplace_back("vtkhdf");
  return names;
}

class FacesInFiles : public FileTest {};

TEST_F(FacesInFiles, ComeBackFromFormatsWithDataOfLines) {
  const OutlineMesh made = valley();
  const auto wanted = faces_of(made.mesh);
  ASSERT_GE(wanted.size(), 8U);
  for (const std::string& format : formats_with_faces()) {
    const std::string name = format == "ugrid" ? "m.nc" : "m." + format;
    WriteOptions options;
    options.format = format;
    const auto warnings = write(path(name), from_outline(made), options);
    ASSERT_TRUE(warnings) << format << ": " << warnings.error().what();
    const auto file = read(path(name));
    ASSERT_TRUE(file) << format << ": " << file.error().what();
    const auto loaded = make_mesh(*file);
    ASSERT_TRUE(loaded) << format << ": " << loaded.error().what();
    expect_equal(faces_of(loaded->mesh), wanted, format);
    for (const VertexId v : made.mesh.vertices())
      EXPECT_EQ(loaded->mesh.is_frozen(v), made.mesh.is_frozen(v)) << format << " " << v.index;
  }
}

TEST_F(FacesInFiles, StayInAFileThatIsOptimized) {
  const OutlineMesh made = valley();
  MeshFile file = from_outline(made);
  const auto loaded = make_mesh(file);
  ASSERT_TRUE(loaded);
  Mesh mesh = loaded->mesh;
  const auto report = optimize(mesh, {});
  ASSERT_TRUE(report) << report.error().what();
  update(file, *loaded, mesh, report->vertices);
  const auto again = make_mesh(file);
  ASSERT_TRUE(again);
  expect_equal(faces_of(again->mesh), faces_of(made.mesh), "after the optimization");
}

TEST_F(FacesInFiles, ThatHaveNoPlaceAreNamedInAWarning) {
  WriteOptions options;
  options.format = "medit";
  const auto warnings = write(path("m.mesh"), from_outline(valley()), options);
  ASSERT_TRUE(warnings);
  const bool is_named = std::ranges::any_of(
      *warnings, [](const std::string& w) { return w.find("faces on lines are not written") != std::string::npos; });
  EXPECT_TRUE(is_named);
}

}  // namespace
}  // namespace temper::io
