// What takes meshes of the plane alone says so of a mesh of the sphere, instead of reading two of its three
// coordinates.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "temper/connectivity.hpp"
#include "temper/explain.hpp"
#include "temper/feasibility.hpp"
#include "temper/generate.hpp"
#include "temper/lp.hpp"

namespace temper {
namespace {

TEST(PlaneAlone, IsSaidOfASphere) {
  const auto globe = icosahedral({.level = 1});
  ASSERT_TRUE(globe);
  const Mesh& mesh = *globe;
  const auto error_of = [](const auto& result) { return result ? InputError() : result.error(); };
  struct Row {
    const char* what;
    std::function<InputError()> call;
  };
  const std::vector<Row> rows = {
      {"find_weights()", [&] { return error_of(find_weights(mesh, *clp_solver())); }},
      {"best_connectivity()", [&] { return error_of(best_connectivity(mesh, *clp_solver())); }},
      {"explain()", [&] { return error_of(explain(mesh, *clp_solver())); }},
  };
  for (const Row& row : rows) {
    const InputError error = row.call();
    EXPECT_EQ(error.code, ErrorCode::unsupported) << row.what;
    EXPECT_EQ(error.message,
              std::string("the mesh is one of the sphere, and ") + row.what + " takes meshes of the plane");
  }
  EXPECT_FALSE(expect_plane(*annulus(), "anything"));
}

}  // namespace
}  // namespace temper
