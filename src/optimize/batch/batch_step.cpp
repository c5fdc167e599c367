#include "optimize/batch/batch_step.hpp"

#include <algorithm>

#include "base/compiler.hpp"
#include "base/instruction_set_choice.hpp"
#include "optimize/batch/star_batch.hpp"

namespace temper {
namespace {

// Number of vertices to choose from. A batch of eight blocks about a hundred vertices, and takes a quarter of the rest.
constexpr std::size_t kWindow = 256;
// Distance from the present vertex to the vertex whose memory is fetched in advance.
constexpr std::size_t kAhead = 64;
// From a halfedge to the next and the previous one in its triangle, by its place there. Mesh::next() and Mesh::prev()
// together become branches, which are often predicted wrong.
constexpr std::array<std::uint32_t, 3> kToNext = {1U, 1U, -2U}, kToPrev = {2U, -1U, -1U};
// With fewer vertices left, full lanes matter more than similar stars.
constexpr std::size_t kLastFew = 48;

void prefetch_point(const Mesh& mesh, std::size_t v) {
  if (v < mesh.n_vertices()) prefetch(mesh.vertex_data() + v * (Mesh::kVertexStride / sizeof(double)));
}

void prefetch_star(const Mesh& mesh, VertexId v) {
  const HalfedgeId h = mesh.outgoing(v);
  if (!h.valid()) return;
  prefetch(&mesh.corner_data()[h.index]);
  prefetch(&mesh.twin_data()[h.index]);
}

}  // namespace

const BatchSteps& batch_steps(const Space& space) {
  return space.is_plane() ? *TEMPER_IN_USE(kPlaneSteps) : *TEMPER_IN_USE(kSphereSteps);
}

void BatchStep::improve(std::span<const VertexId> vertices, const Part& part, std::vector<VertexId>& left) {
  unknowns_ = alone_.unknowns(), part_ = part, left_ = &left;
  const std::size_t n_left = left.size();
  auto next = vertices.begin();
  for (std::size_t n_waiting = 0;;) {
    for (; n_waiting < kWindow && next != vertices.end(); ++next, ++n_waiting) {
      prefetch_point(mesh, std::size_t{next->index} + kAhead);
      prefetch_star(mesh, *next);
      waiting_[kind_of(*next)].push_back(*next);
    }
    if (n_waiting == 0) break;
    const auto longest = std::max_element(waiting_.begin(), waiting_.end(),
                                          [](const auto& a, const auto& b) { return a.size() < b.size(); });
    const bool few = n_waiting < kLastFew;
    for (auto& list : waiting_) {
      if (few || &list == &*longest) n_waiting -= take_from(list);
    }
    run();
  }
  std::sort(left.begin() + static_cast<std::ptrdiff_t>(n_left), left.end());
}

/// Fills the batch from the front of a list. Returns the number of vertices that left the list.
std::size_t BatchStep::take_from(std::vector<VertexId>& list) {
  auto kept = list.begin(), at = kept;
  for (; at != list.end() && batch_.lanes < kLanes; ++at) {
    if (!take(*at)) *kept++ = *at;
  }
  const auto gone = static_cast<std::size_t>(at - kept);
  list.erase(kept, at);
  return gone;
}

/// Stars of a batch should be alike: the largest decides how long it takes.
std::size_t BatchStep::kind_of(VertexId v) const {
  constexpr std::size_t kSmall = 5;
  return std::clamp<std::size_t>(limits.degree[v], kSmall, kSmall + waiting_.size() - 1) - kSmall;
}

/// Returns false if v has to wait. Otherwise v is in the batch, or needs nothing here.
bool BatchStep::take(VertexId v) {
  if (mark(v) != Mark::none) return false;
  const Mobility mobility = limits.mobility[v];
  const bool stays = mobility == Mobility::fixed && unknowns_ == Unknowns::positions;
  if (stays || mobility == Mobility::frozen || mesh.is_isolated(v)) return true;
  gather(v, mobility);
  return true;
}

void BatchStep::gather(VertexId v, Mobility mobility) {
  const std::size_t lane = batch_.lanes;
  Occupant& occupant = occupants_[lane];
  occupant.v = v;
  if (!gather_star(occupant, lane)) {
    left_->push_back(v);
    return;
  }
  mark(v) = Mark::looked_at;
  const std::size_t triangles = batch_.open[lane] != 0 ? occupant.n_link - 1 : occupant.n_link;
  limits.degree[v] = static_cast<std::uint8_t>(std::min<std::size_t>(triangles, 255));
  occupant.alone = mobility == Mobility::sliding || triangles > StarBatch::kMostTriangles;
  batch_.p.set(lane, mesh.point(v));
  batch_.triangles[lane] = occupant.alone ? 0 : static_cast<double>(triangles);
  batch_.moves[lane] = !occupant.alone && mobility == Mobility::free && unknowns_ != Unknowns::weights ? -1 : 0;
  batch_.changes_weight[lane] = !occupant.alone && unknowns_ != Unknowns::positions ? -1 : 0;
  if (state.accuracy_domain != nullptr) gather_domain(occupant, lane);
  if (!occupant.alone) batch_.most_triangles = std::max(batch_.most_triangles, triangles);
  ++batch_.lanes;
}

/// Gathers and marks the points that a vertex's step reads. Returns false if they are not all in the part.
bool BatchStep::gather_star(Occupant& occupant, std::size_t lane) {
  constexpr std::size_t kMost = StarBatch::kMostTriangles;
  const bool may_flip = state.accuracy_domain == nullptr;
  const Part part = part_;
  const WeightedPoint center = mesh.point(occupant.v);
  const HalfedgeId first = mesh.outgoing(occupant.v);
  HalfedgeId h = first;
  VertexId q = mesh.target(h);
  std::size_t i = 0;
  bool open = false;
  if (!part.contains(q)) return false;
  do {
    const std::size_t side = h.index % 3;
    const HalfedgeId link(h.index + kToNext[side]), back(h.index + kToPrev[side]);
    const VertexId r = mesh.origin(back);
    // The twin and the corner across may be read only if both ends of the link edge are in the part.
    if (!part.contains(r)) return false;
    const HalfedgeId across = mesh.twin(link);
    const VertexId o = across.valid() ? mesh.opposite(across) : q;
    if (!part.contains(o)) return false;
    mark(q) = mark(o) = Mark::looked_at;
    if (i < kMost) {
      occupant.link[i] = q;
      occupant.spokes[i] = h;
      batch_.link[i].set(lane, mesh.point(q, center));
      batch_.across[i].set(lane, mesh.point(o, center));
      if (may_flip) {
        batch_.link_flips[i][lane] = across.valid() && !mesh.is_constrained(link) ? -1 : 0;
        batch_.spoke_flips[i][lane] = mesh.is_constrained(h) ? 0 : -1;
      }
    }
    ++i;
    q = r;
    h = mesh.twin(back);
    open = !h.valid();
  } while (!open && h != first);
  batch_.open[lane] = open ? -1 : 0;
  if (i <= kMost) {
    occupant.link[i] = q;
    batch_.link[i].set(lane, mesh.point(q, center));
  }
  if (open) batch_.spoke_flips[0][lane] = 0, mark(q) = Mark::looked_at;
  occupant.n_link = i + (open ? 1 : 0);
  return true;
}

/// Gathers the sizes and floors around an occupant. A vertex at a triangle without a floor stays.
void BatchStep::gather_domain(const Occupant& occupant, std::size_t lane) {
  if (occupant.alone) return;
  const auto& [sizes, floors] = *state.accuracy_domain;
  accuracy_.size[lane] = sizes[occupant.v];
  const std::size_t triangles = batch_.open[lane] != 0 ? occupant.n_link - 1 : occupant.n_link;
  for (std::size_t i = 0; i < triangles; ++i) {
    const HalfedgeId h = occupant.spokes[i], across = mesh.twin(Mesh::next(h));
    const TriangleId t = Mesh::triangle(h);
    const double floor = floors[t];
    if (!(floor > 0) || (across.valid() && !floors.has(Mesh::triangle(across)))) {
      batch_.moves[lane] = batch_.changes_weight[lane] = 0;
    }
    accuracy_.floor[i][lane] = floor;
    accuracy_.inner[i][lane] = across.valid() ? -1 : 0;
    if (settings.accuracy.keeps_lengths()) gather_lengths(h, i, lane);
    accuracy_.link_size[i][lane] = sizes[occupant.link[i]];
  }
  accuracy_.link_size[triangles][lane] = sizes[occupant.link[triangles]];
}

/// Gathers the least lengths of the edges of triangle i of a star, whose spoke is h.
void BatchStep::gather_lengths(HalfedgeId h, std::size_t i, std::size_t lane) {
  const LengthFloors& lengths = state.accuracy_domain->floors.lengths;
  const auto of = [&](HalfedgeId edge) {
    return mesh.is_boundary(edge) ? LengthBarrier<double>{} : lengths(mesh, edge);
  };
  accuracy_.spoke[i].set(lane, of(h));
  accuracy_.spoke[i + 1].set(lane, of(Mesh::prev(h)));
  accuracy_.link[i].set(lane, of(Mesh::next(h)));
}

void BatchStep::run() {
  if (batch_.lanes > 0) step_and_settle();
  marks_.fill(Mark::none);
  batch_.lanes = batch_.most_triangles = 0;
}

void BatchStep::step_and_settle() {
  for (std::size_t lane = batch_.lanes; lane < kLanes; ++lane) {
    batch_.triangles[lane] = 0;
    batch_.open[lane] = batch_.moves[lane] = batch_.changes_weight[lane] = 0;
  }
  const Vec2 rounding = units.rounding;
  const StepParameters parameters{edge_formula(state.model), state.relaxation, rounding.x, rounding.y};
  const BatchSteps& steps = batch_steps(mesh.space());
  const bool lowers_accuracy = state.accuracy_domain != nullptr;
  const StepOutcome outcome = lowers_accuracy ? steps.accuracy(parameters, settings.accuracy, accuracy_, batch_)
                                              : steps.barrier(parameters, batch_);
  const auto n_changes = [this] { return flipper_.changes().flips + flipper_.changes().removed; };
  const std::size_t before = n_changes();
  for (std::size_t lane = 0; lane < batch_.lanes; ++lane) {
    settle(occupants_[lane], lane, outcome, n_changes() != before);
  }
}

/// Applies a step of the batch to the mesh. `flips`: edges were flipped or vertices removed since the batch was made.
void BatchStep::settle(const Occupant& occupant, std::size_t lane, const StepOutcome& outcome, bool flips) {
  const VertexId v = occupant.v;
  const auto has = [lane](unsigned lanes) { return (lanes >> lane & 1) != 0; };
  if (flips && mesh.is_isolated(v)) return;
  if (occupant.alone || has(outcome.alone) || (flips && !has_its_link(occupant, batch_.open[lane] != 0)))
    return improve_alone(v);
  if (!has(outcome.stepped)) return;
  const WeightedPoint from = batch_.p.at(lane), to = batch_.to.at(lane);
  if (mesh.space().is_periodic() && !reaches_its_link(occupant, to)) return improve_alone(v);
  const double energy = batch_.before[lane], lower = batch_.after[lane];
  Guard* const guard = alone_.guard().on() && !mesh.space().same_place(from, to) ? &alone_.guard() : nullptr;
  if (guard != nullptr) {
    guard->begin_step();
    if (!guard->allows_move(v, to)) return improve_alone(v);
  }
  mesh.set_point(v, to);
  if (guard != nullptr) guard->moved(v);
  if (!flips && has(outcome.regular)) {
    recorder.placed(v, from, to, energy, lower);
    return;
  }
  constexpr bool kMustPay = true;  // of all barriers
  const Flipper::Settled settled = flipper_.settle({v, from, energy, lower, kMustPay, nullptr, guard, part_});
  if (settled == Flipper::Settled::done) return;
  if (guard != nullptr) guard->moved(v);
  settled == Flipper::Settled::undone ? improve_alone(v) : left_->push_back(v);
}

void BatchStep::improve_alone(VertexId v) {
  if (!alone_.improve(v, part_)) left_->push_back(v);
}

/// Says whether the edges from `to` to the link are shorter than half a period.
bool BatchStep::reaches_its_link(const Occupant& occupant, const WeightedPoint& to) const {
  const WeightedPoint from = mesh.point(occupant.v);
  return std::all_of(occupant.link.begin(), occupant.link.begin() + static_cast<std::ptrdiff_t>(occupant.n_link),
                     [&](VertexId q) { return mesh.space().are_near(mesh.point(q, from), to); });
}

/// Says whether no flip has changed the star since it was gathered.
bool BatchStep::has_its_link(const Occupant& occupant, bool open) const {
  std::size_t i = 0;
  for (const HalfedgeId h : mesh.star(occupant.v)) {
    if (i == occupant.n_link || mesh.target(h) != occupant.link[i]) return false;
    ++i;
  }
  return i == occupant.n_link - (open ? 1 : 0);
}

}  // namespace temper
