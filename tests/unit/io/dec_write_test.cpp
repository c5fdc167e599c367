// Operators as files: all of them or none, the same bytes every time, archives that are what zip says.
// (tests/interop/test_dec.py reads the numbers back by NumPy, SciPy and meshio.)
#include <zlib.h>

#include <map>

#include "io/containers/zip_writer.hpp"
#include "support.hpp"
#include "support/std_threads.hpp"
#include "support/tet_lattice.hpp"
#include "temper/detail/dec_io.hpp"

namespace temper::io {
namespace {

constexpr DecFormat kAllFormats[] = {DecFormat::npz, DecFormat::mtx, DecFormat::vtu};

/// A square cut in two: the dual edge between has length zero.
struct Operators {
  Mesh mesh;
  DecComplex complex;
  PowerCells cells;
  Operators() {
    const std::vector<Vec2> points = {{0, 0}, {0.1, 0}, {0.1, 0.1}, {0, 0.1}};
    const std::vector<std::array<std::int32_t, 3>> triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh = (*Mesh::build({.points = points, .triangles = triangles})).mesh;
    complex = dec_operators(mesh);
    cells = power_cells(mesh, complex);
  }
  [[nodiscard]] Expected<std::vector<std::string>> write(const std::string& folder,
                                                         const DecWriteOptions& options = {}) const {
    return write_dec(folder, mesh, complex, cells, options);
  }
};

std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::uint64_t number_at(std::string_view bytes, std::size_t at, int n) {
  std::uint64_t value = 0;
  for (int i = n; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(i)]);
  return value;
}

/// The entries of a stored archive, found from its end as readers do; every checksum and repeated number compared.
std::map<std::string, std::string> unzip(std::string_view zip) {
  std::map<std::string, std::string> entries;
  const std::size_t end = zip.size() - 22;
  EXPECT_EQ(number_at(zip, end, 4), 0x06054b50u);
  std::uint64_t n = number_at(zip, end + 10, 2), at = number_at(zip, end + 16, 4);
  if (end >= 20 && number_at(zip, end - 20, 4) == 0x07064b50u) {
    const std::uint64_t large = number_at(zip, end - 12, 8);
    EXPECT_EQ(number_at(zip, large, 4), 0x06064b50u);
    n = number_at(zip, large + 32, 8), at = number_at(zip, large + 48, 8);
  }
  for (std::uint64_t i = 0; i < n; ++i) {
    EXPECT_EQ(number_at(zip, at, 4), 0x02014b50u);
    const std::uint64_t crc = number_at(zip, at + 16, 4), length = number_at(zip, at + 28, 2);
    const std::uint64_t extra = number_at(zip, at + 30, 2);
    std::uint64_t size = number_at(zip, at + 24, 4), offset = number_at(zip, at + 42, 4);
    std::size_t next = at + 46 + length + 4;  // the first number of the extra field
    if (size == 0xffffffffu) size = number_at(zip, next, 8), next += 16;
    if (offset == 0xffffffffu) offset = number_at(zip, next, 8);
    const std::string name(zip.substr(at + 46, length));
    EXPECT_EQ(number_at(zip, offset, 4), 0x04034b50u);
    EXPECT_EQ(number_at(zip, offset + 14, 4), crc);
    EXPECT_EQ(zip.substr(offset + 30, length), name);
    const std::string_view content = zip.substr(offset + 30 + length + number_at(zip, offset + 28, 2), size);
    EXPECT_EQ(crc32_z(0, reinterpret_cast<const unsigned char*>(content.data()), content.size()), crc);
    entries[name] = std::string(content);
    at += 46 + length + extra;
  }
  return entries;
}

class DecFiles : public FileTest {};

TEST_F(DecFiles, EveryFormatMakesTheFilesItNamesAndNoOther) {
  const Operators operators;
  for (const DecFormat format : kAllFormats) {
    const std::string folder = path("out" + std::to_string(static_cast<int>(format)));
    const auto written = operators.write(folder, {{format}, {}, 0, nullptr});
    ASSERT_TRUE(written);
    std::vector<std::string> expected(dec_file_names(format).begin(), dec_file_names(format).end());
    ASSERT_EQ(written->size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ((*written)[i], folder + "/" + expected[i]);
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(names_in(folder), expected);
  }
}

TEST_F(DecFiles, TetrahedraHaveTheirFiles) {
  const tets::TetMesh mesh = test::mesh_of(test::body_centered(2));
  const tets::DecComplex complex = tets::dec_operators(mesh);
  for (const DecFormat format : {DecFormat::npz, DecFormat::mtx, DecFormat::vtu, DecFormat::tough, DecFormat::uge}) {
    const std::string folder = path("tets" + std::to_string(static_cast<int>(format)));
    ASSERT_TRUE(write_dec(folder, mesh, complex, {.formats = {format}}));
    const auto names = dec_file_names(format, DecKind::tetrahedra);
    std::vector<std::string> expected(names.begin(), names.end());
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(names_in(folder), expected);
  }
  const auto refused = write_dec(path("none"), mesh, complex, {.formats = {DecFormat::disv}});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::invalid_option);
  EXPECT_EQ(refused.error().message, "formats disv and disu are for triangles with layers");
}

TEST_F(DecFiles, CellsOfTetrahedraFillTheMeshAndLieOnBothSidesOfTheirFaces) {
  const tets::TetMesh mesh = test::mesh_of(test::body_centered(2));
  const tets::DecComplex complex = tets::dec_operators(mesh);
  ASSERT_TRUE(write_dec(path("t"), mesh, complex, {.formats = {DecFormat::tough, DecFormat::uge}}));
  std::istringstream uge(slurp(path("t/mesh.uge")));
  std::string word;
  std::size_t n = 0, m = 0;
  uge >> word >> n;
  ASSERT_EQ(n, mesh.n_vertices());
  double volume = 0;
  for (std::size_t i = 0; i < n; ++i) {
    double x = 0, y = 0, z = 0, cell = 0;
    uge >> word >> x >> y >> z >> cell;
    EXPECT_EQ((Vec3{x, y, z}), mesh.position(VertexId(i)));
    volume += cell;
  }
  double whole = 0;
  for (const double tet : complex.volumes) whole += tet;
  EXPECT_NEAR(volume, whole, 1e-12 * whole);
  uge >> word >> m;
  EXPECT_GT(m, n);
  for (std::size_t i = 0; i < m; ++i) {
    std::size_t a = 0, b = 0;
    Vec3 face;
    double area = 0;
    uge >> a >> b >> face.x >> face.y >> face.z >> area;
    const Vec3 from = mesh.position(VertexId(a - 1)), to = mesh.position(VertexId(b - 1));
    EXPECT_NEAR(length(face - from) + length(to - face), length(to - from), 1e-12);
    EXPECT_GT(area, 0);
  }
  EXPECT_TRUE(uge.good());
  const std::string tough = slurp(path("t/MESH"));
  EXPECT_EQ(static_cast<std::size_t>(std::count(tough.begin(), tough.end(), '\n')), 1 + n + 1 + 1 + m + 1);
}

TEST_F(DecFiles, TheSameBytesComeAgainAndForAnyNumberOfThreads) {
  const Operators operators;
  test::StdThreads threads(3);
  DecWriteOptions options;
  ASSERT_TRUE(operators.write(path("a"), options));
  options.executor = &threads;
  ASSERT_TRUE(operators.write(path("b"), options));
  EXPECT_GT(threads.runs(), 0u);
  ASSERT_EQ(names_in(path("a")).size(), 16u);
  for (const std::string& name : names_in(path("a")))
    EXPECT_EQ(slurp(path("a/" + name)), slurp(path("b/" + name))) << name;
}

TEST_F(DecFiles, ArchivesHoldArraysWhoseNumbersStartAtAMultipleOf64Bytes) {
  const Operators operators;
  ASSERT_TRUE(operators.write(path("a")));
  const auto entries = unzip(slurp(path("a/operators.npz")));
  EXPECT_GT(entries.size(), 25u);
  for (const auto& [name, content] : entries) {
    EXPECT_EQ(content.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8)) << name;
    EXPECT_EQ((10 + number_at(content, 8, 2)) % 64, 0u) << name;
  }
  const std::string& star1 = entries.at("star1.npy");
  EXPECT_NE(star1.find("'shape': (5, )"), std::string::npos);
  double value = -1;
  std::memcpy(&value, star1.data() + star1.size() - 4 * sizeof value, sizeof value);
  EXPECT_EQ(value, operators.complex.star1[EdgeId(1)]);
  EXPECT_NE(entries.at("edges.npy").find("'shape': (5, 2)"), std::string::npos);
}

TEST_F(DecFiles, LargeArchivesUseTheFieldsOfZip64) {
  const std::string content = "twenty bytes of text";
  for (const std::uint64_t limit : {std::uint64_t{10}, std::uint64_t{30}, std::uint64_t{0xffffffffu}}) {
    {
      OutputSet outputs;
      ZipWriter zip(outputs.open(path("a.zip")), limit);
      zip.add("first", {content.substr(0, 6), content.substr(6)});
      zip.add("second", {"x"});
      zip.finish();
      outputs.commit();
    }
    const std::string bytes = slurp(path("a.zip"));
    const auto entries = unzip(bytes);
    ASSERT_EQ(entries.size(), 2u) << limit;
    EXPECT_EQ(entries.at("first"), content);
    EXPECT_EQ(entries.at("second"), "x");
    EXPECT_EQ(bytes.find(std::string("PK\x06\x06", 4)) != std::string::npos, limit < 100);
  }
}

TEST_F(DecFiles, MatrixMarketHoldsZerosAndWhatIsInfinite) {
  const Operators operators;
  ASSERT_TRUE(operators.write(path("a"), {{DecFormat::mtx}, {}, 0, nullptr}));
  EXPECT_EQ(slurp(path("a/d0.mtx")).substr(0, 55), "%%MatrixMarket matrix coordinate real general\n% edges x");
  EXPECT_NE(slurp(path("a/star1.mtx")).find("\n5 5 5\n1 1 0.5\n2 2 0\n3 3 0.5\n"), std::string::npos)
      << slurp(path("a/star1.mtx"));
  EXPECT_NE(slurp(path("a/transmissibility.mtx")).find("\n2 2 inf\n"), std::string::npos);
}

TEST_F(DecFiles, OnAnErrorNothingHasChanged) {
  const Operators operators;
  make("file", "not a folder");
  const auto file = operators.write(path("file"));
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().code, ErrorCode::not_writable);
  EXPECT_EQ(file.error().what(), path("file") + ": is not a folder; expected a folder, or a new name");
  const auto nowhere = operators.write(path("no/such"));
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(nowhere.error().what(), path("no/such") + ": cannot be made: No such file or directory");
  // The last file of all cannot be written: none is, not even into a folder that was made for them.
  std::filesystem::create_directories(path("old/dual_edges.vtu"));
  spill(path("old/d0.npz"), "as it was");
  const auto last = operators.write(path("old"));
  ASSERT_FALSE(last);
  EXPECT_EQ(last.error().code, ErrorCode::not_writable);
  EXPECT_EQ(names_in(path("old")), (std::vector<std::string>{"d0.npz", "dual_edges.vtu"}));
  EXPECT_EQ(slurp(path("old/d0.npz")), "as it was");
  EXPECT_EQ(files(), (std::vector<std::string>{"file", "old"}));
}

}  // namespace
}  // namespace temper::io
