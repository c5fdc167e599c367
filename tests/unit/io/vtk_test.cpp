// Legacy VTK in the forms that are about: versions 2 to 5.1, binary, polydata, attributes of all kinds.
#include "io/formats/vtk/vtk_arrays.hpp"
#include "support.hpp"

namespace temper::io {
namespace {

template <class T>
std::string big_endian(const std::vector<T>& values) {
  std::string result;
  for (const T v : values) {
    std::string one(reinterpret_cast<const char*>(&v), sizeof v);
    std::reverse(one.begin(), one.end());
    result += one;
  }
  return result;
}

const std::vector<float> kPoints = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
const std::vector<std::array<std::int32_t, 3>> kTriangles = {{0, 1, 2}, {0, 2, 3}};

TEST_F(FileTest, BinaryVtkOfVersion3IsRead) {
  const std::string content =
      "# vtk DataFile Version 3.0\ntitle\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n" + big_endian(kPoints) +
      "\nCELLS 3 11\n" + big_endian<std::int32_t>({2, 0, 1, 3, 0, 1, 2, 3, 0, 2, 3}) + "\nCELL_TYPES 3\n" +
      big_endian<std::int32_t>({3, 5, 5}) + "\nCELL_DATA 3\nSCALARS mat_id int 1\nLOOKUP_TABLE default\n" +
      big_endian<std::int32_t>({8, 6, 7}) + "\nPOINT_DATA 4\nFIELD FieldData 2\nweight 1 4 double\n" +
      big_endian<double>({0.1, -0.0, 3, 4}) + "\nv%20x 2 4 short\n" +
      big_endian<std::int16_t>({1, 2, 3, 4, 5, 6, 7, -8}) + "\n";
  const auto f = read(make("m.vtk", content));
  ASSERT_TRUE(f) << f.error().what();
  EXPECT_EQ(f->triangles.corners, kTriangles);
  EXPECT_EQ(f->triangles.tags, (std::vector<std::int32_t>{6, 7}));
  EXPECT_EQ(f->lines.tags, (std::vector<std::int32_t>{8}));
  EXPECT_TRUE(same_bits(f->weights, {0.1, -0.0, 3, 4}));
  ASSERT_EQ(f->point_data.size(), 1u);
  EXPECT_EQ(f->point_data[0].name, "v x");
  EXPECT_EQ(std::get<std::vector<std::int16_t>>(f->point_data[0].values),
            (std::vector<std::int16_t>{1, 2, 3, 4, 5, 6, 7, -8}));
  ASSERT_EQ(f->triangles.data.size(), 1u) << "mat_id also stays as data of its own type";
}

TEST_F(FileTest, BinaryVtkOfVersion5WithMetadataIsRead) {
  const std::string content =
      "# vtk DataFile Version 5.1\nvtk output\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n" +
      big_endian(kPoints) + "\nMETADATA\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0 1\n\n" +
      "CELLS 3 6\nOFFSETS vtktypeint64\n" + big_endian<std::int64_t>({0, 3, 6}) + "\nCONNECTIVITY vtktypeint64\n" +
      big_endian<std::int64_t>({0, 1, 2, 0, 2, 3}) + "\nCELL_TYPES 2\n" + big_endian<std::int32_t>({5, 5}) + "\n";
  const auto f = read(make("m.vtk", content));
  ASSERT_TRUE(f) << f.error().what();
  EXPECT_EQ(f->triangles.corners, kTriangles);
}

TEST_F(FileTest, TypesOfFixedWidthAreKnownByTheirNames) {
  const auto f = read(
      make("m.vtk",
           "# vtk DataFile Version 5.1\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 vtktypefloat64\n"
           "0 0 0 1 0 0 1 1 0 0 1 0\nCELLS 3 6\nOFFSETS vtktypeint64\n0 3 6\nCONNECTIVITY vtktypeint64\n0 1 2 0 2 3\n"
           "CELL_TYPES 2\n5\n5\nCELL_DATA 2\nFIELD FieldData 3\nregion 1 2 vtktypeint32\n6 7\n"
           "a 1 2 vtktypeuint8\n1 255\nb 1 2 vtktypeuint64\n1 2\n"));
  ASSERT_TRUE(f) << f.error().what();
  EXPECT_EQ(f->triangles.tags, (std::vector<std::int32_t>{6, 7}));
  ASSERT_EQ(f->triangles.data.size(), 2u);
  EXPECT_EQ(std::get<std::vector<std::uint8_t>>(f->triangles.data[0].values), (std::vector<std::uint8_t>{1, 255}));
  EXPECT_EQ(std::get<std::vector<std::uint64_t>>(f->triangles.data[1].values), (std::vector<std::uint64_t>{1, 2}));
}

TEST_F(FileTest, PolydataWithLinesAndVerticesIsRead) {
  const auto f = read(
      make("m.vtk",
           "# vtk DataFile Version 4.2\nt\nASCII\nDATASET POLYDATA\nPOINTS 4 double\n0 0 1 1 0 1 1 1 1 0 1 1\n"
           "VERTICES 1 3\n2 0 3\nLINES 1 4\n3 0 1 2\nPOLYGONS 2 8\n3 0 1 2\n3 0 2 3\nCELL_DATA 4\nSCALARS region int\n"
           "LOOKUP_TABLE default\n1 2 3 4\n"));
  ASSERT_TRUE(f) << f.error().what();
  EXPECT_EQ(f->z(), 1);
  EXPECT_EQ(f->triangles.corners, kTriangles);
  EXPECT_EQ(f->triangles.tags, (std::vector<std::int32_t>{3, 4}));
  EXPECT_EQ(f->lines.corners, (std::vector<std::array<std::int32_t, 2>>{{0, 1}, {1, 2}}));
  EXPECT_EQ(f->lines.tags, (std::vector<std::int32_t>{2, 2}));
  EXPECT_EQ(f->marked_points.corners, (std::vector<std::int32_t>{0, 3}));
  EXPECT_EQ(f->marked_points.tags, (std::vector<std::int32_t>{1, 1}));
}

TEST_F(FileTest, AttributesOfAllKindsAreKeptWithTheirTypes) {
  const auto f = read(make(
      "m.vtk",
      "# vtk DataFile Version 2.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n"
      "CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n5\nPOINT_DATA 3\nSCALARS a unsigned_char\nLOOKUP_TABLE mine\n1 2 3\n"
      "LOOKUP_TABLE mine 2\n0 0 0 1 1 1 1 1\nVECTORS b double\n1 2 3 4 5 6 7 8 9\nNORMALS c float\n0 0 1 0 0 1 0 0 1\n"
      "TENSORS d float\n1 2 3 4 5 6 7 8 9 1 2 3 4 5 6 7 8 9 1 2 3 4 5 6 7 8 9\n"
      "TEXTURE_COORDINATES e 2 float\n0 0 1 0 0 1\nCOLOR_SCALARS f 3\n0 0 0 1 1 1 .5 .5 .5\n"
      "FIELD more 1\ng 1 3 vtkIdType\n5 6 7\n"));
  ASSERT_TRUE(f) << f.error().what();
  const std::tuple<const char*, int, std::size_t> kExpected[] = {{"a", 1, 4}, {"b", 3, 0}, {"c", 3, 1}, {"d", 9, 1},
                                                                 {"e", 2, 1}, {"f", 3, 1}, {"g", 1, 3}};
  ASSERT_EQ(f->point_data.size(), std::size(kExpected));
  for (std::size_t i = 0; i < std::size(kExpected); ++i) {
    const auto& [name, components, type] = kExpected[i];
    EXPECT_EQ(f->point_data[i].name, name);
    EXPECT_EQ(f->point_data[i].components, components) << name;
    EXPECT_EQ(f->point_data[i].values.index(), type) << name;
  }
}

TEST_F(FileTest, OtherDataSetsAreNamed) {
  const auto f =
      read(make("m.vtk", "# vtk DataFile Version 2.0\nt\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2 2 1\n"));
  ASSERT_FALSE(f);
  EXPECT_EQ(plain(f.error().what()),
            "m.vtk:4: is a data set of kind 'structured_points'; temper reads UNSTRUCTURED_GRID and POLYDATA");
}

// What nobody has the memory to write: 2³¹ points of cells are those of 716 million triangles.
TEST(VtkCellEnds, AreOfSixtyFourBitsWhereThirtyTwoEnd) {
  constexpr std::size_t kLast = 715'827'882;  // of which the last one ends at 2³¹ − 2
  EXPECT_EQ(vtk_cell_ends({kLast, 0, 0, 0}).scalar, Scalar::i32);
  EXPECT_EQ(vtk_cell_ends({kLast, 0, 0, 1}).scalar, Scalar::i32);  // at 2³¹ − 1
  const VtkArray ends = vtk_cell_ends({kLast, 0, 1, 1});
  ASSERT_EQ(ends.scalar, Scalar::i64);
  EXPECT_EQ(ends.bytes(), 8 * (kLast + 2));
  std::array<std::int64_t, 3> last = {};
  ends.fill(kLast - 1, 3, reinterpret_cast<char*>(last.data()));
  EXPECT_EQ(last, (std::array<std::int64_t, 3>{2'147'483'646, 2'147'483'648, 2'147'483'649}));
}

}  // namespace
}  // namespace temper::io
