// measure_errors() of tetrahedra.
//
// A flag is a tetrahedron with one of its faces and an edge of this face. The triangle of the weighted midpoint of the
// edge and both orthocenters is a part of the dual face; with either end of the edge it is a part of a dual cell. Parts
// have the signs of their heights.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "errors/poisson.hpp"
#include "geometry/bounding_boxes.hpp"
#include "temper/tets/errors.hpp"
#include "temper/tets/operators.hpp"

namespace temper::tets {
namespace {

using error_detail::CellLink;
using error_detail::Field;
using error_detail::FieldSize;
using error_detail::Place;

// Rules of degree 3 with points on the corners, which parts share: errors of fourth order, far below the measured ones.

/// The mean over a triangle of a function with values in a vector space.
template <class Value>
auto mean_over_triangle(const std::array<Vec3, 3>& corners, const Value& value) {
  const auto& [a, b, c] = corners;
  return (1.0 / 20) * (value(a) + value(b) + value(c)) +
         (2.0 / 15) * (value(0.5 * (a + b)) + value(0.5 * (b + c)) + value(0.5 * (c + a))) +
         (9.0 / 20) * value((1.0 / 3) * (a + b + c));
}

template <class Value>
double mean_over_tetrahedron(const std::array<Vec3, 4>& corners, const Value& value) {
  const auto& [a, b, c, d] = corners;
  const auto of_face = [&](Vec3 p, Vec3 q, Vec3 r) { return value((1.0 / 3) * (p + q + r)); };
  return (1.0 / 40) * (value(a) + value(b) + value(c) + value(d)) +
         (9.0 / 40) * (of_face(a, b, c) + of_face(a, b, d) + of_face(a, c, d) + of_face(b, c, d));
}

/// A field in the coordinates of the mesh.
struct Framed {
  const Field& field;
  const FieldFrame& frame;

  [[nodiscard]] Place place(Vec3 p) const { return (1 / frame.half_size) * (p - frame.center); }
  [[nodiscard]] double value(Vec3 p) const { return field.at(place(p)).u; }
  [[nodiscard]] Vec3 gradient(Vec3 p) const { return (1 / frame.half_size) * field.at(place(p)).gradient; }
  [[nodiscard]] double laplacian(Vec3 p) const {
    return field.at(place(p)).laplacian / frame.half_size / frame.half_size;
  }
  [[nodiscard]] FieldSize size() const {
    const FieldSize in_frame = size_of(field);
    return {in_frame.value, in_frame.gradient / frame.half_size};
  }
  [[nodiscard]] Vec3 mean_gradient(const std::array<Vec3, 2>& segment) const {
    Vec3 mean;
    for (const error_detail::GaussNode& node : error_detail::kGauss)
      mean = mean + node.weight * gradient(segment[0] + node.at * (segment[1] - segment[0]));
    return mean;
  }
  [[nodiscard]] Vec3 mean_gradient(const std::array<Vec3, 3>& triangle) const {
    return mean_over_triangle(triangle, [&](Vec3 p) { return gradient(p); });
  }
};

/// ∫ over a dual face or a dual cell, and its size without signs.
struct Integral {
  double value = 0, size = 0;

  void add(double part, double mean) { value += part * mean, size += std::abs(part); }
  /// The error of a star, relative to `scale`; a dual of no size has none.
  [[nodiscard]] double error(double star, double scale) const {
    return size > 0 ? error_detail::finite_or_infinity(std::abs(value - star) / size / scale) : 0;
  }
};
struct Duals {
  std::vector<Integral> cells, faces;
};

/// Errors with weights that sum to about `all` without signs.
struct WeightedErrors {
  std::vector<double> weights = {}, errors = {};

  void add(double weight, double error) { weights.push_back(weight), errors.push_back(error); }
  [[nodiscard]] ErrorNorms relative(double all) const {
    const ErrorNorms norms = error_detail::norms_of(weights, errors);
    return {norms.l2 / std::sqrt(all), norms.max};
  }
};

/// A mesh with its operators, and a frame for the fields.
class Subject {
 public:
  Subject(const TetMesh& mesh, const FieldFrame& frame)
      : mesh_(mesh), frame_(frame), dec_(dec_operators(mesh)), summary_(summarize(dec_)) {}

  [[nodiscard]] ErrorReport report(const std::vector<Field>& fields, bool condition) const;

 private:
  using Schemes = error_detail::SchemeErrors;
  [[nodiscard]] std::array<ErrorNorms, 3> star_errors(const Field& field) const;
  void add_flags(const Framed& field, std::size_t f, Duals& duals) const;
  [[nodiscard]] double error_of_face(const Framed& field, const DecFace& face) const;
  [[nodiscard]] Schemes poisson_errors(const std::vector<Field>& fields, bool condition) const;
  [[nodiscard]] Schemes flux_errors(const std::vector<Field>& fields, bool condition) const;
  [[nodiscard]] error_detail::FluxScheme flux_scheme() const;

  [[nodiscard]] std::array<Vec3, 3> corners_of(const DecFace& face) const {
    return {mesh_.position(face.vertices[0]), mesh_.position(face.vertices[1]), mesh_.position(face.vertices[2])};
  }
  [[nodiscard]] Vec3 normal_of(const DecFace& face) const {
    const auto [p, q, r] = corners_of(face);
    return (0.5 / face.area) * cross(q - p, r - p);
  }
  [[nodiscard]] Vec3 direction_of(const DecEdge& edge) const {
    return (1 / edge.length) * (mesh_.position(edge.to) - mesh_.position(edge.from));
  }

  const TetMesh& mesh_;
  const FieldFrame frame_;
  const DecComplex dec_;
  const DecSummary summary_;
};

/// Adds the parts of dual faces and dual cells at one face.
void Subject::add_flags(const Framed& field, std::size_t f, Duals& duals) const {
  const DecFace& face = dec_.faces[FaceId(f)];
  const Vec3 n = normal_of(face);
  for (std::size_t i = 3 * f; i < 3 * f + 3; ++i) {
    const auto e = static_cast<std::size_t>(dec_.d1.columns[i]);
    const DecEdge& edge = dec_.edges[EdgeId(e)];
    const Vec3 t = direction_of(edge);
    // Height of the orthocenter of the face over the edge, towards the inside of the face.
    const double k = dot(face.orthocenter - edge.midpoint, dec_.d1.signs[i] * cross(n, t));
    for (const auto& [h, tetrahedron] :
         {std::pair(face.behind_height, face.behind), std::pair(face.ahead_height, face.ahead)}) {
      if (!tetrahedron.valid()) continue;
      const Vec3 center = dec_.orthocenters[tetrahedron];
      const double area = 0.5 * k * h;
      duals.faces[e].add(area, dot(t, field.mean_gradient(std::array{edge.midpoint, face.orthocenter, center})));
      for (const auto& [d, v] :
           {std::pair(edge.crossing, edge.from), std::pair(edge.length - edge.crossing, edge.to)}) {
        duals.cells[v.index].add(area * d / 3,
                                 mean_over_tetrahedron({mesh_.position(v), edge.midpoint, face.orthocenter, center},
                                                       [&](Vec3 p) { return field.value(p); }));
      }
    }
  }
}

/// The dual edge runs from the orthocenter behind to the one ahead. On the boundary it ends on the face.
double Subject::error_of_face(const Framed& field, const DecFace& face) const {
  const auto end = [&](TetId t) { return t.valid() ? dec_.orthocenters[t] : face.orthocenter; };
  const Vec3 along = field.mean_gradient(std::array{end(face.behind), end(face.ahead)});
  return std::abs(dot(normal_of(face), along - field.mean_gradient(corners_of(face))));
}

// Edges, and faces, times their duals have three times the volume, and each sees one of three directions.
std::array<ErrorNorms, 3> Subject::star_errors(const Field& plain) const {
  const Framed field = {plain, frame_};
  const FieldSize size = field.size();
  Duals duals = {std::vector<Integral>(dec_.star0.size()), std::vector<Integral>(dec_.edges.size())};
  std::array<WeightedErrors, 3> errors;
  for (std::size_t f = 0; f < dec_.faces.size(); ++f) {
    const DecFace& face = dec_.faces[FaceId(f)];
    add_flags(field, f, duals);
    errors[2].add(face.area * std::abs(face.dual_length), error_of_face(field, face) / size.gradient);
  }
  for (std::size_t e = 0; e < dec_.edges.size(); ++e) {
    const DecEdge& edge = dec_.edges[EdgeId(e)];
    const Vec3 mean = field.mean_gradient(std::array{mesh_.position(edge.from), mesh_.position(edge.to)});
    const double star = edge.dual_area * dot(direction_of(edge), mean);
    errors[1].add(edge.length * duals.faces[e].size, duals.faces[e].error(star, size.gradient));
  }
  for (const VertexId v : mesh_.vertices()) {
    const Integral& cell = duals.cells[v.index];
    errors[0].add(cell.size, cell.error(dec_.star0[v] * field.value(mesh_.position(v)), size.value));
  }
  return {errors[0].relative(summary_.volume), errors[1].relative(summary_.volume),
          errors[2].relative(summary_.volume)};
}

Subject::Schemes Subject::poisson_errors(const std::vector<Field>& fields, bool condition) const {
  std::vector<bool> given;
  for (const std::uint8_t on_boundary : boundary_vertices(mesh_)) given.push_back(on_boundary != 0);
  const error_detail::PointSystem points = error_detail::vertex_system(dec_, given);
  Schemes result;
  describe_coefficients(
      dec_, points, [](const DecEdge& edge) { return edge.is_boundary; }, result.system);
  error_detail::LinearSystem linear = {points.n_unknowns(), points.lower(), {}};
  for (const Field& plain : fields) {
    const Framed field = {plain, frame_};
    std::vector<double> sources, values;
    for (const VertexId v : mesh_.vertices()) {
      sources.push_back(-dec_.star0[v] * field.laplacian(mesh_.position(v)));
      values.push_back(field.value(mesh_.position(v)));
    }
    linear.right_sides.push_back(points.right_side(sources, values));
  }
  const error_detail::LinearSolution solution = error_detail::solve(linear, condition);
  describe(linear, solution, result.system);
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const Framed field = {fields[i], frame_};
    const double size = field.size().value;
    if (solution.singular) {
      result.fields.push_back({HUGE_VAL, HUGE_VAL});
      continue;
    }
    std::vector<double> values(given.size(), 0.0);
    points.put(solution.solutions[i], values);
    WeightedErrors errors;
    for (const VertexId v : mesh_.vertices()) {
      if (!given[v.index])
        errors.add(std::abs(dec_.star0[v]), (values[v.index] - field.value(mesh_.position(v))) / size);
    }
    result.fields.push_back(errors.relative(summary_.volume));
  }
  return result;
}

error_detail::FluxScheme Subject::flux_scheme() const {
  std::vector<CellLink> links;
  std::vector<Place> orthocenters;
  const auto place = [&](Vec3 p) { return Place((1 / frame_.half_size) * (p - frame_.center)); };
  for (std::size_t f = 0; f < dec_.faces.size(); ++f) {
    const DecFace& face = dec_.faces[FaceId(f)];
    const TetId cell = face.behind.valid() ? face.behind : face.ahead;
    links.push_back({cell.index, face.is_boundary() ? CellLink::kOutside : face.ahead.index,
                     dec_.transmissibility[FaceId(f)], face.dual_length, std::sqrt(face.area),
                     place(face.orthocenter)});
  }
  for (const Vec3 center : dec_.orthocenters) orthocenters.push_back(place(center));
  return {std::move(links), std::move(orthocenters), false};
}

Subject::Schemes Subject::flux_errors(const std::vector<Field>& fields, bool condition) const {
  error_detail::FluxScheme scheme = flux_scheme();
  for (const Field& plain : fields) {
    const Framed field = {plain, frame_};
    std::vector<double> inflows;
    for (const DecFace& face : dec_.faces) {
      const double along = face.area * dot(normal_of(face), field.mean_gradient(corners_of(face)));
      inflows.push_back(face.behind.valid() ? -along : along);
    }
    scheme.add_field(plain, inflows);
  }
  return scheme.solve(dec_.volumes.raw(), summary_.volume, condition);
}

ErrorReport Subject::report(const std::vector<Field>& fields, bool condition) const {
  ErrorReport report;
  report.vertices = summary_.vertices;
  report.edges = summary_.edges;
  report.faces = summary_.faces;
  report.tetrahedra = summary_.tetrahedra;
  report.non_regular_faces = summary_.negative_star2;
  report.negative_boundary_duals = summary_.negative_boundary_star2;
  report.negative_star0 = summary_.negative_star0;
  report.not_well_centered = summary_.not_well_centered;
  report.frame = frame_;
  const Schemes poisson = poisson_errors(fields, condition), flux = flux_errors(fields, condition);
  report.poisson = poisson.system;
  report.flux = flux.system;
  for (std::size_t i = 0; i < fields.size(); ++i)
    report.fields.push_back({fields[i].field, {star_errors(fields[i]), poisson.fields[i], flux.fields[i]}});
  return report;
}

}  // namespace

FieldFrame field_frame(const TetMesh& mesh) {
  const auto [low, high] = bounding_box(mesh);
  return {0.5 * low + 0.5 * high, 0.5 * std::max({high.x - low.x, high.y - low.y, high.z - low.z})};
}

Expected<ErrorReport> measure_errors(const TetMesh& mesh, const MeasureErrorsOptions& options) {
  const auto fields = error_detail::select_fields_of_space(options.fields);
  if (!fields) return fields.error();
  if (mesh.n_tetrahedra() == 0) return InputError{ErrorCode::empty_input, "", "the mesh has no tetrahedra"};
  const FieldFrame frame = options.frame.value_or(field_frame(mesh));
  const auto& [center, half] = frame;
  if (!(half > 0) || !std::isfinite(half + center.x + center.y + center.z)) {
    return InputError{ErrorCode::invalid_option, "",
                      "the frame's half_size is not positive, or a number of it is not finite"};
  }
  return Subject(mesh, frame).report(*fields, options.condition);
}

Expected<std::vector<FieldErrors>> error_ratios(const ErrorReport& after, const ErrorReport& before) {
  return error_detail::field_ratios(after.fields, before.fields, after.frame == before.frame);
}

}  // namespace temper::tets
