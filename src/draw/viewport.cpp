#include "draw/viewport.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>

namespace temper {
namespace {

constexpr double kPiece = 0.06;    // radians of an arc: 0.2 pixels from its chord on a disc of 900 pixels
constexpr int kCorners = 36;       // of a circle
constexpr double kOneSided = 0.5;  // length of the mean direction of what keeps to a half of the sphere
constexpr double kDegree = std::numbers::pi / 180;

Vec3 unit(Vec3 p) { return (1 / length(p)) * p; }

/// The point on the limb of the arc between a visible and a hidden point.
Vec3 on_limb(Vec3 a, Vec3 b) {
  const Vec3 p = a + (a.z / (a.z - b.z)) * (b - a);
  return unit({p.x, p.y, 0});
}

}  // namespace

View::View(double radius, Vec2 middle) : radius_(radius) {
  const double lon = kDegree * middle.x, lat = kDegree * middle.y;
  towards_ = {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
  right_ = {-std::sin(lon), std::cos(lon), 0};
  up_ = cross(towards_, right_);
}

Vec3 View::seen(const WeightedPoint& p) const {
  const Vec3 d = unit(as_vector(p));
  return {dot(right_, d), dot(up_, d), dot(towards_, d)};
}

Vec2 View::at(const WeightedPoint& p) const {
  if (is_flat()) return p.position();
  const Vec3 s = seen(p);
  return {radius_ * s.x, radius_ * s.y};
}

bool View::shows(const WeightedPoint& p) const { return is_flat() || seen(p).z >= 0; }

/// Appends the arc without its end.
void View::add_arc(std::vector<Vec2>& chain, Vec3 a, Vec3 b) const {
  const int pieces = 1 + static_cast<int>(std::atan2(length(cross(a, b)), dot(a, b)) / kPiece);
  for (int i = 0; i < pieces; ++i) {
    const Vec3 p = i == 0 ? a : unit(a + (static_cast<double>(i) / pieces) * (b - a));
    chain.push_back({radius_ * p.x, radius_ * p.y});
  }
}

std::vector<Vec2> View::line(const WeightedPoint& p, const WeightedPoint& q) const {
  if (is_flat()) return {p.position(), q.position()};
  Vec3 a = seen(p), b = seen(q);
  if (!(a.z >= 0) && !(b.z >= 0)) return {};
  if (a.z < 0) a = on_limb(b, a);
  if (b.z < 0) b = on_limb(a, b);
  std::vector<Vec2> chain;
  add_arc(chain, a, b);
  chain.push_back({radius_ * b.x, radius_ * b.y});
  return chain;
}

std::vector<Vec2> View::polygon(const std::array<WeightedPoint, 3>& t) const {
  if (is_flat()) return {t[0].position(), t[1].position(), t[2].position()};
  const std::array<Vec3, 3> corners = {seen(t[0]), seen(t[1]), seen(t[2])};
  std::vector<Vec3> kept;  // of the triangle, before the limb
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 a = corners[i], b = corners[(i + 1) % 3];
    if (a.z >= 0) kept.push_back(a);
    if ((a.z < 0) != (b.z < 0)) kept.push_back(a.z < 0 ? on_limb(b, a) : on_limb(a, b));
  }
  std::vector<Vec2> polygon;
  for (std::size_t i = 0; i < kept.size(); ++i) add_arc(polygon, kept[i], kept[(i + 1) % kept.size()]);
  return polygon;
}

// The circle in the plane that touches the sphere at p, seen from the center.
std::vector<WeightedPoint> View::circle(const WeightedPoint& p, double radius) const {
  const Vec3 d = unit(as_vector(p));
  const Vec3 axis = std::abs(d.z) < 0.5 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};  // not along d
  const Vec3 u = unit(cross(axis, d)), v = cross(d, u);
  std::vector<WeightedPoint> around;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners;
    around.push_back(as_point(d + (radius / radius_) * (std::cos(angle) * u + std::sin(angle) * v)));
  }
  return around;
}

View make_view(std::span<const Mesh* const> meshes, const DrawOptions& options) {
  const Space space = meshes.empty() ? Space() : meshes.front()->space();
  if (space.radius() == 0) return {};
  if (options.view) return {space.radius(), *options.view};
  Vec3 sum;
  double count = 0;
  for (const Mesh* mesh : meshes) {
    for (const VertexId v : mesh->vertices()) sum = sum + unit(mesh->weighted_vector(v)), ++count;
  }
  if (!(length(sum) > kOneSided * count)) return {space.radius(), {0, 0}};
  return {space.radius(), {std::atan2(sum.y, sum.x) / kDegree, std::atan2(sum.z, std::hypot(sum.x, sum.y)) / kDegree}};
}

namespace {

constexpr double kMargin = 0.03;                   // white space around the mesh, of the larger side of its box
constexpr double kMostCircle = 0.08;               // more of it for weight circles, at most
constexpr double kClipMargin = 0.05;               // beyond the panel, so that strokes leave it without an end in sight
constexpr double kLeastWidth = 50;                 // pixels; less cannot be read
constexpr double kEm = 12.0 / 700;                 // of the width of a picture
constexpr double kLeastEm = 14;                    // pixels
constexpr double kFlattest = 0.1;                  // height of a panel over its width, at least …
constexpr double kTallest = 1.25;                  // … and at most; the mesh is centered in what is left
constexpr double kStepsPerEdge = 100;              // grid steps on a median edge: its ends are then right to 1 %
constexpr double kFinest = 1e-3, kCoarsest = 0.1;  // pixels per grid step

/// The box of the visible part. If a mesh continues behind the limb, the box of the whole disc; along a period the
/// domain.
Box bounding_box(std::span<const Mesh* const> meshes, const View& view) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box box{{kInfinity, kInfinity}, {-kInfinity, -kInfinity}};
  for (const Mesh* mesh : meshes) {
    for (VertexId v : mesh->vertices()) {
      if (!view.shows(mesh->point(v))) return {{-view.radius(), -view.radius()}, {view.radius(), view.radius()}};
      const Vec2 p = view.at(mesh->point(v));
      box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
      box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
    }
  }
  const Vec2 period = meshes.empty() ? Vec2{} : meshes.front()->space().period();
  if (period.x > 0) box.low.x = 0, box.high.x = period.x;
  if (period.y > 0) box.low.y = 0, box.high.y = period.y;
  return box.low.x <= box.high.x ? box : Box{{0, 0}, {1, 1}};
}

Box grown(const Box& box, double by) { return {box.low - Vec2{by, by}, box.high + Vec2{by, by}}; }

Box ordered(const Box& box) {
  return {{std::min(box.low.x, box.high.x), std::min(box.low.y, box.high.y)},
          {std::max(box.low.x, box.high.x), std::max(box.low.y, box.high.y)}};
}

// Weight circles at the boundary of the domain are shown whole, unless they would shrink the mesh too much.
double margin(std::span<const Mesh* const> meshes, const DrawOptions& options, double side) {
  double radius = 0;
  for (const Mesh* mesh : meshes) {
    for (VertexId v : mesh->vertices()) {
      if (options.weights && mesh->is_boundary(v)) radius = std::max(radius, std::abs(mesh->weight(v)));
    }
  }
  radius = std::sqrt(radius) * options.weight_scale;
  return kMargin * side + (radius > 0 ? std::min(radius, kMostCircle * side) : 0);
}

double larger_side(const Box& box) { return std::max(box.high.x - box.low.x, box.high.y - box.low.y); }

double upper_median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The median length of the edges that meet the box; 0 when none does.
double median_edge(std::span<const Mesh* const> meshes, const View& view, const Box& box) {
  std::vector<double> lengths;
  for (const Mesh* mesh : meshes) {
    for (HalfedgeId h : mesh->halfedges()) {
      if (!mesh->is_edge_representative(h)) continue;
      const WeightedPoint from = mesh->point(mesh->origin(h));
      const std::vector<Vec2> line = view.line(from, mesh->point(mesh->target(h), from));
      if (line.empty()) continue;
      const Segment edge{line.front(), line.back()};
      if (clip(edge, box)) lengths.push_back(length(edge.to - edge.from));
    }
  }
  return upper_median(std::move(lengths));
}

Box bounding_box(std::span<const Section> sections) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box box{{kInfinity, kInfinity}, {-kInfinity, -kInfinity}};
  for (const Section& section : sections) {
    for (const Section::Piece& piece : section.pieces) {
      for (const Vec2 p : piece.corners) {
        box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
        box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
      }
    }
  }
  return box.low.x <= box.high.x ? box : Box{{0, 0}, {1, 1}};
}

double median_edge(std::span<const Section> sections, const Box& box) {
  std::vector<double> lengths;
  for (const Section& section : sections) {
    for (const Section::Piece& piece : section.pieces) {
      for (std::size_t i = 0; i < piece.corners.size(); ++i) {
        const Segment side{piece.corners[i], piece.corners[(i + 1) % piece.corners.size()]};
        if (piece.sides[i] != Section::Side::none && clip(side, box)) lengths.push_back(length(side.to - side.from));
      }
    }
  }
  return upper_median(std::move(lengths));
}

// The power of ten next below a hundredth of an edge.
double grid_unit(double edge_pixels) {
  double unit = kCoarsest;
  while (unit > kFinest && unit * kStepsPerEdge > edge_pixels) unit /= 10;
  return unit;
}

}  // namespace

GridPoint Viewport::grid(Vec2 p) const {
  const double steps = scale / unit;
  return {std::llround((p.x - box.low.x) * steps), std::llround((box.high.y - p.y) * steps)};
}

std::int64_t Viewport::steps(double pixels) const { return std::llround(pixels / unit); }

namespace {

/// The viewport of a box, without its view. `all`: the box of everything; `margin_of`: white space around, from the
/// larger side; `edge_of`: the median edge in a box.
template <class MarginOf, class EdgeOf>
Viewport viewport_of(const Box& all, std::size_t n_panels, const DrawOptions& options, const MarginOf& margin_of,
                     const EdgeOf& edge_of) {
  Viewport viewport;
  Box box = options.zoom ? ordered(*options.zoom) : all;
  double side = larger_side(box);
  if (!(side > 0) || !std::isfinite(side)) {
    box = grown(all, 0.5);
    side = larger_side(box);
  }
  if (!options.zoom) box = grown(box, margin_of(side));

  viewport.width = options.width >= kLeastWidth ? options.width : kLeastWidth;
  const double panels = static_cast<double>(n_panels);
  viewport.em = std::max(kLeastEm, kEm * panels * viewport.width / (1 - kEm * Viewport::kGapEms * (panels + 1)));
  const double w = box.high.x - box.low.x, h = box.high.y - box.low.y;
  const double ratio = w > 0 ? std::clamp(h / w, kFlattest, kTallest) : kTallest;
  viewport.height = std::round(viewport.width * ratio);
  viewport.scale =
      std::min(w > 0 ? viewport.width / w : viewport.height / h, h > 0 ? viewport.height / h : viewport.width / w);
  const Vec2 center = 0.5 * (box.low + box.high);
  const Vec2 half = {viewport.width / (2 * viewport.scale), viewport.height / (2 * viewport.scale)};
  viewport.box = {center - half, center + half};
  viewport.clip = grown(viewport.box, kClipMargin * larger_side(viewport.box));
  viewport.edge = edge_of(viewport.clip) * viewport.scale;
  viewport.unit = grid_unit(viewport.edge);
  return viewport;
}

}  // namespace

Viewport make_viewport(std::span<const Mesh* const> meshes, const DrawOptions& options) {
  const View view = make_view(meshes, options);
  Viewport viewport = viewport_of(
      bounding_box(meshes, view), meshes.size(), options, [&](double side) { return margin(meshes, options, side); },
      [&](const Box& box) { return median_edge(meshes, view, box); });
  viewport.view = view;
  return viewport;
}

Viewport make_viewport(std::span<const Section> sections, const DrawOptions& options) {
  return viewport_of(
      bounding_box(sections), sections.size(), options, [](double side) { return kMargin * side; },
      [&](const Box& box) { return median_edge(sections, box); });
}

std::optional<Segment> clip(const Segment& s, const Box& box) {
  const Vec2 along = s.to - s.from;
  if (!std::isfinite(along.x) || !std::isfinite(along.y)) return std::nullopt;
  // The segment is from + t · along, t in [0, 1]; each side of the box cuts that range.
  double t0 = 0, t1 = 1;
  const std::array<double, 4> outward = {-along.x, along.x, -along.y, along.y};
  const std::array<double, 4> room = {s.from.x - box.low.x, box.high.x - s.from.x, s.from.y - box.low.y,
                                      box.high.y - s.from.y};
  for (int side = 0; side < 4; ++side) {
    if (outward[side] == 0) {
      if (room[side] < 0) return std::nullopt;
    } else if (outward[side] < 0) {
      t0 = std::max(t0, room[side] / outward[side]);
    } else {
      t1 = std::min(t1, room[side] / outward[side]);
    }
  }
  if (t0 > t1) return std::nullopt;
  return Segment{t0 == 0 ? s.from : s.from + t0 * along, t1 == 1 ? s.to : s.from + t1 * along};
}

std::vector<Vec2> clip(std::vector<Vec2> polygon, const Box& box) {
  // Keeps the part with positive room, for one side after the other.
  for (int side = 0; side < 4 && !polygon.empty(); ++side) {
    const auto room = [&](Vec2 p) {
      switch (side) {
        case 0:
          return p.x - box.low.x;
        case 1:
          return box.high.x - p.x;
        case 2:
          return p.y - box.low.y;
        default:
          return box.high.y - p.y;
      }
    };
    std::vector<Vec2> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
      const double in_a = room(a), in_b = room(b);
      if (in_a >= 0) kept.push_back(a);
      if ((in_a < 0) != (in_b < 0)) kept.push_back(a + (in_a / (in_a - in_b)) * (b - a));
    }
    polygon = std::move(kept);
  }
  return polygon;
}

bool meets(Vec2 center, double radius, const Box& box) {
  const Vec2 nearest = {std::clamp(center.x, box.low.x, box.high.x), std::clamp(center.y, box.low.y, box.high.y)};
  return squared_length(center - nearest) <= radius * radius;
}

void PathText::command(char c) {
  if (c != last_) text_ += c;
  last_ = c;
}

void PathText::number(std::int64_t value) {
  const char before = text_.empty() ? '\0' : text_.back();
  if (value >= 0 && before >= '0' && before <= '9') text_ += ' ';
  char buffer[24];
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
  text_.append(buffer, result.ptr);
}

void PathText::step_to(GridPoint p) {
  number(p.x - at_.x);
  number(p.y - at_.y);
  at_ = p;
}

void PathText::move_to(GridPoint p) {
  last_ = '\0';  // a pair after a move would be a line
  command('m');
  step_to(p);
  start_ = p;
}

void PathText::line_to(GridPoint p) {
  command('l');
  step_to(p);
}

void PathText::close() {
  text_ += 'z';
  last_ = '\0';
  at_ = start_;
}

void PathText::circle(GridPoint center, std::int64_t radius) {
  if (radius <= 0) return;
  move_to({center.x - radius, center.y});
  for (const std::int64_t across : {2 * radius, -2 * radius}) {
    command('a');
    number(radius);
    number(radius);
    text_ += " 0 1 0";
    number(across);
    number(0);
  }
  close();
}

void PathText::segment(GridPoint a, GridPoint b) {
  if (a == b) return;
  const bool goes_on = !text_.empty() && last_ == 'l';
  if (goes_on && at_ == a) return line_to(b);
  if (goes_on && at_ == b) return line_to(a);
  move_to(a);
  line_to(b);
}

}  // namespace temper
