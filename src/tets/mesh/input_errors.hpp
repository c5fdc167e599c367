// Errors of the input of TetMesh::build, in the user's names.
#pragma once

#include <string>
#include <vector>

#include "base/text.hpp"
#include "temper/tets/mesh.hpp"

namespace temper::tets {

/// "a, b and c"
[[nodiscard]] inline std::string enumerated(const std::vector<std::string>& names) {
  std::string result;
  for (std::size_t i = 0; i < names.size(); ++i)
    result += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return result;
}

class InputErrors {
 public:
  explicit InputErrors(const TetMeshInput& input)
      : in_(input), names_(input.names != nullptr ? *input.names : default_) {}

  [[nodiscard]] std::string name(VertexId v) const { return names_.point(v.index); }
  [[nodiscard]] std::string name(TetId t) const { return names_.tetrahedron(t.index); }
  template <class Corners>
  [[nodiscard]] std::string numbers(const Corners& corners) const {
    std::vector<std::string> all;
    all.reserve(corners.size());
    for (const VertexId v : corners) all.push_back(last_word(name(v)));
    return enumerated(all);
  }
  /// ", near (0.5, 0, 1)": the centroid of corners.
  template <class Corners>
  [[nodiscard]] std::string near(const Corners& corners) const {
    Vec3 sum;
    for (const VertexId v : corners) sum = sum + in_.points[v.index];
    const Vec3 p = 1.0 / static_cast<double>(corners.size()) * sum;
    return ", near (" + rounded(p.x, 6) + ", " + rounded(p.y, 6) + ", " + rounded(p.z, 6) + ")";
  }
  [[nodiscard]] InputError at(ErrorCode code, TetId t, const std::string& message) const {
    return {code, names_.tetrahedron_where(t.index), message};
  }
  [[nodiscard]] InputError at(ErrorCode code, VertexId v, const std::string& message) const {
    return {code, names_.point_where(v.index), message};
  }

 private:
  const TetMeshInput& in_;
  InputNames default_;
  const InputNames& names_;
};

}  // namespace temper::tets
