// Expected and InputError.
#include "temper/detail/error.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <string>

namespace temper {
namespace {

TEST(Expected, HoldsAValue) {
  Expected<std::string> result(std::string("seven"));
  ASSERT_TRUE(result.has_value());
  EXPECT_TRUE(static_cast<bool>(result));
  EXPECT_EQ(*result, "seven");
  EXPECT_EQ(result->size(), 5u);
  *result += "!";
  const Expected<std::string> copy = result;
  EXPECT_EQ(*copy, "seven!");
  EXPECT_EQ(copy->back(), '!');
}

TEST(Expected, HoldsAnError) {
  const Expected<std::string> result(InputError{ErrorCode::syntax, "a.mesh:3", "expected a number, found 'x'"});
  EXPECT_FALSE(result.has_value());
  EXPECT_FALSE(static_cast<bool>(result));
  EXPECT_EQ(result.error().code, ErrorCode::syntax);
  EXPECT_EQ(result.error().what(), "a.mesh:3: expected a number, found 'x'");
}

TEST(Expected, GivesAwayItsValue) {
  Expected<std::unique_ptr<int>> result(std::make_unique<int>(7));
  const std::unique_ptr<int> taken = *std::move(result);
  EXPECT_EQ(*taken, 7);
}

TEST(Expected, HoldsAZero) {
  const Expected<int> zero(0);
  EXPECT_TRUE(zero.has_value());
  EXPECT_EQ(*zero, 0);
}

TEST(ExpectedOfNothing, IsSuccessUnlessGivenAnError) {
  const Expected<void> success;
  EXPECT_TRUE(success.has_value());
  const Expected<void> failure(InputError{ErrorCode::not_writable, {}, "disk full"});
  EXPECT_FALSE(static_cast<bool>(failure));
  EXPECT_EQ(failure.error().what(), "disk full");
}

TEST(ErrorCode, HasItsOwnName) {
  std::set<std::string_view> names;
  constexpr int kCodes = static_cast<int>(ErrorCode::not_writable) + 1;
  for (int code = 0; code < kCodes; ++code) {
    const std::string_view text = name(static_cast<ErrorCode>(code));
    EXPECT_NE(text, "unknown") << code;
    names.insert(text);
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(kCodes));
  EXPECT_EQ(name(ErrorCode::duplicate_point), "duplicate_point");
}

}  // namespace
}  // namespace temper
