// The paper's symbols in HTML.
#include "gallery/prose.hpp"

#include <gtest/gtest.h>

namespace temper::gallery {
namespace {

TEST(Prose, CharactersOfHtmlAreEscapedEverywhere) {
  EXPECT_EQ(escaped("a < b & \"c\" > d"), "a &lt; b &amp; &quot;c&quot; &gt; d");
  EXPECT_EQ(prose("h_k < 0 & d > \"1\""), "<i>h</i><sub>k</sub> &lt; 0 &amp; d &gt; &quot;1&quot;");
}

TEST(Prose, OneLetterBeforeTheUnderscoreIsASymbol) {
  EXPECT_EQ(prose("d_ij"), "<i>d</i><sub>ij</sub>");
  EXPECT_EQ(prose("E_BHs, E_∂T."), "<i>E</i><sub>BHs</sub>, <i>E</i><sub>∂T</sub>.");
  EXPECT_EQ(prose("(i_w = 2)"), "(<i>i</i><sub>w</sub> = 2)");
}

TEST(Prose, TheStarOfAnEnergyIsRaised) {
  EXPECT_EQ(prose("E_F1"), "<i>E</i><sub>F</sub><sup>1</sup>");
  EXPECT_EQ(prose("E_F^2"), "<i>E</i><sub>F</sub><sup>2</sup>");
  EXPECT_EQ(prose("E_∂T¹"), "<i>E</i><sub>∂T</sub>¹");
  EXPECT_EQ(prose("p_4"), "<i>p</i><sub>4</sub>");
}

TEST(Prose, NamesWithUnderscoresStayAsTheyAre) {
  for (const char* name : {"min_h_over_l", "fig_06", "h_over_l", "a_", "_b", "x_abcd", "E_"})
    EXPECT_EQ(prose(name), name);
}

TEST(Prose, TextWithoutSymbolsIsUnchanged) {
  for (const char* text : {"", "plain", "★1 of 10⁻³ → −∞", "∂", "E"}) EXPECT_EQ(prose(text), text);
}

}  // namespace
}  // namespace temper::gallery
