#include "optimize/step/vertex_limits.hpp"

#include <utility>

namespace temper {

VertexLimits::VertexLimits(const Mesh& mesh, const Settings& settings, const Frame& frame)
    : mobility(mobilities(mesh, settings.options, settings.hooks.executor)),
      degree(mesh.n_vertices(), 0),
      band(mesh, frame, settings.size_field, settings.options.size_band),
      mesh_(mesh),
      settings_(settings) {}

void VertexLimits::renumber(const Compaction& kept) {
  IdVector<VertexId, Mobility> left;
  left.reserve(kept.vertices.size());
  for (const VertexId v : kept.vertices) left.push_back(mobility[v]);
  mobility = std::move(left);
  degree.resize(mobility.size());
  band.renumber(kept);
}

void VertexLimits::grow() {
  for (std::size_t i = mobility.size(); i < mesh_.n_vertices(); ++i) {
    mobility.push_back(temper::mobility(mesh_, VertexId(i), settings_.options));
  }
  degree.resize(mobility.size());
  band.grow();
}

}  // namespace temper
