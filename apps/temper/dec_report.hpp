// The reports of `temper dec` on the operators it wrote: as text, as JSON, and as warnings.
#pragma once

#include <string>
#include <vector>

#include "temper/columns.hpp"
#include "temper/dec.hpp"

namespace temper::app {

struct DecRecord {
  std::string path;  ///< of the mesh
  const DecSummary& summary;
  const PowerCells& cells;
  const Columns* columns;  ///< null: without layers
  std::vector<std::string> files;
};

[[nodiscard]] std::string dec_text(const DecRecord& record);
[[nodiscard]] std::string dec_json(const DecRecord& record);
/// The warnings that the author of a solver should read before using the operators: none for a well-centered mesh.
[[nodiscard]] std::vector<std::string> dec_warnings(const DecRecord& record);

}  // namespace temper::app
