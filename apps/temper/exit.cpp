#include "exit.hpp"

namespace temper::app {

std::string_view meaning(Exit exit, std::string_view verb) {
  switch (exit) {
    case Exit::done:
      return "Done.";
    case Exit::bad_input:
      return "Bad input, or an output cannot be written. The message names all written files.";
    case Exit::bad_usage:
      return "Bad usage: options that are wrong or missing.";
    case Exit::requirement:
      return "A requirement of --require or --require-claims is not met.";
    case Exit::stopped_early:
      if (verb == "weights")
        return "A signal or --time-limit stopped the search before it found weights. OUT is not written.";
      if (verb == "mesh") return "A signal or --time-limit stopped the run. The best mesh is written, if there is one.";
      return verb.empty() ? "A signal or --time-limit stopped the run, or edges are not regular. The best mesh is "
                            "written, except by weights."
                          : "A signal or --time-limit stopped the run, or edges are not regular. The best mesh is "
                            "written.";
    case Exit::internal:
      return "Out of memory, or an internal error. Please report it.";
    case Exit::infeasible:
      return "No weights meet the request. Only the certificate is written.";
  }
  return "";
}

}  // namespace temper::app
