// The accuracy objective: a twin by brute force, derivatives, and what its steps keep.
#include "tets/optimize/accuracy.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

#include "support/tet_lattice.hpp"
#include "temper/tets/criterion.hpp"
#include "temper/tets/quality.hpp"
#include "tets/energy/star.hpp"
#include "tets/optimize/sweeper.hpp"

namespace temper::tets {
namespace {

constexpr AccuracyModel kBoth = {1, 0.5, 2, 0.25, 0.01};
constexpr AccuracyModel kModels[] = {kBoth, {1, 0, 0, 0, 0.1}, {0, 0, 1, 3, 0.1}};

constexpr Criterion kCriteria[] = {Criterion::well_centered, Criterion::coefficients, Criterion::distances};

TetMesh lattice() { return test::mesh_of(test::shaken(test::body_centered(3), 0.05, 0.05)); }
TetMesh lattice_of_two_regions() {
  TetMesh mesh = lattice();
  for (const TetId t : mesh.tetrahedra()) mesh.set_region(t, t.index % 3 == 0 ? 1 : 0);
  return mesh;
}

/// Sizes, floors and what shall be positive.
struct Domain {
  VertexSizes sizes;
  AccuracyEnergy::Floors floors;
  Criterion criterion;
};
Domain domain_of(const TetMesh& mesh, Criterion criterion = Criterion::well_centered) {
  return {local_sizes(mesh), AccuracyEnergy::Floors(mesh.n_halffaces(), 0.001), criterion};
}

/// V and N of an edge or face, and its number of boundary faces.
struct Element {
  double volume = 0;
  Vec3 moment;
  int boundary = 0;
};

/// E and barrier by their definitions: dual faces as polygons of orthocenters, dual edges as segments.
AccuracyTotal naive_total(const TetMesh& mesh, const Domain& domain, const AccuracyModel& model) {
  std::map<std::vector<VertexId>, Element> elements;
  AccuracyTotal total;
  std::vector<double> heights, units;  // of the halffaces: h/ℓ, μ s³
  const auto at = [&](VertexId v) { return mesh.position(v); };
  const auto face_center = [&](VertexId a, VertexId b, VertexId c) {  // in the plane, far points do not count
    const Vec3 n = cross(at(b) - at(a), at(c) - at(a));
    const Vec3 above = at(a) + n;
    const Vec3 o = orthocenter(mesh.point(a), mesh.point(b), mesh.point(c), {above.x, above.y, above.z, 0});
    return o - dot(n, o - at(a)) / dot(n, n) * n;
  };
  for (const TetId t : mesh.tetrahedra()) {
    const auto points = mesh.points(t);
    const Vec3 o = orthocenter(points[0], points[1], points[2], points[3]);
    double size = 0;
    for (const VertexId v : mesh.corners(t)) size += domain.sizes[v] / 4;
    for (int f = 0; f < 4; ++f) {
      const HalffaceId h = TetMesh::halfface(t, f);
      const auto [a, b, c] = mesh.vertices(h);
      const Vec3 center = face_center(a, b, c), n = 0.5 * cross(at(b) - at(a), at(c) - at(a));
      const double area = length(n), height = dot(n, o - center) / area;
      heights.push_back(height / (kLengthOfArea * std::sqrt(2 * area)));
      units.push_back(model.barrier * size * size * size);
      std::vector<VertexId> key = {a, b, c};
      std::sort(key.begin(), key.end());
      Element& face = elements[key];
      face.volume += area * height;
      face.moment = face.moment + area * height * (0.5 * (center + o) - (1.0 / 3) * (at(a) + at(b) + at(c)));
      face.boundary += mesh.is_boundary(h) ? 1 : 0;
      for (const auto& [i, j, k] : {std::array{a, b, c}, {b, c, a}, {c, a, b}}) {
        // The triangle between edge, face and tetrahedron; its sign is that of the heights of both orthocenters.
        const Vec3 e = at(j) - at(i);
        const double l = length(e), d = dual_crossing(mesh.point(i), mesh.point(j));
        const Vec3 x = at(i) + (d / l) * e;
        const double in_face = signed_height(mesh.point(i), mesh.point(j), mesh.point(k));
        const double part = l * 0.5 * in_face * height;
        Element& edge = elements[i < j ? std::vector{i, j} : std::vector{j, i}];
        edge.volume += part;
        edge.moment = edge.moment + part * ((1.0 / 3) * (x + center + o) - 0.5 * (at(i) + at(j)));
        edge.boundary += mesh.is_boundary(h) ? 1 : 0;
      }
    }
  }
  for (const HalffaceId h : mesh.halffaces()) {
    const bool is_sum = domain.criterion != Criterion::well_centered && !mesh.is_boundary(h) &&
                        mesh.region(TetMesh::tetrahedron(h)) == mesh.region(TetMesh::tetrahedron(mesh.twin(h)));
    const double height = heights[h.index] + (is_sum ? heights[mesh.twin(h).index] : 0);
    total.barrier -= units[h.index] * std::log(height - domain.floors[h]);
  }
  for (const auto& [key, element] : elements) {
    double size = 0;
    for (const VertexId v : key) size += domain.sizes[v] / double(key.size());
    const bool inner = element.boundary == 0;
    const double factor =
        key.size() == 2 ? (inner ? model.edges : model.boundary_edges) : (inner ? model.faces : model.boundary_faces);
    total.energy += factor / (size * size) * squared_length(element.moment) / element.volume;
  }
  return total;
}

AccuracyTotal total_of(const TetMesh& mesh, const Domain& domain, const AccuracyModel& model) {
  return AccuracyEnergy(mesh, domain.sizes, domain.floors, model, domain.criterion).of(mesh, nullptr, nullptr);
}

TEST(TetAccuracy, IsTheSumOfItsDefinition) {
  const TetMesh mesh = lattice_of_two_regions();
  for (const Criterion criterion : kCriteria) {
    const Domain domain = domain_of(mesh, criterion);
    for (const AccuracyModel& model : kModels) {
      const AccuracyTotal total = total_of(mesh, domain, model), naive = naive_total(mesh, domain, model);
      EXPECT_GT(naive.energy, 0);
      EXPECT_NEAR(total.energy, naive.energy, 1e-12 * naive.energy);
      EXPECT_NEAR(total.barrier, naive.barrier, 1e-12 * std::abs(naive.barrier));
    }
  }
}

TEST(TetAccuracy, DifferencesConvergeToTheGradientWithOrderTwo) {
  TetMesh mesh = lattice_of_two_regions();
  for (std::size_t k = 0; k < std::size(kModels); ++k) {
    const Domain domain = domain_of(mesh, kCriteria[k]);
    const AccuracyEnergy energy(mesh, domain.sizes, domain.floors, kModels[k], domain.criterion);
    Gradient gradient;
    (void)energy.of(mesh, &gradient, nullptr);
    double coarse = 0, fine = 0, size = 0;
    for (const VertexId v : mesh.vertices()) {
      if (v.index % 5 != 0) continue;
      const WeightedPoint at = mesh.point(v);
      for (double WeightedPoint::*i : {&WeightedPoint::x, &WeightedPoint::y, &WeightedPoint::z, &WeightedPoint::w}) {
        const auto value = [&](double step) {
          WeightedPoint there = at;
          there.*i += step;
          mesh.set_point(v, there);
          const auto [offsets, barrier] = energy.of(mesh, nullptr, nullptr);
          mesh.set_point(v, at);
          return offsets + barrier;
        };
        const auto difference = [&](double step) { return (value(step) - value(-step)) / (2 * step); };
        coarse += std::abs(difference(0x1p-8) - gradient[v].*i);
        fine += std::abs(difference(0x1p-9) - gradient[v].*i);
        size += std::abs(gradient[v].*i);
      }
    }
    EXPECT_LT(coarse, 0.05 * size);
    EXPECT_LT(fine, 0.27 * coarse);
  }
}

TEST(TetAccuracy, LeavesOutBadTetrahedraAndNegativeDualsOfItsFirstMesh) {
  TetMesh mesh = lattice();
  const VertexId v(mesh.n_vertices() / 2);
  WeightedPoint heavy = mesh.point(v);
  heavy.w -= 4;
  mesh.set_point(v, heavy);
  Domain domain = domain_of(mesh);
  for (const HalffaceId h : mesh.halffaces()) {
    if (height_that_counts(mesh, h, domain.criterion) < 0) domain.floors[h] = AccuracyEnergy::kNoFloor;
  }
  const auto [energy, barrier] = total_of(mesh, domain, kBoth);
  EXPECT_TRUE(std::isfinite(energy) && std::isfinite(barrier));
}

TEST(TetAccuracy, OffsetsOfTheBodyCenteredLatticeVanishInside) {
  const TetMesh mesh = test::mesh_of(test::shaken(test::body_centered(4), 0, 0));
  EXPECT_NEAR(total_of(mesh, domain_of(mesh), {1, 0, 0, 0, 0}).energy, 0, 1e-25);
}

TEST(TetAccuracy, StepsForAnySchemeLowerItsOffsetsAndKeepItsCriterion) {
  TetMesh input = lattice();
  OptimizeOptions only_good;
  only_good.tets.accuracy_steps = 0;
  ASSERT_TRUE(optimize(input, only_good));
  ASSERT_EQ(quality(input).orthocenters_outside, 0U);
  for (const Scheme scheme : {Scheme::vertex, Scheme::cell}) {
    TetMesh mesh = input;
    OptimizeOptions options;
    options.scheme = scheme;
    const auto report = optimize(mesh, options);
    ASSERT_TRUE(report);
    EXPECT_TRUE(meets(mesh, criterion_of(scheme)));
    EXPECT_EQ(mesh.validate(), std::nullopt);
    const AccuracyModel model = accuracy_model(scheme);
    EXPECT_LT(total_of(mesh, domain_of(input), model).energy, 0.95 * total_of(input, domain_of(input), model).energy);
    EXPECT_EQ(report->history.back().objective, Objective::accuracy);
  }
}

}  // namespace
}  // namespace temper::tets
