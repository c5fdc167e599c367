// The file's own numbers for the vertices of a mesh, when points of the file that no triangle uses were dropped, and
// names for vertices that the file does not have.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "temper/mesh.hpp"

namespace temper::app {

class VertexNames final : public InputNames {
 public:
  /// points: mesh vertex → point of the file; empty: the same. n_vertices: of the file's mesh; those after are new.
  VertexNames(std::shared_ptr<const InputNames> file, std::vector<std::size_t> points, std::size_t n_vertices);
  [[nodiscard]] std::string point(std::size_t index) const override;
  [[nodiscard]] std::string triangle(std::size_t index) const override;
  [[nodiscard]] std::string point_where(std::size_t index) const override;
  [[nodiscard]] std::string triangle_where(std::size_t index) const override;

 private:
  [[nodiscard]] std::size_t in_file(std::size_t index) const;

  std::shared_ptr<const InputNames> file_;
  std::vector<std::size_t> points_;
  std::size_t n_vertices_;
};

}  // namespace temper::app
