#include "experiments/moment_picture.hpp"

namespace temper::gallery {

void add_mark(MeshPicture& picture, const Moment& moment, VertexId input, const char* color) {
  const VertexId v = moment.find(input);
  if (v.valid()) picture.marks.push_back({moment.mesh.position(v), color});
}

std::vector<Shade> cavities(const Moment& here, const Moment& there) {
  std::vector<Shade> shades;
  for (const TriangleId t : triangles_not_in(here, there)) shades.push_back({t, MarkColor::cavity});
  return shades;
}

}  // namespace temper::gallery
