// temper paper reproduce|replay: the figures of the paper, and the steps of a run.
#include "options/options.hpp"
#include "verbs.hpp"
#include "verbs/paper.hpp"

namespace temper::app {

Exit run_paper(const Arguments& arguments) {
  Command command("paper",
                  "Makes the figures of \"Not so HOT Triangulations\" again, and repeats the steps of a run. temper "
                  "optimize --help-paper lists the switches of the paper.");
  const std::function<Exit()> reproduce = add_reproduce(command), replay = add_replay(command);
  command.add_help(
      {"reproduce|replay ... [options]",
       "  temper paper reproduce --list\n"
       "  temper paper reproduce 6 -o gallery\n"
       "  temper paper reproduce 3,6-8 -o gallery --reduced\n"
       "  temper optimize in.vtu -o a.vtu --write t.jsonl && temper paper replay in.vtu t.jsonl -o b.vtu\n",
       {Exit::done, Exit::bad_input, Exit::bad_usage, Exit::requirement, Exit::internal}});
  if (!command.parse(arguments)) return Exit::done;
  if (command.chosen() == nullptr) refuse_usage("paper", "a word is missing: reproduce or replay");
  return command.chosen()->name() == "replay" ? replay() : reproduce();
}

}  // namespace temper::app
