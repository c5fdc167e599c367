// The HTML report: its arrays decode to the mesh, bit for bit, and nothing that users write can end an element.
#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "temper/detail/geometry.hpp"
#include "temper/detail/html.hpp"
#include "temper/generate.hpp"
#include "temper/quality.hpp"

namespace temper::io {
namespace {

/// The text between two others, the first after `from`.
std::string between(const std::string& text, const std::string& begin, const std::string& end, std::size_t from = 0) {
  const std::size_t at = text.find(begin, from);
  if (at == std::string::npos) return {};
  const std::size_t start = at + begin.size();
  return text.substr(start, text.find(end, start) - start);
}

std::string decoded(const std::string& base64) {
  const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int n = 0;
  for (const char c : base64) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(alphabet.find(c));
    n += 6;
    if (n < 8) continue;
    n -= 8;
    bytes += static_cast<char>(bits >> n & 0xff);
  }
  return bytes;
}

/// The numbers of an element, as the page reads them; none: there is no such element.
template <class T>
std::vector<T> array_of(const std::string& html, const std::string& id) {
  const std::size_t at = html.find("id=\"" + id + "\"");
  if (at == std::string::npos) return {};
  const std::size_t length = std::stoul(between(html, "data-length=\"", "\"", at));
  const std::size_t delta = std::stoul(between(html, "data-delta=\"", "\"", at));
  const std::string packed = decoded(between(html, ">", "<", at));
  std::vector<unsigned char> planes(length * sizeof(T));
  uLongf size = planes.size();
  EXPECT_EQ(uncompress(planes.data(), &size, reinterpret_cast<const Bytef*>(packed.data()), packed.size()), Z_OK);
  EXPECT_EQ(size, planes.size());
  std::vector<T> values(length);
  for (std::size_t i = 0; i < length; ++i) {
    std::uint64_t bits = 0;
    for (std::size_t b = 0; b < sizeof(T); ++b) bits |= std::uint64_t{planes[b * length + i]} << (8 * b);
    if constexpr (std::is_same_v<T, double>) {
      std::memcpy(&values[i], &bits, sizeof bits);
    } else {
      values[i] = static_cast<T>(bits);
      if (delta == 0) continue;
      const auto zigzag = static_cast<std::uint32_t>(bits);
      values[i] = static_cast<T>(zigzag >> 1 ^ (0 - (zigzag & 1)));
      if (i >= delta) values[i] = static_cast<T>(values[i] + values[i - delta]);
    }
  }
  return values;
}

Mesh weighted_mesh() {
  Mesh mesh = *annulus();
  for (const VertexId v : mesh.vertices()) mesh.set_weight(v, 1e-3 * static_cast<double>(v.index % 7) / 3);
  return mesh;
}

void expect_mesh(const std::string& html, const std::string& side, const Mesh& mesh) {
  const auto points = array_of<double>(html, side + ".points"), weights = array_of<double>(html, side + ".weights");
  const auto corners = array_of<std::int32_t>(html, side + ".triangles");
  const auto verdicts = array_of<std::uint8_t>(html, side + ".verdicts");
  ASSERT_EQ(points.size(), 2 * mesh.n_vertices());
  ASSERT_EQ(corners.size(), 3 * mesh.n_triangles());
  ASSERT_EQ(verdicts.size(), mesh.n_triangles());
  for (const VertexId v : mesh.vertices()) {
    EXPECT_EQ(points[2 * v.index], mesh.position(v).x);
    EXPECT_EQ(points[2 * v.index + 1], mesh.position(v).y);
    EXPECT_EQ(weights.empty() ? 0 : weights[v.index], mesh.weight(v));
  }
  for (const TriangleId t : mesh.triangles()) {
    const auto c = mesh.corners(t);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(corners[3 * t.index + k], static_cast<std::int32_t>(c[k].index));
    const bool good = is_well_centered(mesh.point(c[0]), mesh.point(c[1]), mesh.point(c[2]));
    EXPECT_EQ(verdicts[t.index] == 0, good) << "triangle " << t.index;
  }
}

TEST(HtmlReport, ArraysAreTheMeshesBitForBit) {
  const Mesh mesh = weighted_mesh(), before = *annulus();
  const std::string html = html_report({HtmlMesh{mesh}, HtmlMesh{before}, "ring"});
  expect_mesh(html, "after", mesh);
  expect_mesh(html, "before", before);
  EXPECT_TRUE(array_of<double>(html, "before.weights").empty());
}

TEST(HtmlReport, IsTheSameBytesEachTime) {
  const Mesh mesh = weighted_mesh();
  EXPECT_EQ(html_report({HtmlMesh{mesh}, {}, "ring"}), html_report({HtmlMesh{mesh}, {}, "ring"}));
}

TEST(HtmlReport, HasTheNumbersOfTheUser) {
  struct FromTen : InputNames {
    [[nodiscard]] std::string point(std::size_t i) const override { return "node " + std::to_string(10 + 3 * i); }
  };
  const Mesh mesh = weighted_mesh();
  const FromTen names;
  const std::string html = html_report({HtmlMesh{mesh, &names}, {}, "ring"});
  const auto numbers = array_of<std::int32_t>(html, "after.vertex_numbers");
  ASSERT_EQ(numbers.size(), mesh.n_vertices());
  for (std::size_t i = 0; i < numbers.size(); ++i) EXPECT_EQ(numbers[i], static_cast<std::int32_t>(10 + 3 * i));
  EXPECT_TRUE(array_of<std::int32_t>(html, "after.triangle_numbers").empty()) << "they count from 0";
}

TEST(HtmlReport, TextsEndNoElement) {
  const Mesh mesh = weighted_mesh();
  const std::string html = html_report({HtmlMesh{mesh}, {}, "</title><script>", R"({"notes": ["</script>"]})"});
  EXPECT_EQ(between(html, "<title>", "</title>"), "&lt;/title>&lt;script>");
  EXPECT_EQ(between(html, "id=\"report\">", "</script>"), R"({"notes": ["\u003c/script>"]})");
}

TEST(HtmlReport, NamesEachMeasure) {
  const Mesh mesh = weighted_mesh();
  const std::string html = html_report({HtmlMesh{mesh}, {}, "ring"});
  const std::string table = between(html, "id=\"measures\">", "</script>");
  for (const QualityMeasure& measure : quality_measures()) {
    EXPECT_NE(table.find("{\"key\":\"" + std::string(measure.key) + "\""), std::string::npos) << measure.key;
    for (const std::string_view word : {measure.key, measure.label, measure.community, measure.definition}) {
      EXPECT_EQ(word.find_first_of("\"\\\n"), std::string_view::npos) << word << ": JSON escapes these";
    }
  }
}

TEST(HtmlReport, AsksForNothingOnTheNetwork) {
  const Mesh mesh = weighted_mesh();
  const std::string html = html_report({HtmlMesh{mesh}, {}, "ring"});
  const std::string page = html.substr(html.find("-->"));  // after the licences, which have addresses
  for (const char* word : {"src=\"http", "href=\"http", "url(http", "@import"}) {
    EXPECT_EQ(page.find(word), std::string::npos) << word;
  }
}

}  // namespace
}  // namespace temper::io
