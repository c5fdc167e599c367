// Ctrl-C: the first SIGINT or SIGTERM asks the optimiser to stop and the best mesh to be written; the second
// kills the program as if there were no handler.
#pragma once

namespace temper::app {

/// From here on the first signal is only noted.
void catch_interrupts();
/// A signal came in.
[[nodiscard]] bool interrupted();

}  // namespace temper::app
