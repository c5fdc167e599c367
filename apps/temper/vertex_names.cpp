#include "vertex_names.hpp"

#include <utility>

namespace temper::app {

VertexNames::VertexNames(std::shared_ptr<const InputNames> file, std::vector<std::size_t> points)
    : file_(file ? std::move(file) : std::make_shared<const InputNames>()), points_(std::move(points)) {}

// A vertex that the table does not have keeps its own number.
std::size_t VertexNames::in_file(std::size_t index) const { return index < points_.size() ? points_[index] : index; }

std::string VertexNames::point(std::size_t index) const { return file_->point(in_file(index)); }
std::string VertexNames::triangle(std::size_t index) const { return file_->triangle(index); }
std::string VertexNames::point_where(std::size_t index) const { return file_->point_where(in_file(index)); }
std::string VertexNames::triangle_where(std::size_t index) const { return file_->triangle_where(index); }

}  // namespace temper::app
