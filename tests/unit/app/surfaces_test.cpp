// Curved surfaces in the program: each verb on a torus, and what is not for surfaces.
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "workshop.hpp"

namespace temper::test {
namespace {

class Surfaces : public Workshop {
 protected:
  /// A torus of trapezoids, each cut in two, whose vertices are moved a little, as OBJ.
  static std::string torus(int n, int m) {
    std::ostringstream text;
    text.precision(17);
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < m; ++j) {
        const double u = 2 * std::numbers::pi * (i + 0.1 * std::sin(7 * i + 3 * j)) / n;
        const double v = 2 * std::numbers::pi * (j + 0.1 * std::cos(5 * i + 2 * j)) / m, r = 1 + 0.4 * std::cos(v);
        text << "v " << r * std::cos(u) << ' ' << r * std::sin(u) << ' ' << 0.4 * std::sin(v) << '\n';
      }
    }
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < m; ++j) {
        const int next = (i + 1) % n * m, up = (j + 1) % m;
        const int a = i * m + j, b = next + j, c = next + up, d = i * m + up;
        text << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << "\nf " << a + 1 << ' ' << c + 1 << ' ' << d + 1
             << '\n';
      }
    }
    return text.str();
  }
  static void make_torus() { write("in.obj", torus(20, 8)); }
};

TEST_F(Surfaces, AreCheckedByTheMeasuresThatTheyHave) {
  make_torus();
  const Outcome brief = temper_ok({"check", "in.obj"});
  EXPECT_TRUE(contains(brief.out, "in.obj: 160 vertices, 320 triangles\n"));
  EXPECT_TRUE(contains(brief.out, "154 of 320 triangles are bad (not well-centered)"));
  EXPECT_FALSE(contains(brief.out, "edge/size"));
  const nlohmann::json json = nlohmann::json::parse(temper_ok({"check", "in.obj", "--json"}).out);
  EXPECT_EQ(json["triangles"], 320);
  EXPECT_FALSE(json.contains("energy"));
  // A place has three coordinates: it is on the torus.
  const auto expect_on_torus = [](const nlohmann::json& place) {
    const double x = place["at"][0], y = place["at"][1], z = place["z"], away = std::hypot(x, y) - 1;
    EXPECT_NEAR(std::hypot(away, z), 0.4, 0.06);
  };
  expect_on_torus(json["min_coefficient_place"]);
  for (const nlohmann::json& worst : json["worst"]) expect_on_torus(worst);
  EXPECT_FALSE(json.contains("obtuse_triangles")) << "which is not measured";
  EXPECT_EQ(temper({"check", "in.obj", "--require", "outside=0"}).exit, 3);
  EXPECT_EQ(temper({"check", "in.obj", "--require", "obtuse_triangles=0"}).exit, 2);
  EXPECT_TRUE(contains(temper_ok({"check", "in.obj", "--details"}).out, "worst triangles\n"));
}

TEST_F(Surfaces, BecomeWellCenteredNearTheInput) {
  make_torus();
  const std::vector<std::string> run = {"optimize", "in.obj", "-o", "out.vtu", "--write", "report.json", "history.csv"};
  const Outcome outcome = temper_ok(run);
  EXPECT_TRUE(contains(outcome.out, "bad triangles                            154             0\n"));
  EXPECT_TRUE(contains(outcome.out, "converged after "));
  const nlohmann::json report = read_json("report.json");
  EXPECT_EQ(report["after"]["orthocenters_outside"], 0);
  EXPECT_LE(report["surface_distance"], 0.005 * report["diagonal"].get<double>());
  EXPECT_EQ(report["settings"]["surface_distance"], 0.005);
  EXPECT_FALSE(report["settings"].contains("tets_patches"));
  EXPECT_EQ(report["history"].size(), report["sweeps"].get<std::size_t>() + 1);
  EXPECT_TRUE(contains(temper_ok({"check", "out.vtu", "--require", "bad"}).out, "all 320 triangles are well-centered"));
  const std::string bytes = read("out.vtu");
  temper_ok({"optimize", "in.obj", "-o", "out.vtu", "--quiet"});
  EXPECT_EQ(read("out.vtu"), bytes);
  write("options.json", read("report.json"));
  temper_ok({"optimize", "in.obj", "-o", "again.vtu", "--options", "options.json", "--quiet"});
  EXPECT_EQ(read("again.vtu"), bytes);
  temper_ok({"optimize", "in.obj", "-o", "saved.vtu", "--save-every", "0", "--quiet"});
  EXPECT_EQ(read("saved.vtu"), bytes);
}

TEST_F(Surfaces, OptionsHaveTheirEffect) {
  make_torus();
  const auto report = [](std::vector<std::string> options) {
    options.insert(options.begin(), {"optimize", "in.obj", "-o", "out.obj", "--quiet", "--write", "r.json"});
    temper(options);
    return read_json("r.json");
  };
  const auto kept = report({"--keep", "positions"});
  EXPECT_EQ(kept["sweeps"], 0);
  EXPECT_LT(kept["surface_distance"], 1e-12);
  EXPECT_LE(report({"--surface-distance", "0.001", "--effort", "quick"})["surface_distance"],
            0.001 * kept["diagonal"].get<double>());
  const auto creased = report({"--crease-angle", "1", "--effort", "quick"});
  EXPECT_GT(creased["crease_edges"], 400);
  EXPECT_EQ(report({"--keep", "edges", "--surface-distance", "0.02"})["flips"], 0);
  EXPECT_EQ(report({"--time-limit", "1e-9"})["stopped"], "time_limit");
  for (const std::string target : {"vertex", "cell", "stars"}) {
    report({"--for", target, "--surface-distance", "0.02"});
    temper_ok({"check", "out.obj", "--for", target, "--require", "bad=0"});
  }
}

TEST_F(Surfaces, VerticesOfTheBoundarySlideIfAsked) {
  // Half of the torus: 132 points. Its boundary has two circles of twelve points.
  std::string half;
  std::istringstream lines(torus(20, 12));
  int n = 0;
  for (std::string line; std::getline(lines, line);) {
    int a = 0, b = 0, c = 0;
    const bool is_face = std::sscanf(line.c_str(), "f %d %d %d", &a, &b, &c) == 3;
    if ((is_face ? std::max({a, b, c}) : ++n) <= 132) half += line + '\n';
  }
  write("half.obj", half);
  const auto points = [](const std::string& file) {
    std::istringstream in(read(file));
    std::vector<std::array<double, 3>> all;
    for (std::string line; std::getline(in, line);) {
      std::array<double, 3> p = {};
      if (std::sscanf(line.c_str(), "v %lf %lf %lf", &p[0], &p[1], &p[2]) == 3) all.push_back(p);
    }
    return all;
  };
  const auto moved = [&](const std::string& how) {
    temper_ok({"optimize", "half.obj", "-o", "out.obj", "--boundary", how, "--surface-distance", "0.02", "--quiet"});
    const auto before = points("half.obj"), after = points("out.obj");
    int count = 0;
    for (const std::size_t first : {0, 120}) {
      for (std::size_t i = first; i < first + 12; ++i) count += before[i] != after[i] ? 1 : 0;
    }
    return count;
  };
  EXPECT_EQ(moved("keep"), 0);
  EXPECT_GT(moved("slide"), 10);
}

TEST_F(Surfaces, HaveWeightsWithProofs) {
  make_torus();
  temper_ok({"optimize", "in.obj", "-o", "good.vtu", "--quiet", "--surface-distance", "0.02"});
  EXPECT_TRUE(contains(temper_ok({"weights", "good.vtu", "-o", "best.vtu", "--from", "input"}).out, "feasible: "));
  temper_ok({"check", "best.vtu", "--require", "bad"});
  const Outcome none = temper({"weights", "in.obj", "--mode", "margin", "--certificate", "why.json"});
  ASSERT_EQ(none.exit, 6) << none.out << none.err;
  EXPECT_TRUE(contains(none.out, "infeasible: no weights make every triangle well-centered"));
  EXPECT_TRUE(contains(temper_ok({"weights", "in.obj", "--check-certificate", "why.json"}).out, "why.json proves it"));
  write("other.obj", torus(22, 9));
  EXPECT_EQ(temper({"weights", "other.obj", "--check-certificate", "why.json"}).exit, 1);

  // On the surface edges may flip. The result is no mesh of a file, but arrays.
  const Outcome flipped = temper({"weights", "in.obj", "--mode", "fewest", "--flips", "intrinsic", "-o", "arrays"});
  EXPECT_EQ(flipped.exit, 0) << flipped.err;
  EXPECT_TRUE(contains(flipped.out, "intrinsic flips: bad triangles 154 -> "));
  EXPECT_TRUE(contains(flipped.out, "wrote arrays\n"));
  const std::string arrays = read("arrays/operators.npz");
  for (const char* name : {"weights.npy", "triangles.npy", "edges.npy", "edge_lengths.npy", "star1.npy"})
    EXPECT_TRUE(contains(arrays, name)) << name;
  for (const char* name : {"vertices.npy", "edge_midpoints.npy", "orthocenters.npy"})
    EXPECT_FALSE(contains(arrays, name)) << name << ", which no vertex or triangle of it has";
  const auto json = nlohmann::json::parse(
      temper_ok({"weights", "in.obj", "--mode", "fewest", "--flips", "intrinsic", "-o", "arrays", "--json"}).out);
  EXPECT_EQ(json["intrinsic"]["bad_before"], 154);
  EXPECT_LT(json["intrinsic"]["bad_after"], 100);
  EXPECT_GT(json["intrinsic"]["flips"], 0);
  for (const char* option : {"--certificate", "--format"})
    EXPECT_EQ(temper({"weights", "in.obj", "-o", "arrays", "--flips", "intrinsic", option, "vtu"}).exit, 2) << option;
  EXPECT_EQ(temper({"weights", "in.obj", "--mode", "margin", "--flips", "intrinsic"}).exit, 2);
}

TEST_F(Surfaces, HaveOperatorsInSpace) {
  make_torus();
  temper_ok({"optimize", "in.obj", "-o", "good.vtu", "--quiet", "--surface-distance", "0.02"});
  const Outcome outcome = temper_ok({"operators", "good.vtu", "-o", "ops"});
  EXPECT_TRUE(contains(outcome.out, "good.vtu: all coefficients are positive\n"));
  EXPECT_TRUE(read("ops/orthocenters.mtx").starts_with("%%MatrixMarket matrix array real general\n% x, y, z of"));
  const auto json = nlohmann::json::parse(temper_ok({"operators", "good.vtu", "-o", "ops", "--json"}).out);
  EXPECT_NEAR(json["star0_sum"], json["area"].get<double>(), 1e-12);
  EXPECT_NEAR(json["cell_area_sum"], json["area"].get<double>(), 1e-12);
  EXPECT_EQ(json["cell_polygons"], 3 * 320);
  EXPECT_EQ(temper({"operators", "good.vtu", "-o", "ops", "--format", "disv"}).exit, 2);
}

TEST_F(Surfaces, HaveErrorsOfSolvers) {
  make_torus();
  write("fine.obj", torus(40, 16));
  const nlohmann::json json =
      nlohmann::json::parse(temper_ok({"errors", "fine.obj", "--against", "in.obj", "--json"}).out);
  EXPECT_EQ(json["triangles"], 1280);
  EXPECT_EQ(json["frame"]["center"].size(), 3);
  EXPECT_EQ(json["errors"]["fields"].size(), 7);
  EXPECT_NEAR(json["against"]["ratios"]["mean"]["all"]["poisson"]["l2"], 0.25, 0.1);
  const Outcome linear = temper_ok({"errors", "in.obj", "--fields", "exact"});
  EXPECT_TRUE(contains(linear.out, "in.obj: 320 triangles, 154 bad (not well-centered); "));
  EXPECT_TRUE(contains(linear.out, "relative error, linear"));
  const Outcome run = temper_ok({"optimize", "in.obj", "-o", "out.vtu", "--measure-errors", "--write", "report.json"});
  EXPECT_TRUE(contains(run.out, "mean relative error"));
  const nlohmann::json errors = read_json("report.json")["errors"];
  EXPECT_EQ(errors["after"]["matrices"]["flux"]["negative"], 0);
  EXPECT_EQ(errors["before"]["frame"], errors["after"]["frame"]);
  const nlohmann::json both =
      nlohmann::json::parse(temper_ok({"errors", "in.obj", "--against", "out.vtu", "--json"}).out);
  EXPECT_EQ(both["errors"], errors["before"]["errors"]);
  EXPECT_EQ(both["against"]["report"]["errors"], errors["after"]["errors"]);
}

TEST_F(Surfaces, AreExplainedAndDrawn) {
  make_torus();
  const Outcome why = temper_ok({"explain", "in.obj", "--limit", "2"});
  EXPECT_TRUE(contains(why.out, "If no vertex moves and no edge flips, no weights make all of them well-centered.\n"));
  EXPECT_TRUE(contains(why.out, " 2. at ("));
  EXPECT_TRUE(contains(why.out, "and 152 more"));
  EXPECT_TRUE(contains(temper_ok({"explain", "in.obj", "--for", "cell", "--limit", "1"}).out, "why:  h/"));
  const auto json = nlohmann::json::parse(temper_ok({"explain", "in.obj", "--json"}).out);
  EXPECT_EQ(json["bad"], 154);
  EXPECT_EQ(json["worst"].size(), 154U);
  EXPECT_EQ(json["verdict"], "infeasible");
  temper_ok({"draw", "in.obj", "-o", "torus.svg", "--view", "0,90"});
  const std::string above = read("torus.svg");
  EXPECT_TRUE(contains(above, " triangles in view bad"));
  temper_ok({"draw", "in.obj", "--before", "in.obj", "-o", "two.svg"});
  EXPECT_EQ(temper({"draw", "in.obj", "-o", "torus.svg", "--numbers"}).exit, 2);
}

TEST_F(Surfaces, DataAndTagsComeBack) {
  write("in.vtk",
        "# vtk DataFile Version 2.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 double\n0 0 0\n2 0 0\n1 1.7 0\n"
        "1 0.6 1.6\n9 9 9\nCELLS 4 16\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\nCELL_TYPES 4\n5\n5\n5\n5\nPOINT_DATA 5\n"
        "SCALARS heat double 1\nLOOKUP_TABLE default\n1 2 3 4 5\nCELL_DATA 4\nSCALARS part int 1\n"
        "LOOKUP_TABLE default\n1 2 3 4\n");
  const Outcome outcome = temper_ok({"optimize", "in.vtk", "-o", "out.vtk", "--keep", "positions"});
  EXPECT_TRUE(contains(outcome.err, "1 point of no triangle is dropped"));
  EXPECT_TRUE(contains(read("out.vtk"), "heat"));
  EXPECT_TRUE(contains(read("out.vtk"), "part"));
}

TEST_F(Surfaces, NearlyASphereMayBeTakenAsOne) {
  write("near.obj",
        "v 1 0 0\nv 0 1 0\nv -1 0 0\nv 0 -1 0\nv 0 0 1.00001\nv 0 0 -1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\nf 2 1 6\n"
        "f 3 2 6\nf 4 3 6\nf 1 4 6\n");
  EXPECT_TRUE(contains(temper_ok({"check", "near.obj"}).err, "Next: --projection sphere moves them to the sphere"));
  const Outcome sphere = temper_ok({"convert", "near.obj", "-o", "sphere.obj", "--projection", "sphere"});
  EXPECT_TRUE(contains(sphere.err, "points are moved to the sphere of radius 1, by 1e-05 of the radius at most"));
  EXPECT_EQ(temper_ok({"check", "sphere.obj", "--json"}).err, "");
  EXPECT_TRUE(numbers_of("sphere.obj").contains("energy")) << "a mesh of the sphere";
  make_torus();
  EXPECT_TRUE(
      contains(temper({"check", "in.obj", "--projection", "sphere"}).err, "expected all within 0.01 of a sphere"));
}

TEST_F(Surfaces, WhatIsNotForThemIsRefusedByName) {
  make_torus();
  const auto error_of = [](const std::vector<std::string>& words) {
    const Outcome outcome = temper(words);
    EXPECT_TRUE(outcome.exit == 1 || outcome.exit == 2);
    return outcome.err;
  };
  const std::string has = "in.obj has a curved surface, and ";
  EXPECT_TRUE(contains(error_of({"check", "in.obj", "--tensor", "1,0,1"}),
                       has + "--tensor is for triangles and tetrahedra alone. Next: leave it out"));
  EXPECT_TRUE(contains(error_of({"optimize", "in.obj", "-o", "out.obj", "--boundary", "split"}),
                       has + "--boundary split is for triangles and tetrahedra alone"));
  EXPECT_TRUE(contains(error_of({"optimize", "in.obj", "-o", "out.obj", "--keep", "weights"}),
                       has + "keep 'weights' is for triangles and tetrahedra alone. Next: leave it out; for curved "
                             "surfaces there are positions, edges, boundary"));
  EXPECT_TRUE(contains(error_of({"optimize", "in.obj", "-o", "out.obj", "--cell-data", "conserve"}),
                       has + "--cell-data conserve is"));
  EXPECT_TRUE(
      contains(error_of({"weights", "in.obj", "-o", "out.obj", "--mode", "accuracy"}), has + "--mode accuracy is"));
  EXPECT_TRUE(contains(error_of({"weights", "in.obj", "-o", "out.obj", "--for", "stars"}), has + "--for stars is"));
  EXPECT_TRUE(contains(error_of({"optimize", "in.obj", "-o", "out.obj", "--crease-angle", "0"}),
                       "--crease-angle: 0 is out of range"));
  EXPECT_TRUE(contains(error_of({"errors", "in.obj", "--refine", "1"}), has + "--refine is for triangles alone"));
  EXPECT_TRUE(contains(error_of({"errors", "in.obj", "--fields", "product"}),
                       "fields of tetrahedra and curved surfaces are all"));
  make_input();
  EXPECT_TRUE(contains(error_of({"optimize", "in.vtu", "-o", "out.vtu", "--surface-distance", "0.1"}),
                       "in.vtu has triangles, and --surface-distance is for curved surfaces alone"));
  EXPECT_TRUE(contains(error_of({"draw", "in.obj", "--before", "in.vtu", "-o", "a.svg"}),
                       "in.vtu: expected a curved surface, as in in.obj, found triangles"));
}

}  // namespace
}  // namespace temper::test
