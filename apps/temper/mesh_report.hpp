// The reports of `temper mesh` on the mesh it made: as text, and as JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "options.hpp"
#include "temper/io.hpp"
#include "temper/mesher.hpp"
#include "temper/projection.hpp"
#include "temper/quality.hpp"

namespace temper::app {

/// Where points in longitude and latitude are: on a map, on the sphere, or there are none.
struct MapUsed {
  std::optional<Projection> projection = {};
  double radius = 0;                          ///< of the sphere
  double covered = 0;                         ///< the part of the sphere that is meshed
  std::vector<Vec2> lon_lat = {};             ///< of the outlines' points, as they were given
  double least_scale = 1, largest_scale = 1;  ///< length on the map over length on the globe, over all vertices
};

/// "outline", "coast" or "lines", and what was read.
struct NamedOutline {
  const char* name;
  io::OutlineFile file;
};

struct MeshRecord {
  std::string command;
  std::vector<UsedOption> options;
  const std::vector<NamedOutline>& inputs;
  const MapUsed& map;
  const OutlineMesh& made;
  const Quality& quality;
};

/// "stereographic:7.5,51", as --projection takes it.
[[nodiscard]] std::string spell(const Projection& projection);

[[nodiscard]] std::string mesh_text(const MeshRecord& record);
[[nodiscard]] std::string mesh_json(const MeshRecord& record);

}  // namespace temper::app
