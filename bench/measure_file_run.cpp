// From file to file, as `temper optimize IN -o OUT` does it, stage by stage.
#include <cmath>
#include <vector>

#include "child.hpp"
#include "measure.hpp"
#include "sweeps.hpp"
#include "threads.hpp"
#ifdef TEMPER_WITH_IO
#include "temper/io.hpp"
#endif

namespace temper::bench {

#ifdef TEMPER_WITH_IO
namespace {

/// The stages of optimize() and their times. `order`: seconds that ordering the mesh takes by itself.
Stages stages_of(const TimedRun& timed, double Mark::*clock, double before, double total, double order) {
  const std::vector<Mark>& marks = timed.marks;
  // The last sweep ends after the last mark: the history knows when.
  const double end = marks.back().*clock + timed.report.history.back().seconds - marks.back().last.seconds;
  std::size_t good = 0;
  while (good + 1 < marks.size() && marks[good].last.bad > 0) ++good;
  Stages stages;
  stages.order = order;
  stages.make_regular = before - order;
  stages.to_well_centered = marks[good].*clock - marks.front().*clock;
  stages.to_converged = end - marks[good].*clock;
  stages.back = total - before - (end - marks.front().*clock);
  return stages;
}

void note_report(const OptimizeReport& report, FileRun& run) {
  run.sweeps = report.sweeps;
  run.bad_before = static_cast<double>(report.history.front().bad);
  run.bad = static_cast<double>(report.history.back().bad);
  for (const SweepRecord& record : report.history) {
    if (record.bad == 0 && std::isnan(run.sweeps_to_good)) run.sweeps_to_good = record.sweep;
  }
}

}  // namespace

void make_input(std::size_t vertices, const std::string& path) {
  const auto done = in_child([&] {
    const auto written = io::write(path, io::from_mesh(mesh_of_random_points(vertices)));
    if (!written) fail(written.error().what());
    return 0;
  });
  if (!done) fail("cannot make " + path);
}

FileRun measure_file_run(const std::string& input, const std::string& output, std::size_t threads) {
  const auto executor = make_executor(threads);
  const auto now = executor ? wall_seconds : cpu_seconds;
  const double start = now();
  auto file = io::read(input, {executor.get()});
  if (!file) fail(file.error().what());
  const double read = now();
  auto loaded = io::make_mesh(*file, {}, executor.get());
  if (!loaded) fail(loaded.error().what());
  io::release_geometry(*file, *loaded);
  const double built = now();
  // The optimizer orders a copy of its own: this one is there for its time alone, and gone before that.
  static_cast<void>(hilbert_ordered(loaded->mesh, executor.get()));
  const double order = now() - built;

  FileRun run;
  const TimedRun timed = timed_run(loaded->mesh, {}, {}, executor.get());
  run.seconds = executor ? stages_of(timed, &Mark::wall, timed.before_wall, timed.wall, order)
                         : stages_of(timed, &Mark::cpu, timed.before_cpu, timed.cpu, order);
  const double optimized = now();
  io::update(*file, *loaded, loaded->mesh);
  const double updated = now();
  const auto written = io::write(output, *file, {{}, {}, executor.get()});
  if (!written) fail(written.error().what());
  run.seconds.read = read - start, run.seconds.build = built - read;
  run.seconds.update = updated - optimized, run.seconds.write = now() - updated;
  run.triangles = static_cast<double>(loaded->mesh.n_triangles());
  note_report(timed.report, run);
  run.peak_bytes = peak_bytes();
  return run;
}

#else

void make_input(std::size_t, const std::string&) {}
FileRun measure_file_run(const std::string&, const std::string&, std::size_t) { return {}; }

#endif

}  // namespace temper::bench
