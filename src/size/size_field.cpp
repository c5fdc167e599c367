#include <cmath>
#include <string>
#include <utility>

#include "base/assert.hpp"
#include "base/text.hpp"
#include "temper/detail/places.hpp"
#include "temper/detail/size.hpp"

namespace temper {

struct SizeField::Data {
  Mesh own;          // empty when the field looks at a mesh of the caller's
  const Mesh* mesh;  // own, or the caller's
  IdVector<VertexId, double> sizes;
  PlaceFinder finder{*mesh};

  Data(Mesh copy, IdVector<VertexId, double> values) : own(std::move(copy)), mesh(&own), sizes(std::move(values)) {}
  Data(const Mesh* seen, IdVector<VertexId, double> values) : mesh(seen), sizes(std::move(values)) {}
  Data(const Data&) = delete;
  Data& operator=(const Data&) = delete;
  ~Data() = default;
};

Expected<SizeField> SizeField::from_values(const Mesh& mesh, std::span<const double> sizes, const InputNames* names) {
  const InputNames numbers_from_0;
  const InputNames& say = names != nullptr ? *names : numbers_from_0;
  if (sizes.size() != mesh.n_vertices()) {
    return InputError{ErrorCode::size_mismatch,
                      {},
                      "the size field has " + std::to_string(sizes.size()) + " sizes; expected one for each of the " +
                          std::to_string(mesh.n_vertices()) + " vertices"};
  }
  IdVector<VertexId, double> values(mesh.n_vertices());
  for (const VertexId v : mesh.vertices()) {
    const double size = sizes[v.index];
    if (!(size > 0) || !std::isfinite(size)) {
      return InputError{std::isfinite(size) ? ErrorCode::invalid_option : ErrorCode::not_finite,
                        say.point_where(v.index),
                        say.point(v.index) + " has size " + to_text(size) + "; expected a finite, positive length"};
    }
    values[v] = size;
  }
  return SizeField(std::make_shared<const Data>(mesh, std::move(values)));
}

SizeField::Sample SizeField::at(const WeightedPoint& p, TriangleId hint) const {
  const Place place = data_->finder.find(p, hint);
  return {interpolated(place, [this](VertexId v) { return data_->sizes[v]; }), place.triangle, place.outside};
}

const Mesh& SizeField::mesh() const { return *data_->mesh; }
double SizeField::at(VertexId v) const { return data_->sizes[v]; }

SizeField input_size_field(const Mesh& mesh) {
  return SizeField(std::make_shared<const SizeField::Data>(mesh, local_sizes(mesh, nullptr)));
}

SizeField input_size_field_of(const Mesh& mesh, Executor* executor) {
  return SizeField(std::make_shared<const SizeField::Data>(&mesh, local_sizes(mesh, executor)));
}

}  // namespace temper
