// index.html and gallery.json of two figures made up for the purpose.
#include "gallery/results.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace temper::gallery {
namespace {

using nlohmann::json;

Page nothing(Effort) { return {}; }

std::vector<Result> two_results() {
  Result first = {{6, "Edge <hard>", "walls & a minimum", nothing}, {}};
  first.page.pictures = {{"fig06", "<svg/>", "E_BH over (d, h)"}, {"fig06_zoom", "<svg/>", "closer"}};
  first.page.tables = {{"Minima", {"energy", "value", "where"}, {{"BH", "1.333", "d = h"}, {"BP", "−2", ""}}}};
  first.page.claims = {{"6", "the minimum is 4/3", "4", "1.3333", true, "minimized from 20 starts"},
                       {"4", "B is \"concave\"", "yes", "no", false, "midpoint below"}};
  Result second = {{8, "Six energies", "landscapes", nothing}, {}};
  second.page.claims = {{"2.4", "thresholds", "", "", true, "", Author::temper}};
  return {first, second};
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + part.size())) ++n;
  return n;
}

TEST(Results, ClaimsAreCountedByTheirAuthor) {
  const std::vector<Result> results = two_results();
  EXPECT_EQ(count_claims(results[0].page, Author::paper).hold, 1u);
  EXPECT_EQ(count_claims(results[0].page, Author::paper).all, 2u);
  EXPECT_EQ(count_claims(results, Author::paper).all, 2u);
  EXPECT_EQ(count_claims(results, Author::temper).hold, 1u);
  EXPECT_EQ(count_claims(results, Author::temper).all, 1u);
  EXPECT_EQ(verdict_sentence(results), "1 of 2 claims of the paper hold, and 1 of 1 of ours.");
  EXPECT_EQ(verdict_sentence(std::span(results).first(1)), "1 of 2 claims of the paper hold.");
}

TEST(GalleryJson, HasEveryFigureAndEveryClaimWithAllKeys) {
  const json document = json::parse(gallery_json(two_results(), "1.2.3"));
  EXPECT_EQ(document.size(), 3u);
  EXPECT_EQ(document["version"], "1.2.3");
  EXPECT_EQ(document["figures"], json::parse(R"([
    {"number": 6, "title": "Edge <hard>", "pictures": ["fig06.svg", "fig06_zoom.svg"]},
    {"number": 8, "title": "Six energies", "pictures": []}])"));
  ASSERT_EQ(document["claims"].size(), 3u);
  EXPECT_EQ(document["claims"][1], json::parse(R"({"figure": "4", "claim": "B is \"concave\"", "paper": "yes",
    "temper": "no", "holds": false, "why": "midpoint below", "author": "paper"})"));
  EXPECT_EQ(document["claims"][2],
            json::parse(R"({"figure": "2.4", "claim": "thresholds", "paper": "", "temper": "", "holds": true, "why": "",
    "author": "temper"})"));
}

TEST(GalleryJson, OfNoFiguresStillHasItsKeys) {
  EXPECT_EQ(json::parse(gallery_json({}, "1")), json::parse(R"({"version": "1", "figures": [], "claims": []})"));
}

TEST(ClaimsMarkdown, HasARowForEachClaimWithTheReasonIfItDoesNotHold) {
  EXPECT_EQ(claims_markdown(two_results()), R"(1 of 2 claims of the paper hold, and 1 of 1 of ours.

| where | claim | the paper | temper | holds |
|-|-|-|-|-|
| fig. 6 | the minimum is 4/3 | 4 | 1.3333 | ✓ |
| fig. 4 | B is "concave" | yes | no | **✗**: midpoint below |
| §2.4 | thresholds | (ours)  |  | ✓ |
)");
}

TEST(ClaimsMarkdown, EscapesWhatTablesAndEmphasisAreMadeOf) {
  std::vector<Result> results = two_results();
  results[0].page.claims = {{"6", "a|b", "a*b", "a<b\nc", true, ""}};
  EXPECT_NE(claims_markdown(results).find("| a\\|b | a\\*b | a&lt;b c | ✓ |"), std::string::npos);
}

TEST(IndexHtml, ShowsPicturesTablesAndClaimsOfEachFigure) {
  const std::string html = index_html(two_results(), Effort::full, "1.2.3");
  for (const char* part :
       {"<img src=\"fig06.svg\" alt=\"E_BH over (d, h)\">", "<img src=\"fig06_zoom.svg\"", "Edge &lt;hard&gt;",
        "walls &amp; a minimum", "<i>E</i><sub>BH</sub> over (d, h)</figcaption>", "<p class=\"caption\">Minima</p>",
        "<th class=\"n\">value</th>", "<td class=\"n\">1.333</td>", "<td>d = h</td>",
        "<b>1 of 2 claims of the paper hold, and 1 of 1 of ours.</b>", "minimized from 20 starts", "temper 1.2.3",
        "id=\"fig8\"", "href=\"#fig8\"", "§2.4"}) {
    EXPECT_NE(html.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(count(html, "✓"), 2u);
  EXPECT_EQ(count(html, "✗"), 1u);
  EXPECT_EQ(count(html, "<section"), count(html, "</section>"));
}

TEST(IndexHtml, NeedsNothingButItsPictures) {
  const std::string html = index_html(two_results(), Effort::full, "1");
  for (const char* foreign : {"<script", "<link", "http:", "https:", "@import", "url("}) {
    EXPECT_EQ(html.find(foreign), std::string::npos) << foreign;
  }
}

TEST(IndexHtml, ListsFirstWhatDoesNotHold) {
  std::vector<Result> results = two_results();
  EXPECT_NE(index_html(results, Effort::full, "1").find("What does not hold"), std::string::npos);
  results[0].page.claims[1].holds = true;
  EXPECT_EQ(index_html(results, Effort::full, "1").find("What does not hold"), std::string::npos);
}

TEST(IndexHtml, SaysWhenTheEffortWasReduced) {
  EXPECT_EQ(index_html(two_results(), Effort::full, "1").find("reduced effort"), std::string::npos);
  EXPECT_NE(index_html(two_results(), Effort::reduced, "1").find("reduced effort"), std::string::npos);
}

}  // namespace
}  // namespace temper::gallery
