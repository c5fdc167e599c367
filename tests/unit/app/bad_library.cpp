// A shared library that crashes or loops for ever as soon as it is loaded, as the environment asks.
#include <csignal>
#include <cstdlib>
#include <string>

namespace {

const bool kLoaded = [] {
  const char* const asked = std::getenv("BAD_LIBRARY");
  const std::string does = asked == nullptr ? "" : asked;
  if (does == "crash") {
    std::signal(SIGSEGV, SIG_DFL);
    std::raise(SIGSEGV);
  }
  for (volatile bool forever = does == "loop"; forever;) {
  }
  return true;
}();

}  // namespace
