// Data of points and triangles, from file to file: depths stay where they were measured.
#include <cmath>
#include <variant>

#include "support/sanitizers.hpp"
#include "temper/generate.hpp"
#include "temper/io.hpp"
#include "workshop.hpp"

namespace temper::test {
namespace {

/// A bay: dry land around water, deepest in the middle.
double depth(Vec2 p) { return 0.8 - 0.25 * ((p.x - 2) * (p.x - 2) + (p.y - 2) * (p.y - 2)); }

class Data : public Workshop {
 protected:
  static void write_bay(const std::string& path) {
    io::MeshFile file = io::from_mesh(*random_mesh({.vertices = 400, .seed = 5}));
    std::vector<double> depths;
    std::vector<std::int32_t> node, bottom;
    for (const Vec2 p : file.points) depths.push_back(depth(p)), node.push_back(static_cast<int>(node.size()));
    for (std::size_t t = 0; t < file.triangles.size(); ++t) bottom.push_back(static_cast<int>(t));
    file.point_data = {{"depth", 1, depths}, {"node", 1, node}};
    std::vector<double> load(bottom.begin(), bottom.end());
    file.triangles.data = {{"bottom", 1, bottom}, {"load", 1, load}};
    ASSERT_TRUE(io::write(path, file));
  }
  static std::vector<double> depths(const io::MeshFile& file) {
    return std::get<std::vector<double>>(file.point_data.at(0).values);
  }
  /// The greatest error of the depths, and how many points are wet that should be dry or the other way round.
  struct Errors {
    double greatest = 0;
    int crossed = 0;
  };
  static Errors errors_of(const std::string& path) {
    const auto file = io::read(path);
    Errors errors;
    EXPECT_TRUE(file);
    if (!file) return errors;
    for (std::size_t p = 0; p < file->points.size(); ++p) {
      const double found = depths(*file)[p], right = depth(file->points[p]);
      errors.greatest = std::max(errors.greatest, std::abs(found - right));
      errors.crossed += (found > 0) != (right > 0) ? 1 : 0;
    }
    return errors;
  }
};

TEST_F(Data, DepthsStayAtTheirPlaceUnlessToldToKeepToTheirPoints) {
  write_bay("bay.vtu");
  ASSERT_EQ(errors_of("bay.vtu").greatest, 0);
  temper_ok({"convert", "bay.vtu", "-o", "fort.14"});
  for (const std::string input : {"bay.vtu", "fort.14"}) {
    temper_ok({"optimize", input, "-o", "out-" + input, "--quiet"});
    temper_ok({"optimize", input, "-o", "kept-" + input, "--quiet", "--point-data", "keep=depth"});
    const Errors interpolated = errors_of("out-" + input), kept = errors_of("kept-" + input);
    EXPECT_LT(interpolated.greatest, 0.05) << "linear between points 0.2 apart: a few times 0.25 · 0.2²";
    EXPECT_LT(10 * interpolated.crossed, kept.crossed);
    EXPECT_GT(kept.greatest, 4 * interpolated.greatest);
  }
}

TEST_F(Data, TheReportSaysWhatMovedHowFarAndWhatWasInterpolated) {
  write_bay("bay.vtu");
  const Outcome outcome = temper_ok({"optimize", "bay.vtu", "-o", "out.vtu", "--write", "r.json", "--details"});
  const nlohmann::json data = read_json("r.json")["data"];
  EXPECT_EQ(data["points"], 400);
  EXPECT_GT(data["points_moved"], 200);
  EXPECT_GT(data["distance"]["median"], 0);
  EXPECT_EQ(data["interpolated"], nlohmann::json::array({"depth"}));
  EXPECT_EQ(data["kept"], nlohmann::json::array({"node"}));
  EXPECT_EQ(data["of_triangles"], nlohmann::json::array({"bottom", "load"}));
  EXPECT_GT(data["triangles_changed"], 200);
  EXPECT_TRUE(contains(outcome.out, "point data: " + data["points_moved"].dump() + " of 400 points moved, by "));
  EXPECT_TRUE(contains(outcome.out, "interpolated on the triangles of the input: depth\n"));
  EXPECT_TRUE(contains(outcome.out, "kept with their points: node\n"));
  EXPECT_TRUE(contains(outcome.out, "taken from the input's triangle at the same place: bottom, load\n"));
  EXPECT_EQ(outcome.err, "");
}

TEST_F(Data, ConservedOnesKeepTheirIntegrals) {
  write_bay("bay.vtu");
  const Outcome outcome = temper_ok({"optimize", "bay.vtu", "-o", "out.vtu", "--write", "r.json", "--details",
                                     "--point-data", "conserve=depth", "--cell-data", "conserve"});
  const nlohmann::json data = read_json("r.json")["data"];
  EXPECT_EQ(data["conserved"], nlohmann::json::array({"depth"}));
  EXPECT_EQ(data["conserved_of_triangles"], nlohmann::json::array({"load"}));
  EXPECT_LT(data["integral_change"], 1e-14);
  EXPECT_EQ(data["out_of_range"], 0);
  EXPECT_TRUE(contains(outcome.out, "conserved on power cells: depth\n"));
  EXPECT_TRUE(contains(outcome.out, "conserved on triangles: load\n"));
  EXPECT_TRUE(contains(outcome.out, "integrals of conserved data: changed by "));
  const auto integral = [](const std::string& path) {
    const auto file = io::read(path);
    const auto mesh = io::make_mesh(*file)->mesh;
    const auto& load = std::get<std::vector<double>>(file->triangles.data.at(1).values);
    double sum = 0;
    for (const TriangleId t : mesh.triangles()) {
      const auto [a, b, c] = mesh.points(t);
      sum += 0.5 * cross(b.position() - a.position(), c.position() - a.position()) * load[t.index];
    }
    return sum;
  };
  EXPECT_NEAR(integral("out.vtu") / integral("bay.vtu"), 1, 1e-13);
}

TEST_F(Data, AReplayPutsTheSameDataBackToTheByte) {
  write_bay("bay.vtu");
  for (const std::vector<std::string>& rules : {std::vector<std::string>{},
                                                {"--point-data", "keep"},
                                                {"--point-data", "keep", "--point-data", "interpolate=depth"},
                                                {"--point-data", "conserve", "--cell-data", "conserve"}}) {
    std::vector<std::string> run = {"optimize", "bay.vtu", "-o", "out.vtu", "--quiet", "--write", "t.jsonl"};
    if (TEMPER_SANITIZED) run.insert(run.end(), {"--set", "max_sweeps=10"});
    std::vector<std::string> again = {"paper", "replay", "bay.vtu", "t.jsonl", "-o", "again.vtu", "--quiet"};
    run.insert(run.end(), rules.begin(), rules.end());
    again.insert(again.end(), rules.begin(), rules.end());
    temper_ok(run);
    temper_ok(again);
    EXPECT_EQ(read("out.vtu"), read("again.vtu"));
  }
}

TEST_F(Data, RulesThatFitNoArrayAreRefusedBeforeTheWork) {
  write_bay("bay.vtu");
  const auto refused = [](const std::vector<std::string>& rules, const std::string& part) {
    std::vector<std::string> arguments = {"optimize", "bay.vtu", "-o", "out.vtu"};
    for (const std::string& rule : rules) arguments.insert(arguments.end(), {"--point-data", rule});
    const Outcome outcome = temper(arguments);
    EXPECT_EQ(outcome.exit, 2);
    EXPECT_TRUE(contains(outcome.err, part));
    EXPECT_FALSE(exists("out.vtu"));
  };
  refused({"keep=dept"}, "bay.vtu: --point-data: there is no point data 'dept'; there are: depth, node");
  refused({"interpolate=node"}, "only floating point data are interpolated");
  refused({"keep", "interpolate"}, "--point-data: 'interpolate' contradicts what was said before it");
  refused({"move"}, "--point-data: 'move' is not interpolate, keep, conserve, or one of these with =NAME");
}

TEST_F(Data, TheCommandOfAReportMakesTheSameData) {
  write_bay("bay.vtu");
  temper_ok({"optimize", "bay.vtu", "-o", "out.vtu", "--write", "r.json", "--quiet", "--point-data", "keep",
             "--point-data", "interpolate=depth"});
  const nlohmann::json report = read_json("r.json");
  EXPECT_EQ(report["options"]["point_data"], nlohmann::json::array({"keep", "interpolate=depth"}));
  const std::string first = read("out.vtu");
  const Outcome again = shell(report["command"].get<std::string>());
  EXPECT_EQ(again.exit, 0);
  EXPECT_EQ(read("out.vtu"), first);
}

}  // namespace
}  // namespace temper::test
