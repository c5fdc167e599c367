// The names that PLY's reader and writer share: of types, of properties, and in temper's comments.
//
//   comment temper array vertex 3 velocity    properties velocity_0, velocity_1 and velocity_2 are one array
//   comment temper name 2 7 steel             physical name: dimension, tag, name
#pragma once

#include <array>
#include <string_view>

#include "io/text/values.hpp"

namespace temper::io {

struct PlyType {
  std::string_view name, other_name;  ///< of the first description of the format, and with the number of bits
  Scalar scalar;
};
/// Files are written with the first name of each type. PLY has no 64-bit integers, but meshio writes them.
inline constexpr std::array<PlyType, 10> kPlyTypes = {{{"double", "float64", Scalar::f64},
                                                       {"float", "float32", Scalar::f32},
                                                       {"int", "int32", Scalar::i32},
                                                       {"uchar", "uint8", Scalar::u8},
                                                       {"char", "int8", Scalar::i8},
                                                       {"short", "int16", Scalar::i16},
                                                       {"ushort", "uint16", Scalar::u16},
                                                       {"uint", "uint32", Scalar::u32},
                                                       {"int64", "long", Scalar::i64},
                                                       {"uint64", "ulong", Scalar::u64}}};

inline constexpr std::string_view kPlyArrayComment = "temper array ";
inline constexpr std::string_view kPlyNameComment = "temper name ";
inline constexpr std::string_view kPlyTag = "tag";        ///< of a vertex: the tag of a marked point, 0: none
inline constexpr std::string_view kPlyRegion = "region";  ///< of a face, and the tag of an edge
inline constexpr std::string_view kPlyWeight = "weight";

}  // namespace temper::io
