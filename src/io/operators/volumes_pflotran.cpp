// The explicit unstructured grid of PFLOTRAN (.uge): TYPE UNSTRUCTURED_EXPLICIT mesh.uge.
//
//   CELLS n                number x y z volume        numbers count from 1
//   CONNECTIONS n          first second x y z area    the place where the line of the centers crosses the face
#include "io/operators/volumes.hpp"

namespace temper::io {

void write_volumes_pflotran(const DecFolder& folder, const FiniteVolumes& volumes) {
  Output& out = folder.open("mesh.uge");
  out.put("CELLS ", volumes.cells.size(), '\n');
  for (std::size_t i = 0; i < volumes.cells.size(); ++i) {
    const auto& [number, at, volume, material] = volumes.cells[i];
    out.put(i + 1, ' ', at.x, ' ', at.y, ' ', at.z, ' ', volume, '\n');
  }
  out.put("CONNECTIONS ", volumes.connections.size(), '\n');
  for (const FiniteVolumes::Connection& c : volumes.connections)
    out.put(c.first + 1, ' ', c.second + 1, ' ', c.face.x, ' ', c.face.y, ' ', c.face.z, ' ', c.area, '\n');
}

}  // namespace temper::io
