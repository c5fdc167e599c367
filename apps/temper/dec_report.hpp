// What `temper dec` says of the operators it wrote: as text, as JSON, and as warnings.
#pragma once

#include <string>
#include <vector>

#include "temper/dec.hpp"

namespace temper::app {

struct DecRecord {
  std::string path;  ///< of the mesh
  const DecSummary& summary;
  const PowerCells& cells;
  std::vector<std::string> files;
};

[[nodiscard]] std::string dec_text(const DecRecord& record);
[[nodiscard]] std::string dec_json(const DecRecord& record);
/// What a solver's author should know before using them: nothing for a well-centered mesh.
[[nodiscard]] std::vector<std::string> dec_warnings(const DecRecord& record);

}  // namespace temper::app
