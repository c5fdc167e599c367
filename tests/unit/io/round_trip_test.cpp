// The laws of writing and reading: write, read, write gives the same bytes, and weights survive bit for bit.
#include "io/formats/format.hpp"
#include "libraries.hpp"
#include "support.hpp"

namespace temper::io {
namespace {

struct Case {
  std::string name, format, file;
  Encoding encoding;
  bool holds_z;
  Contents tags;  // of kAllTags
  bool netcdf;    // needs that library, and a mesh that has orthocenters
  bool hdf5;      // needs that library
};

class RoundTrip : public FileTest, public ::testing::WithParamInterface<Case> {
 protected:
  void SetUp() override {
    FileTest::SetUp();
    if (GetParam().netcdf && !expects_netcdf()) GTEST_SKIP() << "no libnetcdf";
    if (GetParam().hdf5 && !expects_hdf5()) GTEST_SKIP() << "no libhdf5";
  }
  static MeshFile fit(MeshFile f) { return GetParam().netcdf ? tamed(std::move(f)) : f; }
  WriteOptions options() const { return {GetParam().format, GetParam().encoding}; }
  std::vector<std::string> written(const MeshFile& f, const std::string& file) const {
    auto warnings = write(path(file), f, options());
    EXPECT_TRUE(warnings) << warnings.error().what();
    return warnings ? *warnings : std::vector<std::string>{};
  }
  MeshFile again(const std::string& file) const {
    auto f = read(path(file));
    EXPECT_TRUE(f) << f.error().what();
    return f ? *f : MeshFile{};
  }
};

TEST_P(RoundTrip, OfGeometryWeightsRegionsAndTagsLosesNoBit) {
  MeshFile f = fit(sample());
  std::string warnings;
  for (const std::string& w : written(f, GetParam().file)) warnings += w + "\n";
  const MeshFile g = again(GetParam().file);
  EXPECT_EQ(g.format, GetParam().format);
  if (!GetParam().holds_z) {
    EXPECT_NE(warnings.find("z = 0.7"), std::string::npos) << warnings;
    f.set_z(0);
  }
  if (g.z_is_data) {  // 2DM, whose z is always data
    EXPECT_EQ(g.point_data.at(0).values, Values(std::vector<double>(f.points.size(), 0.7)));
    f.set_z(0);
  }
  const auto is_lost = [&](Contents content, const char* what) {
    const bool lost = (GetParam().tags & content) == 0;
    EXPECT_TRUE(!lost || warnings.find(what) != std::string::npos) << warnings;
    return lost;
  };
  if (is_lost(kRegions, "regions")) f.triangles.tags.clear();
  if (is_lost(kLines, "lines")) f.lines.corners = g.lines.corners, f.lines.tags = g.lines.tags;
  if (is_lost(kMarkedPoints, "marked points")) f.marked_points.corners.clear(), f.marked_points.tags.clear();
  expect_same_mesh(f, g);
}

TEST_P(RoundTrip, WriteReadWriteGivesTheSameBytes) {
  for (const MeshFile& f : {fit(sample()), fit(rich_sample())}) {
    const std::string first = "1" + GetParam().file, second = "2" + GetParam().file;
    written(f, first);
    const auto names = files();
    written(again(first), second);
    int compared = 0;
    for (const std::string& name : names) {
      if (name[0] != '1') continue;
      EXPECT_EQ(slurp(path(name)), slurp(path("2" + name.substr(1)))) << name;
      ++compared;
    }
    EXPECT_GT(compared, 0);
    for (const std::string& name : files()) std::filesystem::remove(path(name));
  }
}

TEST_P(RoundTrip, OfAMeshWithoutWeightsOrTagsAddsNone) {
  MeshFile f;
  f.points = {{0, 0}, {1, 0}, {0, 1}};
  f.triangles.corners = {{0, 1, 2}};
  EXPECT_TRUE(written(f, GetParam().file).empty());
  const MeshFile g = again(GetParam().file);
  EXPECT_EQ(g.points, f.points);
  EXPECT_EQ(g.triangles.corners, f.triangles.corners);
  EXPECT_TRUE(g.weights.empty());
  EXPECT_TRUE(g.lines.empty());
  EXPECT_TRUE(g.marked_points.empty());
  for (const std::int32_t region : g.triangles.tags) EXPECT_EQ(region, 0);
}

// What a format cannot hold is named: nothing disappears in silence.
TEST_P(RoundTrip, EveryArrayThatDoesNotComeBackIsNamedInAWarning) {
  const MeshFile f = fit(rich_sample());
  std::string warnings;
  for (const std::string& w : written(f, GetParam().file)) warnings += w + "\n";
  const MeshFile g = again(GetParam().file);
  int checked = 0;
  const auto check = [&](const std::vector<DataArray>& before, const std::vector<DataArray>& after) {
    for (const DataArray& a : before) {
      const auto it = std::find_if(after.begin(), after.end(), [&](const DataArray& b) { return b.name == a.name; });
      const bool same = it != after.end() && it->values == a.values && it->components == a.components;
      EXPECT_TRUE(same || warnings.find(a.name) != std::string::npos) << a.name << " is gone, and no warning says so:\n"
                                                                      << warnings;
      ++checked;
    }
  };
  check(f.point_data, g.point_data);
  check(f.triangles.data, g.triangles.data);
  check(f.lines.data, g.lines.data);
  check(f.marked_points.data, g.marked_points.data);
  check(f.field_data, g.field_data);
  for (const PhysicalName& n : f.names) {
    const bool same = std::any_of(g.names.begin(), g.names.end(), [&](const PhysicalName& m) {
      return m.dimension == n.dimension && m.tag == n.tag && m.name == n.name;
    });
    EXPECT_TRUE(same || warnings.find(n.name) != std::string::npos) << n.name << "\n" << warnings;
    ++checked;
  }
  EXPECT_EQ(checked, 4 + 6 + 6 + 6 + 2 + 3);
}

/// Every format that is written, in every encoding, whether it knows several or not.
std::vector<Case> cases() {
  constexpr std::pair<const char*, Encoding> kEncodings[] = {
      {"_ascii", Encoding::ascii}, {"_base64", Encoding::base64}, {"_appended", Encoding::appended}};
  std::vector<Case> cases;
  for (const Format& format : formats()) {
    const FormatRow& row = *find_row(format.name);
    const std::string name(format.name), suffix(format.suffixes.substr(0, format.suffixes.find(' ')));
    // fort.14, MIKE 21 and Selafin hold those alone that are boundaries.
    const Contents lost = row.name == "adcirc" ? kAllTags : has_boundary_lines(row.name) ? kLines : 0u;
    const Contents tags = row.holds & kAllTags & ~lost;
    for (const auto& [encoding, value] : kEncodings) {
      if (format.writes && format.holds_planes)
        cases.push_back({name + encoding, name, "m" + suffix, value, (row.holds & kZ) != 0, tags, needs_netcdf(format),
                         needs_hdf5(format)});
    }
  }
  return cases;
}

INSTANTIATE_TEST_SUITE_P(Formats, RoundTrip, ::testing::ValuesIn(cases()),
                         [](const auto& each) { return each.param.name; });

TEST_F(FileTest, VtuKeepsAllDataWithTheirTypes) {
  const MeshFile f = rich_sample();
  for (const Encoding encoding : {Encoding::ascii, Encoding::base64, Encoding::appended}) {
    const auto warnings = write(path("a.vtu"), f, {"vtu", encoding});
    ASSERT_TRUE(warnings) << warnings.error().what();
    EXPECT_TRUE(warnings->empty());
    const auto g = read(path("a.vtu"));
    ASSERT_TRUE(g) << g.error().what();
    expect_same_mesh(f, *g);
    expect_same_data(f, *g);
    ASSERT_EQ(g->names.size(), f.names.size());
    for (std::size_t i = 0; i < f.names.size(); ++i) {
      EXPECT_EQ(g->names[i].dimension, f.names[i].dimension);
      EXPECT_EQ(g->names[i].tag, f.names[i].tag);
      EXPECT_EQ(g->names[i].name, f.names[i].name);
    }
  }
}

// A mesh larger than one compressed block of every array.
TEST_F(FileTest, VtuOfManyBlocksComesBackWhole) {
  constexpr int kSide = 200;
  MeshFile f;
  for (int j = 0; j <= kSide; ++j) {
    for (int i = 0; i <= kSide; ++i) f.points.push_back({i / 7.0, j / 11.0});
  }
  for (const Vec2 p : f.points) f.weights.push_back(p.x * p.y / 3);
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      const int a = j * (kSide + 1) + i, c = a + kSide + 2;
      f.triangles.corners.push_back({a, a + 1, c});
      f.triangles.corners.push_back({a, c, c - 1});
    }
  }
  for (const Encoding encoding : {Encoding::ascii, Encoding::base64, Encoding::appended}) {
    ASSERT_TRUE(write(path("a.vtu"), f, {"vtu", encoding}));
    const auto g = read(path("a.vtu"));
    ASSERT_TRUE(g) << g.error().what();
    expect_same_mesh(f, *g);
  }
}

}  // namespace
}  // namespace temper::io
