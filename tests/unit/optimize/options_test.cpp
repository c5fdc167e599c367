// Errors name invalid options, and the mesh stays as it was.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "support/lattice.hpp"
#include "temper/detail/optimize_table.hpp"

namespace temper::test {
namespace {

std::string error_of(const OptimizeOptions& options) {
  Mesh mesh = lattice();
  const Mesh before = mesh;
  const auto report = optimize(mesh, options);
  EXPECT_EQ(mesh, before);
  if (report) return "no error";
  EXPECT_EQ(report.error().code, ErrorCode::invalid_option);
  return report.error().what();
}

TEST(OptimizeOptions, OutOfRangeAreRefusedByName) {
  EXPECT_EQ(error_of({.objective = Objective::energy, .star = Star::all}),
            "`star=all` is for `objective=accuracy`; of an energy expected 0, 1 or 2");
  EXPECT_EQ(error_of({.paper = {.gamma = LengthParameter{0}}}), "`gamma` is 0; expected more than 0, or auto");
  EXPECT_EQ(error_of({.paper = {.gamma = LengthParameter{NAN}}}), "`gamma` is nan; expected more than 0, or auto");
  EXPECT_EQ(error_of({.paper = {.overshoot = 0}}), "`overshoot` is 0; expected more than 0");
  EXPECT_EQ(error_of({.paper = {.relaxation = 2}}), "`relaxation` is 2; expected more than 0 and less than 2, or auto");
  EXPECT_EQ(error_of({.paper = {.anchor = VertexId(25)}}), "`anchor` is vertex 25, but the mesh has 25 vertices");
  EXPECT_EQ(error_of({.max_sweeps = -1}), "`max_sweeps` is -1; expected at least 0");
  EXPECT_EQ(error_of({.paper = {.tolerance = NAN}}), "`tolerance` is nan; expected at least 0");
  EXPECT_EQ(error_of({.paper = {.collapse_energy = EnergyKind::BP}}), "`collapse_energy` is BP; expected F, T or dT");
}

/// A value that the option must not have.
OptionValue wrong_value(const OptionRow& row) {
  switch (row.kind) {
    case OptionKind::count:
      return std::int64_t{-1};
    case OptionKind::number:
      return row.range.low - 1;
    case OptionKind::length_parameter:
      return LengthParameter{row.range.low - 1};
    case OptionKind::choice:
      return std::string_view("mirrored edges");
    case OptionKind::vertex:
      return 0.5;
  }
  return {};
}

TEST(TableOfOptions, HasADefaultInRangeAndRefusesOthersByNameAndRange) {
  const OptimizeOptions defaults;
  EXPECT_TRUE(check_options(defaults, CellKinds::triangles));
  EXPECT_TRUE(check_options(*options_for("paper"), CellKinds::triangles));
  std::set<std::string_view> names;
  for (const OptionRow& row : option_rows()) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_EQ(find_option(row.name), &row);
    EXPECT_TRUE(check_option(row, row.get(defaults))) << row.name;
    EXPECT_EQ(check_option(row, {}).has_value(), row.optional) << row.name;
    EXPECT_EQ(row.absent.empty(), !row.optional) << row.name;
    const auto refused = check_option(row, wrong_value(row));
    ASSERT_FALSE(refused) << row.name;
    const std::string& message = refused.error().message;
    EXPECT_EQ(message.rfind("`" + std::string(row.name) + "` is ", 0), 0u) << message;
    EXPECT_NE(message.find("; expected " + option_range_text(row)), std::string::npos) << message;
  }
  EXPECT_GT(names.size(), 40u);
  EXPECT_EQ(find_option("no such option"), nullptr);
}

TEST(TableOfOptions, SetsEachOptionAndNoOther) {
  for (const OptionRow& row : option_rows()) {
    std::vector<OptionValue> values;
    for (const std::string_view choice : row.choices) values.emplace_back(choice);
    if (row.kind == OptionKind::count) values = {std::int64_t{3}};
    if (row.kind == OptionKind::number) values = {0.5 * (row.range.low + std::fmin(row.range.high, 9))};
    if (row.kind == OptionKind::length_parameter) values = {LengthParameter{0.25, LengthScale::absolute}};
    if (row.kind == OptionKind::vertex) values = {VertexId(7)};
    if (row.optional) values.emplace_back();
    for (const OptionValue& value : values) {
      OptimizeOptions options;
      row.set(options, value);
      EXPECT_TRUE(row.get(options) == value) << row.name;
      for (const OptionGroup& other_group : option_groups()) {
        for (const OptionRow& other : other_group.rows) {
          if (other.name == row.name) continue;
          EXPECT_TRUE(other.get(options) == other.get({})) << row.name << " sets " << other.name;
        }
      }
    }
  }
}

TEST(TableOfOptions, NeedsNameOptionsAndValuesOfThem) {
  std::size_t needs = 0;
  for (const OptionRow& row : option_rows()) {
    for (const OptionNeed& need : row.needs) {
      if (need.option.empty()) continue;
      const OptionRow* other = find_option(need.option);
      ASSERT_NE(other, nullptr) << row.name;
      std::string_view values = need.values;
      while (!values.empty()) {
        const std::string_view value = values.substr(0, values.find('|'));
        EXPECT_TRUE(check_option(*other, value)) << row.name << " needs " << need.option << "=" << value;
        values.remove_prefix(std::min(values.size(), value.size() + 1));
      }
      ++needs;
    }
  }
  EXPECT_GT(needs, 20u);
  EXPECT_EQ(missing_need(*find_option("boundary_ratio"), {}), "`boundary=split`");
  EXPECT_EQ(missing_need(*find_option("boundary_ratio"), {.boundary = BoundaryVertices::split}), "");
  EXPECT_EQ(missing_need(*find_option("overshoot"), {}), "`flip_limit=after`");
  EXPECT_EQ(missing_need(*find_option("overshoot"), {.energy = EnergyKind::F}), "");
  EXPECT_EQ(missing_need(*find_option("collapse_ratio"), {}), "`collapse_from`");
  EXPECT_EQ(missing_need(*find_option("relaxation"), {.paper = {.solver = Solver::golden}}),
            "`solver=newton` or `solver=alternating`");
}

TEST(TableOfOptions, SaysForWhichCellsOptionsWordsAndValuesAre) {
  constexpr auto kTriangles = CellKinds::triangles, kTetrahedra = CellKinds::tetrahedra;
  using Names = std::vector<std::string_view>;
  const auto refusal = [](const OptimizeOptions& options, const GivenNames& given, CellKinds cells) {
    const auto right = check_cells(options, given, cells);
    return right ? std::string() : right.error().message.substr(0, right.error().message.find(';'));
  };
  const Names all = {"seed", "star", "tets_patches"}, sizes = {"edges", "sizes"};
  EXPECT_EQ(refusal({}, {.options = all}, kTriangles), "");
  EXPECT_EQ(refusal({}, {.options = all}, kTetrahedra), "");
  EXPECT_EQ(refusal({.tets = {.patches = Patches::each}}, {.options = all}, kTriangles),
            "`tets_patches=each` is for tetrahedra alone. Next: leave it out");
  EXPECT_EQ(refusal({.paper = {.seed = 5}}, {.options = all}, kTetrahedra),
            "`seed=5` is for triangles alone. Next: leave it out");
  EXPECT_EQ(refusal({.paper = {.seed = 5}}, {}, kTetrahedra), "");  // a word has set it
  EXPECT_EQ(refusal({}, {.target = "mpas"}, kTetrahedra), "target 'mpas' is for triangles alone. Next: leave it out");
  EXPECT_EQ(refusal({}, {.keep = sizes}, kTetrahedra), "keep 'sizes' is for triangles alone. Next: leave it out");
  EXPECT_EQ(refusal({.star = Star::three}, {.options = all}, kTriangles),
            "`star=3` is for tetrahedra alone. Next: leave it out");
  EXPECT_FALSE(check_options({.star = Star::three}, kTriangles));
  EXPECT_TRUE(check_options({.star = Star::three}, kTetrahedra));
  EXPECT_TRUE(check_options({.tets = {.repair_trials = -1}}, kTriangles));
  EXPECT_FALSE(check_options({.tets = {.repair_trials = -1}}, kTetrahedra));
}

TEST(TableOfOptions, AreSpelledByEachFrontEnd) {
  const OptionSpelling shout = [](const OptionRow& row, std::string_view value) {
    return "<" + std::string(row.name) + (value.empty() ? "" : " ") + std::string(value) + ">";
  };
  EXPECT_EQ(spell_options("see `boundary=split`, `seed` and `nothing`", shout),
            "see <boundary split>, <seed> and `nothing`");
  EXPECT_EQ(spell_options("a lone ` and `seed", shout), "a lone ` and `seed");
  for (const OptionRow& row : option_rows()) {
    EXPECT_EQ(spell_options(row.sentence, shout).find('`'), std::string::npos) << row.sentence;
  }
}

TEST(OptimizeOptions, AHardBarrierOutsideItsDomainIsRefused) {
  Mesh mesh = lattice({.jitter = 0.45, .weight = 0});
  const Mesh before = mesh;
  const auto report = optimize(mesh, {.energy = EnergyKind::BH});
  ASSERT_FALSE(report);
  EXPECT_NE(report.error().what().find("energy BH is infinite on this mesh"), std::string::npos);
  EXPECT_EQ(mesh, before);
}

TEST(OptimizeOptions, AVertexHiddenByItsWeightIsNamed) {
  Mesh mesh = lattice();
  mesh.set_weight(VertexId(12), -50);
  const Mesh before = mesh;
  const auto report = optimize(mesh);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::hidden_vertex);
  EXPECT_EQ(report.error().what(),
            "weights hide point 12 (weight -50); expected weights that leave every vertex a power cell");
  EXPECT_EQ(mesh, before);
}

}  // namespace
}  // namespace temper::test
