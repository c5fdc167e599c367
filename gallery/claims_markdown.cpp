// The claims as gallery/claims.md has them: a table, with the reason for each that does not hold.
#include <string>

#include "results.hpp"

namespace temper::gallery {
namespace {

/// A text in a cell of a table: on one line, its marks of emphasis and tags escaped.
std::string cell(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '|':
      case '*':
        escaped += '\\';
        escaped += c;
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '\n':
        escaped += ' ';
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string place(const Claim& claim) {
  return (claim.figure.find_first_not_of("0123456789-") == std::string::npos ? "fig. " : "§") + claim.figure;
}

std::string row(const Claim& claim) {
  const std::string paper = claim.author == Author::temper ? "(ours) " + claim.paper : claim.paper;
  return "| " + place(claim) + " | " + cell(claim.claim) + " | " + cell(paper) + " | " + cell(claim.temper) + " | " +
         (claim.holds ? "✓" : "**✗**: " + cell(claim.why)) + " |\n";
}

}  // namespace

std::string claims_markdown(std::span<const Result> results) {
  std::string rows;
  for (const Result& result : results) {
    for (const Claim& claim : result.page.claims) rows += row(claim);
  }
  return verdict_sentence(results) + "\n\n| where | claim | the paper | temper | holds |\n|-|-|-|-|-|\n" + rows;
}

}  // namespace temper::gallery
