// Lower bounds for the time of a sweep on this machine: the arithmetic of its derivatives, and its memory traffic.
#pragma once

#include <memory>
#include <vector>

#include "temper/mesh.hpp"

namespace temper::bench {

/// The stars of a mesh in the order in which sweeps come to them, packed.
class PackedStars {
 public:
  explicit PackedStars(const Mesh& mesh);
  ~PackedStars();
  PackedStars(const PackedStars&) = delete;
  PackedStars& operator=(const PackedStars&) = delete;

  /// Value, gradient and Hessian of E_BP of every star, and nothing else, in the fastest instruction set.
  /// The triangles of a star are the lanes; returns the sum of the values.
  [[nodiscard]] double by_triangles() const;
  /// The same with a star in each lane, alike stars together as in sweeps.
  [[nodiscard]] double by_stars() const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

/// a[i] = b[i] + s c[i], over so many bytes as a sweep reads or writes at the least: those of the mesh.
class Triad {
 public:
  explicit Triad(const Mesh& mesh);
  void run();
  /// Bytes of a mesh, a vertex.
  static constexpr double kBytes = 80;

 private:
  std::vector<double> a_, b_, c_;
};

}  // namespace temper::bench
