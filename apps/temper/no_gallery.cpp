// temper reproduce, in a program that was built without the paper's figures.
#include "exit.hpp"
#include "verbs.hpp"

namespace temper::app {

Exit run_reproduce(const Arguments&) {
  throw Failure(Exit::bad_usage,
                "reproduce: this program was built without the paper's figures; for them configure it with "
                "-DTEMPER_BUILD_GALLERY=ON");
}

}  // namespace temper::app
