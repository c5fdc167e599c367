// read_number where from_chars reads no real numbers: the same texts, the same bits.
#include "temper/detail/read_number.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <string>

#include "base/rng.hpp"
#include "base/text.hpp"

#ifdef __cpp_lib_to_chars  // else there is no second way

namespace temper {
namespace {

/// Both ways read the text to the same end, with the same verdict and the same bits.
template <class T>
void expect_same(const std::string& text) {
  const char *first = text.data(), *last = first + text.size();
  T expected = 7, found = 7;
  const auto by_library = std::from_chars(first, last, expected);
  const auto by_strtod = read_by_strtod(first, last, found);
  EXPECT_EQ(by_strtod.ec, by_library.ec) << "'" << text << "'";
  EXPECT_EQ(by_strtod.ptr - first, by_library.ptr - first) << "'" << text << "'";
  if (expected == expected) {
    EXPECT_EQ(found, expected) << "'" << text << "'";
  } else {
    EXPECT_NE(found, found) << "'" << text << "'";
  }
}

TEST(ReadNumber, ByStrtodTakesWhatFromCharsTakesAndNothingElse) {
  for (const char* text : {"1",
                           "-1",
                           "1.5",
                           ".5",
                           "-.5",
                           "5.",
                           "1e5",
                           "1E-5",
                           "1e",
                           "1e+",
                           "1.5.3",
                           "1-2",
                           "",
                           "-",
                           ".",
                           "-.",
                           "e5",
                           "+1",
                           "--1",
                           "-+1",
                           " 1",
                           "1 ",
                           "0x10",
                           "1x",
                           "inf",
                           "-inf",
                           "INF",
                           "infinity",
                           "nan",
                           "-nan",
                           "nan(1)",
                           "indeed",
                           "no",
                           "1e400",
                           "-1e400",
                           "1e-400",
                           "0e-400",
                           "-0",
                           "0.0e9",
                           "4.9e-324",
                           "2.2250738585072011e-308",
                           "1.7976931348623157e308",
                           "1,5"}) {
    expect_same<double>(text);
    expect_same<float>(text);
  }
}

TEST(ReadNumber, ByStrtodHasTheBitsOfFromChars) {
  Rng rng(1);
  for (int i = 0; i < 20000; ++i) {
    const double value = std::bit_cast<double>(rng.next());
    expect_same<double>(to_text(value));
    expect_same<double>(to_text(value) + "1");
  }
}

TEST(ReadNumber, ReadsIntegersToo) {
  const std::string text = "-12 ";
  int value = 0;
  EXPECT_EQ(read_number(text.data(), text.data() + text.size(), value).ptr - text.data(), 3);
  EXPECT_EQ(value, -12);
}

}  // namespace
}  // namespace temper

#endif
