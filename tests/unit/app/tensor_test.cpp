// --tensor of tetrahedra: regions, data and angles, and weights for each vertex and region in files.
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "support/tet_layers.hpp"
#include "temper/io.hpp"
#include "workshop.hpp"

namespace temper::test {
namespace {

const std::string kOne = "1,0,0,1,0,0.1", kOther = "3,0,0,3,0,30";

std::string spelled(const Tensor3& k) {
  std::ostringstream text;
  text.precision(17);
  for (const double c : k.components()) text << (text.tellp() > 0 ? "," : "") << c;
  return text.str();
}

class Tensors : public Workshop {
 protected:
  /// Writes the layers, with cell data of these names.
  static void make_layers(const std::vector<io::DataArray>& data = {}, const CubeCut& cut = kSixTets) {
    const tets::TetMesh mesh = two_layers(4, 0.1, 0, cut);
    io::MeshFile file;
    std::vector<Vec3> points;
    for (const VertexId v : mesh.vertices()) points.push_back(mesh.position(v));
    for (const tets::TetId t : mesh.tetrahedra()) {
      std::array<std::int32_t, 4> corners;
      for (std::size_t k = 0; k < 4; ++k) corners[k] = static_cast<std::int32_t>(mesh.corners(t)[k].index);
      if (t.index % 2 == 1) std::swap(corners[0], corners[1]);  // files have both orientations
      file.tetrahedra.add(corners, mesh.region(t));
    }
    ASSERT_TRUE(io::set_points(file, points));  // of space, since there are tetrahedra
    file.tetrahedra.data = data;
    ASSERT_TRUE(io::write("in.vtu", file));
  }
  static std::size_t n_layers_tetrahedra() { return two_layers(4, 0.1, 0, kSixTets).n_tetrahedra(); }

  /// A value of region 1 at its tetrahedra, and another one at the others.
  static std::vector<double> of_regions(double one, double other) {
    std::vector<double> values;
    const tets::TetMesh mesh = two_layers(4, 0.1, 0, kSixTets);
    for (const tets::TetId t : mesh.tetrahedra()) values.push_back(mesh.region(t) == 1 ? one : other);
    return values;
  }
  std::string star1(const std::vector<std::string>& options) {
    std::vector<std::string> words = {"operators", "in.vtu", "-o", "out", "--format", "mtx"};
    words.insert(words.end(), options.begin(), options.end());
    temper_ok(words);
    return read("out/star1.mtx");
  }
};

TEST_F(Tensors, OfRegionsMakeTetrahedraWellCenteredAndFilesHoldTheWeights) {
  make_layers();
  const std::vector<std::string> tensors = {"--tensor", "1=" + kOne, "--tensor", "2=" + kOther};
  const auto with = [&](std::vector<std::string> words) {
    words.insert(words.end(), tensors.begin(), tensors.end());
    return temper_ok(words);
  };
  const auto count = [&](const std::string& path) {
    return nlohmann::json::parse(with({"check", path, "--json"}).out);
  };
  with({"optimize", "in.vtu", "-o", "out.vtu", "--effort", "quick"});
  const auto before = count("in.vtu"), after = count("out.vtu");
  EXPECT_LT(after.at("orthocenters_outside"), before.at("orthocenters_outside"));
  const auto plain = nlohmann::json::parse(temper_ok({"check", "in.vtu", "--json"}).out);
  for (const char* key : {"vertices", "inner_vertices", "edges", "faces", "boundary_faces", "regions"})
    EXPECT_EQ(before.at(key), plain.at(key)) << key;
  EXPECT_EQ(with({"check", "out.vtu"}).err, "");  // no interface has two crossings
  const auto file = io::read("out.vtu");
  ASSERT_TRUE(file);
  ASSERT_EQ(file->tetrahedra.data.size(), 1U);
  EXPECT_EQ(file->tetrahedra.data[0].name, "corner_weights");
  EXPECT_EQ(file->tetrahedra.data[0].components, 4);
  with({"weights", "out.vtu", "-o", "weighted.vtu", "--mode", "elastic", "--constraints", "distances"});
  EXPECT_EQ(with({"check", "weighted.vtu"}).err, "");
  const Outcome uneven = temper_ok({"check", "in.vtu", "--tensor", "1=" + kOne, "--tensor", "2=1,0.5,0,4,0,1"});
  EXPECT_TRUE(contains(uneven.err, "the metrics of the tensors differ within its faces")) << uneven.err;
}

TEST_F(Tensors, CertificatesNameCopiesAndAreCheckedWithTheTensors) {
  make_layers({}, kFiveTets);
  write(
      "rock.poly",
      "6 2 0 0\n0 0 0\n1 1 0\n2 1 0.6\n3 1 1\n4 0 1\n5 0 0.4\n7 0\n0 0 1\n1 1 2\n2 2 3\n3 3 4\n4 4 5\n5 5 0\n6 5 2\n0\n"
      "2\n0 0.5 0.1 1\n1 0.5 0.9 2\n");
  temper_ok({"mesh", "rock.poly", "-o", "rock.vtu", "--size", "0.2"});
  struct Case {
    std::string path;
    std::vector<std::string> tensors, others;
  };
  const std::vector<Case> cases = {
      {"in.vtu", {"--tensor", "1=" + spelled(kLower), "--tensor", "2=" + spelled(kUpper)}, {"--tensor", "1,0,0,1,0,1"}},
      {"rock.vtu", {"--tensor", "1=1,0,4", "--tensor", "2=3,1,2"}, {"--tensor", "1,0,1"}}};
  for (const auto& [path, tensors, others] : cases) {
    const auto run = [&](std::vector<std::string> words, const std::vector<std::string>& with) {
      words.insert(words.end(), with.begin(), with.end());
      return temper(words);
    };
    const Outcome outcome = run({"weights", path, "--mode", "margin", "--json", "--certificate", "why.json"}, tensors);
    EXPECT_EQ(outcome.exit, 6) << outcome.err;
    const auto proof = nlohmann::json::parse(read("why.json"));
    EXPECT_EQ(nlohmann::json::parse(outcome.out).at("certificate"), proof);
    const Outcome checked = run({"weights", path, "--check-certificate", "why.json"}, tensors);
    EXPECT_EQ(checked.exit, 0) << checked.err;
    EXPECT_TRUE(contains(checked.out, "proves it for " + path)) << checked.out;
    EXPECT_EQ(run({"weights", path, "--check-certificate", "why.json"}, others).exit, 1);
    const auto reasons = nlohmann::json::parse(run({"explain", path, "--json"}, tensors).out).at("reasons");
    ASSERT_FALSE(reasons.empty());
    temper_ok([&] {
      std::vector<std::string> words = {"draw", path, "-o", "picture.svg"};
      words.insert(words.end(), tensors.begin(), tensors.end());
      return words;
    }());
    if (path == "in.vtu") continue;
    for (const auto& reason : reasons) {
      if (reason.at("certificate").is_null()) continue;
      write("reason.json", reason.at("certificate").dump());
      EXPECT_EQ(run({"weights", path, "--check-certificate", "reason.json"}, tensors).exit, 0) << reason;
    }
  }
}

TEST_F(Tensors, ComeFromRegionsDataAndAnglesAlike) {
  make_layers();
  const std::string expected = star1({"--tensor", "1=2,0,0,2,0,2", "--tensor", "2=7,0,0,7,0,7"});
  EXPECT_EQ(expected, star1({"--coefficient", "1=2,2=7"}));
  const std::size_t n = n_layers_tetrahedra();
  std::vector<double> six;
  for (const double k : of_regions(2, 7)) six.insert(six.end(), {k, 0, 0, k, 0, k});
  const std::vector<double> zero(n, 0), right(n, 90);
  make_layers({{"k", 6, six},
               {"k11", 1, of_regions(2, 7)},
               {"k22", 1, of_regions(2, 7)},
               {"k33", 1, of_regions(2, 7)},
               {"angle1", 1, right},
               {"angle2", 1, zero},
               {"angle3", 1, right}});
  EXPECT_EQ(expected, star1({"--tensor", "k"}));
  EXPECT_EQ(expected, star1({"--tensor", "k11,k22,k33,angle2"}));
}

TEST_F(Tensors, AnglesTurnAxesAsModflowDoes) {
  // Right angles exchange axes. angle1 turns x to y. angle2 lifts the first axis to z. angle3 turns the second to -z.
  struct Case {
    double angle1, angle2, angle3;
    std::string tensor;
  };
  const std::size_t n = n_layers_tetrahedra();
  const auto all = [n](double value) { return std::vector<double>(n, value); };
  for (const Case& c : {Case{0, 0, 0, "1,0,0,2,0,3"},
                        {90, 0, 0, "2,0,0,1,0,3"},
                        {0, 90, 0, "3,0,0,2,0,1"},
                        {0, 0, 90, "1,0,0,3,0,2"},
                        {90, 90, 0, "2,0,0,3,0,1"},
                        {45, 0, 0, "1.5,-0.5,0,1.5,0,3"},
                        {0, 45, 0, "2,0,-1,2,0,2"},
                        {0, 0, 45, "1,0,0,2.5,0.5,2.5"}}) {
    make_layers({{"k11", 1, all(1)},
                 {"k22", 1, all(2)},
                 {"k33", 1, all(3)},
                 {"angle1", 1, all(c.angle1)},
                 {"angle2", 1, all(c.angle2)},
                 {"angle3", 1, all(c.angle3)}});
    const auto sum = [&](const std::vector<std::string>& options) {
      std::vector<std::string> words = {"operators", "in.vtu", "-o", "out", "--format", "mtx", "--json"};
      words.insert(words.end(), options.begin(), options.end());
      return nlohmann::json::parse(temper_ok(words).out).at("median_star1").get<double>();
    };
    EXPECT_NEAR(sum({"--tensor", "k11,k22,k33,angle1,angle2,angle3"}), sum({"--tensor", c.tensor}), 1e-9) << c.tensor;
  }
}

TEST_F(Tensors, FilesOfCellsHaveTheFluxWithAPermeabilityOfOne) {
  make_layers();
  const auto cells_of = [&](const std::vector<std::string>& options) {
    std::vector<std::string> words = {"operators", "in.vtu", "-o", "out", "--format", "tough,uge,mtx"};
    words.insert(words.end(), options.begin(), options.end());
    temper_ok(words);
    return read("out/MESH");
  };
  EXPECT_EQ(cells_of({}), cells_of({"--tensor", "1,0,0,1,0,1"}));
  cells_of({"--tensor", "1=" + kOne, "--tensor", "2=" + kOther});
  std::istringstream cells(read("out/mesh.uge")), star1(read("out/star1.mtx"));
  std::string word;
  std::size_t n = 0, n_edges = 0, first = 0, second = 0;
  cells >> word >> n;
  std::vector<Vec3> centers(n);
  double volume = 0, sum = 0, area = 0;
  for (Vec3& c : centers) cells >> first >> c.x >> c.y >> c.z >> volume, sum += volume;
  EXPECT_NEAR(sum, 64, 1e-9);
  while (std::getline(star1, word) && word[0] == '%') {
  }
  cells >> word >> n;
  for (std::size_t i = 0; i < n; ++i) {
    Vec3 face;
    double star = 0;
    cells >> first >> second >> face.x >> face.y >> face.z >> area;
    do {
      star1 >> n_edges >> n_edges >> star;
    } while (star == 0 && star1);
    const double distance = length(centers[second - 1] - centers[first - 1]);
    ASSERT_NEAR(area, star * distance, 1e-9 * std::abs(area)) << i;
  }
}

TEST_F(Tensors, WrongOnesAreToldWithWhatTetrahedraNeed) {
  make_layers();
  const auto refused = [&](const std::string& tensor, const std::string& message) {
    const Outcome outcome = temper({"check", "in.vtu", "--tensor", tensor});
    EXPECT_EQ(outcome.exit, 2) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, message)) << outcome.err;
  };
  refused("1,0,1", "in.vtu: --tensor: tetrahedra need 6 numbers KXX,KXY,KXZ,KYY,KYZ,KZZ, found 3");
  refused("1=1,0,1", "tetrahedra need 6 numbers");
  refused("1=1,0,0,1,0,1", "there is no value for region 2");
  refused("1,0,0,1,0", "for tetrahedra six numbers KXX,KXY,KXZ,KYY,KYZ,KZZ; found 5");
  refused("1,2,0,1,0,1", "expected a positive definite tensor kxx,kxy,kxz,kyy,kyz,kzz");
  refused("a,b,c",
          "tetrahedra need one name of cell data, 6 names of kxx,kxy,kxz,kyy,kyz,kzz, or "
          "k11,k22,k33,angle1[,angle2[,angle3]]; found 3 names");
  refused("k", "there are no cell data 'k' of six numbers");
}

}  // namespace
}  // namespace temper::test
