// temper paper reproduce [FIG...] -o DIR: the figures and claims of the paper, made again; see gallery/.
//
// Each figure writes its pictures, then index.html, gallery.json, claims.md and settings.md of all figures so far. So a
// run that is stopped leaves a folder of whole files that fit together.
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "console.hpp"
#include "files/outputs.hpp"
#include "gallery/reading.hpp"
#include "gallery/results.hpp"
#include "gallery/selection.hpp"
#include "help/help.hpp"
#include "options/options.hpp"
#include "options/table_options.hpp"
#include "system/system.hpp"
#include "temper/detail/path.hpp"
#include "temper/detail/suggest.hpp"
#include "temper/detail/version.hpp"
#include "verbs/paper.hpp"

namespace temper::app {
namespace {

namespace fs = std::filesystem;
using gallery::Effort, gallery::Figure, gallery::Result, gallery::Tally;

constexpr const char* kVerb = "paper reproduce";

struct ReproduceSettings {
  std::vector<std::string> figures;
  std::string output;
  bool reduced = false, list = false, require_claims = false;
  Assignments readings;
};

/// Readings of the paper that are open. Each figure has its own; --set replaces them in all figures.
void add_readings(Command& command, Assignments& target) {
  add_set(command, target, gallery::kOpen).sentence = fmt::format(
      "Replace readings of the paper in all figures, separated by commas: {}. See temper optimize "
      "--help-paper.",
      join(gallery::kOpen));
}

gallery::Reading reading(const Assignments& assignments) {
  gallery::Reading given;
  for (const Assignment& a : assignments) given.push_back({a.row, a.value});
  return given;
}

void add_options(Command& command, ReproduceSettings& s) {
  add_texts(command, "FIG", "", Values::words, s.figures,
            "Figures of the paper: a number 6, a list 6,8 or a range 16-18. Without FIG, all figures are made, which "
            "takes minutes.");
  add_text(command, "-o,--output", "DIR", s.output,
           "Folder for the pictures, index.html, gallery.json, claims.md and settings.md. It is made if it does not "
           "exist. Files with these names are replaced.");
  command.add_flag("--reduced", s.reduced, "Test every claim with fewer samples and shorter runs.");
  command.add_flag("--require-claims", s.require_claims,
                   "Exit with 3 if a claim does not hold. All files are written first.");
  command.add_flag("--list", s.list, "List the figures.");
  add_readings(command, s.readings);
}

void list(std::span<const Figure> figures) {
  for (const Figure& figure : figures) print(fmt::format("{:>2}  {}\n", figure.number, figure.title));
}

void make_folder(const std::string& path) {
  std::error_code error;
  if (fs::exists(path_of(path), error) && !fs::is_directory(path_of(path), error))
    throw Failure(Exit::bad_input, path + ": cannot be written: it is not a directory");
  fs::create_directories(path_of(path), error);
  if (error) throw Failure(Exit::bad_input, path + ": cannot be written: " + error.message());
}

class Folder {
 public:
  Folder(std::string path, Effort effort) : path_(std::move(path)), effort_(effort) {
    make_folder(path_);
    for (const char* name : {"index.html", "gallery.json", "claims.md", "settings.md"})
      outputs_.expect_text("--output", file(name), {});
  }

  [[nodiscard]] std::string file(const std::string& name) const { return utf8(path_of(path_) / name); }

  /// Writes the pictures of the last result, and the pages about all.
  void write(std::span<const Result> results) {
    const SignalsHeld until_whole;
    for (const gallery::Picture& picture : results.back().page.pictures)
      outputs_.write_text(file(picture.name + ".svg"), picture.svg);
    outputs_.write_text(file("index.html"), gallery::index_html(results, effort_, version()));
    outputs_.write_text(file("gallery.json"), gallery::gallery_json(results, version()));
    outputs_.write_text(file("claims.md"), gallery::claims_markdown(results));
    outputs_.write_text(file("settings.md"), gallery::settings_markdown(results));
  }

 private:
  std::string path_;
  Effort effort_;
  Outputs outputs_{kVerb};
};

/// Shows on a terminal the figure in progress.
void show_progress(const Figure& figure, std::size_t place, std::size_t count) {
  if (!error_is_terminal()) return;
  fmt::print(stderr, "\rfigure {} ({} of {}): {}\x1b[K", figure.number, place, count, figure.title);
  std::fflush(stderr);
}
void clear_progress() {
  if (error_is_terminal()) fmt::print(stderr, "\r\x1b[K");
}

struct Made {
  std::vector<Result> results;
  std::vector<double> seconds;  ///< of each
};

Made make(std::span<const Figure> figures, Effort effort, Folder& folder) {
  Made made;
  for (const Figure& figure : figures) {
    show_progress(figure, made.results.size() + 1, figures.size());
    const auto start = std::chrono::steady_clock::now();
    try {
      made.results.push_back({figure, gallery::make(figure, effort)});
    } catch (const gallery::CannotBeMade& error) {
      throw Failure(Exit::bad_input,
                    fmt::format("figure {} cannot be made under this reading: {}", figure.number, error.what()));
    }
    made.seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    folder.write(made.results);
  }
  clear_progress();
  return made;
}

std::string summary_row(std::string_view number, std::string_view title, std::string_view seconds,
                        std::string_view claims) {
  return fmt::format("{:>6}  {}{:>9}{:>9}\n", number, pad_right(title, 58), seconds, claims);
}

/// The claims of both authors.
Tally all_claims(const Result& result) {
  Tally tally = gallery::count_claims(result.page, gallery::Author::paper);
  return tally += gallery::count_claims(result.page, gallery::Author::temper);
}
Tally all_claims(std::span<const Result> results) {
  Tally tally;
  for (const Result& result : results) tally += all_claims(result);
  return tally;
}

std::string fraction(Tally tally) { return fmt::format("{}/{}", tally.hold, tally.all); }

void print_summary(const Made& made) {
  std::string text = summary_row("figure", "title", "seconds", "claims");
  double seconds = 0;
  for (std::size_t i = 0; i < made.results.size(); ++i) {
    const Result& result = made.results[i];
    seconds += made.seconds[i];
    text += summary_row(std::to_string(result.figure.number), result.figure.title,
                        fmt::format("{:.1f}", made.seconds[i]), fraction(all_claims(result)));
  }
  text += summary_row("", "", fmt::format("{:.1f}", seconds), fraction(all_claims(made.results)));
  text += gallery::verdict_sentence(made.results) + "\n";
  for (const Result& result : made.results) {
    for (const gallery::Claim& claim : result.page.claims) {
      if (!claim.holds) text += fmt::format("does not hold, in figure {}: {}\n", result.figure.number, claim.claim);
    }
  }
  print(text);
}

Exit reproduce(const ReproduceSettings& s) {
  const Expected<std::vector<Figure>> chosen = gallery::select(gallery::figures(), s.figures);
  if (!chosen) refuse_usage(kVerb, chosen.error().what());
  if (s.list) {
    list(*chosen);
    return Exit::done;
  }
  if (s.output.empty()) refuse_usage(kVerb, "-o DIR is missing: the folder for the figures");
  const Effort effort = s.reduced ? Effort::reduced : Effort::full;
  Folder folder(s.output, effort);

  gallery::set_reading(reading(s.readings));
  const Made made = make(*chosen, effort, folder);
  print_summary(made);
  print(folder.file("index.html") + "\n");
  flush_output();  // before the verdict on standard error
  const Tally tally = all_claims(made.results);
  if (!s.require_claims || tally.hold == tally.all) return Exit::done;
  print_error(fmt::format("{}: {} of {} claims do not hold", kVerb, tally.all - tally.hold, tally.all));
  return Exit::requirement;
}

}  // namespace

std::function<Exit()> add_reproduce(Command& paper) {
  Command& command = paper.add_subcommand("reproduce", "make the figures of the paper again, and test its claims");
  const auto settings = std::make_shared<ReproduceSettings>();
  add_options(command, *settings);
  return [settings] { return reproduce(*settings); };
}

}  // namespace temper::app
