// The gallery for programs.
#include <nlohmann/json.hpp>

#include "results.hpp"

namespace temper::gallery {
namespace {

using Json = nlohmann::ordered_json;

Json figure_json(const Result& result) {
  Json pictures = Json::array();
  for (const Picture& picture : result.page.pictures) pictures.push_back(picture.name + ".svg");
  return {{"number", result.figure.number}, {"title", result.figure.title}, {"pictures", std::move(pictures)}};
}

Json claim_json(const Claim& claim) {
  return {{"figure", claim.figure},
          {"claim", claim.claim},
          {"paper", claim.paper},
          {"temper", claim.temper},
          {"holds", claim.holds},
          {"why", claim.why},
          {"author", claim.author == Author::paper ? "paper" : "temper"}};
}

}  // namespace

std::string gallery_json(std::span<const Result> results, std::string_view version) {
  Json figures = Json::array(), claims = Json::array();
  for (const Result& result : results) {
    figures.push_back(figure_json(result));
    for (const Claim& claim : result.page.claims) claims.push_back(claim_json(claim));
  }
  const Json document = {{"version", version}, {"figures", std::move(figures)}, {"claims", std::move(claims)}};
  return document.dump(2) + "\n";
}

}  // namespace temper::gallery
