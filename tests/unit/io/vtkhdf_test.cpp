// VTKHDF: what is in the files, those of others (pieces, versions, ghosts), and damage.
#include "libraries.hpp"
#include "support.hpp"

#if TEMPER_HDF5

#include "io/containers/hdf5_file.hpp"
#include "io/formats/format.hpp"
#include "io/formats/vtk/vtkhdf.hpp"
#include "temper/generate.hpp"

namespace temper::io {
namespace {

template <class T>
VtkArray array_of(std::string name, Scalar scalar, std::vector<T> values, int components = 1) {
  const std::size_t n = values.size();
  return computed_vtk_array<T>(
      std::move(name), scalar, n, [values = std::move(values)](std::size_t i) { return values[i]; }, components);
}
VtkArray longs(std::string name, std::vector<std::int64_t> values) {
  return array_of(std::move(name), Scalar::i64, std::move(values));
}
VtkArray doubles(std::string name, std::vector<double> values, int components = 1) {
  return array_of(std::move(name), Scalar::f64, std::move(values), components);
}

/// A file of two pieces, a triangle each, that meet in two points: the square of side 1. Tests spoil parts of it.
struct TwoPieces {
  std::vector<std::int64_t> version = {2, 3}, time_steps = {};
  std::string type = "UnstructuredGrid";
  std::vector<VtkArray> arrays = {longs("NumberOfPoints", {3, 3}),
                                  longs("NumberOfCells", {1, 1}),
                                  longs("NumberOfConnectivityIds", {3, 3}),
                                  doubles("Points", {0, 0, 0, 1, 0, 0, 1, 1, 0, 1, 1, 0, 0, 1, 0, 0, 0, 0}, 3),
                                  longs("Connectivity", {0, 1, 2, 0, 1, 2}),
                                  longs("Offsets", {0, 3, 0, 3}),
                                  array_of<std::uint8_t>("Types", Scalar::u8, {5, 5})};
  std::vector<VtkArray> point_data = {doubles("depth", {1, 2, 3, 3, 4, 1})};
  std::vector<VtkArray> cell_data = {longs("number", {10, 20})};
  std::string group = "VTKHDF";

  [[nodiscard]] TwoPieces with(VtkArray other) const {
    TwoPieces changed = *this;
    for (VtkArray& a : changed.arrays) {
      if (a.name == other.name) a = other;
    }
    return changed;
  }
  [[nodiscard]] TwoPieces without(std::string_view name) const {
    TwoPieces changed = *this;
    std::erase_if(changed.arrays, [&](const VtkArray& a) { return a.name == name; });
    return changed;
  }
};

class Vtkhdf : public FileTest {
 protected:
  void SetUp() override {
    FileTest::SetUp();
    if (hdf5_version().empty()) GTEST_SKIP() << "no libhdf5";
  }

  std::string make_pieces(const TwoPieces& file) const {
    OutputSet outputs;
    {
      Hdf5Writer out(path("m.hdf"), 20);
      const Hdf5Id root = out.group(out.root(), file.group);
      if (!file.version.empty()) out.attribute(root, "Version", file.version);
      if (!file.type.empty()) out.attribute(root, "Type", file.type);
      const auto put = [&](const Hdf5Id& in, const std::vector<VtkArray>& arrays) {
        for (const VtkArray& a : arrays) static_cast<void>(out.dataset(in, a.name, a));
      };
      put(root, file.arrays);
      put(out.group(root, "PointData"), file.point_data);
      put(out.group(root, "CellData"), file.cell_data);
      if (!file.time_steps.empty()) out.attribute(out.group(root, "Steps"), "NSteps", file.time_steps);
      out.finish(outputs.open(path("m.hdf")));
    }
    outputs.commit();
    return path("m.hdf");
  }
  [[nodiscard]] std::string error_of(const TwoPieces& file) const {
    const auto f = read(make_pieces(file));
    return f ? "" : plain(f.error().what());
  }
};

TEST_F(Vtkhdf, KeepsAllDataWithTheirTypes) {
  MeshFile f = rich_sample();
  f.field_data.push_back({"nothing", 1, std::vector<float>{}});
  const auto warnings = write(path("a.vtkhdf"), f);
  ASSERT_TRUE(warnings) << warnings.error().what();
  EXPECT_TRUE(warnings->empty());
  const auto g = read(path("a.vtkhdf"));
  ASSERT_TRUE(g) << g.error().what();
  EXPECT_EQ(g->format, "vtkhdf");
  EXPECT_TRUE(g->warnings.empty());
  expect_same_mesh(f, *g);
  expect_same_data(f, *g);
  ASSERT_EQ(g->names.size(), f.names.size());
  for (std::size_t i = 0; i < f.names.size(); ++i) EXPECT_EQ(g->names[i].name, f.names[i].name);
}

// The arrays of VTU are those of VTKHDF: through either the file of the other comes back, byte for byte.
TEST_F(Vtkhdf, HoldsWhatVtuHolds) {
  std::vector<MeshFile> files = {sample(), rich_sample(), from_mesh(*random_sphere({.vertices = 100})),
                                 from_mesh(*periodic_hexagons({.nx = 6, .ny = 4}))};
  for (const MeshFile& f : files) {
    ASSERT_TRUE(write(path("1.vtu"), f));
    ASSERT_TRUE(write(path("1.vtkhdf"), *read(path("1.vtu"))));
    const auto back = read(path("1.vtkhdf"));
    ASSERT_TRUE(back) << back.error().what();
    EXPECT_EQ(back->space(), f.space());
    if (f.sphere() != nullptr) {
      EXPECT_EQ(back->sphere()->places, f.sphere()->places);
    }
    ASSERT_TRUE(write(path("2.vtu"), *back));
    EXPECT_EQ(slurp(path("2.vtu")), slurp(path("1.vtu")));
  }
}

TEST_F(Vtkhdf, TakesAnyNameOfAnArray) {
  MeshFile f = sample();
  for (const char* name : {"a/b", "a%2Fb", ".", "..", "", "unnamed", "größer als 0", "/"}) {
    f.point_data.push_back({name, 1, std::vector<std::int32_t>(6, static_cast<int>(f.point_data.size()))});
  }
  ASSERT_TRUE(write(path("a.vtkhdf"), f));
  const auto g = read(path("a.vtkhdf"));
  ASSERT_TRUE(g) << g.error().what();
  expect_same_data(f.point_data, g->point_data, "point data");
}

// Blocks are smaller than the arrays, and the layout takes more than the first piece of memory.
TEST_F(Vtkhdf, OfManyBlocksAndArraysComesBackWhole) {
  MeshFile f = from_mesh(*random_mesh({.vertices = 20000, .seed = 1}));
  for (int k = 0; k < 60; ++k) {
    std::vector<double> values(f.points.size());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = f.points[i].x * k;
    f.point_data.push_back({"data of a rather long name that goes on and on, number " + std::to_string(k), 1, values});
  }
  ASSERT_TRUE(write(path("a.vtkhdf"), f));
  const auto g = read(path("a.vtkhdf"));
  ASSERT_TRUE(g) << g.error().what();
  expect_same_mesh(f, *g);
  expect_same_data(f.point_data, g->point_data, "point data");
}

TEST_F(Vtkhdf, IsWrittenWithoutASecondCopyOfTheMesh) {
  constexpr std::size_t kNumbers = std::size_t{1} << 20, kMany = kNumbers << 20;  // 8 TB
  const auto never = [](auto, auto, auto*) { ADD_FAILURE() << "numbers are asked for before the layout is done"; };
  {
    Hdf5Writer large(path("large"), 3);
    const Hdf5Id root = large.group(large.root(), "VTKHDF");
    for (const char* name : {"a", "b", "c"}) {
      static_cast<void>(large.dataset(root, name, {name, Scalar::f64, 1, kMany, never}));
    }
  }
  Hdf5Writer small(path("small"), 1);
  std::size_t next = 0, most = 0;
  static_cast<void>(small.dataset(small.root(), "a", {"a", Scalar::f64, 1, kNumbers, [&](auto first, auto n, auto* to) {
                                                        EXPECT_EQ(first, next) << "each number once, in order";
                                                        std::memset(to, 0, n * sizeof(double));
                                                        next = first + n;
                                                        most = std::max<std::size_t>(most, n);
                                                      }}));
  OutputSet outputs;
  small.finish(outputs.open(path("small")));
  EXPECT_EQ(next, kNumbers);
  EXPECT_LE(most * sizeof(double), kVtkBlockBytes);
  EXPECT_LT(kVtkBlockBytes, kNumbers);
}

TEST_F(Vtkhdf, TriangleQualityIsNoDataOfTheUser) {
  MeshFile f = sample();
  ASSERT_TRUE(write(path("a.vtkhdf"), f));
  EXPECT_NE(slurp(path("a.vtkhdf")).find("min_angle_deg"), std::string::npos);
  EXPECT_TRUE(read(path("a.vtkhdf"))->triangles.data.empty());
  ASSERT_TRUE(write(path("a.vtkhdf"), f, {"", {}, nullptr, false}));
  EXPECT_EQ(slurp(path("a.vtkhdf")).find("min_angle_deg"), std::string::npos);
}

herr_t own_handler(hid_t, void*) { return 0; }

// libhdf5 may be that of others in the process, who have it do something else with errors.
TEST_F(Vtkhdf, WhatTheLibraryDoesWithErrorsIsAsItWasBefore) {
  const Hdf5Library& library = hdf5_library(path("a.vtkhdf"));
  // Such a file also loads libnetcdf, which sets its own handler once.
  EXPECT_FALSE(read(make("c.vtkhdf", "\x89HDF\r\n\x1a\n")));
  int data = 0;
  H5E_auto2_t before = nullptr, after = nullptr;
  void *data_before = nullptr, *data_after = nullptr;
  library.H5Eget_auto2(H5E_DEFAULT, &before, &data_before);
  library.H5Eset_auto2(H5E_DEFAULT, own_handler, &data);
  EXPECT_TRUE(write(path("a.vtkhdf"), sample()));
  EXPECT_TRUE(read(path("a.vtkhdf")));
  EXPECT_FALSE(read(make("b.vtkhdf", slurp(path("a.vtkhdf")).substr(0, 1000))));
  library.H5Eget_auto2(H5E_DEFAULT, &after, &data_after);
  library.H5Eset_auto2(H5E_DEFAULT, before, data_before);
  EXPECT_TRUE(after == own_handler);
  EXPECT_EQ(data_after, &data);
}

// --- files of others ---------------------------------------------------------------------------------

TEST_F(Vtkhdf, PiecesBecomeOneMesh) {
  for (const std::vector<std::int64_t>& version : {std::vector<std::int64_t>{1, 0}, {2, 0}, {2, 9}}) {
    TwoPieces file;
    file.version = version;
    const auto f = read(make_pieces(file));
    ASSERT_TRUE(f) << f.error().what();
    EXPECT_EQ(f->points, (std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
    EXPECT_EQ(f->triangles.corners, (std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}, {2, 3, 0}}));
    ASSERT_EQ(f->point_data.size(), 1u);
    EXPECT_EQ(std::get<std::vector<double>>(f->point_data[0].values), (std::vector<double>{1, 2, 3, 4}));
    ASSERT_EQ(f->triangles.data.size(), 1u);
    EXPECT_EQ(std::get<std::vector<std::int64_t>>(f->triangles.data[0].values), (std::vector<std::int64_t>{10, 20}));
    EXPECT_EQ(f->numbering->point(3), "point 4");
    ASSERT_EQ(f->warnings.size(), 1u);
    EXPECT_EQ(plain(f->warnings[0]),
              "m.hdf: 2 points are where points of other pieces are; each is one with the first there, whose data it "
              "has");
    EXPECT_TRUE(make_mesh(*f));
  }
}

TEST_F(Vtkhdf, GhostsOfOtherPiecesAreLeftOut) {
  TwoPieces file;
  file = file.with(longs("NumberOfCells", {2, 1})).with(longs("NumberOfConnectivityIds", {6, 3}));
  file = file.with(longs("NumberOfPoints", {4, 3}));
  file = file.with(doubles("Points", {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 1, 1, 0, 0, 1, 0, 0, 0, 0}, 3));
  file = file.with(longs("Connectivity", {0, 1, 2, 0, 2, 3, 0, 1, 2})).with(longs("Offsets", {0, 3, 6, 0, 3}));
  file = file.with(array_of<std::uint8_t>("Types", Scalar::u8, {5, 5, 5}));
  file.point_data = {};
  for (const VtkArray& ghosts :
       {array_of<std::uint8_t>("vtkGhostType", Scalar::u8, {0, 1, 0}), longs("vtkGhostType", {0, 1, 0})}) {
    file.cell_data = {longs("number", {10, 20, 20}), ghosts};
    const auto f = read(make_pieces(file));
    ASSERT_TRUE(f) << f.error().what();
    EXPECT_EQ(f->triangles.corners, (std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}, {2, 3, 0}}));
    ASSERT_EQ(f->triangles.data.size(), 1u);
    EXPECT_EQ(std::get<std::vector<std::int64_t>>(f->triangles.data[0].values), (std::vector<std::int64_t>{10, 20}));
    EXPECT_TRUE(make_mesh(*f));
  }
  file.cell_data = {doubles("vtkGhostType", {0, 1, 0})};
  const auto all = read(make_pieces(file));
  ASSERT_TRUE(all) << all.error().what();
  EXPECT_EQ(all->triangles.size(), 3u);
  ASSERT_FALSE(all->warnings.empty());
  EXPECT_EQ(plain(all->warnings.back()),
            "m.hdf: cell data vtkGhostType is no integer for each cell: all cells are taken");
}

TEST_F(Vtkhdf, APieceMayBeEmpty) {
  TwoPieces file;
  file = file.with(longs("NumberOfPoints", {3, 0})).with(longs("NumberOfCells", {1, 0}));
  file = file.with(longs("NumberOfConnectivityIds", {3, 0})).with(longs("Connectivity", {0, 1, 2}));
  file = file.with(doubles("Points", {0, 0, 0, 1, 0, 0, 1, 1, 0}, 3)).with(longs("Offsets", {0, 3, 0}));
  file = file.with(array_of<std::uint8_t>("Types", Scalar::u8, {5}));
  file.point_data = {}, file.cell_data = {};
  const auto f = read(make_pieces(file));
  ASSERT_TRUE(f) << f.error().what();
  EXPECT_EQ(f->triangles.size(), 1u);
  EXPECT_TRUE(f->warnings.empty());
}

TEST_F(Vtkhdf, OtherTypesOfNumbersAreTaken) {
  TwoPieces file;
  file = file.with(array_of<float>("Points", Scalar::f32, {0, 0, 0, 1, 0, 0, 1, 1, 0, 1, 1, 0, 0, 1, 0, 0, 0, 0}, 3));
  file = file.with(array_of<std::uint16_t>("Connectivity", Scalar::u16, {0, 1, 2, 0, 1, 2}));
  file = file.with(array_of<std::int32_t>("Offsets", Scalar::i32, {0, 3, 0, 3}));
  file = file.with(longs("Types", {5, 5}));
  file.time_steps = {1};
  EXPECT_EQ(error_of(file), "");
}

TEST(JoinedPointsTest, PointsOfOnePieceStayApart) {
  const std::vector<Vec3> places = {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {-0.0, 0, 0}, {1, 0, 1}, {1, 0, 0}};
  const JoinedPoints joined = join_points({3, 3}, [&](std::size_t i) { return places[i]; });
  EXPECT_EQ(joined.number, (std::vector<std::int32_t>{0, 1, 2, 0, 3, 2}));
  ASSERT_EQ(joined.kept.size(), 4u);
  EXPECT_EQ(joined.kept[3], 4);
}

// --- what is refused ---------------------------------------------------------------------------------

TEST_F(Vtkhdf, WhatDoesNotFitIsNamed) {
  const TwoPieces good;
  EXPECT_EQ(error_of(good), "");
  TwoPieces other = good;
  other.version = {3, 0};
  EXPECT_EQ(error_of(other), "m.hdf: is VTKHDF of version 3.0; temper reads versions 1 and 2");
  other.version = {2};
  EXPECT_EQ(error_of(other), "m.hdf: has no attribute Version of two integers in the group VTKHDF");
  other = good;
  other.type = "ImageData";
  EXPECT_EQ(error_of(other), "m.hdf: is a VTKHDF file of type 'ImageData'; temper reads UnstructuredGrid");
  other.type = "";
  EXPECT_EQ(error_of(other), "m.hdf: has no attribute Type of text in the group VTKHDF");
  other = good;
  other.time_steps = {5};
  EXPECT_EQ(error_of(other), "m.hdf: has 5 time steps; temper reads files of one: write one alone");

  EXPECT_EQ(error_of(good.without("Offsets")), "m.hdf: the dataset 'Offsets' is missing");
  EXPECT_EQ(error_of(good.with(longs("NumberOfPoints", {3, 4}))),
            "m.hdf: the dataset 'Points' has 6 times 3 values, expected 7 times 3");
  EXPECT_EQ(error_of(good.with(longs("NumberOfPoints", {3, -3}))),
            "m.hdf: NumberOfPoints of piece 1 is -3; expected a number");
  EXPECT_EQ(error_of(good.with(longs("NumberOfPoints", {2147483647, 2}))),
            "m.hdf: has 2147483649 points, more than 32 bits count");
  EXPECT_EQ(error_of(good.with(longs("NumberOfPoints", {}))),
            "m.hdf: NumberOfPoints has 0 numbers, expected one per piece");
  EXPECT_EQ(error_of(good.with(longs("NumberOfCells", {2}))),
            "m.hdf: NumberOfCells has 1 numbers, expected one per piece, of which NumberOfPoints has 2");
  EXPECT_EQ(error_of(good.with(doubles("Points", {0, 0, 1, 0, 1, 1, 1, 1, 0, 1, 0, 0}, 2))),
            "m.hdf: the dataset 'Points' has 6 times 2 values, expected 6 times 3");
  EXPECT_EQ(error_of(good.with(longs("Offsets", {0, 3, 3, 6}))),
            "m.hdf: element 1 ends at 6 of 3 connectivity values, and starts at 3");
  EXPECT_EQ(error_of(good.with(longs("Offsets", {0, 3, -3, 3}))),
            "m.hdf: element 1 ends at 3 of 3 connectivity values, and starts at -3");
  EXPECT_EQ(error_of(good.with(longs("Connectivity", {0, 1, 2, 0, 1, 3}))),
            "m.hdf: element 1 uses vertex 3, but its piece has 3 vertices, numbered from 0");
  EXPECT_EQ(error_of(good.with(longs("Connectivity", {0, 1, 2, 0, 1, 1LL << 40}))),
            "m.hdf: the dataset 'Connectivity' has a value beyond 32 bits");
  EXPECT_EQ(error_of(good.with(doubles("Connectivity", {0, 1, 2, 0, 1, 2}))),
            "m.hdf: the dataset 'Connectivity' holds no integers");
  EXPECT_EQ(error_of(good.with(array_of<std::uint8_t>("Types", Scalar::u8, {5, 10}))),
            "m.hdf: element 1 is a tetrahedron with 3 vertices");
  EXPECT_EQ(error_of(good.with(array_of<std::uint8_t>("Types", Scalar::u8, {5, 12}))),
            "m.hdf: element 1 is a hexahedron; temper reads linear triangles, quadrilaterals and tetrahedra, with "
            "lines and points as tags. Next: split it into tetrahedra, as triangulate() of PyVista does");
  other = good;
  other.point_data = {doubles("depth", {1, 2, 3, 4})};
  EXPECT_EQ(error_of(other), "m.hdf: point data 'depth' has 4 rows, expected 6");
}

TEST_F(Vtkhdf, AFileWithoutTheGroupIsLeftToNetcdf) {
  TwoPieces other;
  other.group = "notVTKHDF";
  const std::string error = error_of(other);
  EXPECT_NE(error.find(expects_netcdf() ? "is NetCDF without a mesh that temper reads" : "NetCDF"), std::string::npos)
      << error;
}

TEST_F(Vtkhdf, NothingIsWrittenWhereTheFolderIsNotThere) {
  const auto written = write(path("no/m.vtkhdf"), sample());
  ASSERT_FALSE(written);
  EXPECT_EQ(plain(written.error().what()), "no/m.vtkhdf: cannot be written: No such file or directory");
}

TEST_F(Vtkhdf, CutAnywhereIsRefused) {
  const std::string whole = slurp(make_pieces({}));
  for (std::size_t n = 9; n < whole.size(); n += whole.size() / 40) {
    const auto f = read(make("cut.vtkhdf", whole.substr(0, n)));
    ASSERT_FALSE(f) << n;
    EXPECT_FALSE(f.error().message.empty());
    EXPECT_EQ(plain(f.error().where).substr(0, 10), "cut.vtkhdf");
  }
}

}  // namespace
}  // namespace temper::io
#endif
