// Names that would be more than names elsewhere: a line of a header, a second property, an order to the terminal.
#include "io/text/names.hpp"

#include "support.hpp"

namespace temper::io {
namespace {

constexpr std::string_view kNasty = "a\nproperty double x\x1b[2J\"";
constexpr std::string_view kNastyInVtu = "a&#10;property double x&#27;[2J&quot;";
constexpr std::string_view kPlain = "a\\x0aproperty double x\\x1b[2J\"";

using Names = FileTest;

/// A triangle with point data, a group and field data of the nasty name.
std::string nasty_vtu() {
  std::string bytes;
  for (const char c : std::string("2 7 ")) bytes += std::to_string(c) + " ";
  for (const char c : std::string("group\x1b[2J\"")) bytes += std::to_string(c) + " ";
  const std::string name(kNastyInVtu);
  return "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><FieldData><DataArray type=\"UInt8\" "
         "Name=\"physical_names\" format=\"ascii\">" +
         bytes + "</DataArray><DataArray type=\"Int8\" Name=\"" + name +
         "\" format=\"ascii\">1</DataArray></FieldData><Piece NumberOfPoints=\"3\" NumberOfCells=\"1\"><Points>"
         "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0</DataArray></Points>"
         "<Cells><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray>"
         "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3</DataArray>"
         "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">5</DataArray></Cells>"
         "<PointData><DataArray type=\"Int8\" Name=\"" +
         name +
         "\" format=\"ascii\">1 2 3</DataArray></PointData><CellData><DataArray type=\"Int32\" Name=\"region\" "
         "format=\"ascii\">7</DataArray></CellData></Piece></UnstructuredGrid></VTKFile>";
}

TEST_F(Names, AreReadWithoutControlCharactersAndAWarningSaysSo) {
  const auto f = read(make("m.vtu", nasty_vtu()));
  ASSERT_TRUE(f) << f.error().what();
  ASSERT_EQ(f->point_data.size(), 1u);
  EXPECT_EQ(f->point_data[0].name, kPlain);
  ASSERT_EQ(f->field_data.size(), 1u);
  EXPECT_EQ(f->field_data[0].name, kPlain);
  ASSERT_EQ(f->names.size(), 1u);
  EXPECT_EQ(f->names[0].name, "group\\x1b[2J\"");
  ASSERT_EQ(f->warnings.size(), 1u);
  EXPECT_EQ(plain(f->warnings[0]), "m.vtu: 3 names have control characters, or bytes that are no UTF-8: read as '" +
                                       std::string(kPlain) + "' and the like");
}

TEST_F(Names, OfLatin1AreReadAsUtf8) {
  const auto f = read(make("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\ng Gr\xfc\x6e\nf 1 2 3\n"));
  ASSERT_TRUE(f) << f.error().what();
  EXPECT_EQ(f->names.at(0).name, "Grün");
}

TEST_F(Names, WrittenToAnyFormatHoldNoControlCharacterAndReadBackAsOneName) {
  const auto f = read(make("m.vtu", nasty_vtu()));
  ASSERT_TRUE(f);
  int n = 0;
  for (const Format& format : formats()) {
    if (!format.writes) continue;
    const std::string out = path("out." + std::string(format.name));
    const auto warnings = write(out, *f, {std::string(format.name), Encoding::ascii});
    if (!warnings && warnings.error().code == ErrorCode::unsupported) continue;  // NetCDF that is not there
    ASSERT_TRUE(warnings) << format.name << ": " << warnings.error().what();
    ++n;
    EXPECT_EQ(slurp(out).find("\x1b[2J"), std::string::npos) << format.name;
    const auto back = read(format.name == "triangle" ? out + ".node" : out);
    ASSERT_TRUE(back) << format.name << ": " << back.error().what();
    EXPECT_EQ(back->points.size(), 3u) << format.name;
    EXPECT_LE(back->point_data.size(), 2u) << format.name;  // fort.14 has a depth, too
    for (const DataArray& a : back->field_data) EXPECT_EQ(a.name, kPlain) << format.name;
  }
  EXPECT_GE(n, 12);
}

TEST_F(Names, WithAQuoteDoNotEndTheStringOfGmsh) {
  MeshFile f = sample();
  f.names = {{2, 7, "6\" pipe"}};
  const auto warnings = write(path("m.msh"), f);
  ASSERT_TRUE(warnings) << warnings.error().what();
  EXPECT_NE(slurp(path("m.msh")).find("2 7 \"6%22 pipe\"\n"), std::string::npos);
  ASSERT_EQ(warnings->size(), 1u);
  EXPECT_EQ(plain(warnings->front()),
            "m.msh: the name '6\" pipe' is written as '6%22 pipe': in Gmsh MSH 4.1 it would end early");
}

TEST_F(Names, MadeByHandWithControlCharactersAreRefusedInWriting) {
  for (const Format& format : formats()) {
    if (!format.writes) continue;
    MeshFile f = tamed(rich_sample());
    f.triangles.data[0].name = kNasty;
    const auto written = write(path("m.out"), f, {std::string(format.name), {}});
    ASSERT_FALSE(written) << format.name;
    EXPECT_EQ(plain(written.error().what()), "m.out: the mesh to be written has the name '" + std::string(kPlain) +
                                                 "'; expected one in UTF-8 without control characters");
    EXPECT_TRUE(files().empty()) << format.name;
  }
}

TEST(TakenNamesTest, GiveTheFirstNumberThatIsFree) {
  TakenNames taken;
  std::vector<std::string> got;
  for (const char* name : {"a", "a_2", "a", "a", "b", "a_2", ""}) got.push_back(taken.take(name));
  EXPECT_EQ(got, (std::vector<std::string>{"a", "a_2", "a_3", "a_4", "b", "a_2_2", ""}));
}

}  // namespace
}  // namespace temper::io
