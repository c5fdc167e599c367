// The words of temper paper. Each adds its options to the verb, and returns the function that runs it after parse.
#pragma once

#include <functional>

#include "exit.hpp"
#include "help/command.hpp"

namespace temper::app {

[[nodiscard]] std::function<Exit()> add_reproduce(Command& paper);
[[nodiscard]] std::function<Exit()> add_replay(Command& paper);

}  // namespace temper::app
