#include "experiments/sparse_runs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/closeness.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/generate.hpp"

namespace temper::gallery {
namespace {

// Energies of bounded runs stay below 400.
constexpr double kRunaway = 1e4;
constexpr const char* kFixedColor = "#333333";

/// The sparse horseshoe with its vertices numbered in that order.
Mesh numbered(const VertexSequence& sequence) {
  const Mesh mesh = sparse_horseshoe();
  std::array<Vec2, 5> points;
  std::array<std::int32_t, 5> number{};
  for (std::size_t i = 0; i < sequence.size(); ++i) {
    points[i] = mesh.position(VertexId(sequence[i]));
    number[sequence[i]] = static_cast<std::int32_t>(i);
  }
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    triangles.push_back({number[a.index], number[b.index], number[c.index]});
  }
  MeshInput input;
  input.points = points;
  input.triangles = triangles;
  return Mesh::build(input)->mesh;
}

OptimizeOptions options_of(const SparseSetting& setting, const Mesh& input) {
  OptimizeOptions o = *options_for("paper");
  o.energy = find_energy(setting.energy)->kind;
  o.unknowns = setting.weights_from ? Unknowns::positions_and_weights : Unknowns::positions;
  o.paper.weights_from = setting.weights_from.value_or(0);
  o.paper.removal = Removal::none;
  o.paper.collapse_from.reset();
  if (setting.collapse_energy) {
    o.paper.collapse_from = 0;
    o.paper.collapse_energy = find_energy(*setting.collapse_energy)->kind;
  }
  o.paper.anchor =
      VertexId(static_cast<std::size_t>(std::ranges::find(setting.sequence, 0u) - setting.sequence.begin()));
  o.paper.inversion = setting.inversion;
  o.paper.outer = 1;
  if (o.paper.weights_from > 0) o.paper.tolerance = 0;
  o.max_sweeps = setting.sweeps;
  o.paper.gamma = LengthParameter{setting.length_parameter.value_or(kPaperGamma), LengthScale::absolute};
  o.paper.h0 = setting.length_parameter ? LengthParameter{*setting.length_parameter, LengthScale::absolute}
                                        : shift_beyond(input);
  return o;
}

SparseSweep sweep_of(const Moment& moment) {
  SparseSweep sweep;
  sweep.energy = moment.energy;
  sweep.mesh = moment.mesh;
  sweep.collapsed = true;
  for (const VertexId v : sweep.mesh.vertices()) {
    sweep.largest_weight = std::max(sweep.largest_weight, std::abs(sweep.mesh.weight(v)));
    if (sweep.mesh.is_boundary(v)) continue;
    sweep.collapsed = false;
    sweep.p4 = sweep.mesh.position(v);
    sweep.closeness = closest_neighbor(sweep.mesh, v).ratio;
  }
  return sweep;
}

}  // namespace

std::vector<VertexSequence> all_sequences() {
  std::vector<VertexSequence> all;
  VertexSequence sequence = kAsNumbered;
  do all.push_back(sequence);
  while (std::ranges::next_permutation(sequence).found);
  return all;
}

std::string name(const VertexSequence& sequence) {
  std::string text;
  for (const std::size_t v : sequence) text += std::to_string(v);
  return text;
}

int SparseRun::collapsed_in() const {
  const auto gone = std::ranges::find(sweeps, true, &SparseSweep::collapsed);
  return gone == sweeps.end() ? 0 : static_cast<int>(gone - sweeps.begin());
}

bool SparseRun::runs_away() const {
  return std::ranges::any_of(sweeps, [](const SparseSweep& s) { return !(std::abs(s.energy) < kRunaway); });
}

bool SparseRun::nearly_collapses() const { return !last().collapsed && last().closeness < kNearlyCoincident; }

SparseRun run_sparse(const SparseSetting& setting) {
  const Mesh input = numbered(setting.sequence);
  const Recording recording = record(input, options_of(setting, input), Keep::sweeps);
  SparseRun run;
  for (const Moment& moment : recording.moments) {
    const bool counts = moment.kind == Snapshot::Moment::start || moment.kind == Snapshot::Moment::after_sweep;
    if (counts) run.sweeps.push_back(sweep_of(moment));
  }
  if (run.sweeps.empty()) {  // outside the barrier: the run did not start
    run.sweeps.push_back(sweep_of({.energy = std::numeric_limits<double>::infinity(), .mesh = input, .vertices = {}}));
  }
  return run;
}

SequenceCount count_sequences(const SparseSetting& setting, std::size_t stride) {
  SequenceCount count;
  double furthest = 0;
  const std::vector<VertexSequence> all = all_sequences();
  for (std::size_t i = 0; i < all.size(); i += stride) {
    const VertexSequence& sequence = all[i];
    SparseSetting one = setting;
    one.sequence = sequence;
    const SparseRun run = run_sparse(one);
    ++count.all;
    if (run.last().collapsed) {
      ++count.collapsed;
      if (run.collapsed_in() > 1) ++count.collapsed_later;
    } else if (run.nearly_collapses()) {
      ++count.near;
    } else {
      ++count.open;
      if (run.runs_away()) continue;
      ++count.open_bounded;
      if (run.last().closeness <= furthest) continue;
      furthest = run.last().closeness;
      count.most_open = sequence;
    }
  }
  return count;
}

std::string sparse_picture(const Mesh& mesh, const std::string& title, const std::string& footer) {
  const Mesh input = sparse_horseshoe();
  MeshPicture picture;
  picture.title = title;
  picture.footer = footer;
  picture.box = {{-3.3, -0.9}, {3.3, 4.7}};
  picture.width = 280;
  picture.weight_scale = 0.25;
  for (const VertexId v : mesh.vertices()) {
    std::size_t number = 4;
    for (std::size_t i = 0; i < 4; ++i) {
      if (mesh.position(v) == input.position(VertexId(i))) number = i;
    }
    picture.marks.push_back({mesh.position(v), number == 4 ? MarkColor::moving : kFixedColor, std::to_string(number)});
  }
  for (const Mark& mark : closeness_marks(mesh)) picture.marks.push_back(mark);
  return mesh_picture_svg(mesh, picture);
}

}  // namespace temper::gallery
