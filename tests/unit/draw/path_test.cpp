// Path text against a reader of its own: what is written in few bytes says what was meant. And XML text.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "draw/text.hpp"
#include "draw/viewport.hpp"
#include "unit/draw/svg_reading.hpp"

namespace temper {
namespace {

using test::Read;
using test::read_path;

TEST(PathText, SegmentsReadBackEachOnceInEitherDirection) {
  const std::vector<std::pair<GridPoint, GridPoint>> segments = {
      {{0, 0}, {10, 5}}, {{10, 5}, {-3, -7}}, {{8, 8}, {-3, -7}}, {{100, 0}, {100, 1}}, {{0, 0}, {0, 1}}};
  PathText path;
  for (const auto& [a, b] : segments) path.segment(a, b);
  const Read back = read_path(path.text());
  ASSERT_EQ(back.segments.size(), segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const auto& [a, b] = segments[i];
    const auto& [c, d] = back.segments[i];
    EXPECT_TRUE((a == c && b == d) || (a == d && b == c)) << "segment " << i << " of " << path.text();
  }
}

TEST(PathText, ConnectedSegmentsTakeOneMove) {
  PathText path;
  path.segment({1, 2}, {4, 6});
  path.segment({4, 6}, {3, 4});
  path.segment({-5, 4}, {3, 4});
  EXPECT_EQ(path.text(), "m1 2l3 4-1-2-8 0");
}

TEST(PathText, ASegmentWithoutLengthIsNotWritten) {
  PathText path;
  path.segment({3, 3}, {3, 3});
  path.circle({3, 3}, 0);
  EXPECT_TRUE(path.empty());
}

TEST(PathText, CirclesAndPolygonsReadBack) {
  PathText path;
  path.circle({10, -4}, 7);
  path.move_to({1, 1});
  path.line_to({5, 1});
  path.line_to({5, 4});
  path.close();
  path.circle({-1, 0}, 2);
  const Read back = read_path(path.text());
  ASSERT_EQ(back.circles.size(), 2u);
  EXPECT_EQ(back.circles[0].first, (GridPoint{10, -4}));
  EXPECT_EQ(back.circles[0].second, 7);
  EXPECT_EQ(back.circles[1].first, (GridPoint{-1, 0}));
  ASSERT_EQ(back.segments.size(), 3u);
  EXPECT_EQ(back.segments[2].second, (GridPoint{1, 1}));
}

TEST(XmlText, MarkupIsEscapedAndControlsAreDropped) {
  EXPECT_EQ(xml_text("a < b & c > \"d\""), "a &lt; b &amp; c &gt; \"d\"");
  EXPECT_EQ(xml_text(std::string("x\x01\x1b[31m\ny\0z", 12)), "x[31m yz");
  EXPECT_EQ(xml_text("ℓ ≥ 0, 🙂"), "ℓ ≥ 0, 🙂");
}

TEST(XmlText, BytesThatAreNotUtf8AreReplaced) {
  const std::string replaced = "\xef\xbf\xbd";
  EXPECT_EQ(xml_text("a\xff"
                     "b"),
            "a" + replaced + "b");
  EXPECT_EQ(xml_text("caf\xe9"), "caf" + replaced) << "Latin-1, cut short at the end";
  EXPECT_EQ(xml_text("\xc0\xaf"), replaced + replaced) << "overlong";
  EXPECT_EQ(xml_text("\xed\xa0\x80"), replaced + replaced + replaced) << "a surrogate";
  EXPECT_EQ(xml_text("\xef\xbf\xbf"), replaced + replaced + replaced) << "U+FFFF is no character of XML";
}

TEST(ShortNumber, HasThreeDigitsAtMostAndNoTrailingZeros) {
  EXPECT_EQ(short_number(0), "0");
  EXPECT_EQ(short_number(-0.0001), "0");
  EXPECT_EQ(short_number(100), "100");
  EXPECT_EQ(short_number(0.1), "0.1");
  EXPECT_EQ(short_number(-2.5), "-2.5");
  EXPECT_EQ(short_number(1.0 / 3), "0.333");
  EXPECT_EQ(short_number(1e21).find('e'), std::string::npos);
}

}  // namespace
}  // namespace temper
