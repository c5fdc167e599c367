// The quality of triangles as cell data of VTU: what quality.hpp says, made anew by every writing.
#include "support/std_threads.hpp"
#include "temper/generate.hpp"
#include "temper/quality.hpp"
#include "unit/io/support.hpp"

namespace temper::io {
namespace {

constexpr std::array<std::string_view, 4> kQualityNames = {"well_centered", "min_h_over_l", "min_d_over_l",
                                                           "min_angle_deg"};

class TriangleQualityOfFiles : public FileTest {
 protected:
  /// The cell data of a VTU file, those of temper included, whose names are hidden from the reader.
  [[nodiscard]] std::vector<DataArray> all_cell_data(const std::string& from) const {
    std::string bytes = slurp(from);
    for (const std::string_view name : kQualityNames) {
      const std::size_t at = bytes.find("Name=\"" + std::string(name));
      if (at != std::string::npos) bytes[at + 6] = '_';
    }
    const auto file = read(make("all.vtu", bytes));
    EXPECT_TRUE(file) << file.error().what();
    return file ? file->triangles.data : std::vector<DataArray>();
  }

  void expect_quality_of(const Mesh& mesh, const std::vector<DataArray>& data) const {
    ASSERT_EQ(data.size(), kQualityNames.size());
    const auto& good = std::get<std::vector<std::uint8_t>>(data[0].values);
    ASSERT_EQ(good.size(), mesh.n_triangles());
    const auto floats = [&](std::size_t k) { return std::get<std::vector<float>>(data[k].values); };
    const auto h = floats(1), d = floats(2), angle = floats(3);
    std::size_t n_good = 0;
    for (const TriangleId t : mesh.triangles()) {
      const TriangleQuality q = triangle_quality(mesh, t);
      EXPECT_EQ(good[t.index] == 1, q.well_centered) << t.index;
      EXPECT_EQ(h[t.index], static_cast<float>(q.min_h_over_l)) << t.index;
      EXPECT_EQ(d[t.index], static_cast<float>(q.min_d_over_l)) << t.index;
      EXPECT_EQ(angle[t.index], static_cast<float>(q.min_angle_deg)) << t.index;
      n_good += good[t.index];
    }
    const Quality whole = quality(mesh);
    EXPECT_EQ(static_cast<double>(n_good) / static_cast<double>(good.size()), whole.well_centered_fraction);
    EXPECT_EQ(*std::min_element(h.begin(), h.end()), static_cast<float>(whole.min_h_over_l));
    EXPECT_EQ(*std::min_element(d.begin(), d.end()), static_cast<float>(whole.min_d_over_l));
    EXPECT_EQ(*std::min_element(angle.begin(), angle.end()), static_cast<float>(whole.min_angle_deg));
  }
};

Mesh with_weights(Mesh mesh) {
  for (const VertexId v : mesh.vertices()) {
    const double w = 1e-3 * static_cast<double>(v.index % 7) * mesh.space().radius() * mesh.space().radius();
    mesh.set_weight(v, mesh.space().is_plane() ? 1e-4 * static_cast<double>(v.index % 7) : w);
  }
  return mesh;
}

TEST_F(TriangleQualityOfFiles, IsThatOfTheMeshInThePlaneAndOnTheSphereInEveryEncoding) {
  for (const Mesh& mesh : {with_weights(*horseshoe()), with_weights(*random_sphere({.vertices = 200}))}) {
    for (const Encoding encoding : {Encoding::ascii, Encoding::base64, Encoding::appended}) {
      ASSERT_TRUE(write(path("m.vtu"), from_mesh(mesh), {"", encoding}));
      expect_quality_of(mesh, all_cell_data(path("m.vtu")));
    }
  }
}

TEST_F(TriangleQualityOfFiles, IsNoDataOfTheUserAndIsThereOnceAfterManyRounds) {
  ASSERT_TRUE(write(path("1.vtu"), from_mesh(*horseshoe())));
  const auto first = read(path("1.vtu"));
  ASSERT_TRUE(first);
  EXPECT_TRUE(first->triangles.data.empty());
  ASSERT_TRUE(write(path("2.vtu"), *first));
  EXPECT_EQ(slurp(path("2.vtu")), slurp(path("1.vtu")));
}

TEST_F(TriangleQualityOfFiles, IsTheLowestIfExactArithmeticCannotMeasureATriangle) {
  MeshFile file;
  file.triangles.corners = {{0, 1, 2}};
  for (const double x : {0x1p250, -0x1p250, 0x1p-214, 0x1.1p250, 1e154, -1e308, 0x1.fp-215, -1e-200}) {
    file.points = {{0, 0}, {1, 0}, {x, 1}};
    const bool is_unknown = std::abs(x) > 0x1p250 || std::abs(x) < 0x1p-214;
    const auto warnings = write(path("m.vtu"), file);
    ASSERT_TRUE(warnings) << warnings.error().what();
    const auto data = all_cell_data(path("m.vtu"));
    ASSERT_EQ(data.size(), kQualityNames.size()) << x;
    EXPECT_EQ(std::get<std::vector<float>>(data[3].values)[0] == std::numeric_limits<float>::lowest(), is_unknown) << x;
    EXPECT_TRUE(!is_unknown || std::get<std::vector<std::uint8_t>>(data[0].values)[0] == 0) << x;
    ASSERT_EQ(warnings->size(), is_unknown ? 1U : 0U) << x;
    if (is_unknown) {
      EXPECT_NE(warnings->front().find("m.vtu: the quality of triangle 0 and perhaps of others is unknown, and "
                                       "written as the lowest: point 2 has coordinates ("),
                std::string::npos)
          << warnings->front();
    }
    const auto again = read(path("m.vtu"));
    ASSERT_TRUE(again) << again.error().what();
    EXPECT_EQ(again->points[2].x, x);
  }
}

TEST_F(TriangleQualityOfFiles, FollowsAMeshThatHasChanged) {
  ASSERT_TRUE(write(path("1.vtu"), from_mesh(*horseshoe())));
  auto file = read(path("1.vtu"));
  ASSERT_TRUE(file);
  const auto loaded = make_mesh(*file);
  ASSERT_TRUE(loaded);
  const Mesh changed = with_weights(loaded->mesh);
  update(*file, *loaded, changed);
  ASSERT_TRUE(write(path("2.vtu"), *file));
  expect_quality_of(changed, all_cell_data(path("2.vtu")));
}

TEST_F(TriangleQualityOfFiles, IsLeftOutWhenAskedTo) {
  ASSERT_TRUE(write(path("m.vtu"), from_mesh(*horseshoe()), {"", {}, nullptr, false}));
  EXPECT_TRUE(all_cell_data(path("m.vtu")).empty());
}

TEST_F(TriangleQualityOfFiles, IsLeftOutForDataOfThatNameWhichStay) {
  MeshFile file = sample();
  file.weights.clear();
  file.triangles.data = {{"min_angle_deg", 1, std::vector<double>{1, 2, 3, 4}}};
  const auto warnings = write(path("m.vtu"), file);
  ASSERT_TRUE(warnings);
  ASSERT_EQ(warnings->size(), 1u);
  EXPECT_EQ(plain(warnings->front()),
            "m.vtu: the quality of triangles is not written: the mesh has data 'min_angle_deg' of its own");
  const auto back = read(path("m.vtu"));
  ASSERT_TRUE(back);
  ASSERT_EQ(back->triangles.data.size(), 1u);
  EXPECT_EQ(back->triangles.data[0].values, file.triangles.data[0].values);
}

TEST_F(TriangleQualityOfFiles, IsThatOfTheCounterClockwiseTriangleAndNoNumberWhereThereIsNoArea) {
  MeshFile file;
  file.points = {{0, 0}, {1, 0}, {0.5, 0.8}, {2, 0}};
  file.triangles.corners = {{0, 1, 2}, {0, 2, 1}, {0, 1, 3}};
  ASSERT_TRUE(write(path("m.vtu"), file, {"", Encoding::ascii}));
  const std::vector<DataArray> data = all_cell_data(path("m.vtu"));
  ASSERT_EQ(data.size(), 4u);
  EXPECT_EQ(std::get<std::vector<std::uint8_t>>(data[0].values), (std::vector<std::uint8_t>{1, 1, 0}));
  const auto& h = std::get<std::vector<float>>(data[1].values);
  EXPECT_EQ(h[0], h[1]);
  EXPECT_GT(h[0], 0);
  EXPECT_EQ(h[2], std::numeric_limits<float>::lowest());
}

TEST_F(TriangleQualityOfFiles, IsOfLengthsAndSoNotOfPointsInDegrees) {
  MeshFile file;
  file.points = {{0, 60}, {1, 60}, {0.5, 60.5}};
  file.triangles.corners = {{0, 1, 2}};
  file.points_in = DegreePoints{};
  ASSERT_TRUE(write(path("degrees.vtu"), file));
  EXPECT_TRUE(all_cell_data(path("degrees.vtu")).empty());

  ASSERT_TRUE(project(file, "stereographic"));
  ASSERT_TRUE(write(path("map.vtu"), file));  // in degrees again
  const auto loaded = make_mesh(file);
  ASSERT_TRUE(loaded);
  expect_quality_of(loaded->mesh, all_cell_data(path("map.vtu")));
}

TEST_F(TriangleQualityOfFiles, DoesNotDependOnThreads) {
  const MeshFile file = from_mesh(*random_mesh({.vertices = 9000}));
  ASSERT_TRUE(write(path("1.vtu"), file));
  test::StdThreads executor(3);
  ASSERT_TRUE(write(path("3.vtu"), file, {"", {}, &executor}));
  EXPECT_EQ(slurp(path("3.vtu")), slurp(path("1.vtu")));
}

}  // namespace
}  // namespace temper::io
