#include "temper/detail/version.hpp"

namespace temper {

std::string_view version() { return TEMPER_VERSION; }

}  // namespace temper
