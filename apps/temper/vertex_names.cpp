#include "vertex_names.hpp"

#include <utility>

namespace temper::app {

VertexNames::VertexNames(std::shared_ptr<const InputNames> file, std::vector<std::size_t> points,
                         std::size_t n_vertices)
    : file_(file ? std::move(file) : std::make_shared<const InputNames>()),
      points_(std::move(points)),
      n_vertices_(n_vertices) {}

std::size_t VertexNames::in_file(std::size_t index) const { return index < points_.size() ? points_[index] : index; }

/// The file may number its points as it likes, so new ones are counted by themselves, from 1.
std::string VertexNames::point(std::size_t index) const {
  if (index >= n_vertices_) return "new point " + std::to_string(index - n_vertices_ + 1);
  return file_->point(in_file(index));
}
std::string VertexNames::triangle(std::size_t index) const { return file_->triangle(index); }
std::string VertexNames::point_where(std::size_t index) const {
  return index < n_vertices_ ? file_->point_where(in_file(index)) : std::string();
}
std::string VertexNames::triangle_where(std::size_t index) const { return file_->triangle_where(index); }

}  // namespace temper::app
