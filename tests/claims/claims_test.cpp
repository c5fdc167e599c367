// Every claim of the paper is a test: it holds, or it is known not to; and gallery/claims.md says what
// was found.
//
// The pages are made once for all tests of this process. The program `claims` takes fewer samples and shorter runs,
// which give other numbers than gallery/claims.md has. Built with TEMPER_WHOLE_CLAIMS, it makes them in
// full, and compares the page.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <ostream>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "gallery/gallery.hpp"
#include "gallery/results.hpp"

namespace temper::gallery {

// Found by GoogleTest beside Figure only.
void PrintTo(const Figure& figure, std::ostream* out) { *out << "figure " << figure.number; }

namespace {

constexpr std::size_t kFiguresOfPaper = 32;

/// A claim of the paper that does not hold: a figure, or section, and a part of the claim. One that comes to hold must
/// go from here.
struct Exception {
  std::string_view figure, part;
};
constexpr Exception kDoesNotHold[] = {
    {"2.1", "pushes the midpoint and the orthocenter"},
    {"2.3", "alone gives no barrier"},
    {"4 Barriers", "tends to zero where an edge collapses"},
    {"6", "is concave, as its Hessian"},
    {"7 Further Exploration", "quasi-convex in the position of a vertex"},
    {"7 Further Exploration", "quasi-convex in the positions of its vertices"},
    {"7", "is negative definite"},
    {"8", "have minima where the free vertex coincides"},
    {"12", "can send p_4's y to −∞"},
    {"13", "E_T has nearly coincident orthocenters"},
    {"14", "E_T is similar to E_∂T"},
    {"15", "neither near-collapses nor explicit collapses"},
    {"16", "The number of circumcenters in no triangle"},
    {"18", "converge in fewer iterations"},
    {"19", "whatever the order in which vertices are visited"},
    {"2.3", "E_T of one and the same mesh"},
    {"21", "the first stops at its limit"},
    {"21", "at its leftmost place"},
    {"6.6.1", "The best strategy is"},
    {"23", "All dual vertices have moved inside"},
    {"23", "Unlimited weights with deferred flips are chaotic"},
    {"6.6.2", "lowest energy in all cases"},
    {"6.6.2", "is minutely better than"},
    {"6.6.2", "look the same"},
    {"6.6.2", "only two vertices cause more than one flip"},
    {"26", "a fifth at the start of the third"},
    {"29", "Two adjacent 4-valent nodes"},
    {"30", "coarse mesh of high quality"},
    {"7 Further Exploration", "without removals collapse edges"},
    {"7 Further Exploration", "produce a HOT mess"},
    {"7 Further Exploration", "explicit collapses make every energy work"},
    {"7 Conclusion", "only E_BP is robust"},
    {"7 Conclusion", "any metric can be used"},
    {"31", "coarse mesh of high quality"},
    {"7 Conclusion", "by its barrier alone"},
    {"7 Further Exploration", "ends with less energy than E_BP alone"},
    {"7 Further Exploration", "should be removed explicitly"},
};

#ifdef TEMPER_WHOLE_CLAIMS
constexpr Effort kEffort = Effort::full;
#else
constexpr Effort kEffort = Effort::reduced;
#endif

const Page& page(const Figure& figure) {
  static std::map<int, Page> pages;
  const auto found = pages.find(figure.number);
  return found != pages.end() ? found->second : pages.emplace(figure.number, make(figure, kEffort)).first->second;
}

bool matches(const Exception& exception, const Claim& claim) {
  return claim.figure == exception.figure && claim.claim.find(exception.part) != std::string::npos;
}

bool is_exception(const Claim& claim) {
  return std::any_of(std::begin(kDoesNotHold), std::end(kDoesNotHold),
                     [&](const Exception& exception) { return matches(exception, claim); });
}

class EachFigure : public testing::TestWithParam<Figure> {};

TEST_P(EachFigure, HoldsWhatThePaperClaimsOfIt) {
  ASSERT_FALSE(page(GetParam()).claims.empty());
  for (const Claim& claim : page(GetParam()).claims) {
    EXPECT_EQ(claim.holds, !is_exception(claim)) << claim.figure << ": " << claim.claim << "\n  paper: " << claim.paper
                                                 << "\n  temper: " << claim.temper << "\n  why: " << claim.why;
  }
}

TEST_P(EachFigure, SaysOfEachClaimWhatWasFoundAndHow) {
  for (const Claim& claim : page(GetParam()).claims) {
    for (const std::string* text : {&claim.figure, &claim.claim, &claim.paper, &claim.temper, &claim.why}) {
      EXPECT_FALSE(text->empty()) << claim.figure << ": " << claim.claim;
    }
  }
}

TEST_P(EachFigure, HasPicturesNamedAfterItAndCompleteTables) {
  const Figure& figure = GetParam();
  const std::string prefix = (figure.number < 10 ? "fig0" : "fig") + std::to_string(figure.number);
  const Page& made = page(figure);
  EXPECT_FALSE(made.pictures.empty());
  for (const Picture& picture : made.pictures) {
    EXPECT_EQ(picture.name.rfind(prefix, 0), 0u) << picture.name;
    EXPECT_EQ(picture.name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-"),
              std::string::npos)
        << picture.name;
    EXPECT_EQ(picture.svg.rfind("<svg", 0), 0u) << picture.name;
    EXPECT_NE(picture.svg.find("</svg>"), std::string::npos) << picture.name;
    EXPECT_FALSE(picture.caption.empty()) << picture.name;
  }
  for (const Table& table : made.tables) {
    EXPECT_FALSE(table.caption.empty() || table.rows.empty());
    for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.header.size()) << table.caption;
  }
}

INSTANTIATE_TEST_SUITE_P(Gallery, EachFigure, testing::ValuesIn(figures()),
                         [](const auto& test) { return "Figure" + std::to_string(test.param.number); });

TEST(Gallery, FiguresAreThoseOfThePaperInOrderAndTitled) {
  EXPECT_EQ(figures().size(), kFiguresOfPaper);
  int last = 0;
  for (const Figure& figure : figures()) {
    EXPECT_GT(figure.number, last);
    last = figure.number;
    EXPECT_FALSE(figure.title.empty()) << figure.number;
    EXPECT_FALSE(figure.paper_caption.empty()) << figure.number;
  }
}

TEST(Gallery, NoTwoClaimsOrPicturesAreTheSame) {
  std::set<std::pair<std::string, std::string>> claims;
  std::set<std::string> pictures;
  for (const Figure& figure : figures()) {
    for (const Claim& claim : page(figure).claims)
      EXPECT_TRUE(claims.emplace(claim.figure, claim.claim).second) << claim.figure << ": " << claim.claim;
    for (const Picture& picture : page(figure).pictures)
      EXPECT_TRUE(pictures.insert(picture.name).second) << picture.name;
  }
  EXPECT_FALSE(pictures.empty());
}

TEST(Gallery, EveryKnownExceptionIsAClaim) {
  for (const Exception& exception : kDoesNotHold) {
    int claims = 0;
    for (const Figure& figure : figures()) {
      for (const Claim& claim : page(figure).claims) claims += matches(exception, claim);
    }
    EXPECT_EQ(claims, 1) << exception.figure << ": " << exception.part;
  }
}

#ifdef TEMPER_WHOLE_CLAIMS

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// What a page has between <!-- NAME --> and <!-- /NAME -->.
std::vector<std::string> documented(const std::string& page_name, const std::string& name) {
  std::ifstream file(TEMPER_SOURCE_DIR + page_name);
  std::ostringstream text;
  text << file.rdbuf();
  const std::string begins = "<!-- " + name + " -->\n\n", ends = "\n<!-- /" + name + " -->";
  const std::string page = text.str();
  const std::size_t begin = page.find(begins), end = page.find(ends);
  if (begin == page.npos || end == page.npos) return {};
  return lines_of(page.substr(begin + begins.size(), end - begin - begins.size()));
}

std::string missing(const std::vector<std::string>& lines, const std::vector<std::string>& among) {
  std::string text;
  for (const std::string& line : lines) {
    if (std::ranges::find(among, line) == among.end()) text += line + "\n";
  }
  return text;
}

TEST(Gallery, TheDocsHaveEveryRowAsItIsFound) {
  std::vector<Result> results;
  for (const Figure& figure : figures()) results.push_back({figure, page(figure)});
  const std::tuple<std::string, std::string, std::string> pages[] = {
      {"/gallery/claims.md", "claims", claims_markdown(results)},
      {"/gallery/readings.md", "settings", settings_markdown(results)}};
  for (const auto& [where, name, text] : pages) {
    const std::vector<std::string> found = lines_of(text), docs = documented(where, name);
    EXPECT_TRUE(found == docs) << "Found, and not in " << where << ":\n"
                               << missing(found, docs) << "In " << where << ", and not found:\n"
                               << missing(docs, found) << "temper paper reproduce -o DIR && gallery/update_docs.py DIR";
  }
}

#endif

}  // namespace
}  // namespace temper::gallery
