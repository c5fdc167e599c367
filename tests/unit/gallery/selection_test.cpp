// Selections: the figures that words on the command line name.
#include "gallery/selection.hpp"

#include <gtest/gtest.h>

namespace temper::gallery {
namespace {

Page none_selected(Effort) { return {}; }

/// Figures 3 to 10 and 12; 11 is missing.
const std::vector<Figure> kAll = {{3, "", "", none_selected}, {4, "", "", none_selected},  {5, "", "", none_selected},
                                  {6, "", "", none_selected}, {7, "", "", none_selected},  {8, "", "", none_selected},
                                  {9, "", "", none_selected}, {10, "", "", none_selected}, {12, "", "", none_selected}};

std::vector<int> chosen(const std::vector<std::string>& words) {
  const Expected<std::vector<Figure>> figures = select(kAll, words);
  std::vector<int> numbers;
  if (!figures) {
    ADD_FAILURE() << figures.error().what();
    return numbers;
  }
  for (const Figure& figure : *figures) numbers.push_back(figure.number);
  return numbers;
}

std::string problem(const std::vector<std::string>& words) {
  const Expected<std::vector<Figure>> figures = select(kAll, words);
  if (figures) return "";
  EXPECT_EQ(figures.error().code, ErrorCode::invalid_option);
  return figures.error().what();
}

using Numbers = std::vector<int>;

TEST(Selection, NoWordsMeanAllFigures) { EXPECT_EQ(chosen({}), (Numbers{3, 4, 5, 6, 7, 8, 9, 10, 12})); }

TEST(Selection, NumbersListsAndRangesMix) {
  EXPECT_EQ(chosen({"6"}), (Numbers{6}));
  EXPECT_EQ(chosen({"6,8"}), (Numbers{6, 8}));
  EXPECT_EQ(chosen({"8-10"}), (Numbers{8, 9, 10}));
  EXPECT_EQ(chosen({"12", "3,8-9"}), (Numbers{3, 8, 9, 12}));
  EXPECT_EQ(chosen({"06"}), (Numbers{6}));
}

TEST(Selection, EachFigureIsChosenOnceAndInOrder) { EXPECT_EQ(chosen({"8", "6-8", "6,6"}), (Numbers{6, 7, 8})); }

TEST(Selection, NumbersThePaperHasNotAreRefused) {
  for (const char* word : {"0", "33", "30-40", "6,99"}) {
    EXPECT_NE(problem({word}).find("the paper has figures 1 to 32"), std::string::npos) << word;
  }
}

TEST(Selection, AFigureThatIsNotInTheGalleryIsNamed) {
  EXPECT_EQ(problem({"11"}), "figure 11 is not in this gallery");
  EXPECT_EQ(problem({"10-12"}), "figure 11 is not in this gallery");
}

TEST(Selection, WhatIsNoNumberListOrRangeIsRefused) {
  for (const char* word : {"", "six", "6,", ",6", "6-", "-6", "6-7-8", "6.5", "+6", " 6", "99999999999999999999"}) {
    EXPECT_NE(problem({word}).find("is not a figure"), std::string::npos) << word;
  }
  EXPECT_EQ(problem({"8-6"}), "'8-6' is an empty range");
}

}  // namespace
}  // namespace temper::gallery
