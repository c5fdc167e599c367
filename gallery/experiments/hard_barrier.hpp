// Are there weights for which every d and every h of the sparse horseshoe is positive, at its input positions (§6.4)?
//
// 2 S h ℓ and 2 d ℓ are linear in the weights, with integer coefficients for integer coordinates (S twice the area of
// the triangle). So strict positivity of all of them is a linear system, and a combination of some of them by
// positive integers that has no weights left in it and is not positive proves that there is no solution (Farkas).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace temper::gallery {

/// constant + Σ weight[i] w_i > 0.
struct Condition {
  std::string name;  ///< "h_30 of 430", "d_10"
  std::int64_t constant = 0;
  std::array<std::int64_t, 5> weight = {};
};

/// The 12 conditions on h and the 16 on d of the sparse horseshoe, in exact integers.
[[nodiscard]] std::vector<Condition> hard_barrier_conditions();

/// Multiples of conditions, by name.
struct Certificate {
  std::string terms;                        ///< "1 h_30 of 430 + 4 d_10 + …"
  std::array<std::int64_t, 5> weight = {};  ///< of their sum
  std::int64_t constant = 0;
  bool complete = false;  ///< every name was found, every multiple is positive
  /// No weights satisfy all these conditions.
  [[nodiscard]] bool proves() const;
};
/// The shortest proof, of four conditions.
[[nodiscard]] Certificate shortest_certificate();
/// The four conditions that the paper's argument uses: h_40 of 014, h_03 of 430, d_10, and d_43.
[[nodiscard]] Certificate papers_certificate();

/// The greatest margin t that a seeded random search finds with every h ≥ t ℓ and, if asked, t ℓ ≤ d ≤ (1 − t) ℓ.
struct MarginSearch {
  double margin = 0;
  std::array<double, 5> weights = {};
  std::size_t tries = 0;
};
[[nodiscard]] MarginSearch search_margin(bool with_d, std::size_t tries);

}  // namespace temper::gallery
