// Files of tetrahedra from arrays, and their points.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "temper/io.hpp"

namespace temper::test {

inline io::MeshFile tet_file(std::vector<Vec3> points, std::vector<std::array<std::int32_t, 4>> tetrahedra) {
  io::MeshFile file;
  file.tetrahedra.corners = std::move(tetrahedra);
  EXPECT_TRUE(io::set_points(file, std::move(points)));
  return file;
}

inline std::vector<Vec3> places_of(const io::MeshFile& file) {
  std::vector<Vec3> places;
  for (std::size_t i = 0; i < file.points.size(); ++i) places.push_back(file.place(i));
  return places;
}

}  // namespace temper::test
