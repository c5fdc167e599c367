// A program as users of the core library write it: it builds a mesh, measures it, draws it.
#include <array>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "temper/draw.hpp"
#include "temper/mesh.hpp"
#include "temper/quality.hpp"

int main() {
  const std::vector<temper::Vec2> points = {{0, 0}, {2, 0}, {1, 2}};
  const std::vector<std::array<std::int32_t, 3>> triangles = {{0, 1, 2}};
  temper::MeshInput input;
  input.points = points;
  input.triangles = triangles;
  const auto built = temper::Mesh::build(input);
  if (!built) {
    std::printf("%s\n", built.error().what().c_str());
    return 1;
  }
  const temper::Quality quality = temper::quality(built->mesh);
  const std::string picture = temper::draw_svg(built->mesh);
  std::printf("%zu triangle, %zu bytes of picture\n", quality.triangles, picture.size());
  return quality.triangles == 1 && quality.well_centered_fraction == 1 && !picture.empty() ? 0 : 1;
}
