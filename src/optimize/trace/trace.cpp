#include "temper/detail/trace.hpp"

namespace temper {

std::string_view name(EventKind kind) {
  switch (kind) {
    case EventKind::move:
      return "move";
    case EventKind::weight:
      return "weight";
    case EventKind::flip:
      return "flip";
    case EventKind::collapse:
      return "collapse";
    case EventKind::removal:
      return "removal";
    case EventKind::insertion:
      return "insertion";
    case EventKind::split:
      return "split";
    case EventKind::hidden:
      return "hidden";
    case EventKind::undo:
      return "undo";
  }
  return "unknown";
}

}  // namespace temper
