// The gallery for people: contents, then a section a figure with the paper's side and ours.
#include <algorithm>
#include <cstddef>
#include <string>

#include "index_style.hpp"
#include "prose.hpp"
#include "results.hpp"

namespace temper::gallery {
namespace {

std::string anchor(const Figure& figure) { return "fig" + std::to_string(figure.number); }

std::string of(Tally tally) { return std::to_string(tally.hold) + " of " + std::to_string(tally.all); }
std::string fraction(Tally tally) { return std::to_string(tally.hold) + "/" + std::to_string(tally.all); }

std::string verdict_mark(bool holds) {
  return holds ? "<span class=\"yes\">✓<span class=\"hidden\"> holds</span></span>"
               : "<span class=\"no\">✗<span class=\"hidden\"> does not hold</span></span>";
}

/// "figure 12", "figures 26-29" or "§2.4": where in the paper a claim stands.
std::string place_in_words(const Claim& claim) {
  if (claim.figure.find_first_not_of("0123456789-") != std::string::npos) return "§" + claim.figure;
  return (claim.figure.find('-') == std::string::npos ? "figure " : "figures ") + claim.figure;
}

/// A number, perhaps with sign, exponent or percent: "−1.2e−3", "40 %", "5/6".
bool is_number(const std::string& text) {
  std::string rest = text;
  for (std::size_t minus = rest.find("−"); minus != rest.npos; minus = rest.find("−"))
    rest.replace(minus, std::string_view("−").size(), "-");
  return rest.find_first_of("0123456789") != rest.npos && rest.find_first_not_of("0123456789.+-e/% ") == rest.npos;
}

bool says_nothing(const std::string& text) { return text.empty() || text == "–" || text == "none" || text == "∞"; }

/// Columns of numbers are right-aligned.
bool is_number_column(const Table& table, std::size_t column) {
  std::size_t numbers = 0;
  for (const std::vector<std::string>& row : table.rows) {
    if (column >= row.size() || says_nothing(row[column])) continue;
    if (!is_number(row[column])) return false;
    ++numbers;
  }
  return numbers > 0;
}

std::string row_html(const Table& table, const std::vector<std::string>& cells, const char* tag) {
  std::string html = "<tr>";
  for (std::size_t i = 0; i < cells.size(); ++i) {
    html.append("<").append(tag).append(is_number_column(table, i) ? " class=\"n\">" : ">");
    html.append(prose(cells[i])).append("</").append(tag).append(">");
  }
  return html + "</tr>\n";
}

std::string table_html(const Table& table) {
  std::string html = "<p class=\"caption\">" + prose(table.caption) + "</p>\n<div class=\"wide\"><table>\n<thead>" +
                     row_html(table, table.header, "th") + "</thead>\n<tbody>\n";
  for (const std::vector<std::string>& row : table.rows) html += row_html(table, row, "td");
  return html + "</tbody></table></div>\n";
}

std::string picture_html(const Picture& picture) {
  return "<figure id=\"" + escaped(picture.name) + "\"><a href=\"" + escaped(picture.name) + ".svg\"><img src=\"" +
         escaped(picture.name) + ".svg\" alt=\"" + escaped(picture.caption) + "\"></a><figcaption>" +
         prose(picture.caption) + "</figcaption></figure>\n";
}

std::string claim_html(const Claim& claim, const Figure& figure) {
  std::string html = claim.holds ? "<tr><td>" : "<tr class=\"failed\"><td>";
  html += verdict_mark(claim.holds) + "</td><td>" + prose(claim.claim);
  if (claim.author == Author::temper) html += " <span class=\"where\">(ours)</span>";
  if (claim.figure != std::to_string(figure.number))
    html += " <span class=\"where\">(" + place_in_words(claim) + ")</span>";
  html += "<span class=\"why\">" + prose(claim.why) + "</span></td>";
  html += "<td data-label=\"Paper\">" + prose(claim.paper) + "</td>";
  html += "<td data-label=\"temper\">" + prose(claim.temper) + "</td></tr>\n";
  return html;
}

std::string claims_html(const Result& result) {
  if (result.page.claims.empty()) return "";
  std::string html =
      "<table class=\"claims\">\n<colgroup><col class=\"verdict\"><col class=\"says\"><col><col></colgroup>\n"
      "<thead><tr><th><span class=\"hidden\">Verdict</span></th><th>Claim</th><th>The paper</th><th>temper</th></tr>"
      "</thead>\n<tbody>\n";
  for (const Claim& claim : result.page.claims) html += claim_html(claim, result.figure);
  return html + "</tbody></table>\n";
}

std::string section_html(const Result& result) {
  const std::string id = anchor(result.figure);
  std::string html = "<section id=\"" + id + "\">\n<h2><a href=\"#" + id + "\"><span class=\"number\">Figure " +
                     std::to_string(result.figure.number) + "</span>" + prose(result.figure.title) + "</a></h2>\n";
  html += "<p class=\"paper\"><span class=\"label\">The paper shows</span>" + prose(result.figure.paper_caption) +
          "</p>\n<div class=\"" + (result.page.pictures.size() % 3 == 0 ? "pictures threes" : "pictures") + "\">\n";
  for (const Picture& picture : result.page.pictures) html += picture_html(picture);
  html += "</div>\n<div class=\"tables\">\n";
  for (const Table& table : result.page.tables) html += table_html(table);
  return html + "</div>\n" + claims_html(result) + "</section>\n";
}

std::string contents_html(std::span<const Result> results) {
  std::string html = "<nav><h2>Figures, and their claims that hold</h2>\n<ol>\n";
  for (const Result& result : results) {
    Tally tally = count_claims(result.page, Author::paper);
    tally += count_claims(result.page, Author::temper);
    html += "<li><span class=\"number\">" + std::to_string(result.figure.number) + "</span><a href=\"#" +
            anchor(result.figure) + "\">" + prose(result.figure.title) + "</a><span class=\"count" +
            (tally.hold < tally.all ? " no" : "") + "\">" + (tally.all > 0 ? fraction(tally) : "") + "</span></li>\n";
  }
  return html + "</ol></nav>\n";
}

/// The claims that fail, which a reader wants to know first.
std::string failing_html(std::span<const Result> results) {
  std::string items;
  for (const Result& result : results) {
    for (const Claim& claim : result.page.claims) {
      if (claim.holds) continue;
      items += "<li>" + prose(claim.claim) + " <a class=\"where\" href=\"#" + anchor(result.figure) + "\">" +
               escaped(place_in_words(claim)) + "</a></li>\n";
    }
  }
  if (items.empty()) return "";
  return "<h3>What does not hold</h3>\n<ul class=\"failing\">\n" + items + "</ul>\n";
}

std::string header_html(std::span<const Result> results, Effort effort) {
  std::string html =
      "<header>\n<h1>“Not so HOT Triangulations”, made again</h1>\n"
      "<p>The figures of S. A. Mitchell, P. Knupp, S. Mackay and M. F. Deakin, <i>Not so HOT Triangulations</i>, "
      "Computer-Aided Design 158 (2023), computed anew by temper. Beside each stands what the paper says, what temper "
      "finds, and whether the two agree.</p>\n";
  html += "<p class=\"sum\"><b>" + verdict_sentence(results) + "</b> " + std::to_string(results.size()) +
          (results.size() == 1 ? " figure." : " figures.");
  if (effort == Effort::reduced) html += " Made with reduced effort: fewer samples and shorter runs.";
  return html + "</p>\n" + failing_html(results) + "</header>\n";
}

}  // namespace

Tally& Tally::operator+=(Tally other) {
  hold += other.hold;
  all += other.all;
  return *this;
}

Tally count_claims(const Page& page, Author author) {
  Tally tally;
  for (const Claim& claim : page.claims) {
    if (claim.author == author) tally += {claim.holds ? 1U : 0U, 1};
  }
  return tally;
}

Tally count_claims(std::span<const Result> results, Author author) {
  Tally sum;
  for (const Result& result : results) sum += count_claims(result.page, author);
  return sum;
}

std::string verdict_sentence(std::span<const Result> results) {
  const Tally papers = count_claims(results, Author::paper), ours = count_claims(results, Author::temper);
  std::string text = of(papers) + " claims of the paper hold";
  if (ours.all > 0) text += ", and " + of(ours) + " of ours";
  return text + ".";
}

std::string index_html(std::span<const Result> results, Effort effort, std::string_view version) {
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>Not so HOT Triangulations, made again</title>\n<style>";
  html.append(kIndexStyle).append("</style>\n</head>\n<body>\n").append(header_html(results, effort));
  html.append("<div class=\"body\">\n").append(contents_html(results)).append("<main>\n");
  for (const Result& result : results) html += section_html(result);
  html.append("</main>\n</div>\n<footer>temper ").append(escaped(version));
  return html +
         "; the same numbers for programs: <a href=\"gallery.json\">gallery.json</a></footer>\n</body>\n</html>\n";
}

}  // namespace temper::gallery
