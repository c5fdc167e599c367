// temper optimize --save-every: the output is a whole mesh during the run, and a later run starts from it.
#include <signal.h>

#include <chrono>
#include <thread>

#include "support/tet_files.hpp"
#include "support/tet_lattice.hpp"
#include "temper/generate.hpp"
#include "temper/io.hpp"
#include "workshop.hpp"

namespace temper::test {
namespace {

using namespace std::chrono_literals;

class SaveEvery : public Workshop {
 protected:
  /// A mesh with data, far from well-centered.
  static void make_mesh_with_data() {
    const Mesh mesh = *random_mesh({.vertices = 2000, .seed = 4});
    io::MeshFile file = io::from_mesh(mesh);
    std::vector<double> depth;
    for (const Vec2 p : file.points) depth.push_back(p.x * p.y);
    file.point_data.push_back({"depth", 1, depth});
    ASSERT_TRUE(io::write("in.vtu", file));
  }
  /// A run that ends by a signal only.
  static pid_t start_long(const std::string& output) {
    return start({"optimize", "in.vtu", "-o", output, "--set", "objective=energy", "--set", "max_sweeps=1000000",
                  "--set", "tolerance=0", "--set", "repair=none", "--save-every", "0"},
                 "out.txt", "err.txt");
  }
  template <class Holds>
  static void wait_until(const Holds& holds) {
    for (int i = 0; i < 3000 && !holds(); ++i) std::this_thread::sleep_for(10ms);
    ASSERT_TRUE(holds());
  }
};

TEST_F(SaveEvery, AKilledRunLeavesAMeshThatALaterOneStartsFrom) {
  make_mesh_with_data();
  const pid_t process = start_long("out.vtu");
  wait_until([] { return exists("out.vtu"); });
  const std::string first = read("out.vtu");
  wait_until([&] { return read("out.vtu") != first; });
  kill(process, SIGKILL);
  EXPECT_EQ(wait_for(process), -SIGKILL);
  temper_ok({"check", "out.vtu", "--require", "vertices=2000,inverted=0,nonregular=0"});
  EXPECT_LT(numbers_of("out.vtu")["orthocenters_outside"], numbers_of("in.vtu")["orthocenters_outside"]);
  const auto file = io::read("out.vtu");
  ASSERT_TRUE(file);
  ASSERT_EQ(file->point_data.size(), 1u);
  EXPECT_EQ(file->point_data[0].name, "depth");
  temper_ok({"optimize", "out.vtu", "-o", "out.vtu", "--require", "outside=0,not_crossed=0"});
}

TEST_F(SaveEvery, TheResultIsThatOfARunWithoutIt) {
  make_mesh_with_data();
  temper_ok({"optimize", "in.vtu", "-o", "without.vtu"});
  for (const std::string seconds : {"0", "1e300"}) {
    temper_ok({"optimize", "in.vtu", "-o", "out.vtu", "--save-every", seconds});
    EXPECT_TRUE(read("out.vtu") == read("without.vtu"));
  }
}

TEST_F(SaveEvery, AKilledRunLeavesAMeshOfTetrahedraToo) {
  const TetArrays arrays = shaken(cubes(12, kSixTets), 0.25, 0);
  ASSERT_TRUE(io::write("in.mesh", test::tet_file(arrays.points, arrays.tetrahedra)));
  const pid_t process =
      start({"optimize", "in.mesh", "-o", "out.vtu", "--save-every", "0", "--threads", "1"}, "out.txt", "err.txt");
  wait_until([] { return exists("out.vtu"); });
  kill(process, SIGKILL);
  EXPECT_EQ(wait_for(process), -SIGKILL);
  const nlohmann::json before = numbers_of("in.mesh"), after = numbers_of("out.vtu");
  EXPECT_EQ(after["tetrahedra"], before["tetrahedra"]);
  EXPECT_EQ(after["inverted_tetrahedra"], 0);
  EXPECT_LT(after["orthocenters_outside"], before["orthocenters_outside"]);
}

TEST_F(SaveEvery, TetrahedraHaveTheResultOfARunWithoutItToo) {
  make_tetrahedra();
  temper_ok({"optimize", "two.mesh", "-o", "without.vtu"});
  temper_ok({"optimize", "two.mesh", "-o", "out.vtu", "--save-every", "0"});
  EXPECT_TRUE(read("out.vtu") == read("without.vtu"));
}

TEST_F(SaveEvery, AMeshThatCannotBeWrittenIsOneWarningAndTheRunGoesOn) {
  make_mesh_with_data();
  std::filesystem::create_directory("folder");
  const pid_t process = start_long("folder/out.vtu");
  wait_until([] { return exists("folder/out.vtu"); });
  std::filesystem::rename("folder", "away");
  const std::string warning = "warning: folder/out.vtu: ";
  wait_until([&] { return read("err.txt").find(warning) != std::string::npos; });
  std::this_thread::sleep_for(100ms);
  std::filesystem::rename("away", "folder");
  kill(process, SIGTERM);
  EXPECT_EQ(wait_for(process), 4);
  const std::string said = read("err.txt");
  EXPECT_EQ(said.find(warning), said.rfind(warning)) << said;
  temper_ok({"check", "folder/out.vtu"});
}

TEST_F(SaveEvery, WantsAFileThatCanBeReplaced) {
  make_input();
  for (const std::string output : {"-", "/dev/null"}) {
    const Outcome refused = temper({"optimize", "in.vtu", "-o", output, "--format", "vtu", "--save-every", "3"});
    EXPECT_EQ(refused.exit, 2);
    EXPECT_EQ(refused.out, "");
    EXPECT_TRUE(contains(refused.err, "is not a file that can be replaced"));
  }
  EXPECT_EQ(temper({"optimize", "in.vtu", "-o", "out.vtu", "--save-every", "-1"}).exit, 2);
  EXPECT_FALSE(exists("out.vtu"));
}

}  // namespace
}  // namespace temper::test
