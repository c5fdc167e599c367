#include "temper/detail/error.hpp"

namespace temper {

std::string_view name(ErrorCode code) {
  switch (code) {
    case ErrorCode::not_found:
      return "not_found";
    case ErrorCode::empty_input:
      return "empty_input";
    case ErrorCode::truncated:
      return "truncated";
    case ErrorCode::syntax:
      return "syntax";
    case ErrorCode::unsupported:
      return "unsupported";
    case ErrorCode::index_out_of_range:
      return "index_out_of_range";
    case ErrorCode::size_mismatch:
      return "size_mismatch";
    case ErrorCode::not_finite:
      return "not_finite";
    case ErrorCode::not_planar:
      return "not_planar";
    case ErrorCode::not_on_sphere:
      return "not_on_sphere";
    case ErrorCode::duplicate_point:
      return "duplicate_point";
    case ErrorCode::unused_point:
      return "unused_point";
    case ErrorCode::zero_area:
      return "zero_area";
    case ErrorCode::non_manifold_edge:
      return "non_manifold_edge";
    case ErrorCode::non_manifold_vertex:
      return "non_manifold_vertex";
    case ErrorCode::overlap:
      return "overlap";
    case ErrorCode::missing_edge:
      return "missing_edge";
    case ErrorCode::geographic:
      return "geographic";
    case ErrorCode::out_of_scale:
      return "out_of_scale";
    case ErrorCode::invalid_option:
      return "invalid_option";
    case ErrorCode::hidden_vertex:
      return "hidden_vertex";
    case ErrorCode::stopped:
      return "stopped";
    case ErrorCode::trace_mismatch:
      return "trace_mismatch";
    case ErrorCode::rank_mismatch:
      return "rank_mismatch";
    case ErrorCode::not_writable:
      return "not_writable";
  }
  return "unknown";
}

}  // namespace temper
