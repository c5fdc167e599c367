// Files and what was loaded of them, as bytes and back.
#include "support.hpp"
#include "temper/archive.hpp"
#include "temper/generate.hpp"

namespace temper::io {
namespace {

template <class... T>
std::string bytes_of(T... values) {
  std::string bytes;
  Archive archive(bytes);
  archive(values...);
  archive.seal();
  return bytes;
}

/// What the bytes are of: all of them.
void expect_read(const std::string& bytes, MeshFile& file, LoadedMesh& loaded) {
  Archive archive{std::string_view(bytes)};
  archive(file, loaded);
  archive.seal();
  EXPECT_TRUE(archive.at_end());
}

class FileArchiveTest : public FileTest {
 protected:
  /// A file with points of no triangle, names of its points, and places on a map.
  MeshFile file_on_a_map() {
    MeshFile f = tamed(rich_sample());
    for (Vec2& p : f.points) p = {10 + p.x, 50 + p.y};
    f.points.push_back({12, 52});
    f.weights.clear();
    for (DataArray& array : f.point_data) {
      const auto longer = [&array](auto& values) {
        values.resize(values.size() + static_cast<std::size_t>(array.components));
      };
      std::visit(longer, array.values);
    }
    EXPECT_TRUE(write(path("in.vtu"), f));
    MeshFile again = *read(path("in.vtu"));
    again.points_in = DegreePoints{.z = again.z()};
    EXPECT_TRUE(project(again, "mercator:11"));
    return again;
  }
};

TEST_F(FileArchiveTest, what_is_read_of_bytes_has_these_bytes_again) {
  MeshFile file = file_on_a_map();
  LoadedMesh loaded = *make_mesh(file);
  ASSERT_LT(loaded.vertex_of_point.n_kept(), loaded.vertex_of_point.size());
  loaded.mesh = Mesh();
  loaded.edge_lines = {true, false, true};
  const std::string bytes = bytes_of(file, loaded);
  MeshFile file_again;
  LoadedMesh loaded_again;
  expect_read(bytes, file_again, loaded_again);
  EXPECT_EQ(bytes_of(file_again, loaded_again), bytes);
  expect_same_mesh(file_again, file);
  expect_same_data(file_again, file);
  EXPECT_EQ(file_again.numbering->point_where(3), file.numbering->point_where(3));
  EXPECT_EQ(loaded_again.edge_lines, loaded.edge_lines);
  for (std::size_t p = 0; p < loaded.vertex_of_point.size(); ++p) {
    EXPECT_EQ(loaded_again.vertex_of_point[p], loaded.vertex_of_point[p]);
  }
}

TEST_F(FileArchiveTest, a_file_of_bytes_is_written_as_the_file_itself) {
  const MeshFile file = file_on_a_map();
  MeshFile again;
  LoadedMesh none;
  expect_read(bytes_of(file, LoadedMesh()), again, none);
  ASSERT_TRUE(again.map() != nullptr);
  EXPECT_EQ(again.map()->places, file.map()->places);
  for (const std::string format : {"vtu", "gmsh22", "gmsh41"}) {
    ASSERT_TRUE(write(path("a"), file, {format, {}}));
    ASSERT_TRUE(write(path("b"), again, {format, {}}));
    EXPECT_EQ(slurp(path("a")), slurp(path("b"))) << format;
  }
}

TEST_F(FileArchiveTest, a_file_that_was_not_read_has_no_numbers_and_no_map_afterwards_either) {
  MeshFile again;
  LoadedMesh none;
  again.points_in = MappedPoints{std::make_shared<const GeographicMap>()};
  expect_read(bytes_of(from_mesh(*sheared_grid({3, 3, 0.1})), LoadedMesh()), again, none);
  EXPECT_FALSE(again.numbering);
  EXPECT_EQ(again.map(), nullptr);
}

}  // namespace
}  // namespace temper::io
