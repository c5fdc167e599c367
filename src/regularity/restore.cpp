// restore_regularity: Lawson on all edges, then the names of the vertices that stuck edges run into.
#include "regularity/hidden.hpp"
#include "regularity/lawson.hpp"
#include "temper/regularity.hpp"

namespace temper {

Restoration restore_regularity(Mesh& mesh, HiddenPolicy /*policy*/, const RestorationObserver* /*observer*/) {
  Lawson lawson;
  lawson.push_all(mesh);
  Restoration result;
  result.flips = lawson.run(mesh).flips;
  result.stuck = lawson.stuck(mesh);
  if (!result.stuck.empty()) result.hidden = hidden_vertices(mesh, result.stuck);
  return result;
}

}  // namespace temper
