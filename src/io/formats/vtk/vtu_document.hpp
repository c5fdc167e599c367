// A VTU file of one piece, section by section; every array is made block by block, and only the compressed blocks of
// one array are kept until its header is known.
//
//   VtuDocument vtu(out, Encoding::base64, executor);
//   vtu.fields(…);                        // may be left out
//   vtu.begin_piece(n_points, n_cells);
//   vtu.section("Points", {…});           // and Cells, PointData, CellData
//   vtu.finish();
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/containers/vtu_codec.hpp"
#include "io/formats/vtk/vtk_arrays.hpp"

namespace temper::io {

class VtuDocument {
 public:
  /// Writes what comes before all arrays. The executor's threads compress, when there is one.
  VtuDocument(Output& out, Encoding encoding, Executor* executor);
  /// Data of the file as a whole; nothing is written of none.
  void fields(const std::vector<VtkArray>& arrays);
  void begin_piece(std::size_t n_points, std::size_t n_cells);
  void section(std::string_view name, const std::vector<VtkArray>& arrays);
  /// The last call.
  void finish();

 private:
  void put_section(std::string_view name, const std::vector<VtkArray>& arrays, bool field);
  void array(const VtkArray& array, bool field);
  static std::string packed_block(const VtkArray& a, std::size_t i, Redundancy redundancy);
  static Redundancy redundancy_of(const VtkArray& a);
  void base64(const VtkArray& array);
  void appended();

  Output& out_;
  Encoding encoding_;
  Executor* executor_;
  std::vector<VtkArray> waiting_;  // for the appended section
  std::uint64_t offset_ = 0;
};

// --- arrays that are computed of operators or columns ---

/// An array of doubles, or of 32-bit integers.
template <class F>
[[nodiscard]] VtkArray dual_reals(std::string name, std::size_t n, F value) {
  return computed_vtk_array<double>(std::move(name), Scalar::f64, n, std::move(value));
}
template <class F>
[[nodiscard]] VtkArray dual_integers(std::string name, std::size_t n, F value) {
  return computed_vtk_array<std::int32_t>(std::move(name), Scalar::i32, n,
                                          [value](std::size_t i) { return static_cast<std::int32_t>(value(i)); });
}
/// The types of cells that are all of one.
[[nodiscard]] inline VtkArray one_type(std::size_t n, int type) {
  return computed_vtk_array<std::uint8_t>("types", Scalar::u8, n,
                                          [type](std::size_t) { return static_cast<std::uint8_t>(type); });
}

}  // namespace temper::io
