// temper paper reproduce, in a program that was built without the paper's figures.
#include "verbs/paper.hpp"

namespace temper::app {

std::function<Exit()> add_reproduce(Command& paper) {
  paper.add_subcommand("reproduce", "make the figures of the paper again; this program was built without them");
  return []() -> Exit {
    refuse_usage("paper reproduce",
                 "this program was built without the paper's figures. Next: build it with -DTEMPER_BUILD_GALLERY=ON");
  };
}

}  // namespace temper::app
