// temper optimize: what it writes and prints, and that a report can be run again.
#include "temper/optimize.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <sstream>
#include <thread>

#include "support/tet_files.hpp"
#include "support/tet_lattice.hpp"
#include "temper/detail/optimize_table.hpp"
#include "workshop.hpp"

namespace temper::test {
namespace {

class Optimize : public Workshop {
 protected:
  void SetUp() override { make_input(); }
};

TEST_F(Optimize, MakesEveryTriangleWellCentered) {
  EXPECT_EQ(temper({"check", "in.vtu", "--require", "outside=0"}).exit, 3);
  const Outcome outcome = temper_ok({"optimize", "in.vtu", "-o", "out.vtu"});
  EXPECT_EQ(temper({"check", "out.vtu", "--require", "outside=0,not_crossed=0,nonregular=0,inverted=0"}).exit, 0);
  for (const char* part : {"in.vtu: 49 vertices, 72 triangles", "before", "after", "bad triangles", "least margin",
                           "transmissibility", "angles (degrees)", "least edge/size", "wrote out.vtu"}) {
    EXPECT_TRUE(contains(outcome.out, part));
  }
  EXPECT_LE(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 10);
  const Outcome details = temper_ok({"optimize", "in.vtu", "-o", "out.vtu", "--details"});
  for (const char* part : {"orthocenters outside", "least h/l", "E_BP, ★1"}) EXPECT_TRUE(contains(details.out, part));
  EXPECT_EQ(names(), (std::vector<std::string>{"in.vtu", "out.vtu"}));
}

TEST_F(Optimize, LinesThatAreAllEdgesOfTheMeshHoldNothing) {
  io::MeshFile file = *io::read("in.vtu");
  const std::size_t n_lines = file.lines.size();
  for (const auto& [a, b, c] : file.triangles) {
    for (const std::array<std::int32_t, 2>& side : {std::array{a, b}, {b, c}, {c, a}}) {
      if (side[0] < side[1]) file.lines.corners.push_back(side);
    }
  }
  file.lines.tags.resize(file.lines.size(), 0);
  ASSERT_GT(file.lines.size(), n_lines);
  ASSERT_TRUE(io::write("lines.msh", file));
  const std::string warning = "inner edges are lines of tag 0: they are taken for the edges of the mesh";
  for (const std::string boundary : {"keep", "split"}) {
    const Outcome outcome = temper_ok({"optimize", "lines.msh", "-o", "out.msh", "--boundary", boundary, "--write",
                                       "t.jsonl", "--require", "outside=0"});
    EXPECT_TRUE(contains(outcome.err, warning));
    EXPECT_TRUE(contains(temper_ok({"check", "out.msh"}).err, warning)) << "they are listed again";
    temper_ok({"paper", "replay", "lines.msh", "t.jsonl", "-o", "again.msh"});
    EXPECT_EQ(read("again.msh"), read("out.msh"));
  }
}

TEST_F(Optimize, EveryTagComesThroughConversionsAndSweeps) {
  io::MeshFile file = *io::read("in.vtu");
  file.triangles.tags.assign(file.triangles.size(), 7);
  std::fill(file.triangles.tags.begin() + 36, file.triangles.tags.end(), 3);
  file.lines.corners.clear(), file.lines.tags.clear();
  for (std::int32_t i = 0; i < 6; ++i) file.lines.corners.push_back({i, i + 1}), file.lines.tags.push_back(20 + i);
  file.marked_points.corners = {0, 6, 24}, file.marked_points.tags = {31, 32, 33};
  file.names = {{2, 7, "steel"}, {1, 20, "wall"}};
  ASSERT_TRUE(io::write("tags.msh", file));
  temper_ok({"convert", "tags.msh", "-o", "tags.vtu"});
  temper_ok({"convert", "tags.vtu", "-o", "converted.msh"});
  temper_ok({"optimize", "tags.msh", "-o", "kept.msh", "--keep", "edges", "--quiet"});
  temper_ok({"optimize", "tags.msh", "-o", "flipped.msh", "--quiet"});
  for (const char* path : {"converted.msh", "kept.msh", "flipped.msh"}) {
    SCOPED_TRACE(path);
    io::MeshFile found = *io::read(path);
    if (std::string_view(path) == "flipped.msh") {  // an edge flips within its region
      std::sort(found.triangles.tags.begin(), found.triangles.tags.end(), std::greater());
      std::sort(file.triangles.tags.begin(), file.triangles.tags.end(), std::greater());
    }
    EXPECT_EQ(found.triangles.tags, file.triangles.tags);
    EXPECT_EQ(found.lines.corners, file.lines.corners);
    EXPECT_EQ(found.lines.tags, file.lines.tags);
    EXPECT_EQ(found.marked_points.corners, file.marked_points.corners);
    EXPECT_EQ(found.marked_points.tags, file.marked_points.tags);
    ASSERT_EQ(found.names.size(), 2u);
    for (const io::PhysicalName& name : file.names) {
      EXPECT_EQ(std::count_if(found.names.begin(), found.names.end(),
                              [&](const io::PhysicalName& n) {
                                return n.dimension == name.dimension && n.tag == name.tag && n.name == name.name;
                              }),
                1)
          << name.name;
    }
  }
}

TEST_F(Optimize, InTheMetricOfATensorAndNowhereElse) {
  const std::vector<std::string> tensor = {"--tensor", "1,0,25"};
  const auto with = [&](std::vector<std::string> words) {
    words.insert(words.end(), tensor.begin(), tensor.end());
    return words;
  };
  temper_ok(with({"optimize", "in.vtu", "-o", "out.vtu", "--require", "outside=0"}));
  temper_ok(with({"check", "out.vtu", "--require", "outside=0,not_crossed=0,nonregular=0"}));
  EXPECT_EQ(temper({"check", "out.vtu", "--require", "outside=0"}).exit, 3) << "in the plane";
  EXPECT_FALSE(contains(read("out.vtu"), "min_h_over_l")) << "numbers of the plane";
  temper_ok(with({"optimize", "in.vtu", "-o", "again.vtu", "--quiet", "--save-every", "0"}));
  EXPECT_EQ(read("again.vtu"), read("out.vtu"));
  const auto fluxes = nlohmann::json::parse(temper_ok(with({"operators", "out.vtu", "-o", "operators", "--json"})).out);
  EXPECT_GT(fluxes.at("min_star1").get<double>(), 0);
  EXPECT_EQ(temper(with({"optimize", "in.vtu", "-o", "b.vtu", "--write", "t.jsonl"})).exit, 2);
  EXPECT_EQ(temper(with({"check", "in.vtu", "--write", "t.html"})).exit, 2);
  const Outcome wrong = temper({"optimize", "in.vtu", "-o", "b.vtu", "--tensor", "1,2,1"});
  EXPECT_EQ(wrong.exit, 2);
  EXPECT_TRUE(contains(wrong.err, "expected a positive definite tensor kxx,kxy,kyy"));
  temper_ok({"example", "random-sphere", "--vertices", "60", "-o", "globe.vtu"});
  const Outcome globe = temper(with({"optimize", "globe.vtu", "-o", "b.vtu"}));
  EXPECT_EQ(globe.exit, 1);
  EXPECT_TRUE(
      contains(globe.err, "globe.vtu: the mesh is on a sphere, but a diffusion tensor needs a mesh of the plane"));
  EXPECT_FALSE(std::filesystem::exists("b.vtu"));
}

TEST_F(Optimize, TakesATensorForEachRegion) {
  write(
      "rock.poly",
      "6 2 0 0\n0 0 0\n1 1 0\n2 1 0.6\n3 1 1\n4 0 1\n5 0 0.4\n7 0\n0 0 1\n1 1 2\n2 2 3\n3 3 4\n4 4 5\n5 5 0\n6 5 2\n0\n"
      "2\n0 0.5 0.1 1\n1 0.5 0.9 2\n");
  temper_ok({"mesh", "rock.poly", "-o", "rock.vtu", "--size", "0.12"});
  const std::vector<std::string> tensors = {"--tensor", "1=1,0,4", "--tensor", "2=3,1,2"};
  const auto with = [&](std::vector<std::string> words) {
    words.insert(words.end(), tensors.begin(), tensors.end());
    return words;
  };
  temper_ok(with({"optimize", "rock.vtu", "-o", "out.vtu", "--boundary", "split", "--require", "outside=0"}));
  EXPECT_TRUE(contains(read("out.vtu"), "Name=\"corner_weights\""));
  const Outcome check = temper_ok(with({"check", "out.vtu", "--require", "outside=0,not_crossed=0"}));
  EXPECT_EQ(check.err, "") << "weights keep the equations";
  const auto fluxes = nlohmann::json::parse(temper_ok(with({"operators", "out.vtu", "-o", "operators", "--json"})).out);
  EXPECT_GT(fluxes.at("min_star1").get<double>(), 0);
  EXPECT_EQ(fluxes.at("vertices"), nlohmann::json::parse(temper_ok({"check", "out.vtu", "--json"}).out).at("vertices"));
  temper_ok(with({"draw", "out.vtu", "-o", "out.svg", "--before", "rock.vtu"}));
  EXPECT_TRUE(contains(read("out.svg"), "bad"));
  temper_ok(with({"explain", "rock.vtu"}));
  temper_ok(with({"weights", "rock.vtu", "-o", "weighted.vtu", "--mode", "elastic"}));
  EXPECT_EQ(temper_ok(with({"check", "weighted.vtu"})).err, "");
  // The layers as files for MODFLOW, which computes lengths of DISV itself.
  write("layers.csv", "vertex,top,bottom 1\n*,1,0\n");
  const std::vector<std::string> layers = {"operators",  "out.vtu", "-o",        "model",   "--layers",
                                           "layers.csv", "--cells", "triangles", "--format"};
  const auto format = [&](const std::string& name) {
    std::vector<std::string> words = layers;
    words.push_back(name);
    return with(words);
  };
  temper_ok(format("disu,tough,uge"));
  EXPECT_TRUE(contains(temper(format("disv")).err, "MODFLOW computes lengths itself, without the tensor"));
  EXPECT_TRUE(
      contains(temper(with({"operators", "out.vtu", "-o", "model", "--layers", "layers.csv", "--format", "disu"})).err,
               "a power cell may have several tensors"));
}

TEST_F(Optimize, TensorsThatDoNotFitAreTold) {
  const auto refused = [](std::vector<std::string> words) {
    std::vector<std::string> all = {"optimize", "in.vtu", "-o", "none.vtu"};
    all.insert(all.end(), words.begin(), words.end());
    const Outcome outcome = temper(all);
    EXPECT_EQ(outcome.exit, 2) << outcome.err;
    EXPECT_FALSE(exists("none.vtu"));
    return outcome.err;
  };
  EXPECT_TRUE(contains(refused({"--tensor", "7=1,0,2"}), "in.vtu: --tensor: there is no value for region 0"));
  EXPECT_TRUE(contains(refused({"--tensor", "0=1,0,2", "--tensor", "9=1,0,3"}), "--tensor: the mesh has no region 9"));
  EXPECT_TRUE(contains(refused({"--tensor", "0=1,0,2", "--tensor", "0=1,0,3"}), "--tensor: region 0 has two values"));
  EXPECT_TRUE(
      contains(refused({"--tensor", "0=1,0,2", "--tensor", "1,0,3"}), "or one other value, found '1,0,3', too"));
  EXPECT_TRUE(contains(refused({"--tensor", "sand=1,0,2"}), "expected the number or name of a region before '='"));
  EXPECT_TRUE(contains(
      refused({"--tensor", "0=1,2"}),
      "expected three numbers KXX,KXY,KYY, or for tetrahedra six numbers KXX,KXY,KXZ,KYY,KYZ,KZZ; found 2 in '0=1,2'"));
  EXPECT_TRUE(contains(refused({"--tensor", "k"}), "--tensor: there are no cell data 'k' of three numbers"));
  EXPECT_TRUE(contains(refused({"--tensor", "k11,k22,angle1"}), "there are no cell data 'k11' of one number"));
  EXPECT_TRUE(contains(refused({"--tensor", "0=1,3,1"}), "region 0: tensor: expected a positive definite tensor"));
}

TEST_F(Optimize, TakesTensorsFromCellDataAsMODFLOWHasThem) {
  // A square of two triangles: k11 and k22 of axes that are turned by 30 degrees in one of them.
  const std::string
      head =
          "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\"><UnstructuredGrid><Piece NumberOfPoints=\"4\" "
          "NumberOfCells=\"2\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 "
          "0 1 1 "
          "0 0 1 0</DataArray></Points><Cells><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2 0 "
          "2 "
          "3</DataArray><DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3 6</DataArray><DataArray "
          "type=\"UInt8\" Name=\"types\" format=\"ascii\">5 5</DataArray></Cells><CellData>",
      tail = "</CellData></Piece></UnstructuredGrid></VTKFile>";
  const auto data = [](const std::string& name, const std::string& values, int components = 1) {
    return "<DataArray type=\"Float64\" Name=\"" + name + "\" NumberOfComponents=\"" + std::to_string(components) +
           "\" format=\"ascii\">" + values + "</DataArray>";
  };
  write("modflow.vtu", head + data("k11", "4 2") + data("k22", "1 1") + data("angle1", "30 0") + tail);
  // 4 cos² + sin², 3 cos sin, 4 sin² + cos² of 30 degrees.
  write("tensor.vtu", head + data("K", "3.25 1.299038105676658 1.75 2 0 1", 3) + tail);
  const auto measures = [](const std::string& file, const std::string& tensor) {
    return nlohmann::json::parse(temper_ok({"operators", file, "-o", "d", "--json", "--tensor", tensor}).out);
  };
  const auto turned = measures("modflow.vtu", "k11,k22,angle1"), whole = measures("tensor.vtu", "K");
  for (const std::string key : {"min_star1", "max_star1", "min_star0", "max_transmissibility"})
    EXPECT_NEAR(turned.at(key).get<double>(), whole.at(key).get<double>(), 1e-12) << key;
}

// What comes back from a metric is rounded, and edges of squares, which are ties there, may lack a flip here.
TEST_F(Optimize, LowersTheErrorOfTheUsersOwnProblem) {
  temper_ok({"mesh", TEMPER_SOURCE_DIR "/examples/layers.geojson", "-o", "in.msh", "--size", "150"});
  const std::vector<std::string> problem = {"--coefficient", "sand=1000,clay=1", "--dirichlet", "river=1",
                                            "--neumann",     "drain=-1",         "--source",    "1e-3"};
  const auto with_problem = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), problem.begin(), problem.end());
    return arguments;
  };
  temper_ok({"optimize", "in.msh", "-o", "general.msh", "--for", "cell"});
  temper_ok(with_problem({"optimize", "in.msh", "-o", "special.msh", "--for", "cell"}));
  const auto error = [&](const std::string& mesh) {
    const auto json = nlohmann::json::parse(temper_ok(with_problem({"errors", mesh, "--refine", "3", "--json"})).out);
    return json["problem"]["cell"]["l2"].get<double>();
  };
  EXPECT_LT(error("special.msh"), 0.5 * error("general.msh"));
  const auto refuse = [&](const std::vector<std::string>& more, const std::string& message) {
    std::vector<std::string> arguments = {"optimize", "in.msh", "-o", "none.msh"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto outcome = temper(arguments);
    EXPECT_NE(outcome.exit, 0);
    EXPECT_TRUE(contains(outcome.err, message)) << outcome.err;
    EXPECT_FALSE(exists("none.msh"));
  };
  refuse(with_problem({}), "expected the target vertex or cell (--for)");
  refuse(with_problem({"--for", "cell", "--effort", "quick"}), "Next: the effort normal (--effort normal)");
  refuse({"--for", "cell", "--source", "1"}, "--source needs --dirichlet");
  refuse({"--for", "cell", "--dirichlet", "lake=1"}, "--dirichlet");
  refuse(with_problem({"--for", "vertex", "--set", "solver_error_vertices=10"}), "solver_error_vertices=");
  refuse(with_problem({"--for", "vertex", "--tensor", "2,0,1"}), "--tensor");
  refuse(with_problem({"--for", "fem"}), "expected the target vertex or cell (--for)");
  refuse({"--for", "cell", "--dirichlet", "river=1,river=2"}, "has two values: by 'river' and by 'river'");
}

TEST_F(Optimize, ExitsWith4WhereEdgesThatMayFlipAreNotRegular) {
  temper_ok({"example", "sheared-grid", "--shear", "0", "--nx", "4", "--ny", "4", "-o", "squares.vtu"});
  const std::string regular = "nonregular=0";
  int lacking = 0;
  for (const std::string tensor : {"1,0,5", "1,0,7", "1,0,10"}) {
    const Outcome outcome = temper(
        {"optimize", "squares.vtu", "-o", "out.vtu", "--tensor", tensor, "--set", "energy=F", "--set", "max_sweeps=1"});
    const int check = temper({"check", "out.vtu", "--tensor", tensor, "--require", regular}).exit;
    EXPECT_EQ(outcome.exit, check == 3 ? 4 : check) << tensor;
    EXPECT_EQ(temper({"optimize", "squares.vtu", "-o", "out.vtu", "--tensor", tensor, "--set", "energy=F", "--set",
                      "max_sweeps=1", "--quiet"})
                  .exit,
              outcome.exit)
        << tensor;
    lacking += check == 3 ? 1 : 0;
  }
  EXPECT_GT(lacking, 0);
  temper_ok({"optimize", "in.vtu", "-o", "kept.vtu", "--keep", "edges", "--set", "max_sweeps=1"});
  EXPECT_EQ(temper({"check", "kept.vtu", "--require", regular}).exit, 3) << "none may flip";
}

TEST_F(Optimize, InAPipeNoControlCharacters) {
  const Outcome outcome = temper_ok({"optimize", "in.vtu", "-o", "out.vtu"});
  for (const std::string* text : {&outcome.out, &outcome.err}) {
    EXPECT_TRUE(std::none_of(text->begin(), text->end(), [](char c) { return c == '\r' || c == '\x1b'; }));
  }
  EXPECT_EQ(outcome.err, "");
}

TEST_F(Optimize, QuietPrintsNothing) {
  const Outcome outcome = temper_ok({"optimize", "in.vtu", "-o", "out.vtu", "--quiet"});
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "");
}

TEST_F(Optimize, InputAndOutputMayBeTheSame) {
  temper_ok({"optimize", "in.vtu", "-o", "out.vtu", "--quiet"});
  temper_ok({"optimize", "in.vtu", "-o", "in.vtu", "--quiet"});
  EXPECT_EQ(read("in.vtu"), read("out.vtu"));
}

TEST_F(Optimize, ThreadsDoNotChangeAByte) {
  temper_ok({"optimize", "in.vtu", "-o", "one.vtu", "--quiet", "--threads", "1"});
  temper_ok({"optimize", "in.vtu", "-o", "two.vtu", "--quiet", "--threads", "2"});
  EXPECT_EQ(read("one.vtu"), read("two.vtu"));
}

TEST_F(Optimize, RequirementsAreJudgedOnWhatIsWritten) {
  temper_ok({"optimize", "in.vtu", "-o", "out.vtu", "--require", "outside=0,nonregular=0", "--write", "r.json"});
  EXPECT_EQ(read_json("r.json")["requirements"].size(), 2u);
  const Outcome outcome = temper({"optimize", "in.vtu", "-o", "hard.vtu", "--quiet", "--require", "min_h>=0.5"});
  EXPECT_EQ(outcome.exit, 3);
  EXPECT_TRUE(contains(outcome.err, "hard.vtu: requirement not met: min_h>=0.5 means min_h_over_l >= 0.5, found 0."));
  EXPECT_TRUE(exists("hard.vtu"));
  EXPECT_EQ(temper({"optimize", "in.vtu", "-o", "no.vtu", "--require", "min_hight=1"}).exit, 2);
  EXPECT_FALSE(exists("no.vtu"));
}

TEST_F(Optimize, TheReportHasBeforeAfterAndHistory) {
  temper_ok({"optimize", "in.vtu", "-o", "out.vtu", "--write", "r.json", "--write", "h.csv", "--write", "p.svg"});
  const nlohmann::json report = read_json("r.json");
  for (const char* key : {"command", "version", "options", "before", "after", "sweeps", "seconds", "stopped",
                          "vertices_removed", "vertices_inserted", "flips", "notes", "warnings", "history"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
  EXPECT_EQ(report["before"], numbers_of("in.vtu"));
  EXPECT_EQ(report["after"], numbers_of("out.vtu"));
  EXPECT_EQ(report["version"], TEMPER_VERSION);
  EXPECT_EQ(report["after"]["orthocenters_outside"], 0);

  const std::size_t sweeps = report["sweeps"];
  ASSERT_GT(sweeps, 0u);
  ASSERT_EQ(report["history"].size(), sweeps + 1);
  for (const char* key : {"sweep", "energy", "bad", "flips", "seconds", "objective"}) {
    EXPECT_TRUE(report["history"][0].contains(key)) << key;
  }
  EXPECT_EQ(report["history"][0]["sweep"], 0);

  const std::string csv = read("h.csv");
  EXPECT_EQ(csv.rfind("sweep,energy,bad,flips,length_parameter,seconds,objective\n0,", 0), 0u);
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')), sweeps + 2);
  EXPECT_TRUE(contains(read("p.svg"), "</svg>"));
}

TEST_F(Optimize, ForAllStarsEachObjectiveComparesEnergiesOfStar1) {
  make_input();
  for (const char* objective : {"accuracy", "solver_error"}) {
    const std::string out = temper_ok({"optimize", "in.vtu", "-o", "out.vtu", "--details", "--set",
                                       "star=all,max_sweeps=5,objective=" + std::string(objective)})
                                .out;
    EXPECT_TRUE(contains(out, "E_BP, ★1")) << objective;
  }
}

TEST_F(Optimize, ForAccuracyMarginsHoldAndTheHistorySaysWhatEachSweepWasFor) {
  const Outcome run = temper_ok({"optimize", "in.vtu", "-o", "out.vtu", "--set", "objective=accuracy", "--set",
                                 "margin=0.02", "--write", "r.json", "--details"});
  const nlohmann::json report = read_json("r.json");
  EXPECT_GE(report["after"]["min_h_over_l"], 0.02);
  EXPECT_GE(report["after"]["min_d_over_l"], 0.02);
  EXPECT_EQ(report["after"]["well_centered_fraction"], 1);
  EXPECT_EQ(report["history"].front()["objective"], "energy");
  EXPECT_EQ(report["history"].back()["objective"], "accuracy");
  EXPECT_LT(report["objective_after"], report["objective_before"]);
  EXPECT_EQ(report["options"]["objective"], "accuracy");
  EXPECT_TRUE(contains(run.out, "\nobjective                           accuracy\nobjective before "));
}

TEST_F(Optimize, OptionsOfTheAccuracyObjectiveAreForItAlone) {
  const Outcome idle =
      temper_ok({"optimize", "in.vtu", "-o", "out.vtu", "--set", "margin=0.1", "--set", "objective=energy"});
  EXPECT_TRUE(contains(idle.err, "--set margin=0.1 has no effect without --set objective=accuracy"));
  const Outcome used =
      temper_ok({"optimize", "in.vtu", "-o", "out.vtu", "--for", "cell", "--set", "solver_error_steps=1"});
  EXPECT_FALSE(contains(used.err, "no effect"));
  const Outcome all = temper({"optimize", "in.vtu", "-o", "new.vtu", "--set", "star=all", "--set", "objective=energy"});
  EXPECT_EQ(all.exit, 2);
  EXPECT_TRUE(contains(all.err, "--set star=all is for --set objective=accuracy; of an energy expected 0, 1 or 2"));
  const Outcome hot =
      temper({"optimize", "in.vtu", "-o", "new.vtu", "--set", "objective=accuracy", "--set", "energy=T"});
  EXPECT_NE(hot.exit, 0);
  EXPECT_TRUE(contains(hot.err, "--set objective=accuracy begins with an energy that makes triangles well-centered"));
  EXPECT_FALSE(std::filesystem::exists("new.vtu"));
}

TEST_F(Optimize, TheCommandInTheReportGivesTheSameBytes) {
  const std::vector<std::vector<std::string>> runs = {
      {},
      {"--set", "energy=F", "--set", "solver=alternating", "--set", "max_sweeps=5", "--set", "flips=deferred", "--set",
       "stopping=paper"},
      {"--set", "gamma=0.25:absolute", "--keep", "weights", "--set", "seed=7", "--set", "interfaces=sliding", "--set",
       "anchor=3"},
      {"--keep", "positions", "--keep", "edges", "--set", "energy=BHs", "--set", "h0=20", "--set", "overshoot=1.05",
       "--set", "flip_limit=at"},
      {"--set", "objective=accuracy", "--set", "star=all,accuracy_sweeps=4", "--set", "margin=0.01"},
  };
  std::filesystem::rename("in.vtu", "it's a mesh.vtu");
  for (const auto& options : runs) {
    std::vector<std::string> arguments = {"optimize", "it's a mesh.vtu", "-o", "$out.vtu", "--write", "r.json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    temper_ok(arguments);
    const std::string first = read("$out.vtu");
    ASSERT_FALSE(first.empty());
    const std::string command = read_json("r.json")["command"];
    std::filesystem::remove("$out.vtu");
    EXPECT_EQ(shell(command).exit, 0) << command;
    EXPECT_EQ(read("$out.vtu"), first) << command;
    EXPECT_EQ(read_json("r.json")["command"], command);
  }
}

TEST_F(Optimize, TheReportHasWhatWasGivenAndEverySetting) {
  temper_ok({"optimize", "in.vtu", "-o", "out.vtu", "--write", "r.json", "--effort", "quick", "--set", "gamma=0.25"});
  const nlohmann::json report = read_json("r.json"), settings = report["settings"];
  EXPECT_EQ(report["options"], (nlohmann::json{{"effort", "quick"}, {"gamma", "0.25"}}));
  for (const OptionRow& row : option_rows())
    EXPECT_EQ(settings.contains(row.name), fits(row.cells, CellKinds::triangles)) << row.name;
  const OptimizeOptions quick = *options_for("any", "quick");
  EXPECT_EQ(settings["max_sweeps"], quick.max_sweeps);
  EXPECT_EQ(settings["repair_trials"], quick.repair_trials);
  EXPECT_EQ(settings["tolerance"], quick.paper.tolerance);
  EXPECT_EQ(settings["gamma"], "0.25");
  EXPECT_TRUE(settings["relaxation"].is_null());
}

TEST_F(Optimize, OptionsAndSettingsOfAReportGiveTheSameRun) {
  temper_ok({"optimize", "in.vtu", "-o", "out.vtu", "--write", "r.json", "--for", "cell", "--keep", "edges", "--set",
             "seed=7,gamma=0.25:absolute", "--boundary", "slide"});
  const nlohmann::json report = read_json("r.json");
  write("settings.json", report["settings"].dump());
  for (const char* file : {"r.json", "settings.json"}) {
    temper_ok({"optimize", "in.vtu", "-o", "again.vtu", "--options", file, "--write", "again.json", "--quiet"});
    EXPECT_EQ(read("again.vtu"), read("out.vtu")) << file;
    EXPECT_EQ(read_json("again.json")["settings"], report["settings"]) << file;
  }
  temper_ok({"optimize", "in.vtu", "-o", "again.vtu", "--options", "r.json", "--set", "seed=8", "--for", "any",
             "--write", "again.json", "--quiet"});
  EXPECT_EQ(read_json("again.json")["settings"]["seed"], 8) << "the command line overrides the file";
  EXPECT_EQ(read_json("again.json")["settings"]["scheme"], "all") << "the command line overrides the file";
}

TEST_F(Optimize, AFileOfOptionsThatIsWrongIsNamedWithItsMember) {
  const auto refused = [](const std::string& json, std::initializer_list<const char*> parts) {
    write("o.json", json);
    const Outcome outcome = temper({"optimize", "in.vtu", "-o", "out.vtu", "--options", "o.json"});
    EXPECT_NE(outcome.exit, 0) << json;
    EXPECT_TRUE(contains(outcome.err, "o.json")) << outcome.err;
    for (const char* part : parts) EXPECT_TRUE(contains(outcome.err, part)) << outcome.err;
    EXPECT_FALSE(exists("out.vtu"));
  };
  refused("{", {"is no JSON"});
  refused("{\n\"seed\": 1,\n}", {"o.json:3: is no JSON"});
  refused("[1]", {"expected a JSON object"});
  refused(R"({"schema": 1, "vertices": 5})", {"a report of temper optimize"});
  refused(R"({"tolerance": 1e400})", {"too large"});
  refused(R"({"max_sweep": 5})", {"max_sweep", "max_sweeps"});
  refused(R"({"max_sweeps": "many"})", {"max_sweeps", "many"});
  refused(R"({"seed": {"a": 1}})", {"seed", "expected a text or a number"});
  refused(R"({"for": "cells"})", {"for", "cell"});
  std::filesystem::create_directory("folder");
  const Outcome folder = temper({"optimize", "in.vtu", "-o", "out.vtu", "--options", "folder"});
  EXPECT_EQ(folder.exit, 1);
  EXPECT_TRUE(contains(folder.err, "folder: is a directory"));
  const Outcome none = temper({"optimize", "in.vtu", "-o", "out.vtu", "--options", "none.json"});
  EXPECT_TRUE(contains(none.err, "none.json: cannot be opened: No such file"));
}

TEST_F(Optimize, FixTakesSeveralTagsAndStillFindsTheInput) {
  write("tagged.mesh",
        "MeshVersionFormatted 2\nDimension 2\nVertices\n5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0.3 0.4 0\n"
        "Edges\n2\n1 2 11\n2 3 12\nTriangles\n4\n1 2 5 0\n2 3 5 0\n3 4 5 0\n4 1 5 0\nEnd\n");
  temper_ok({"optimize", "tagged.mesh", "-o", "a.vtu", "--fix", "11", "12", "--quiet"});
  temper_ok({"optimize", "--fix", "11", "12", "tagged.mesh", "-o", "b.vtu", "--quiet", "--write", "r.json"});
  temper_ok({"optimize", "--fix", "11", "--fix", "12", "-o", "c.vtu", "--quiet", "tagged.mesh"});
  EXPECT_EQ(read("a.vtu"), read("b.vtu"));
  EXPECT_EQ(read("a.vtu"), read("c.vtu"));
  EXPECT_EQ(read_json("r.json")["options"]["fix"], (nlohmann::json{"11", "12"}));
}

TEST_F(Optimize, OptionsWithoutEffectAreNamed) {
  const Outcome outcome = temper_ok({"optimize", "in.vtu", "-o", "out.vtu", "--set", "energy=F", "--set",
                                     "gamma=1:absolute", "--set", "max_sweeps=2"});
  EXPECT_TRUE(contains(outcome.err, "temper: warning: --set gamma=1:absolute has no effect without --set energy=BP"));
}

TEST_F(Optimize, WeightsThatStayAreToldIfOnlyPositionsChange) {
  const std::string warning = "the mesh has weights, and this run keeps them";
  EXPECT_FALSE(contains(temper_ok({"optimize", "in.vtu", "-o", "plain.vtu", "--for", "fem"}).err, warning));
  temper_ok({"optimize", "in.vtu", "-o", "weighted.vtu", "--quiet"});
  for (const std::vector<std::string>& words : {std::vector<std::string>{"--for", "mpas"}, {"--keep", "weights"}}) {
    std::vector<std::string> all = {"optimize", "weighted.vtu", "-o", "out.vtu"};
    all.insert(all.end(), words.begin(), words.end());
    EXPECT_TRUE(contains(temper_ok(all).err, "weighted.vtu: " + warning));
  }
  EXPECT_EQ(temper_ok({"optimize", "weighted.vtu", "-o", "out.vtu"}).err, "");
}

TEST_F(Optimize, SweepLimitIsKept) {
  temper_ok({"optimize", "in.vtu", "-o", "out.vtu", "--set", "max_sweeps=1", "--write", "r.json"});
  EXPECT_EQ(read_json("r.json")["sweeps"], 1);
  EXPECT_EQ(read_json("r.json")["stopped"], "max_sweeps");
}

/// Two triangles with sizes at their corners, as legacy VTK.
std::string size_file(const std::string& sizes, const std::string& extent = "1") {
  return "# vtk DataFile Version 3.0\nsizes\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0\n" + extent +
         " 0 0\n" + extent + " " + extent + " 0\n0 " + extent +
         " 0\nCELLS 2 8\n3 0 1 2\n3 0 2 3\nCELL_TYPES 2\n5\n5\nPOINT_DATA 4\nSCALARS size double "
         "1\nLOOKUP_TABLE default\n" +
         sizes + "\n";
}

TEST_F(Optimize, ReportsWhatBecameOfTheSizes) {
  const Outcome outcome = temper_ok({"optimize", "in.vtu", "-o", "out.vtu", "--write", "r.json", "--details"});
  for (const char* row : {"size over field, least", "size over field, median", "gradation, 95 %"}) {
    EXPECT_TRUE(contains(outcome.out, row));
  }
  const nlohmann::json size = read_json("r.json")["size"];
  EXPECT_EQ(size["before"]["over_field"]["min"], 1);
  EXPECT_EQ(size["before"]["over_field"]["max"], 1);
  EXPECT_EQ(size["after"]["vertices_outside_field"], 0);
  EXPECT_GT(size["after"]["over_field"]["max"], 1);
  EXPECT_GE(size["after"]["gradation"]["max"], size["after"]["gradation"]["median"]);
  EXPECT_GT(size["after"]["largest_edge_ratio"], 1);
}

TEST_F(Optimize, KeepsToASizeBand) {
  temper_ok({"example", "random", "-o", "random.vtu"});
  temper_ok({"optimize", "random.vtu", "-o", "free.vtu", "--write", "free.json", "--quiet"});
  temper_ok({"optimize", "random.vtu", "-o", "out.vtu", "--write", "r.json", "--set", "size_band=1.4", "--quiet"});
  const double unbound = read_json("free.json")["size"]["after"]["over_field"]["max"];
  const nlohmann::json sizes = read_json("r.json")["size"]["after"]["over_field"];
  EXPECT_GT(unbound, 1.4);
  EXPECT_LE(sizes["max"], 1.4 + 1e-12);
  EXPECT_GE(sizes["min"], 1 / 1.4 - 1e-12);
  EXPECT_EQ(temper({"optimize", "in.vtu", "-o", "out.vtu", "--set", "size_band=0.5"}).exit, 2);
}

TEST_F(Optimize, TakesASizeFieldFromAFile) {
  write("sizes.vtk", size_file("2 2 2 2", "0.125"));
  const Outcome outcome = temper_ok({"optimize", "in.vtu", "-o", "out.vtu", "--size", "sizes.vtk", "--write", "r.json",
                                     "--set", "objective=energy", "--details"});
  EXPECT_TRUE(contains(outcome.out, "note: the size field does not reach "));
  const nlohmann::json report = read_json("r.json");
  EXPECT_GT(report["size"]["before"]["vertices_outside_field"], 0);
  EXPECT_EQ(report["options"]["size"], "sizes.vtk");
  temper_ok({"optimize", "in.vtu", "-o", "own.vtu", "--write", "own.json", "--quiet", "--set", "objective=energy"});
  EXPECT_EQ(read("own.vtu"), read("out.vtu"));  // without a band nothing but the report looks at it
  EXPECT_NE(read_json("own.json")["size"], report["size"]);
}

TEST_F(Optimize, NamesWhatIsWrongWithASizeField) {
  write("sizes.vtk", size_file("1 1 0 1"));
  const auto refused = [](std::vector<std::string> options, std::initializer_list<const char*> parts) {
    options.insert(options.begin(), {"optimize", "in.vtu", "-o", "out.vtu"});
    const Outcome outcome = temper(options);
    EXPECT_EQ(outcome.exit, 1);
    for (const char* part : parts) EXPECT_TRUE(contains(outcome.err, part));
    EXPECT_FALSE(exists("out.vtu"));
  };
  refused({"--size", "sizes.vtk"}, {"sizes.vtk", "point 2 has size 0", "expected a finite, positive length"});
  refused({"--size", "sizes.vtk", "--size-data", "h"}, {"sizes.vtk", "no point data \"h\"", "size"});
  refused({"--size", "none.vtk"}, {"none.vtk"});
}

// --- tetrahedra ------------------------------------------------------------------------------------------------

/// A body-centered lattice with inner vertices off their places, two physical parts of its boundary, and data.
io::MeshFile lattice_file(int n = 3) {
  const TetArrays exact = body_centered(n);
  TetArrays moved = shaken(exact, 0.18, 0);
  const tets::TetMesh mesh = mesh_of(exact);
  const auto on_boundary = tets::boundary_vertices(mesh);
  std::vector<Vec3> points;
  std::vector<double> depth;
  std::vector<std::int32_t> number;
  for (const VertexId v : mesh.vertices()) {
    const Vec3 p = on_boundary[v] != 0 ? exact.points[v.index] : moved.points[v.index];
    points.push_back(p);
    depth.push_back(p.x - 2 * p.y + 3 * p.z);
    number.push_back(static_cast<std::int32_t>(v.index));
  }
  io::MeshFile file = test::tet_file(points, exact.tetrahedra);
  for (const tets::HalffaceId h : mesh.halffaces()) {
    if (!mesh.is_boundary(h)) continue;
    std::array<std::int32_t, 3> face = {};
    for (std::size_t k = 0; k < 3; ++k) face[k] = static_cast<std::int32_t>(mesh.vertices(h)[k].index);
    file.triangles.add(face, h.index % 2 == 0 ? 4 : 9);
  }
  file.names = {{2, 4, "inflow"}};
  file.point_data = {{"depth", 1, depth}, {"number", 1, number}};
  return file;
}

class OptimizeTetrahedra : public Workshop {
 protected:
  void SetUp() override { EXPECT_TRUE(io::write("in.vtu", lattice_file(), {})); }
  static io::MeshFile tets(const std::string& path) { return *io::read(path); }
};

TEST_F(OptimizeTetrahedra, AreMadeWellCenteredAndTheReportHasTheNumbersOfTheFile) {
  EXPECT_EQ(temper({"check", "in.vtu", "--require", "outside=0"}).exit, 3);
  const Outcome outcome = temper_ok(
      {"optimize", "in.vtu", "-o", "out.vtu", "--require", "outside=0,nonregular=0", "--write", "r.json", "h.csv"});
  for (const char* part : {"in.vtu: ", " inside), ", "before", "after", "bad tetrahedra", "converged after ",
                           "wrote out.vtu, r.json, h.csv"})
    EXPECT_TRUE(contains(outcome.out, part)) << part;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(names(), (std::vector<std::string>{"h.csv", "in.vtu", "out.vtu", "r.json"}));
  const nlohmann::json report = read_json("r.json");
  EXPECT_EQ(report["after"], numbers_of("out.vtu"));
  EXPECT_EQ(report["after"]["orthocenters_outside"], 0);
  EXPECT_EQ(report["history"].size(), report["sweeps"].get<std::size_t>() + 1);
  EXPECT_EQ(report["data"]["interpolated"], nlohmann::json({"depth"}));

  const io::MeshFile before = tets("in.vtu"), after = tets("out.vtu");
  EXPECT_EQ(after.triangles.corners, before.triangles.corners);
  EXPECT_EQ(after.triangles.tags, before.triangles.tags);
  EXPECT_EQ(after.names.at(0).name, "inflow");
  EXPECT_EQ(after.point_data[1].values, before.point_data[1].values);
  const auto& depth = std::get<std::vector<double>>(after.point_data[0].values);
  std::size_t moved = 0;
  for (std::size_t i = 0; i < after.points.size(); ++i) {
    const Vec3 p = after.place(i);
    EXPECT_NEAR(depth[i], p.x - 2 * p.y + 3 * p.z, 1e-12);
    moved += p == before.place(i) ? 0 : 1;
  }
  EXPECT_GT(moved, 4U);
  for (const auto& face : after.triangles) {
    for (const std::int32_t p : face) EXPECT_EQ(after.place(std::size_t(p)), before.place(std::size_t(p)));
  }
}

TEST_F(OptimizeTetrahedra, PositionsOrWeightsMayBeKept) {
  temper_ok({"optimize", "in.vtu", "-o", "w.vtu", "--keep", "positions"});
  temper_ok({"optimize", "in.vtu", "-o", "p.vtu", "--keep", "weights,boundary"});
  EXPECT_EQ(tets("w.vtu").points, tets("in.vtu").points);
  EXPECT_FALSE(tets("w.vtu").weights.empty());
  EXPECT_NE(tets("p.vtu").points, tets("in.vtu").points);
  EXPECT_TRUE(tets("p.vtu").weights.empty());
}

TEST_F(OptimizeTetrahedra, OptionsForTrianglesAloneAreRefusedByNameAndNothingIsWritten) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> refused = {
      {{"--for", "mpas"}, "target 'mpas'"},
      {{"--keep", "sizes"}, "keep 'sizes'"},
      {{"--set", "energy=T"}, "--set energy=T is for triangles alone. Next: leave it out; for tetrahedra there are F"},
      {{"--set", "gamma=1"},
       "--set gamma=1 is for triangles alone. Next: leave it out; for tetrahedra there are energy, star, scheme, "},
      {{"--min-edge", "0.5"}, "--min-edge"},
      {{"--write", "t.jsonl"}, "--write t.jsonl"},
      {{"--projection", "sphere"}, "--projection"}};
  for (const auto& [option, name] : refused) {
    std::vector<std::string> all = {"optimize", "in.vtu", "-o", "out.vtu"};
    all.insert(all.end(), option.begin(), option.end());
    const Outcome outcome = temper(all);
    EXPECT_EQ(outcome.exit, 2) << name << outcome.err;
    EXPECT_TRUE(contains(outcome.err, "in.vtu has tetrahedra, and " + name)) << outcome.err;
  }
  temper_ok({"example", "annulus", "-o", "flat.vtu"});
  const Outcome flat = temper({"optimize", "flat.vtu", "-o", "out.vtu", "--set", "tets_patches=each"});
  EXPECT_EQ(flat.exit, 2);
  EXPECT_TRUE(contains(flat.err, "flat.vtu has triangles, and --set tets_patches=each is for tetrahedra alone"));
  std::filesystem::remove("flat.vtu");
  const Outcome both = temper({"optimize", "in.vtu", "-o", "out.vtu", "--boundary", "split", "--effort", "quick"});
  EXPECT_EQ(both.exit, 2);
  EXPECT_TRUE(contains(both.err, "--boundary split inserts vertices, which keep=")) << both.err;
  EXPECT_EQ(temper({"optimize", "in.vtu", "-o", "out.obj"}).exit, 1);  // holds no tetrahedra
  EXPECT_EQ(temper({"optimize", "in.vtu", "-o", "out.vtu", "--require", "min_angle>=1"}).exit, 2);
  EXPECT_EQ(names(), std::vector<std::string>{"in.vtu"});
}

TEST_F(OptimizeTetrahedra, MoreEffortThanTheKeptPartsAllowIsAWarning) {
  const Outcome outcome = temper_ok(
      {"optimize", "in.vtu", "-o", "out.vtu", "--effort", "high", "--keep", "edges", "--set", "max_sweeps=1"});
  EXPECT_TRUE(contains(outcome.err, "warning: --effort high has no effect with --keep edges"));
  EXPECT_TRUE(contains(outcome.err, "Next: leave one of them out"));
}

TEST_F(OptimizeTetrahedra, ATimeLimitWritesTheBestMeshAndExitsWith4) {
  const Outcome outcome = temper({"optimize", "in.vtu", "-o", "out.vtu", "--time-limit", "1e-9", "--write", "r.json"});
  EXPECT_EQ(outcome.exit, 4);
  EXPECT_TRUE(contains(outcome.out, "stopped early by --time-limit after 0 sweeps"));
  EXPECT_EQ(read_json("r.json")["stopped"], "time_limit");
  EXPECT_EQ(tets("out.vtu").points, tets("in.vtu").points);
}

TEST_F(OptimizeTetrahedra, TheFirstSignalWritesTheBestMeshAndExitsWith4) {
  EXPECT_TRUE(io::write("large.vtu", lattice_file(20), {}));
  const pid_t process = start({"optimize", "large.vtu", "-o", "out.vtu", "--write", "r.json"}, "out.txt", "err.txt");
  for (int i = 0; i < 3000 && read("out.txt").find("vertices") == std::string::npos; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(process, SIGINT);
  EXPECT_EQ(wait_for(process), 4);
  EXPECT_EQ(read_json("r.json")["stopped"], "canceled");
  EXPECT_TRUE(contains(read("out.txt"), "stopped early by a signal"));
  EXPECT_EQ(tets("out.vtu").tetrahedra.size(), tets("large.vtu").tetrahedra.size());
}

}  // namespace
}  // namespace temper::test
