// printable: what text from anywhere looks like on a terminal.
#include <gtest/gtest.h>

#include "temper/detail/error.hpp"
#include "temper/detail/utf8.hpp"

namespace temper {
namespace {

TEST(Printable, TextStaysAsItIs) {
  const std::string text = "Straße, 海, \xf0\x9f\x8c\x8a\n\tand 'quotes' \"too\"";
  EXPECT_EQ(printable(text), text);
  EXPECT_EQ(printable(""), "");
}

TEST(Printable, ControlCharactersAreWrittenOut) {
  EXPECT_EQ(printable("\x1b[2J"), "\\x1b[2J");
  EXPECT_EQ(printable(std::string_view("a\0b\r\x7f", 5)), "a\\x00b\\x0d\\x7f");
  EXPECT_EQ(printable("\xc2\x9b"), "\\x9b") << "the one-character form of ESC [";
}

TEST(Printable, BytesThatAreNoUtf8AreLatin1) {
  EXPECT_EQ(printable("Temp\xe9rature"), "Température");
  EXPECT_EQ(printable("\xff\x9b"), "ÿ\\x9b");
  EXPECT_EQ(printable("\xc3"), "Ã") << "cut off";
  EXPECT_EQ(printable("\xc0\xaf"), "À¯") << "longer than it must be";
  EXPECT_EQ(printable("\xed\xa0\x80"), "í\xc2\xa0\\x80") << "half of a pair";
}

TEST(Recoded, BytesThatAreNoUtf8AreLatin1AndTheRestStays) {
  EXPECT_EQ(recoded("Temp\xe9rature, 海\x1b\n"), "Température, 海\x1b\n");
  EXPECT_EQ(recoded("a\x85"), "a\xc2\x85");
  EXPECT_EQ(recoded("海, \xf0\x9f\x8c\x8a\n\x01"), std::nullopt) << "all is UTF-8";
  EXPECT_EQ(recoded(""), std::nullopt);
}

TEST(Printable, TwiceIsTheSameAsOnce) {
  std::string all;
  for (int c = 0; c < 256; ++c) all += {static_cast<char>(c), static_cast<char>(255 - c)};
  EXPECT_EQ(printable(printable(all)), printable(all));
}

}  // namespace
}  // namespace temper
