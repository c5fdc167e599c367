// Manual pages, in the man macros of roff: temper(1) and one for each verb, such as temper-optimize(1).
#pragma once

#include <string>

#include "command.hpp"

namespace temper::app {

[[nodiscard]] std::string man_page_of_program();
[[nodiscard]] std::string man_page(const Command& command);

}  // namespace temper::app
