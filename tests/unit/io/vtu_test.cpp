// VTU in the forms that other programs write, made here by hand: every encoding, header type and byte order.
#include <zlib.h>

#include "io/containers/vtu_codec.hpp"
#include "io/text/failure.hpp"
#include "support.hpp"
#include "support/sanitizers.hpp"
#include "support/std_threads.hpp"
#include "temper/generate.hpp"

namespace temper::io {
namespace {

/// The style in which a test writes its VTU.
struct Style {
  std::string name;
  std::size_t header_bytes = 4;
  bool big_endian = false;
  bool compressed = false;
  enum Place { in_text, appended_raw, appended_base64 } place = in_text;
  bool wide_integers = true;  // Int64 connectivity
  std::size_t block = 16;     // bytes of a compressed block: small, so that there are many
};

std::string base64(std::string_view bytes) {
  constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned bits = 0;
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (k < n ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) result += k <= n ? kAlphabet[bits >> (18 - 6 * k) & 63] : '=';
  }
  return result;
}

class ByHand {
 public:
  explicit ByHand(const Style& style) : style_(style) {}

  template <class T>
  std::string bytes(const std::vector<T>& values) const {
    std::string result;
    for (const T v : values) {
      std::string one(reinterpret_cast<const char*>(&v), sizeof v);
      if (style_.big_endian) std::reverse(one.begin(), one.end());
      result += one;
    }
    return result;
  }
  std::string header(const std::vector<std::uint64_t>& words) const {
    if (style_.header_bytes == 8) return bytes(words);
    return bytes(std::vector<std::uint32_t>(words.begin(), words.end()));
  }
  /// The two pieces that base64 pads on their own; uncompressed they are one.
  std::pair<std::string, std::string> packed(const std::string& data) const {
    if (!style_.compressed) return {header({data.size()}) + data, ""};
    std::vector<std::uint64_t> words = {0, style_.block, data.size() % style_.block};
    std::string blocks;
    for (std::size_t at = 0; at < data.size(); at += style_.block) {
      const std::string_view piece = std::string_view(data).substr(at, style_.block);
      uLongf n = compressBound(piece.size());
      std::string out(n, '\0');
      compress(reinterpret_cast<Bytef*>(out.data()), &n, reinterpret_cast<const Bytef*>(piece.data()), piece.size());
      blocks += out.substr(0, n);
      words.push_back(n);
      ++words[0];
    }
    return {header(words), blocks};
  }
  std::string array(const std::string& type, const std::string& name, int components, const std::string& data) {
    const auto [head, tail] = packed(data);
    const std::string start = "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
                              std::to_string(components) + "\"";
    if (style_.place == Style::in_text)
      return start + " format=\"binary\">\n          " + base64(head) + base64(tail) + "\n        </DataArray>\n";
    const std::string offset = std::to_string(appended_.size());
    appended_ += style_.place == Style::appended_raw ? head + tail : base64(head) + base64(tail);
    return start + " format=\"appended\" offset=\"" + offset + "\"/>\n";
  }
  std::string file() {
    const std::string points = array("Float64", "Points", 3, bytes<double>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}));
    const std::string cells = style_.wide_integers
                                  ? array("Int64", "connectivity", 1, bytes<std::int64_t>({0, 1, 2, 0, 2, 3, 0, 1})) +
                                        array("Int64", "offsets", 1, bytes<std::int64_t>({3, 6, 8}))
                                  : array("Int32", "connectivity", 1, bytes<std::int32_t>({0, 1, 2, 0, 2, 3, 0, 1})) +
                                        array("Int32", "offsets", 1, bytes<std::int32_t>({3, 6, 8}));
    const std::string types = array("UInt8", "types", 1, bytes<std::uint8_t>({5, 5, 3}));
    const std::string weight = array("Float64", "weight", 1, bytes<double>({0.1, -0.0, 1e-300, 7}));
    const std::string t = array("Float32", "t", 1, bytes<float>({0.1f, 2, 3, 4}));
    std::string result = "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"";
    result += style_.big_endian ? "BigEndian" : "LittleEndian";
    result += style_.header_bytes == 8 ? "\" header_type=\"UInt64\"" : "\" header_type=\"UInt32\"";
    if (style_.compressed) result += " compressor=\"vtkZLibDataCompressor\"";
    result +=
        ">\n <UnstructuredGrid>\n  <Piece NumberOfPoints=\"4\" NumberOfCells=\"3\">\n   <PointData Scalars=\"t\">\n" +
        weight + t + "</PointData><CellData/><Points>" + points + "</Points><Cells>" + cells + types +
        "</Cells></Piece></UnstructuredGrid>\n";
    if (style_.place != Style::in_text) {
      result += style_.place == Style::appended_raw ? "<AppendedData encoding=\"raw\">\n _"
                                                    : "<AppendedData encoding=\"base64\">\n _";
      result += appended_ + "\n </AppendedData>\n";
    }
    return result + "</VTKFile>\n";
  }

 private:
  const Style& style_;
  std::string appended_;
};

class VtuStyles : public FileTest, public ::testing::WithParamInterface<Style> {};

TEST_P(VtuStyles, AreReadAlike) {
  const auto f = read(make("m.vtu", ByHand(GetParam()).file()));
  ASSERT_TRUE(f) << f.error().what();
  EXPECT_EQ(f->points, (std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  EXPECT_EQ(f->triangles.corners, (std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(f->lines.corners, (std::vector<std::array<std::int32_t, 2>>{{0, 1}}));
  EXPECT_TRUE(same_bits(f->weights, {0.1, -0.0, 1e-300, 7}));
  ASSERT_EQ(f->point_data.size(), 1u);
  EXPECT_EQ(std::get<std::vector<float>>(f->point_data[0].values), (std::vector<float>{0.1f, 2, 3, 4}));
}

INSTANTIATE_TEST_SUITE_P(Vtu, VtuStyles,
                         ::testing::Values(Style{"plain32"}, Style{"plain64", 8}, Style{"plain64_big_endian", 8, true},
                                           Style{"plain32_narrow", 4, false, false, Style::in_text, false},
                                           Style{"zlib32", 4, false, true}, Style{"zlib64", 8, false, true},
                                           Style{"zlib32_big_endian", 4, true, true},
                                           Style{"zlib_in_one_block", 4, false, true, Style::in_text, true, 32768},
                                           Style{"raw32", 4, false, false, Style::appended_raw},
                                           Style{"raw64", 8, false, false, Style::appended_raw},
                                           Style{"raw64_zlib", 8, false, true, Style::appended_raw},
                                           Style{"raw32_big_endian_zlib", 4, true, true, Style::appended_raw},
                                           Style{"appended_base64", 4, false, false, Style::appended_base64},
                                           Style{"appended_base64_zlib", 8, false, true, Style::appended_base64}),
                         [](const auto& each) { return each.param.name; });

TEST_F(FileTest, VtuErrorsNameTheArrayAndItsLine) {
  const auto message = [&](const std::string& from, const std::string& to) {
    std::string content =
        "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n"
        "<Piece NumberOfPoints=\"3\" NumberOfCells=\"1\">\n<Points>\n<DataArray type=\"Float64\" "
        "NumberOfComponents=\"3\" "
        "format=\"ascii\">\n0 0 0\n1 0 0\n0 1 0\n</DataArray>\n</Points>\n<Cells>\n"
        "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray>\n"
        "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3</DataArray>\n"
        "<DataArray type=\"UInt8\" Name=\"types\" "
        "format=\"ascii\">5</DataArray>\n</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
    const std::size_t at = content.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    content.replace(at, from.size(), to);
    const auto f = read(make("m.vtu", content));
    return plain(f ? "was read" : f.error().what());
  };
  EXPECT_EQ(message("0 1 0", "0 1 0"), "was read");
  EXPECT_EQ(message("Int32\" Name=\"offsets\" format=\"ascii\">3", "Int64\" Name=\"offsets\" format=\"ascii\">3"),
            "was read");
  EXPECT_EQ(
      message("Int32\" Name=\"offsets\" format=\"ascii\">3", "Int64\" Name=\"offsets\" format=\"ascii\">4294967299"),
      "m.vtu: element 0 ends at 4294967299 of 3 connectivity values, and starts at 0");
  EXPECT_EQ(message("0 1 2<", "0 1 3<"),
            "m.vtu: triangle 0 uses vertex 3, but the file has 3 vertices, numbered from 0");
  EXPECT_EQ(message("1 0 0", "1 o 0"), "m.vtu:7: expected a number of array '', found 'o'");
  EXPECT_EQ(message("0 1 0", "0 1"), "m.vtu:5: array '' has 8 values, not a multiple of its 3 components");
  EXPECT_EQ(message("0 1 0", "0 1 2"), "was read") << "a surface";
  EXPECT_EQ(message(">5<", ">10<"), "m.vtu: element 0 is a tetrahedron with 3 vertices");
  EXPECT_EQ(message(">5<", ">13<"),
            "m.vtu: element 0 is a wedge; temper reads linear triangles, quadrilaterals and tetrahedra, with lines and "
            "points as tags. Next: split it into tetrahedra, as triangulate() of PyVista does");
  EXPECT_EQ(message("offsets\" format=\"ascii\">3", "offsets\" format=\"ascii\">7"),
            "m.vtu: element 0 ends at 7 of 3 connectivity values, and starts at 0");
  EXPECT_EQ(message("\"offsets\"", "\"ofsets\""), "m.vtu: the array 'offsets' of the cells is missing");
  EXPECT_EQ(message("\"LittleEndian\"", "\"LittleEndian\" compressor=\"vtkLZ4DataCompressor\""),
            "m.vtu: is compressed with 'vtkLZ4DataCompressor'; temper reads vtkZLibDataCompressor. Next: write it with "
            "that, or without compression");
  EXPECT_EQ(message("NumberOfCells=\"1\"", "NumberOfCells=\"2\""),
            "m.vtu:11: has 1 offsets and 1 types, expected 2 of each");
}

/// A grid of several compressed blocks an array; its points are moved by a pseudorandom bit of a cell when asked for.
MeshFile many_blocks(bool random) {
  constexpr int kSide = 180;
  MeshFile f;
  std::uint32_t state = 1;
  const auto jitter = [&] {
    state = 1664525 * state + 1013904223;
    return random ? 0.3 * state / 4294967296.0 : 0.0;
  };
  for (int j = 0; j <= kSide; ++j) {
    for (int i = 0; i <= kSide; ++i) {
      f.points.push_back({i + jitter(), j + jitter()});
      if (random) f.weights.push_back(jitter());
    }
  }
  for (std::int32_t j = 0; j < kSide; ++j) {
    for (std::int32_t i = 0; i < kSide; ++i) {
      const std::int32_t a = j * (kSide + 1) + i, b = a + kSide + 1;
      f.triangles.corners.push_back({a, a + 1, b + 1});
      f.triangles.corners.push_back({a, b + 1, b});
      f.triangles.tags.insert(f.triangles.tags.end(), 2, i / 50);
    }
  }
  return f;
}

TEST_F(FileTest, VtuIsTheSameForAnyNumberOfThreads) {
  for (const bool random : {false, true}) {
    const MeshFile file = many_blocks(random);
    const auto expected = make_mesh(file);
    ASSERT_TRUE(expected) << expected.error().what();
    EXPECT_EQ(expected->mesh.validate(), std::nullopt);
    for (const Encoding encoding : {Encoding::base64, Encoding::appended}) {
      ASSERT_TRUE(write(path("alone.vtu"), file, {"", encoding}));
      const std::string alone = slurp(path("alone.vtu"));
      for (const std::size_t threads : {1u, 2u, 3u, 8u}) {
        if (TEMPER_SANITIZED && threads != 3) continue;
        test::StdThreads executor(threads);
        ASSERT_TRUE(write(path("threads.vtu"), file, {"", encoding, &executor}));
        EXPECT_GT(executor.runs(), 0u);
        EXPECT_TRUE(slurp(path("threads.vtu")) == alone) << threads;
        const auto back = read(path("threads.vtu"), {&executor});
        ASSERT_TRUE(back) << back.error().what();
        expect_same_mesh(*back, file);
        const auto made = make_mesh(*back, {}, &executor);
        ASSERT_TRUE(made) << made.error().what();
        EXPECT_EQ(made->mesh, expected->mesh);
      }
    }
  }
}

TEST_F(FileTest, VtuOfAGridStaysSmall) {
  // Runs of bytes are all that is looked for in coordinates, unless strings of them pay.
  ASSERT_TRUE(write(path("grid.vtu"), many_blocks(false), {"", Encoding::base64}));
  ASSERT_TRUE(write(path("raw.vtu"), many_blocks(false), {"", Encoding::appended}));
  EXPECT_LT(4 * std::filesystem::file_size(path("grid.vtu")), std::filesystem::file_size(path("raw.vtu")));
}

TEST_F(FileTest, VtuDamagedBlocksAreNamedWhoeverUnpacksThem) {
  ASSERT_TRUE(write(path("m.vtu"), many_blocks(true), {"", Encoding::base64}));
  std::string bytes = slurp(path("m.vtu"));
  const std::size_t points = bytes.find("Name=\"Points\""), end = bytes.find("</DataArray>", points);
  bytes.replace(end - 4000, 8, "AAAAAAAA");  // in the last block
  bytes.replace(end - 400, 8, "AAAAAAAA");
  spill(path("m.vtu"), bytes);
  for (const std::size_t threads : {0u, 1u, 3u, 8u}) {
    test::StdThreads executor(threads);
    const auto f = read(path("m.vtu"), {threads > 0 ? &executor : nullptr});
    ASSERT_FALSE(f);
    EXPECT_EQ(plain(f.error().what()), "m.vtu: array 'Points': block 2 of the compressed data is damaged");
  }
}

TEST_F(FileTest, VtuAppendedDataThatAreCutOrPointNowhereAreNamed) {
  ASSERT_TRUE(write(path("m.vtu"), sample(), {"", Encoding::appended}));
  const std::string whole = slurp(path("m.vtu"));
  const std::size_t data = whole.find('_', whole.find("<AppendedData")) + 1;
  const auto message = [&](std::string_view bytes) {
    const auto f = read(make("cut.vtu", bytes));
    return f ? std::string("was read") : plain(f.error().what());
  };
  EXPECT_EQ(message(whole), "was read");
  EXPECT_EQ(message(whole.substr(0, data + 100)),
            "cut.vtu: array 'connectivity': starts at byte 152 of the appended data, which have only 100");
  EXPECT_EQ(message(whole.substr(0, data + 157)), "cut.vtu: array 'connectivity': the data end within their header");
  EXPECT_EQ(message(whole.substr(0, data + 200)),
            "cut.vtu: array 'connectivity': announces 80 bytes, but only 40 follow");
  EXPECT_EQ(message(whole.substr(0, data - 1)), "cut.vtu: the appended data are missing");
  std::string longer = whole;
  longer[data + 3] = 1;  // sixteen million bytes of points
  EXPECT_EQ(message(longer).substr(0, 57), "cut.vtu: array 'Points': announces 16777360 bytes, but on");
  std::string beyond = whole;
  const std::size_t offset = whole.find("offset=\"152\"");
  ASSERT_NE(offset, std::string::npos);
  beyond.replace(offset, 12, "offset=\"99999\"");
  EXPECT_EQ(message(beyond).substr(0, 60), "cut.vtu: array 'connectivity': starts at byte 99999 of the a");
}

/// n blocks of 2⁴⁰ bytes and a last one: (n − 1) · 2⁴⁰ + 72 is 72 in 64 bits, where n − 1 is 2²⁴.
TEST(Vtu, RefusesBlocksWhoseSizesWrapAround) {
  const std::uint64_t n = (1U << 24) + 1;
  std::vector<std::uint64_t> words(3 + n, 0);
  words[0] = n, words[1] = std::uint64_t{1} << 40, words[2] = 72;
  const std::string_view packed(reinterpret_cast<const char*>(words.data()), 8 * words.size());
  AllocationLimits allocation(packed.size());
  try {
    static_cast<void>(unpack(packed, Scalar::f64, {"m.vtu: array 'Points'", 8, true, false}, allocation, nullptr));
    FAIL() << "was read";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.error.code, ErrorCode::syntax);
  }
}

TEST_F(FileTest, VtuThatCannotBeWrittenLeavesWhatWasThere) {
  make("m.vtu", "precious");
  MeshFile file = many_blocks(true);
  file.weights.pop_back();
  test::StdThreads executor(3);
  for (const Encoding encoding : {Encoding::base64, Encoding::appended}) {
    EXPECT_FALSE(write(path("m.vtu"), file, {"", encoding, &executor}));
    EXPECT_EQ(slurp(path("m.vtu")), "precious");
    EXPECT_EQ(files(), std::vector<std::string>{"m.vtu"});
  }
}

using VtuPeriod = FileTest;

TEST_F(VtuPeriod, PeriodAndPointsComeBackBitForBit) {
  MeshFile f = from_mesh(*random_periodic({.vertices = 400, .period = {0.7, 3.1}}));
  f.points[5].x -= f.periodic()->period.x;
  for (const Encoding encoding : {Encoding::ascii, Encoding::base64, Encoding::appended}) {
    const auto warnings = write(path("a.vtu"), f, {.format = "vtu", .encoding = encoding});
    ASSERT_TRUE(warnings) << warnings.error().what();
    EXPECT_TRUE(warnings->empty());
    const auto back = read(path("a.vtu"));
    ASSERT_TRUE(back) << back.error().what();
    EXPECT_EQ(back->periodic()->period, f.periodic()->period);
    EXPECT_EQ(back->points, f.points);
    EXPECT_TRUE(back->field_data.empty());
  }
  std::string text = slurp(path("a.vtu"));
  EXPECT_NE(text.find("plane_period"), std::string::npos);
  ASSERT_TRUE(write(path("b.vtu"), f, {.format = "vtu", .encoding = Encoding::ascii}));
  text = slurp(path("b.vtu"));
  text.replace(text.find("0.", text.find("plane_period")), 2, "-1");
  make("b.vtu", text);
  const auto bad = read(path("b.vtu"));
  ASSERT_FALSE(bad);
  EXPECT_NE(bad.error().message.find("field data 'plane_period' is not two lengths"), std::string::npos)
      << bad.error().message;
}

}  // namespace
}  // namespace temper::io
