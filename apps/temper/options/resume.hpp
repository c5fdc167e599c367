// temper optimize --resume: the command of a run that goes on.
#pragma once

#include "help/command.hpp"

namespace temper::app {

/// What was given to a verb, as words that give it again, each option by its long name.
[[nodiscard]] Arguments given_words(const Command& command);

/// The words of the run that is resumed, but what is given `now` instead of `then`. Failure when that is more than
/// where outputs go and how long, and on how many threads, the run may take: the rest is the run's.
[[nodiscard]] Arguments resumed_words(const Command& now, const Command& then);

}  // namespace temper::app
