// The words of a user: targets, efforts and parts to keep give valid options, and their order does not matter.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "temper/detail/optimize_table.hpp"
#include "temper/optimize.hpp"

namespace temper::test {
namespace {

using Values = std::map<std::string, std::string>;
using Words = std::vector<std::string_view>;

Values values_of(const OptimizeOptions& options) {
  Values values;
  for (const OptionRow& row : option_rows()) values[std::string(row.name)] = option_text(row, row.get(options));
  return values;
}

std::string message(const Expected<OptimizeOptions>& options) { return options ? "" : options.error().message; }

TEST(Presets, TheFirstOfEachAreTheDefaults) {
  EXPECT_EQ(targets().front().name, "any");
  EXPECT_EQ(values_of(*options_for("any")), values_of(OptimizeOptions()));
  EXPECT_EQ(values_of(*options_for("any", "normal")), values_of(OptimizeOptions()));
}

TEST(Presets, EveryCombinationIsValidOrRefused) {
  int valid = 0, refused = 0;
  for (const Preset& target : targets()) {
    EXPECT_FALSE(target.sentence.empty());
    for (const Preset& effort : efforts()) {
      for (const Preset& part : keeps()) {
        const auto options = options_for(target.name, effort.name, Words{part.name});
        if (!options) {
          const bool research = target.research && effort.name != "normal";
          EXPECT_TRUE(research || part.name == "positions") << target.name << " " << effort.name << " " << part.name;
          EXPECT_NE(message(options).find("expected"), std::string::npos) << message(options);
          ++refused;
          continue;
        }
        for (const CellKinds cells : {CellKinds::triangles, CellKinds::tetrahedra}) {
          if (!fits(target.cells, cells)) continue;
          EXPECT_TRUE(check_options(*options, cells)) << target.name << " " << effort.name << " " << part.name;
        }
        ++valid;
      }
    }
  }
  EXPECT_GT(valid, 100);
  EXPECT_GT(refused, 10);
}

TEST(Presets, PartsToKeepCountOnceAndInAnyOrder) {
  const Words words = {"edges", "boundary", "sizes", "weights"};
  const Words back(words.rbegin(), words.rend());
  Words twice = words;
  twice.insert(twice.end(), back.begin(), back.end());
  const Values once = values_of(*options_for("cell", "high", words));
  EXPECT_EQ(values_of(*options_for("cell", "high", back)), once);
  EXPECT_EQ(values_of(*options_for("cell", "high", twice)), once);
  EXPECT_EQ(once.at("unknowns"), "positions");
  EXPECT_EQ(once.at("flips"), "none");
  EXPECT_EQ(once.at("size_band"), "2");
}

TEST(Presets, EffortsGrow) {
  for (const char* target : {"any", "vertex", "cell", "stars", "mpas"}) {
    const OptimizeOptions quick = *options_for(target, "quick"), normal = *options_for(target),
                          high = *options_for(target, "high");
    for (const auto& [less, more] : {std::pair{&quick, &normal}, std::pair{&normal, &high}}) {
      EXPECT_LT(less->accuracy.sweeps, more->accuracy.sweeps);
      EXPECT_LT(less->repair_trials, more->repair_trials);
      EXPECT_LT(less->solver_error.most_vertices, more->solver_error.most_vertices);
    }
  }
}

TEST(Presets, NoEffortChangesMoreThanValidTrianglesNeed) {
  for (const Preset& effort : efforts()) EXPECT_EQ(options_for("valid", effort.name)->change, Change::least);
}

TEST(Presets, WhatLeavesNothingToChangeIsRefused) {
  EXPECT_NE(message(options_for("any", "normal", Words{"positions", "weights"})).find("nothing can change"),
            std::string::npos);
  EXPECT_NE(message(options_for("mpas", "normal", Words{"positions"})).find("target 'mpas' moves positions"),
            std::string::npos);
}

TEST(Presets, OptionsThatChangeAPartToKeepAreRefused) {
  OptimizeOptions options = *options_for("cell", "normal", Words{"boundary", "edges"});
  EXPECT_TRUE(check_kept(options, Words{"boundary", "edges"}));
  options.boundary = BoundaryVertices::slide;
  const auto kept = check_kept(options, Words{"edges", "boundary"});
  ASSERT_FALSE(kept);
  EXPECT_EQ(kept.error().message, "keep 'boundary' contradicts `boundary=slide`; expected one of the two");
  EXPECT_TRUE(check_kept(options, Words{"edges"}));
  EXPECT_FALSE(check_kept(options, Words{"corners"}));
}

TEST(Presets, TheNameOfASolverStandsForItsTarget) {
  for (const SolverName& solver : solver_names()) {
    const auto options = options_for(solver.name);
    EXPECT_EQ(static_cast<bool>(options), !solver.target.empty()) << solver.name;
    if (options) {
      EXPECT_EQ(values_of(*options), values_of(*options_for(solver.target))) << solver.name;
    }
  }
  for (const char* word : {"PorePy", "porepy", "pore-py"}) EXPECT_EQ(*target_named(word), "cell");
  for (const char* word : {"D-Flow FM", "d-flow-fm", "dflowfm"}) EXPECT_EQ(*target_named(word), "dflowfm");
  EXPECT_EQ(*target_named("SCHISM"), "adcirc");
  EXPECT_EQ(*target_named("tough"), "vertex");
}

TEST(Presets, ASolverOfSeveralUsesIsToldWithItsTargets) {
  const std::string text =
      "'modflow' stands for no target of its own; expected target vertex with power cells on the "
      "mesh, target cell with triangles as cells";
  EXPECT_EQ(message(options_for("modflow")), text);
  EXPECT_NE(message(options_for("Decapodes")).find("target stars for forms"), std::string::npos);
}

TEST(Presets, ASynonymOfAnEffortIsGuessed) {
  EXPECT_TRUE(message(options_for("any", "fast")).ends_with("; did you mean 'quick'?"));
  EXPECT_TRUE(message(options_for("any", "BEST")).ends_with("; did you mean 'high'?"));
  EXPECT_TRUE(message(options_for("any", "default")).ends_with("; did you mean 'normal'?"));
  EXPECT_TRUE(message(options_for("any", "hihg")).ends_with("; did you mean 'high'?"));
  EXPECT_TRUE(message(options_for("skism")).ends_with("; did you mean 'schism'?"));
  EXPECT_FALSE(message(options_for("any", "")).ends_with("?"));
}

TEST(Presets, AnUnknownWordIsToldWithAllWords) {
  for (const std::string& text : {message(options_for("mpass")), message(options_for("any", "hard")),
                                  message(options_for("any", "normal", Words{"points"}))}) {
    EXPECT_NE(text.find("expected one of "), std::string::npos) << text;
  }
  EXPECT_NE(message(options_for("mpass")).find("dflowfm"), std::string::npos);
}

}  // namespace
}  // namespace temper::test
