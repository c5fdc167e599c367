// Meshes in archives: bit for bit with all ids; what is no mesh is none.
#include <gtest/gtest.h>

#include "base/rng.hpp"
#include "mesh/connectivity.hpp"
#include "mesh/mesh_archive.hpp"
#include "support/regions.hpp"
#include "temper/generate.hpp"

namespace temper {
namespace {

std::string bytes_of(Mesh mesh) {
  std::string bytes;
  Archive archive(bytes);
  archive(mesh);
  return bytes;
}

Mesh mesh_of(std::string_view bytes) {
  Mesh mesh = test::mesh_with_regions(40, 1);
  Archive archive(bytes);
  archive(mesh);
  EXPECT_TRUE(archive.at_end() || mesh == Mesh());
  return mesh;
}

TEST(MeshArchives, GiveBackTheMeshBitForBit) {
  for (const Mesh& mesh : {test::mesh_with_regions(60, 2), *annulus(), *icosahedral({.level = 1}),
                           *random_periodic({.vertices = 60}), Mesh()}) {
    const Mesh read = mesh_of(bytes_of(mesh));
    EXPECT_TRUE(read == mesh);
    for (const VertexId v : mesh.vertices()) EXPECT_EQ(read.outgoing(v), mesh.outgoing(v));
  }
}

TEST(MeshArchives, OfBytesThatSomebodyChangedAreMeshesOrNone) {
  const std::string bytes = bytes_of(test::mesh_with_regions(40, 3));
  Rng rng(1);
  int none = 0;
  constexpr int kTries = 3000;
  for (int i = 0; i < kTries; ++i) {
    std::string changed = bytes;
    for (std::uint32_t k = 0; k <= rng.below(3); ++k) {
      changed[rng.below(static_cast<std::uint32_t>(bytes.size()))] = static_cast<char>(rng.below(256));
    }
    const Mesh mesh = mesh_of(changed);
    EXPECT_EQ(broken_connectivity(mesh), std::nullopt);
    if (mesh == Mesh()) ++none;
  }
  EXPECT_GT(none, kTries / 4);
  EXPECT_LT(none, kTries);
}

}  // namespace
}  // namespace temper
