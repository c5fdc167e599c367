// Polygons of cells as files: what each format says of them, and the bytes of GeoPackage by SQLite's own rules.
// (tests/python/test_cells.py reads them by sqlite3 and json.)
#include "temper/detail/cells.hpp"

#include <map>
#include <nlohmann/json.hpp>

#include "io/containers/sqlite_writer.hpp"
#include "support.hpp"
#include "temper/generate.hpp"

namespace temper::io {
namespace {

using Json = nlohmann::json;

double ring_area(const Json& ring) {
  double doubled = 0;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i)
    doubled += ring[i][0].get<double>() * ring[i + 1][1].get<double>() -
               ring[i + 1][0].get<double>() * ring[i][1].get<double>();
  return doubled / 2;
}

WriteOptions options_of(CellsOf of, std::string_view format = {}) {
  WriteOptions options;
  options.format = format;
  options.cells = of;
  return options;
}

class CellFiles : public FileTest {
 protected:
  /// Two regions with names, and a well at vertex 4.
  static MeshFile square() {
    MeshFile file;
    file.points = {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 1}};
    for (const std::array<std::int32_t, 3>& t : {std::array{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}})
      file.triangles.add(t, t[0] == 1 ? 2 : 1);
    file.marked_points.add(4, 5);
    file.names = {{0, 5, "west \"well\""}, {2, 1, "sand"}, {2, 2, "clay"}};
    return file;
  }
  [[nodiscard]] Json geojson(const MeshFile& file, CellsOf of = CellsOf::vertices) const {
    const auto written = write(path("cells.geojson"), file, options_of(of));
    EXPECT_TRUE(written) << written.error().what();
    return Json::parse(slurp(path("cells.geojson")));
  }
};

TEST_F(CellFiles, GeoJsonHasAFeatureForEachCellWithItsNumbers) {
  const Json root = geojson(square());
  ASSERT_EQ(root.at("features").size(), 5u);
  EXPECT_TRUE(root.at("crs").at("properties").at("name").get<std::string>().starts_with("LOCAL_CS")) << "no degrees";
  double area = 0;
  for (std::size_t i = 0; i < 5; ++i) {
    const Json& feature = root.at("features")[i];
    const Json& properties = feature.at("properties");
    EXPECT_EQ(properties.at("vertex"), i);
    EXPECT_NEAR(ring_area(feature.at("geometry").at("coordinates")[0]), properties.at("area").get<double>(), 1e-14);
    area += properties.at("area").get<double>();
  }
  EXPECT_NEAR(area, 4, 1e-14);
  const Json& well = root.at("features")[4].at("properties");
  EXPECT_EQ(well, Json::parse(R"({"vertex": 4, "name": "west \"well\"", "region": 1, "region_name": "sand",
                                  "region_share": 0.75, "area": 2, "center_x": 1, "center_y": 1})"));
  EXPECT_TRUE(root.at("features")[0].at("properties").at("name").is_null());
}

TEST_F(CellFiles, TrianglesAreWrittenInTheSameWay) {
  const Json root = geojson(square(), CellsOf::triangles);
  ASSERT_EQ(root.at("features").size(), 4u);
  EXPECT_EQ(
      root.at("features")[1].at("properties"),
      Json::parse(R"({"triangle": 1, "region": 2, "region_name": "clay", "area": 1, "center_x": 2, "center_y": 1})"));
}

TEST_F(CellFiles, EqualMeshesMakeEqualBytesInEachFormatAndNothingElse) {
  for (const CellFormat& format : cell_formats()) {
    if (format.name == "ugrid" && netcdf_version().empty()) continue;
    const std::string name = "cells." + std::string(format.name == "ugrid" ? "ugrid.nc" : format.name);
    ASSERT_TRUE(write(path("a/" + name), square(), options_of(CellsOf::vertices)).has_value() == false)
        << "no folder a";
    std::filesystem::create_directories(path("a"));
    std::filesystem::create_directories(path("b"));
    ASSERT_TRUE(write(path("a/" + name), square(), options_of(CellsOf::vertices))) << name;
    ASSERT_TRUE(write(path("b/" + name), square(), options_of(CellsOf::vertices, format.name)));
    EXPECT_EQ(slurp(path("a/" + name)), slurp(path("b/" + name))) << name;
    EXPECT_EQ(*files_to_write(path("a/" + name), {}, nullptr, CellsOf::vertices), std::vector{path("a/" + name)});
    std::filesystem::remove_all(path("a"));
  }
}

TEST_F(CellFiles, VtuAndUgridShareTheCorners) {
  WriteOptions options = options_of(CellsOf::vertices);
  options.encoding = Encoding::ascii;
  ASSERT_TRUE(write(path("cells.vtu"), square(), options));
  const std::string vtu = slurp(path("cells.vtu"));
  EXPECT_NE(vtu.find("NumberOfPoints=\"8\" NumberOfCells=\"5\""), std::string::npos)
      << "corners and midpoints of the square, where orthocenters are, too: " << vtu;
  for (const char* name : {"vertex", "region", "region_share", "area", "tag", "center", "physical_names"})
    EXPECT_NE(vtu.find("Name=\"" + std::string(name) + "\""), std::string::npos) << name;
}

TEST_F(CellFiles, DegreesStayDegreesAndPolygonsAreCutAtTheDateLine) {
  const MeshFile globe = from_mesh(*icosahedral({.level = 2}));
  const Json root = geojson(globe);
  EXPECT_FALSE(root.contains("crs")) << "longitude and latitude";
  double area = 0;
  std::size_t cut = 0;
  for (const Json& feature : root.at("features")) {
    const Json& geometry = feature.at("geometry");
    const bool several = geometry.at("type") == "MultiPolygon";
    cut += several ? 1 : 0;
    for (const Json& polygon : several ? geometry.at("coordinates") : Json::array({geometry.at("coordinates")})) {
      EXPECT_EQ(polygon[0].front(), polygon[0].back()) << "closed";
      EXPECT_GT(ring_area(polygon[0]), 0) << "counter-clockwise";
      area += ring_area(polygon[0]);
      for (const Json& position : polygon[0]) {
        EXPECT_LE(std::abs(position[0].get<double>()), 180);
        EXPECT_LE(std::abs(position[1].get<double>()), 90);
        const bool is_pole = std::abs(position[1].get<double>()) == 90;
        EXPECT_FALSE(is_pole && several) << "one whole sheet around a pole";
      }
    }
  }
  EXPECT_NEAR(area, 360 * 180, 1e-6) << "the whole map, once";
  EXPECT_GT(cut, 3u);
}

TEST_F(CellFiles, APeriodicOrTurnedPlaneAndNoFormatForCellsAreTold) {
  const auto message = [this](const std::string& name, const WriteOptions& options) {
    const auto written = write(path(name), square(), options);
    return written ? "nothing" : written.error().message;
  };
  EXPECT_EQ(
      message("cells.msh", options_of(CellsOf::vertices)),
      "the suffix names no format for polygons of cells; expected one of .geojson .json .gpkg .vtu .ugrid.nc .nc, "
      "or a format");
  EXPECT_EQ(message("cells.geojson", options_of(CellsOf::vertices, "gpgk")),
            "polygons of cells cannot be written as 'gpgk'; expected one of geojson, gpkg, vtu, ugrid; did you mean "
            "'gpkg'?");
  EXPECT_NE(message("cells.geojson", {}).find("GeoJSON holds polygons of cells. Next: --cells power"),
            std::string::npos)
      << message("cells.geojson", {});
  MeshFile degrees = square();
  degrees.points_in = DegreePoints{};
  const auto written = write(path("d.geojson"), degrees, options_of(CellsOf::vertices));
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().what().find("cells need a valid mesh"), std::string::npos) << written.error().what();
  EXPECT_FALSE(std::filesystem::exists(path("d.geojson")));
}

/// A database is read back by its pages, as the description of the format has them.
class SqlitePages {
 public:
  explicit SqlitePages(std::string bytes) : bytes_(std::move(bytes)) {}
  /// The payloads of a table by the numbers of its rows, in the order of its tree.
  [[nodiscard]] std::vector<std::pair<std::int64_t, std::string>> rows(std::size_t page) const {
    const std::size_t start = (page - 1) * kPage, header = start + (page == 1 ? 100 : 0);
    const std::size_t n = number(header + 3, 2);
    std::vector<std::pair<std::int64_t, std::string>> all;
    const bool is_leaf = bytes_[header] == 0x0d;
    EXPECT_TRUE(is_leaf || bytes_[header] == 0x05);
    for (std::size_t i = 0; i < n; ++i) {
      std::size_t at = start + number(header + (is_leaf ? 8 : 12) + 2 * i, 2);
      if (is_leaf) {
        const std::size_t size = varint(at);
        const auto row = static_cast<std::int64_t>(varint(at));
        all.emplace_back(row, payload(at, size));
      } else {
        append(all, rows(number(at, 4)));
        at += 4;
        EXPECT_EQ(static_cast<std::int64_t>(varint(at)), all.back().first) << "the key is the last row below";
      }
    }
    if (!is_leaf) append(all, rows(number(header + 8, 4)));
    return all;
  }
  [[nodiscard]] std::size_t n_pages() const { return bytes_.size() / kPage; }
  [[nodiscard]] std::size_t number(std::size_t at, std::size_t n) const {
    std::size_t value = 0;
    for (std::size_t i = 0; i < n; ++i) value = value << 8 | static_cast<unsigned char>(bytes_[at + i]);
    return value;
  }

 private:
  static constexpr std::size_t kPage = 4096;
  static void append(std::vector<std::pair<std::int64_t, std::string>>& all,
                     std::vector<std::pair<std::int64_t, std::string>> more) {
    all.insert(all.end(), more.begin(), more.end());
  }
  [[nodiscard]] std::uint64_t varint(std::size_t& at) const {
    std::uint64_t value = 0;
    for (int i = 0; i < 9; ++i) {
      const auto byte = static_cast<unsigned char>(bytes_[at++]);
      if (i == 8) return value << 8 | byte;
      value = value << 7 | (byte & 0x7f);
      if (byte < 0x80) break;
    }
    return value;
  }
  [[nodiscard]] std::string payload(std::size_t at, std::size_t size) const {
    if (size <= kPage - 35) return bytes_.substr(at, size);
    const std::size_t least = (kPage - 12) * 32 / 255 - 23, full = least + (size - least) % (kPage - 4);
    std::size_t local = full <= kPage - 35 ? full : least;
    std::string all = bytes_.substr(at, local);
    for (std::size_t page = number(at + local, 4); page != 0; page = number((page - 1) * kPage, 4))
      all += bytes_.substr((page - 1) * kPage + 4, std::min(kPage - 4, size - all.size()));
    return all;
  }

  std::string bytes_;
};

TEST(SqliteWriter, RowsOfAnySizeComeBackInTheirOrder) {
  for (const std::size_t n : {0u, 1u, 50u, 5000u, 60000u}) {
    SqliteWriter out;
    out.begin_table("t", "CREATE TABLE t (n INTEGER PRIMARY KEY, b BLOB)");
    for (std::size_t i = 0; i < n; ++i) {
      // Some rows need several pages; sizes are around all limits.
      const std::size_t size = i % 97 == 0 ? 4050 + i % 20 : i % 211 == 5 ? 3 * 4096 + i % 4096 : i % 30;
      out.add_row(static_cast<std::int64_t>(i) * 3 - 40,
                  {std::monostate(), SqliteBlob{std::string(size, static_cast<char>('a' + i % 26))}});
    }
    out.end_table();
    const SqlitePages pages(out.finish(1, 2));
    EXPECT_EQ(pages.number(28, 4), pages.n_pages());
    const auto schema = pages.rows(1);
    ASSERT_EQ(schema.size(), 1u);
    // The root of the table is the number before the text of its statement: one byte or two.
    const std::string& record = schema[0].second;
    const std::size_t sql = record.find("CREATE");
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(record[i]); };
    const std::size_t type = byte(4);
    const std::size_t root = type == 1   ? byte(sql - 1)
                             : type == 2 ? byte(sql - 2) * 256u + byte(sql - 1)
                                         : (byte(sql - 3) * 256u + byte(sql - 2)) * 256u + byte(sql - 1);
    const auto rows = pages.rows(root);
    ASSERT_EQ(rows.size(), n);
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t size = i % 97 == 0 ? 4050 + i % 20 : i % 211 == 5 ? 3 * 4096 + i % 4096 : i % 30;
      ASSERT_EQ(rows[i].first, static_cast<std::int64_t>(i) * 3 - 40);
      ASSERT_TRUE(rows[i].second.ends_with(std::string(size, static_cast<char>('a' + i % 26)))) << i;
      ASSERT_LE(rows[i].second.size(), size + 6) << i;
    }
  }
}

}  // namespace
}  // namespace temper::io
