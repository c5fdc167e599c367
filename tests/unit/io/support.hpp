// A folder of its own for each test, and a mesh that has a bit of everything.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "support/tet_files.hpp"
#include "temper/io.hpp"

namespace temper::io {

inline std::string slurp(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream all;
  all << in.rdbuf();
  return all.str();
}

inline void spill(const std::string& path, std::string_view bytes) {
  std::ofstream out(path, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  ASSERT_TRUE(out.good()) << path;
}

inline bool needs_netcdf(const Format& format) { return format.name == "mpas" || format.name == "ugrid"; }

inline bool needs_hdf5(const Format& format) { return format.name == "vtkhdf"; }

/// Whether its lines are on the boundary alone: strings or codes of boundary nodes.
inline bool has_boundary_lines(std::string_view format) {
  return format == "adcirc" || format == "mike" || format == "selafin";
}

/// Whether temper writes meshes of the plane in it, here.
inline bool writes_planes(const Format& format) {
  return format.writes && format.holds_planes && (!needs_netcdf(format) || !netcdf_version().empty()) &&
         (!needs_hdf5(format) || !hdf5_version().empty());
}

/// A test with a folder that is removed afterwards.
class FileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(test->test_suite_name()) + "." + test->name();
    for (char& c : name) {
      if (c == '/') c = '_';
    }
    folder_ =
        std::filesystem::temp_directory_path() / ("temper_io." + name + "." + std::to_string(std::random_device{}()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).generic_string(); }
  /// A file of that content; returns its path.
  std::string make(const std::string& name, std::string_view content) const {
    spill(path(name), content);
    return path(name);
  }
  [[nodiscard]] std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }
  /// A message with the name of the folder taken out.
  [[nodiscard]] std::string plain(std::string message) const {
    const std::string prefix = folder_.generic_string() + "/";
    for (std::size_t at; (at = message.find(prefix)) != std::string::npos;) message.erase(at, prefix.size());
    return message;
  }

 private:
  std::filesystem::path folder_;
};

/// A 2 × 1 rectangle of 4 triangles in 2 regions, an interior line, two boundary lines, two marked points. Numbers that
/// are hard on text: thirds, denormals, negative zero, the ends of the range.
inline MeshFile sample() {
  MeshFile f;
  f.points = {{0, 0}, {1.0 / 3, -0.0}, {2, 0}, {2, 1}, {0.1 + 0.2, 1}, {0, 1}};
  f.points_in = PlanePoints{0.7};
  f.weights = {
      0, -0.0, 1.0 / 3, std::numeric_limits<double>::denorm_min(), -1e-300, std::numeric_limits<double>::max()};
  f.triangles.corners = {{0, 1, 5}, {1, 4, 5}, {1, 2, 4}, {2, 3, 4}};
  f.triangles.tags = {1, 1, 7, -3};
  f.lines.corners = {{0, 1}, {2, 1}, {2, 4}};
  f.lines.tags = {4, 4, 9};
  f.marked_points.corners = {0, 3};
  f.marked_points.tags = {11, 12};
  return f;
}

/// Two tetrahedra in two regions, with tags and data on everything. Numbers that are hard on text.
inline MeshFile tet_sample() {
  MeshFile f = test::tet_file({{0, 0, -0.0}, {1, 0, 1.0 / 3}, {0, 0.1 + 0.2, 0}, {0, 0, 1}, {2, 2, 2}},
                              {{0, 1, 2, 3}, {1, 2, 3, 4}});
  f.weights = {0, 1.0 / 3, -1e-30, 0.25, 7};
  f.tetrahedra.tags = {3, -4};
  f.triangles.corners = {{1, 2, 3}, {0, 2, 1}};
  f.triangles.tags = {7, 8};
  f.lines.corners = {{3, 4}};
  f.lines.tags = {5};
  f.marked_points.corners = {4, 0};
  f.marked_points.tags = {2, 9};
  f.names = {{0, 9, "corner"}, {1, 5, "pipe"}, {2, 7, "fracture of old"}, {3, 3, "clay"}};
  f.point_data = {{"depth", 1, std::vector<double>{0.1, 2, 3, 4, 1e300}},
                  {"id", 1, std::vector<std::int32_t>{9, 8, 7, 6, 5}}};
  f.tetrahedra.data = {{"flux", 3, std::vector<double>{0.1, 2, 3, 4, 5, 6}}};
  f.triangles.data = {{"load", 1, std::vector<double>{0.5, 0.1}}};
  f.lines.data = {{"width", 1, std::vector<double>{0.3}}};
  f.marked_points.data = {{"rate", 1, std::vector<double>{0.7, 0.9}}};
  return f;
}

/// The sample with names and data of every type.
inline MeshFile rich_sample() {
  MeshFile f = sample();
  f.names = {{0, 11, "corner"}, {1, 4, "inflow and more"}, {2, 7, "steel"}};
  f.point_data = {
      {"temperature", 1, std::vector<double>{1.5, -0.0, 0.1, 1e300, 2, 3}},
      {"velocity", 3, std::vector<float>{0.1f, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17}},
      {"pair", 2,
       std::vector<std::int64_t>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, std::numeric_limits<std::int64_t>::max()}},
      {"byte", 1, std::vector<std::uint8_t>{0, 1, 2, 253, 254, 255}}};
  f.triangles.data = {{"material", 1, std::vector<std::int32_t>{1, 2, 3, -2147483647}},
                      {"small", 1, std::vector<std::int8_t>{1, -128, 127, 0}},
                      {"short", 1, std::vector<std::int16_t>{1, -32768, 32767, 0}},
                      {"ushort", 1, std::vector<std::uint16_t>{1, 2, 65535, 0}},
                      {"uint", 1, std::vector<std::uint32_t>{1, 2, 4294967295u, 0}},
                      {"ulong", 1, std::vector<std::uint64_t>{1, 2, std::numeric_limits<std::uint64_t>::max(), 0}}};
  f.lines.data = {
      {"material", 1, std::vector<std::int32_t>{5, 6, 7}}, {"small", 1, std::vector<std::int8_t>{0, 0, 0}},
      {"short", 1, std::vector<std::int16_t>{0, 0, 0}},    {"ushort", 1, std::vector<std::uint16_t>{0, 0, 0}},
      {"uint", 1, std::vector<std::uint32_t>{0, 0, 0}},    {"ulong", 1, std::vector<std::uint64_t>{0, 0, 0}}};
  f.marked_points.data = {
      {"material", 1, std::vector<std::int32_t>{8, 9}}, {"small", 1, std::vector<std::int8_t>{0, 0}},
      {"short", 1, std::vector<std::int16_t>{0, 0}},    {"ushort", 1, std::vector<std::uint16_t>{0, 0}},
      {"uint", 1, std::vector<std::uint32_t>{0, 0}},    {"ulong", 1, std::vector<std::uint64_t>{0, 0}}};
  f.field_data = {{"time", 1, std::vector<double>{0.25}}, {"steps", 1, std::vector<std::int32_t>{1, 2, 3}}};
  return f;
}

/// The sample with weights that exact arithmetic takes: those above are for files, not for meshes.
inline MeshFile tamed(MeshFile f) {
  f.weights = {0, -0.0, 1.0 / 3, 1e-30, -0.01, 2};
  return f;
}

inline bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

inline void expect_same_data(const std::vector<DataArray>& a, const std::vector<DataArray>& b,
                             const std::string& kind) {
  ASSERT_EQ(a.size(), b.size()) << kind;
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].name, b[i].name) << kind;
    EXPECT_EQ(a[i].components, b[i].components) << kind << " " << a[i].name;
    EXPECT_EQ(a[i].values.index(), b[i].values.index()) << kind << " " << a[i].name;
    EXPECT_TRUE(a[i].values == b[i].values) << kind << " " << a[i].name;
  }
}

/// All that files have besides, bit for bit.
inline void expect_same_data(const MeshFile& a, const MeshFile& b) {
  expect_same_data(a.point_data, b.point_data, "point data");
  expect_same_data(a.triangles.data, b.triangles.data, "cell data");
  expect_same_data(a.lines.data, b.lines.data, "line data");
  expect_same_data(a.marked_points.data, b.marked_points.data, "data of marked points");
  expect_same_data(a.field_data, b.field_data, "field data");
}

/// Geometry, weights, regions and tags, bit for bit.
inline void expect_same_mesh(const MeshFile& a, const MeshFile& b) {
  ASSERT_EQ(a.points.size(), b.points.size());
  EXPECT_EQ(std::memcmp(a.points.data(), b.points.data(), a.points.size() * sizeof(Vec2)), 0);
  EXPECT_EQ(a.z(), b.z());
  EXPECT_TRUE(same_bits(a.weights, b.weights));
  EXPECT_EQ(a.triangles.corners, b.triangles.corners);
  EXPECT_EQ(a.triangles.tags, b.triangles.tags);
  EXPECT_EQ(a.lines.corners, b.lines.corners);
  EXPECT_EQ(a.lines.tags, b.lines.tags);
  EXPECT_EQ(a.marked_points.corners, b.marked_points.corners);
  EXPECT_EQ(a.marked_points.tags, b.marked_points.tags);
}

}  // namespace temper::io
