// Cavities and cones: each operation by its numbers, and the laws that hold for all.
#include <gtest/gtest.h>

#include <map>

#include "support/tet_lattice.hpp"
#include "temper/tets/quality.hpp"
#include "tets/optimize/draft.hpp"

namespace temper::tets {
namespace {

WeightedPoint middle(const TetMesh& mesh, const Cavity& cavity) {
  WeightedPoint p;
  for (const HalffaceId h : cavity.faces) {
    for (const VertexId v : mesh.vertices(h))
      p = {p.x + mesh.point(v).x, p.y + mesh.point(v).y, p.z + mesh.point(v).z, 0};
  }
  const double n = 3 * static_cast<double>(cavity.faces.size());
  return {p.x / n, p.y / n, p.z / n, 0};
}

std::vector<VertexId> corners_of(const TetMesh& mesh, const Cavity& cavity) {
  std::vector<VertexId> all;
  for (const HalffaceId h : cavity.faces) {
    for (const VertexId v : mesh.vertices(h)) {
      if (std::find(all.begin(), all.end(), v) == all.end()) all.push_back(v);
    }
  }
  return all;
}

/// Expects what each filling keeps, and returns the mesh.
TetMesh fill(const TetMesh& mesh, const Filling& filling) {
  const auto made = filled(mesh, {&filling, 1}, Names(mesh));
  EXPECT_TRUE(made.has_value());
  const auto& [after, names] = *made;
  EXPECT_EQ(after.validate(), std::nullopt);
  const Quality a = quality(mesh), b = quality(after);
  EXPECT_NEAR(b.volume, a.volume, 1e-12 * a.volume);
  EXPECT_EQ(b.boundary_faces, a.boundary_faces);
  EXPECT_EQ(b.inverted_tetrahedra, 0U);
  EXPECT_EQ(names.vertices.size(), after.n_vertices());
  for (const VertexId v : after.vertices()) {
    const VertexId name = names.vertices[v];
    EXPECT_EQ(after.point(v), name.index < mesh.n_vertices() ? mesh.point(name) : filling.point);
  }
  return after;
}

std::ptrdiff_t gained(const TetMesh& before, const TetMesh& after) {
  return static_cast<std::ptrdiff_t>(after.n_tetrahedra()) - static_cast<std::ptrdiff_t>(before.n_tetrahedra());
}

struct Tally {
  std::size_t valid = 0, refused = 0;
};

/// Tries each corner of a cavity as an apex, and a new vertex in the middle.
void try_all(const TetMesh& mesh, const Cavity& cavity, Tally& tally, VertexId removed = {}) {
  if (!removed.valid()) {
    const Filling split{cavity, {}, middle(mesh, cavity), {}};
    if (is_valid(mesh, split)) {
      EXPECT_EQ(gained(mesh, fill(mesh, split)),
                std::ptrdiff_t(cavity.faces.size()) - std::ptrdiff_t(cavity.tetrahedra.size()));
      ++tally.valid;
    }
  }
  for (const VertexId v : corners_of(mesh, cavity)) {
    const Filling cone{cavity, v, {}, removed};
    if (!is_valid(mesh, cone)) {
      ++tally.refused;
      continue;
    }
    const TetMesh after = fill(mesh, cone);
    EXPECT_EQ(after.n_vertices(), mesh.n_vertices() - (removed.valid() ? 1 : 0));
    ++tally.valid;
  }
}

TEST(TetTopology, EveryValidConeFillsItsCavityExactly) {
  const TetMesh mesh = test::mesh_of(test::shaken(test::body_centered(2), 0.2, 0.1));
  const Cavities cavities(mesh);
  std::map<std::string, Tally> tallies;
  for (const TetId t : mesh.tetrahedra()) {
    try_all(mesh, cavities.of_tetrahedron(t), tallies["tetrahedron"]);
    for (int f = 0; f < 4; ++f) {
      if (const auto cavity = cavities.of_face(TetMesh::halfface(t, f))) try_all(mesh, *cavity, tallies["face"]);
    }
    const auto& corners = mesh.corners(t);
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) {
        const auto cavity = cavities.of_edge(t, corners[i], corners[j]);
        if (cavity && t.index % 4 == 0) try_all(mesh, *cavity, tallies["edge"]);
      }
    }
  }
  const auto on_boundary = boundary_vertices(mesh);
  for (const VertexId v : mesh.vertices()) {
    const auto cavity = cavities.of_vertex(v);
    EXPECT_EQ(cavity.has_value(), on_boundary[v] == 0);
    if (cavity) try_all(mesh, *cavity, tallies["vertex"], v);
  }
  for (const char* kind : {"tetrahedron", "face", "edge"}) {
    EXPECT_GT(tallies[kind].valid, 10U) << kind;
    EXPECT_TRUE(std::string(kind) == "tetrahedron" || tallies[kind].refused > 0) << kind;
  }
  EXPECT_GT(tallies["vertex"].valid, 0U);
  EXPECT_GT(tallies["vertex"].refused, 0U);
}

TEST(TetTopology, Flips23And32AreInverse) {
  test::TetArrays two;
  two.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 1}, {0.3, 0.3, -1}};
  two.tetrahedra = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  const TetMesh mesh = test::mesh_of(two);
  const auto face = Cavities(mesh).of_face(TetMesh::halfface(TetId(0), 3));
  ASSERT_TRUE(face);
  const TetMesh three = fill(mesh, {*face, VertexId(3), {}, {}});
  EXPECT_EQ(three.n_tetrahedra(), 3U);
  const auto edge = Cavities(three).of_edge(TetId(0), VertexId(3), VertexId(4));
  ASSERT_TRUE(edge);
  EXPECT_EQ(edge->tetrahedra.size(), 3U);
  const TetMesh again = fill(three, {*edge, VertexId(0), {}, {}});
  EXPECT_EQ(again.n_tetrahedra(), 2U);
  EXPECT_EQ(fill(three, {*edge, VertexId(3), {}, {}}).n_tetrahedra(), 3U);  // the cone of an end of the edge: the same
}

TEST(TetTopology, InterfacesAndTagsAreInNoCavity) {
  const test::TetArrays arrays = test::shaken(test::body_centered(2), 0, 0);
  const TetMesh plain = test::mesh_of(arrays);
  TetId t;
  HalffaceId inner;
  for (const HalffaceId h : plain.halffaces()) {
    if (!plain.is_boundary(h)) inner = h;
  }
  t = TetMesh::tetrahedron(inner);
  const auto corners = plain.vertices(inner);
  const auto at = [&](std::size_t k) { return static_cast<std::int32_t>(corners[k].index); };
  ASSERT_TRUE(Cavities(plain).of_face(inner));
  const std::vector<std::int32_t> tag = {1};

  const std::vector<std::array<std::int32_t, 3>> faces = {{at(0), at(1), at(2)}};
  TetMeshInput in = arrays.input();
  in.faces = faces, in.face_tags = tag;
  const TetMesh tagged = test::built(in).mesh;
  EXPECT_FALSE(Cavities(tagged).of_face(inner));
  EXPECT_FALSE(Cavities(tagged).of_face(tagged.twin(inner)));
  EXPECT_FALSE(Cavities(tagged).of_edge(t, corners[0], corners[1]));

  std::vector<std::int32_t> regions(arrays.tetrahedra.size(), 0);
  regions[t.index] = 1;
  in = arrays.input();
  in.regions = regions;
  const TetMesh two = test::built(in).mesh;
  EXPECT_FALSE(Cavities(two).of_face(inner));
  EXPECT_FALSE(Cavities(two).of_edge(t, corners[0], corners[1]));

  std::size_t refused = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto ring = Cavities(plain).of_edge(t, corners[k], corners[(k + 1) % 3]);
    const std::vector<std::array<std::int32_t, 2>> lines = {{at((k + 1) % 3), at(k)}};
    in = arrays.input();
    in.lines = lines, in.line_tags = tag;
    const TetMesh lined = test::built(in).mesh;
    EXPECT_FALSE(Cavities(lined).of_edge(t, corners[k], corners[(k + 1) % 3]));
    EXPECT_FALSE(Cavities(lined).of_vertex(corners[k]));
    refused += ring ? 1 : 0;
  }
  EXPECT_GT(refused, 0U);
}

TEST(TetTopology, AVertexOnATaggedLineIsInNoCavity) {
  const test::TetArrays arrays = test::shaken(test::body_centered(2), 0, 0);
  const TetMesh plain = test::mesh_of(arrays);
  std::size_t inner = 0;
  for (const VertexId v : plain.vertices()) {
    if (!Cavities(plain).of_vertex(v)) continue;
    ++inner;
    const auto& corners = plain.corners(plain.incident(v));
    const VertexId other = corners[0] == v ? corners[1] : corners[0];
    const std::vector<std::array<std::int32_t, 2>> lines = {
        {static_cast<std::int32_t>(v.index), static_cast<std::int32_t>(other.index)}};
    const std::vector<std::int32_t> tag = {1};
    TetMeshInput in = arrays.input();
    in.lines = lines, in.line_tags = tag;
    EXPECT_FALSE(Cavities(test::built(in).mesh).of_vertex(v));
  }
  EXPECT_GT(inner, 0U);
}

TEST(TetTopology, TagsAndRegionsOfOtherPartsStay) {
  const test::TetArrays arrays = test::shaken(test::body_centered(2), 0, 0);
  const TetMesh plain = test::mesh_of(arrays);
  std::vector<std::array<std::int32_t, 3>> faces;
  std::vector<std::int32_t> tags, regions(arrays.tetrahedra.size(), 5), point = {0}, point_tag = {3};
  for (const HalffaceId h : plain.halffaces()) {
    if (!plain.is_boundary(h)) continue;
    const auto [a, b, c] = plain.vertices(h);
    faces.push_back({std::int32_t(a.index), std::int32_t(b.index), std::int32_t(c.index)});
    tags.push_back(static_cast<std::int32_t>(h.index));
  }
  TetMeshInput in = arrays.input();
  in.faces = faces, in.face_tags = tags, in.regions = regions, in.marked_points = point, in.point_tags = point_tag;
  in.fixed_points = point;
  const TetMesh mesh = test::built(in).mesh;
  const Cavity cavity = Cavities(mesh).of_tetrahedron(TetId(3));
  const TetMesh after = fill(mesh, {cavity, {}, middle(mesh, cavity), {}});
  ASSERT_EQ(after.tagged_faces().size(), faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    EXPECT_EQ(after.tagged_faces()[i].tag, tags[i]);
    EXPECT_EQ(after.vertices(after.tagged_faces()[i].face), mesh.vertices(mesh.tagged_faces()[i].face));
  }
  EXPECT_EQ(after.tagged_points(), mesh.tagged_points());
  EXPECT_EQ(after.fixed_points(), std::vector<VertexId>{VertexId(0)});
  for (const TetId t : after.tetrahedra()) EXPECT_EQ(after.region(t), 5);
}

/// Two regions in cubes cut in six, with tags on all faces of the boundary and the interface, and on lines of both.
TetMesh tagged_cubes(int n) {
  const test::TetArrays arrays = test::shaken(test::cubes(n, test::kSixTets), 0.1, 0.05);
  const TetMesh plain = test::mesh_of(arrays);
  std::vector<std::int32_t> regions, face_tags, line_tags;
  for (const TetId t : plain.tetrahedra()) regions.push_back(plain.region(t) + (t.index < plain.n_tetrahedra() / 2));
  TetMeshInput in = arrays.input();
  in.regions = regions;
  const TetMesh parted = test::built(in).mesh;
  std::vector<std::array<std::int32_t, 3>> faces;
  std::vector<std::array<std::int32_t, 2>> lines;
  for (const HalffaceId h : parted.halffaces()) {
    if (!parted.bounds_region(h) || !parted.is_face_representative(h)) continue;
    const auto [a, b, c] = parted.vertices(h);
    faces.push_back({std::int32_t(a.index), std::int32_t(b.index), std::int32_t(c.index)});
    face_tags.push_back(static_cast<std::int32_t>(faces.size() % 3));
    if (faces.size() % 4 != 0) continue;
    lines.push_back({std::int32_t(c.index), std::int32_t(a.index)});
    line_tags.push_back(static_cast<std::int32_t>(lines.size()));
  }
  in.faces = faces, in.face_tags = face_tags, in.lines = lines, in.line_tags = line_tags;
  return test::built(in).mesh;
}

/// What no change of connectivity may alter: volumes of regions, areas and lengths of tags.
std::map<std::string, double> sizes_of_parts(const TetMesh& mesh) {
  std::map<std::string, double> sizes;
  for (const TetId t : mesh.tetrahedra()) {
    const auto [p, q, r, s] = mesh.points(t);
    sizes["region " + std::to_string(mesh.region(t))] +=
        six_volumes(p.position(), q.position(), r.position(), s.position()) / 6;
  }
  for (const auto& [face, tag] : mesh.tagged_faces()) {
    const auto [a, b, c] = mesh.vertices(face);
    const Vec3 p = mesh.position(a);
    sizes["face " + std::to_string(tag)] += length(cross(mesh.position(b) - p, mesh.position(c) - p)) / 2;
  }
  for (const auto& [ends, tag] : mesh.tagged_lines())
    sizes["line " + std::to_string(tag)] += length(mesh.position(ends[0]) - mesh.position(ends[1]));
  return sizes;
}
void expect_same_parts(const TetMesh& before, const TetMesh& after) {
  const auto a = sizes_of_parts(before), b = sizes_of_parts(after);
  ASSERT_EQ(a.size(), b.size());
  for (const auto& [part, size] : a) EXPECT_NEAR(b.at(part), size, 1e-13) << part;
  EXPECT_EQ(after.validate(), std::nullopt);
}

TEST(TetTopology, SplitsOfTheBoundaryAndOfInterfacesKeepAllParts) {
  const TetMesh mesh = tagged_cubes(2);
  const Cavities cavities(mesh);
  std::size_t edges = 0, faces = 0;
  const auto try_split = [&](const Cavity& cavity, std::size_t& count) {
    const double share = 1 / static_cast<double>(cavity.split.size());
    Filling filling{cavity, {}, {}, {}};
    for (const VertexId v : cavity.split) {
      const Vec3 p = mesh.position(v);
      filling.point.x += share * p.x, filling.point.y += share * p.y, filling.point.z += share * p.z;
    }
    ASSERT_TRUE(is_valid(mesh, filling));
    const auto made = filled(mesh, {&filling, 1}, Names(mesh));
    ASSERT_TRUE(made);
    expect_same_parts(mesh, made->first);
    const std::size_t pieces = cavity.split.size();
    EXPECT_EQ(made->first.n_tetrahedra(), mesh.n_tetrahedra() + (pieces - 1) * cavity.tetrahedra.size());
    const auto& names = made->second;
    EXPECT_TRUE(std::is_sorted(names.faces.begin(), names.faces.end()));
    for (std::size_t i = 0; i < names.faces.size(); ++i)
      EXPECT_EQ(made->first.tagged_faces()[i].tag, mesh.tagged_faces()[names.faces[i]].tag);
    ++count;
  };
  for (const TetId t : mesh.tetrahedra()) {
    const auto& corners = mesh.corners(t);
    for (int f = 0; f < 4; ++f) {
      const HalffaceId h = TetMesh::halfface(t, f);
      const auto cavity = cavities.to_split(h);
      EXPECT_EQ(cavity.has_value(), mesh.bounds_region(h));
      if (cavity) try_split(*cavity, faces);
    }
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) {
        const auto cavity = cavities.to_split(t, corners[i], corners[j]);
        EXPECT_NE(cavity.has_value(), cavities.of_edge(t, corners[i], corners[j]).has_value());
        if (cavity) try_split(*cavity, edges);
      }
    }
  }
  EXPECT_GT(edges, 50U);
  EXPECT_GT(faces, 50U);
}

TEST(TetTopology, PatchesFitBackWithAndWithoutChanges) {
  const TetMesh mesh = tagged_cubes(3);
  IdVector<VertexId, Mobility> mobility(mesh.n_vertices(), Mobility::free);
  const Draft whole(mesh, mobility);
  std::vector<TetId> low, high;
  for (const TetId t : mesh.tetrahedra()) {
    double x = 0;
    for (const VertexId v : mesh.corners(t)) x += mesh.position(v).x / 4;
    if (x < 1)
      low.push_back(t);
    else if (x > 2)
      high.push_back(t);
  }
  PatchMaker maker(whole);
  std::vector<Patch> patches = {maker.make(low), maker.make(high)};
  Draft same = whole;
  ASSERT_TRUE(put_back(patches, same));
  expect_same_parts(mesh, same.mesh);
  EXPECT_EQ(same.mesh.n_tetrahedra(), mesh.n_tetrahedra());
  EXPECT_EQ(same.names.vertices.size(), mesh.n_vertices());
  for (const VertexId v : same.mesh.vertices()) EXPECT_EQ(same.mesh.point(v), mesh.point(same.names.vertices[v]));
  EXPECT_EQ(same.names.faces, whole.names.faces);
  EXPECT_EQ(same.names.lines, whole.names.lines);

  // All splits that touch nothing of another tetrahedron: inside, at an interface, and on the boundary.
  std::size_t splits = 0;
  for (Patch& patch : patches) {
    const auto stays = [&](VertexId v) { return patch.draft.mobility_of(v) == Mobility::none; };
    for (const std::size_t edge_of_boundary : {0U, 1U}) {
      const TetMesh& part = patch.draft.mesh;
      const Cavities cavities(part);
      IdVector<TetId, std::uint8_t> used(part.n_tetrahedra());
      std::vector<Filling> fillings;
      const auto try_edge = [&](TetId t, VertexId a, VertexId b) {
        if (stays(a) && stays(b)) return;
        const auto cavity = edge_of_boundary != 0 ? cavities.to_split(t, a, b) : cavities.of_edge(t, a, b);
        if (!cavity) return;
        const auto& all = cavity->tetrahedra;
        if (std::any_of(all.begin(), all.end(), [&](TetId s) { return used[s] != 0; })) return;
        const Vec3 p = 0.5 * (part.position(a) + part.position(b));
        for (const TetId s : all) used[s] = 1;
        fillings.push_back({*cavity, {}, {p.x, p.y, p.z, 0.01}, {}});
      };
      for (const TetId t : part.tetrahedra()) {
        const auto& c = part.corners(t);
        for (std::size_t i = 0; i < 4; ++i) {
          for (std::size_t j = i + 1; j < 4; ++j) try_edge(t, c[i], c[j]);
        }
      }
      splits += fillings.size();
      EXPECT_GT(fillings.size(), 1U);
      ASSERT_TRUE(patch.draft.fill(fillings));
    }
  }
  Draft changed = whole;
  ASSERT_TRUE(put_back(patches, changed));
  expect_same_parts(mesh, changed.mesh);
  EXPECT_EQ(changed.mesh.n_vertices(), mesh.n_vertices() + splits);
  EXPECT_EQ(changed.mobility.size(), mesh.n_vertices() + splits);
  for (const VertexId v : changed.mesh.vertices()) {
    const VertexId name = changed.names.vertices[v];
    if (name.index < mesh.n_vertices())
      EXPECT_EQ(changed.mesh.point(v), mesh.point(name));
    else
      EXPECT_EQ(changed.mesh.weight(v), 0.01);
  }
}

}  // namespace
}  // namespace temper::tets
