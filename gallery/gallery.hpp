// The figures and claims of "Not so HOT Triangulations" (Mitchell, Knupp, Mackay, Deakin 2023), made again.
//
// One folder a figure; each gives pictures, tables and claims. A claim is a sentence of the paper, what the paper
// found, what temper finds, and whether the two agree: computed, never typed in.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace temper::gallery {

struct Picture {
  std::string name;     ///< of the file, without .svg: "fig06", "fig19_iteration_2"
  std::string svg;      ///< the document
  std::string caption;  ///< what to see in it, one or two sentences
};

/// Numbers of ours beside the paper's.
struct Table {
  std::string caption;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;  ///< each as long as the header
};

/// Whose sentence a claim is. Ours add to the paper's, and are counted apart.
enum class Author { paper, temper };

struct Claim {
  std::string figure;  ///< "12", or "2.4" for a section
  std::string claim;   ///< the sentence, in our words
  std::string paper;   ///< what the paper says or shows: a number where it gives one
  std::string temper;  ///< what was measured here, with numbers
  bool holds = false;
  std::string why;  ///< when it does not hold: the experiment that explains it; else what was measured, and how
  Author author = Author::paper;
};

/// The choices of a figure's runs at points that the paper leaves open (reading.hpp).
inline constexpr std::size_t kOpenOptions = 5;
struct RunSettings {
  std::size_t runs = 0;
  std::array<std::set<std::string>, kOpenOptions> values;  ///< of each such option, where it has an effect
};

struct Page {
  std::vector<Picture> pictures;
  std::vector<Table> tables;
  std::vector<Claim> claims;
  RunSettings settings = {};  ///< make() fills it in
};

/// The work that a figure may do: everything, or what the tests have time for (fewer samples, shorter runs, but every
/// claim).
enum class Effort { full, reduced };

/// CannotBeMade: a run that a figure is about does not come to what the figure shows, under the reading that was set.
struct CannotBeMade : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A figure of the paper.
struct Figure {
  int number = 0;                  ///< the paper's
  std::string_view title;          ///< "Hard barrier energy of an edge"
  std::string_view paper_caption;  ///< what the paper's figure shows, in our words
  Page (*make)(Effort effort);
};

/// All figures, by number. Figures that come from one run share it: it is computed once.
[[nodiscard]] std::span<const Figure> figures();

/// The figure, and how its runs were read; those that an earlier figure has made are not among them. May throw
/// CannotBeMade.
[[nodiscard]] Page make(const Figure& figure, Effort effort);

}  // namespace temper::gallery
