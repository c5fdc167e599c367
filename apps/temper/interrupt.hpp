// Ctrl-C and its like: SIGINT, SIGTERM and SIGHUP end the program at once, whatever it does, and leave every file as it
// was or whole. A verb that has something to show for its time notes the first one instead, and stops.
#pragma once

namespace temper::app {

/// From here on a signal ends the program: what is being written is removed, a line says so, and whoever waits for the
/// program sees the signal. (A signal that is ignored, as by nohup, stays so.)
void end_on_signals();
/// From here on the first SIGINT, SIGTERM or SIGUSR1, which mpirun hands on and job schedulers send when time is nearly
/// up, is only noted; the second one ends the program.
void catch_interrupts();
/// One has been noted.
[[nodiscard]] bool interrupted();

}  // namespace temper::app
