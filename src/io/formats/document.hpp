// What a reader makes of a file.
#pragma once

#include <memory>
#include <string>

#include "io/disk/files.hpp"
#include "io/text/file_names.hpp"
#include "temper/io.hpp"

namespace temper::io {

/// The result of a reader: the arrays, and the numbers that the file has for them.
struct Document {
  MeshFile file;
  std::shared_ptr<FileNames> names;
  double z = 0;                      ///< of the first point
  std::vector<double> heights = {};  ///< z of each point, once one is another than that of the first
};
[[nodiscard]] Document new_document(const std::string& path);

/// Checks what every format must fulfil once its arrays are read: points and triangles exist, numbers are in range,
/// coordinates and weights finite, points in a plane or on a sphere around the origin.
void check(Document& document);

/// Collects z, of one point after the other.
class PlaneCheck {
 public:
  explicit PlaneCheck(Document& document) : document_(document) {}
  /// z of the point with this index, whose number and line are already in the names.
  void add(std::size_t index, double z) {
    if (index == 0) document_.z = z;
    if (z != document_.z && document_.heights.empty()) document_.heights.assign(index, document_.z);
    if (!document_.heights.empty()) document_.heights.push_back(z);
  }

 private:
  Document& document_;
};

/// Refuses an element that is neither point, line nor triangle, with the reason.
[[noreturn]] void refuse_element(const std::string& where, std::int64_t number, std::string_view kind);

}  // namespace temper::io
