// The gallery for people: contents, then a section a figure with the paper's side and ours.
#include <algorithm>
#include <cstddef>
#include <string>

#include "prose.hpp"
#include "results.hpp"

namespace temper::gallery {
namespace {

// How index.html looks: one column on a telephone, contents beside the figures on a screen, no figure broken
// across pages in print. Pictures are drawn for white paper and keep it in the dark.

inline constexpr const char* kIndexStyle = R"css(
:root {
  color-scheme: light dark;
  --ink: #1d2127; --soft: #59626d; --page: #f7f6f3; --card: #ffffff; --rule: #d8d5cd;
  --link: #005fa3; --yes: #00714f; --no: #b3350c; --no-card: #fdf1ec;
}
@media (prefers-color-scheme: dark) {
  :root {
    --ink: #e4e2dd; --soft: #a5a9ae; --page: #17191c; --card: #202327; --rule: #3a3e44;
    --link: #7bbcf0; --yes: #55c79f; --no: #ff9166; --no-card: #33241d;
  }
}
* { box-sizing: border-box; }
html { scroll-behavior: smooth; scroll-padding-top: 1rem; }
body {
  margin: 0; background: var(--page); color: var(--ink);
  font: 1rem/1.5 Charter, "Bitstream Charter", "Iowan Old Style", "Source Serif 4", Georgia, serif;
}
a { color: var(--link); text-decoration: none; }
a:hover { text-decoration: underline; }
header, .body, footer { max-width: 100rem; margin: 0 auto; padding: 0 1.5rem; }
header { padding-top: 2.5rem; }
h1 { font-size: 2rem; line-height: 1.2; margin: 0 0 .5rem; text-wrap: balance; }
h2 { font-size: 1.35rem; line-height: 1.25; margin: 0 0 .75rem; text-wrap: balance; }
h2 a { color: inherit; }
h2 .number { color: var(--soft); font-weight: normal; margin-right: .5em; }
h3 { font-size: 1rem; margin: 1.5rem 0 .25rem; }
p { max-width: 46rem; }
sub, sup { line-height: 0; font-size: .72em; }
.sum { font-size: 1.15rem; }
.yes { color: var(--yes); } .no { color: var(--no); }
nav, .tables, .claims, footer, .label { font-family: "Inter", "Source Sans 3", "Helvetica Neue", Arial, sans-serif; }
nav { font-size: .86rem; line-height: 1.35; margin: 1.5rem 0; }
nav h2 { font-size: .8rem; letter-spacing: .06em; text-transform: uppercase; color: var(--soft); }
nav ol { list-style: none; margin: 0; padding: 0; columns: 16rem; column-gap: 2rem; }
nav li { display: grid; grid-template-columns: 1.8rem 1fr auto; gap: .5rem; padding: .2rem 0; break-inside: avoid; }
nav .number, nav .count { color: var(--soft); font-variant-numeric: tabular-nums; white-space: nowrap; }
nav .count.no { color: var(--no); }
section { border-top: 1px solid var(--rule); padding: 1.75rem 0 2.25rem; }
.paper { margin: 0 0 1.25rem; padding-left: 1rem; border-left: 3px solid var(--rule); color: var(--soft); }
.label { font-size: .74rem; letter-spacing: .06em; text-transform: uppercase; display: block; }
.pictures { display: grid; gap: 1.25rem; grid-template-columns: repeat(auto-fit, minmax(min(100%, 26rem), 1fr)); align-items: start; }
figure { margin: 0; max-width: 52rem; }
figure img { display: block; width: 100%; background: #fff; border: 1px solid var(--rule); border-radius: 3px; padding: .5rem; }
figcaption { font-size: .9rem; line-height: 1.4; margin-top: .4rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: .86rem; line-height: 1.4; }
.tables table { font-variant-numeric: tabular-nums lining-nums; }
.caption { margin: 1.5rem 0 .35rem; font-size: .9rem; line-height: 1.4; }
th { text-align: left; font-weight: 600; border-bottom: 1.5px solid var(--ink); padding: .3rem .9rem .3rem 0; vertical-align: bottom; }
td { border-bottom: 1px solid var(--rule); padding: .3rem .9rem .3rem 0; vertical-align: top; }
.n { text-align: right; }
.claims { width: 100%; margin-top: 1.75rem; table-layout: fixed; }
.claims col.verdict { width: 2.2rem; } .claims col.says { width: 40%; }
.claims td { padding-top: .5rem; padding-bottom: .5rem; overflow-wrap: break-word; }
.claims td:first-child { font-size: 1.05rem; line-height: 1.2; font-weight: 700; }
.claims tr.failed td { background: var(--no-card); }
.claims tr.failed td:first-child { padding-left: .5rem; }
.why { display: block; color: var(--soft); font-size: .95em; margin-top: .2rem; }
.where { color: var(--soft); white-space: nowrap; }
.hidden { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); }
.failing { padding-left: 1.2rem; max-width: 60rem; }
footer { color: var(--soft); font-size: .82rem; padding-top: 1rem; padding-bottom: 3rem; }
@media (min-width: 75rem) {
  .body { display: grid; grid-template-columns: 17rem minmax(0, 1fr); gap: 3rem; }
  nav { position: sticky; top: 0; max-height: 100vh; overflow-y: auto; align-self: start; margin: 0; padding: 1.75rem 0; }
  nav ol { columns: auto; }
  .pictures.threes { grid-template-columns: repeat(3, 1fr); }
}
@media (max-width: 44rem) {
  header, .body, footer { padding-left: 1rem; padding-right: 1rem; }
  .claims, .claims tbody { display: block; }
  .claims thead, .claims colgroup { display: none; }
  .claims tr { display: grid; grid-template-columns: 2rem 1fr; border-bottom: 1px solid var(--rule); padding: .5rem 0; }
  .claims td { display: block; border: 0; padding: .1rem 0; grid-column: 2; }
  .claims td:first-child { grid-column: 1; grid-row: 1; }
  .claims td[data-label]::before { content: attr(data-label) ": "; color: var(--soft); }
}
@media print {
  :root { --ink: #000; --soft: #444; --page: #fff; --card: #fff; --rule: #bbb; --link: #000; --no-card: #fff; }
  body { font-size: 9.5pt; }
  .body { display: block; }
  nav { position: static; max-height: none; overflow: visible; }
  nav ol { columns: 2; }
  figure, tr, h2, .paper { break-inside: avoid; }
  h2, .paper, thead { break-after: avoid; }
  .pictures { grid-template-columns: repeat(2, 1fr); }
  .pictures > :only-child { grid-column: 1 / -1; max-width: 14cm; }
  figure img { max-height: 20cm; object-fit: contain; border: 0; }
}
)css";

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
