// Rasters become meshes: where their values are, what has no value, windows, and globes.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "support.hpp"

namespace temper::io {
namespace {

const std::vector<double>& values_of(const MeshFile& file) {
  EXPECT_EQ(file.point_data.size(), 1u);
  return std::get<std::vector<double>>(file.point_data.at(0).values);
}

/// The value at each point.
std::map<std::pair<double, double>, double> table(const MeshFile& file) {
  std::map<std::pair<double, double>, double> all;
  for (std::size_t i = 0; i < file.points.size(); ++i) all[{file.points[i].x, file.points[i].y}] = values_of(file)[i];
  return all;
}

std::string grid(const std::string& header, std::size_t columns, std::size_t rows, double (*value)(double, double)) {
  std::string text = header;
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = 0; i < columns; ++i)
      text += std::to_string(value(static_cast<double>(i), static_cast<double>(rows - 1 - j))) + " ";
    text += "\n";
  }
  return text;
}

class RasterTest : public FileTest {
 protected:
  [[nodiscard]] MeshFile read_grid(const std::string& content, const ReadOptions& options = {}) const {
    auto file = read(make("grid.asc", content), options);
    EXPECT_TRUE(file) << file.error().what();
    return file ? *std::move(file) : MeshFile();
  }
  /// The message of a grid that is refused.
  [[nodiscard]] std::string refused(const std::string& content, const ReadOptions& options = {}) const {
    const auto file = read(make("bad.asc", content), options);
    EXPECT_FALSE(file);
    return file ? "" : plain(file.error().what());
  }
};

TEST_F(RasterTest, ValuesAreAtCentersOfCellsFromNorthToSouth) {
  const MeshFile file = read_grid("NCOLS 3\nNROWS 2\nXLLCORNER 10\nYLLCORNER -4\nCELLSIZE 2\n1 2 3\n4 5 6\n");
  const std::map<std::pair<double, double>, double> expected = {{{11, -1}, 1}, {{13, -1}, 2}, {{15, -1}, 3},
                                                                {{11, -3}, 4}, {{13, -3}, 5}, {{15, -3}, 6}};
  EXPECT_EQ(table(file), expected);
  EXPECT_EQ(file.format, "esri");
  EXPECT_EQ(file.triangles.size(), 4u);
  EXPECT_EQ(make_mesh(file)->mesh.n_vertices(), 6u);
}

TEST_F(RasterTest, CentersAndSizesOfBothAxesMayBeGiven) {
  const MeshFile file = read_grid("nrows 2\nncols 2\nxllcenter 1\nyllcenter 5\ndx 2\ndy 3\n1 2\n3 4\n");
  const std::map<std::pair<double, double>, double> expected = {{{1, 8}, 1}, {{3, 8}, 2}, {{1, 5}, 3}, {{3, 5}, 4}};
  EXPECT_EQ(table(file), expected);
}

TEST_F(RasterTest, PointsWithoutAValueAreLeftOut) {
  //  x x -      The cells at missing corners have one triangle or none.
  //  x x x
  const MeshFile file =
      read_grid("ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value -1\n1 2 -1\n4 5 6\n");
  EXPECT_EQ(file.points.size(), 5u);
  EXPECT_EQ(file.triangles.size(), 3u);
  EXPECT_EQ(make_mesh(file)->mesh.n_vertices(), 5u);
  EXPECT_TRUE(read_grid("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n-9999 1\n1 1\n").points.size() == 3);
}

TEST_F(RasterTest, AWindowKeepsTwoMoreLinesOnEachSide) {
  const std::string header = "ncols 100\nnrows 80\nxllcenter 0\nyllcenter 0\ncellsize 1\n";
  const std::string content = grid(header, 100, 80, [](double x, double y) { return x + 1000 * y; });
  const MeshFile part = read_grid(content, {nullptr, false, {{{{20.5, 30.5}, {23.5, 31.5}}}}});
  const auto whole = table(read_grid(content));
  EXPECT_EQ(part.points.size(), 7u * 5u);
  for (const auto& [place, value] : table(part)) {
    EXPECT_EQ(whole.at(place), value);
    EXPECT_TRUE(place.first >= 19 && place.first <= 25 && place.second >= 29 && place.second <= 33);
  }
  EXPECT_EQ(read_grid(content, {nullptr, false, {{{{500, 500}, {501, 501}}}}}).points.size(), 4u) << "the nearest";
}

double longitude_and_latitude(double x, double y) { return 1000 * x + y; }

TEST_F(RasterTest, AGlobeIsClosedAtItsSeamAndAtThePoles) {
  // 8 columns of 45 degrees, rows from pole to pole.
  const std::string header = "ncols 8\nnrows 5\nxllcenter 0\nyllcenter -90\ncellsize 45\n";
  MeshFile file = read_grid(grid(header, 8, 5, longitude_and_latitude), {nullptr, false, {}, true});
  ASSERT_TRUE(file.degrees() != nullptr);
  EXPECT_EQ(file.points.size(), 3u * 8u + 2u);
  ASSERT_TRUE(project(file, "sphere:radius=2"));
  const Mesh mesh = make_mesh(file)->mesh;
  for (const HalfedgeId h : mesh.halfedges()) EXPECT_FALSE(mesh.is_boundary(h));
  EXPECT_EQ(
      static_cast<int>(mesh.n_vertices()) - static_cast<int>(mesh.n_edges()) + static_cast<int>(mesh.n_triangles()), 2);
}

TEST_F(RasterTest, AColumnAt360DegreesIsTheFirstOneAgain) {
  const std::string header = "ncols 9\nnrows 3\nxllcenter 0\nyllcenter -45\ncellsize 45\n";
  const MeshFile file = read_grid(grid(header, 9, 3, longitude_and_latitude), {nullptr, false, {}, true});
  EXPECT_EQ(file.points.size(), 3u * 8u);
  EXPECT_EQ(file.triangles.size(), 2u * 2u * 8u);
}

TEST_F(RasterTest, LongitudesMoveByWholeTurnsToTheWindow) {
  const std::string header = "ncols 36\nnrows 3\nxllcenter 0\nyllcenter 40\ncellsize 10\n";
  const MeshFile file =
      read_grid(grid(header, 36, 3, longitude_and_latitude), {nullptr, false, {{{{-15, 45}, {15, 55}}}}, true});
  const auto all = table(file);
  EXPECT_EQ(all.at({-10, 50}), 35001);  // the column of 350 degrees
  EXPECT_EQ(all.at({0, 50}), 1);
  EXPECT_EQ(all.at({10, 50}), 1001);
}

/// A little-endian GeoTIFF of 32-bit floats, in the projected system 32632; `pixels` are rows from the north.
std::string geotiff(std::uint16_t columns, std::uint16_t rows, const std::vector<float>& pixels) {
  struct Entry {
    std::uint16_t tag, type;
    std::uint32_t count;
    std::string bytes;
  };
  const auto raw = [](auto... values) {
    std::string bytes;
    (bytes.append(reinterpret_cast<const char*>(&values), sizeof values), ...);
    return bytes;
  };
  using U16 = std::uint16_t;
  const std::uint32_t n_bytes = static_cast<std::uint32_t>(4 * pixels.size());
  const std::vector<Entry> entries = {{256, 3, 1, raw(columns)},
                                      {257, 3, 1, raw(rows)},
                                      {258, 3, 1, raw(U16{32})},
                                      {259, 3, 1, raw(U16{1})},
                                      {262, 3, 1, raw(U16{1})},
                                      {273, 4, 1, raw(std::uint32_t{8})},
                                      {277, 3, 1, raw(U16{1})},
                                      {278, 3, 1, raw(rows)},
                                      {279, 4, 1, raw(n_bytes)},
                                      {339, 3, 1, raw(U16{3})},
                                      {33550, 12, 3, raw(2.0, 3.0, 0.0)},
                                      {33922, 12, 6, raw(0.0, 0.0, 0.0, 100.0, 50.0, 0.0)},
                                      {34735, 3, 16,
                                       raw(U16{1}, U16{1}, U16{0}, U16{3}, U16{1024}, U16{0}, U16{1}, U16{1}, U16{1025},
                                           U16{0}, U16{1}, U16{1}, U16{3072}, U16{0}, U16{1}, U16{32632})},
                                      {42113, 2, 3, std::string("-9\0", 3)}};
  std::string file = raw('I', 'I', U16{42}, std::uint32_t{8 + n_bytes});
  file.append(reinterpret_cast<const char*>(pixels.data()), n_bytes);
  std::string directory = raw(static_cast<U16>(entries.size())), more;
  const std::size_t after = file.size() + 2 + 12 * entries.size() + 4;
  for (const Entry& e : entries) {
    directory += raw(e.tag, e.type, e.count);
    if (e.bytes.size() <= 4) {
      directory += e.bytes + std::string(4 - e.bytes.size(), '\0');
    } else {
      directory += raw(static_cast<std::uint32_t>(after + more.size()));
      more += e.bytes;
    }
  }
  return file + directory + raw(std::uint32_t{0}) + more;
}

// With GDAL the values are at their places; without it the message says what to install.
TEST_F(RasterTest, GeoTiffIsReadThroughGdal) {
  const auto file = read(make("bed.tif", geotiff(3, 2, {1, 2, 3, 4, -9, 6})));
  if (!file) {
    EXPECT_EQ(plain(file.error().what()).find("bed.tif: GeoTIFF, shapefiles and GeoPackages need GDAL 3 or later"), 0u)
        << file.error().what();
    return;
  }
  const std::map<std::pair<double, double>, double> expected = {
      {{101, 48.5}, 1}, {{103, 48.5}, 2}, {{105, 48.5}, 3}, {{101, 45.5}, 4}, {{105, 45.5}, 6}};
  EXPECT_EQ(table(*file), expected);
  EXPECT_EQ(file->degrees(), nullptr);
  EXPECT_EQ(file->point_data[0].name, "Band1");
  std::vector<float> many(100 * 80, 7);
  const ReadOptions around = {nullptr, false, {{{{150, -60}, {160, -50}}}}};
  const auto part = read(make("many.tif", geotiff(100, 80, many)), around);
  ASSERT_TRUE(part) << part.error().what();
  EXPECT_LT(part->points.size(), 100u);
  EXPECT_FALSE(read(make("cut.tif", geotiff(3, 2, {1, 2, 3, 4, 5, 6}).substr(0, 40))));
}

TEST_F(RasterTest, WrongGridsAreRefusedWithTheirLine) {
  EXPECT_EQ(refused("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n3 x\n"),
            "bad.asc:7: expected a value of the grid, found 'x'");
  EXPECT_EQ(refused("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\n1 2\n3 4\n"), "bad.asc: the header has no dx");
  EXPECT_EQ(refused("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 0\n1 2\n3 4\n"),
            "bad.asc: expected cells of a size above 0, found 0");
  EXPECT_EQ(refused("ncols 2\nnrows 2\ncolor 3\n"),
            "bad.asc:3: expected a name of the header of an ESRI ASCII grid, found 'color'");
  EXPECT_NE(refused("ncols 99999\nnrows 99999\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n").find("values"),
            std::string::npos);
  EXPECT_NE(refused("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n3 4 5\n")
                .find("expected the end of the file"),
            std::string::npos);
  EXPECT_NE(refused("ncols 1\nnrows 5\nxllcorner 0\nyllcorner 0\ncellsize 1\n1\n2\n3\n4\n5\n").find("1 times 5 points"),
            std::string::npos);
  EXPECT_NE(
      refused("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n-9999 2\n3 -9999\n").find("no three neighbors"),
      std::string::npos);
}

}  // namespace
}  // namespace temper::io
