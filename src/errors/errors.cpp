// measure_errors(): the parts in order, one field after the other, so that only one field's means are in memory.
#include "temper/errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/box.hpp"
#include "errors/poisson.hpp"
#include "geometry/bounding_boxes.hpp"
#include "temper/dec.hpp"
#include "temper/surface_errors.hpp"

namespace temper {
namespace error_detail {
namespace {

constexpr std::size_t kMostTriangles = 8'000'000;  // of a refined mesh: some ten gigabytes with its factors

void add_squares(LocalErrors& sums, const LocalErrors& errors) {
  for (std::size_t star = 0; star < sums.size(); ++star) {
    sums[star].resize(errors[star].size(), 0.0);
    for (std::size_t i = 0; i < errors[star].size(); ++i) sums[star][i] += errors[star][i] * errors[star][i];
  }
}

void root_of_means(LocalErrors& sums, std::size_t fields) {
  for (std::vector<double>& values : sums) {
    for (double& value : values) value = finite_or_infinity(std::sqrt(value / static_cast<double>(fields)));
  }
}

double domain_area(const DecComplex& dec, const FieldFrame& frame) {
  double sum = 0;
  for (const double area : dec.areas) sum += area;
  return sum / frame.half_size / frame.half_size;
}

bool is_closed(const DecComplex& dec) {
  return std::none_of(dec.edges.begin(), dec.edges.end(), [](const DecEdge& edge) { return edge.is_boundary(); });
}

/// A mesh with its operators, and the setting that refers to both: must not be moved.
struct Subject {
  Subject(const Mesh& m, const FieldFrame& frame, Executor* executor)
      : mesh(m),
        operators(dec_operators(mesh)),
        summary(summarize(mesh, operators)),
        setting{mesh, operators, frame, domain_area(operators, frame), executor, is_closed(operators)} {}
  Subject(const surfaces::SurfaceMesh& surface, const surfaces::FieldFrame& frame)
      : mesh(surface.connectivity()),
        operators(surfaces::dec_operators(surface)),
        summary(surfaces::summarize(surface, operators)),
        setting{mesh,
                operators,
                {{frame.center.x, frame.center.y}, frame.half_size},
                domain_area(operators, {{}, frame.half_size}),
                nullptr,
                is_closed(operators),
                &surface,
                frame.center.z} {}
  Subject(const Subject&) = delete;
  Subject& operator=(const Subject&) = delete;
  ~Subject() = default;

  const Mesh& mesh;
  const DecComplex operators;
  const DecSummary summary;
  const Setting setting;
};

ErrorLevel level_of(const Subject& subject, std::vector<FieldErrors> fields) {
  const DecSummary& summary = subject.summary;
  return {summary.vertices, summary.triangles, summary.negative_star1, summary.not_well_centered, std::move(fields)};
}

ErrorReport report_of(const Subject& subject, Measured measured, bool local) {
  const DecSummary& summary = subject.summary;
  ErrorReport report;
  report.vertices = summary.vertices;
  report.edges = summary.edges;
  report.triangles = summary.triangles;
  report.non_regular_edges = summary.negative_star1;
  report.negative_boundary_duals = summary.negative_boundary_star1;
  report.negative_star0 = summary.negative_star0;
  report.not_well_centered = summary.not_well_centered;
  report.frame = subject.setting.frame;
  report.poisson = measured.poisson;
  report.flux = measured.flux;
  report.fields = std::move(measured.fields);
  if (local) report.local = std::move(measured.local);
  return report;
}

Expected<void> refine_and_measure(const Mesh& mesh, const std::vector<Field>& fields,
                                  const MeasureErrorsOptions& options, ErrorReport& report) {
  Mesh finer = mesh;
  for (int i = 0; i < options.refine; ++i) {
    auto next = refined(finer);
    if (!next) return next.error();
    finer = *std::move(next);
    const Subject subject(finer, report.frame, options.executor);
    report.levels.push_back(level_of(subject, measure(subject.setting, fields, false).fields));
  }
  report.orders = convergence_orders(report.levels);
  return {};
}

Expected<void> check(const Mesh& mesh, const MeasureErrorsOptions& options) {
  const auto error = [](ErrorCode code, const std::string& message) { return InputError{code, "", message}; };
  if (mesh.n_triangles() == 0) return error(ErrorCode::empty_input, "the mesh has no triangles");
  if (options.refine < 0) return error(ErrorCode::invalid_option, "refine is negative");
  std::size_t triangles = mesh.n_triangles();
  for (int i = 0; i < options.refine; ++i) {
    triangles *= 4;
    if (triangles > kMostTriangles) {
      return error(ErrorCode::invalid_option, "refining " + std::to_string(options.refine) + " times makes more than " +
                                                  std::to_string(kMostTriangles) + " triangles");
    }
  }
  if (!options.frame) return {};
  const auto& [center, half] = *options.frame;
  if (!(half > 0) || !std::isfinite(half) || !std::isfinite(center.x) || !std::isfinite(center.y)) {
    return error(ErrorCode::invalid_option, "the frame's half_size is not positive, or a number of it is not finite");
  }
  return {};
}

}  // namespace

Measured measure(const Setting& setting, const std::vector<Field>& fields, bool condition) {
  Measured measured;
  const SchemeErrors poisson = poisson_errors(setting, fields, condition);
  const LocalErrors weights = star_weights(setting);
  FluxScheme flux = flux_scheme(setting);
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const auto means = edge_means(setting, fields[i]);
    const LocalErrors errors = local_star_errors(setting, fields[i], means);
    flux.add_field(fields[i], inflows(setting, means));
    add_squares(measured.local, errors);
    FieldErrors row = {fields[i].field, {}};
    row.errors.star = star_norms(setting, weights, errors);
    row.errors.poisson = poisson.fields[i];
    measured.fields.push_back(row);
  }
  root_of_means(measured.local, fields.size());
  const SchemeErrors solved = flux.solve(weights[2], setting.area, condition);
  for (std::size_t i = 0; i < fields.size(); ++i) measured.fields[i].errors.flux = solved.fields[i];
  measured.poisson = poisson.system;
  measured.flux = solved.system;
  return measured;
}

}  // namespace error_detail

FieldFrame field_frame(const Mesh& mesh) {
  if (mesh.space().radius() > 0) return {{0, 0}, mesh.space().radius()};
  PlaneBox box;
  for (const VertexId v : mesh.vertices()) {
    if (!mesh.is_isolated(v)) box.add(mesh.position(v));
  }
  auto& [low, high] = box;
  if (low.x > high.x) return {};  // no vertex of a triangle
  const Vec2 period = mesh.space().period();
  if (period.x > 0) low.x = 0, high.x = period.x;
  if (period.y > 0) low.y = 0, high.y = period.y;
  return {0.5 * low + 0.5 * high, 0.5 * box.longer_side()};
}

Expected<ErrorReport> measure_errors(const Mesh& mesh, const MeasureErrorsOptions& options) {
  using namespace error_detail;
  auto fields = select_fields(options.fields, mesh.space().kind());
  if (!fields) return fields.error();
  if (const auto checked = check(mesh, options); !checked) return checked.error();

  const Subject subject(mesh, options.frame.value_or(field_frame(mesh)), options.executor);
  for (Field& field : *fields) field.wave = first_waves(mesh.space(), subject.setting.frame);
  ErrorReport report = report_of(subject, measure(subject.setting, *fields, options.condition), options.local);
  if (options.refine == 0) return report;
  report.levels.push_back(level_of(subject, report.fields));
  if (const auto done = refine_and_measure(mesh, *fields, options, report); !done) return done.error();
  return report;
}

namespace surfaces {

FieldFrame field_frame(const SurfaceMesh& mesh) {
  const BoundingBox box = bounding_box(mesh);
  const Vec3 sides = box.high - box.low;
  return {0.5 * box.low + 0.5 * box.high, 0.5 * sides.*(box.longest())};
}

Expected<ErrorReport> measure_errors(const SurfaceMesh& mesh, const MeasureErrorsOptions& options) {
  using namespace error_detail;
  const auto fields = select_fields_of_space(options.fields);
  if (!fields) return fields.error();
  const FieldFrame frame = options.frame.value_or(field_frame(mesh));
  temper::MeasureErrorsOptions in_plane;
  // Not finite if z is not.
  in_plane.frame = {{frame.center.x + 0 * frame.center.z, frame.center.y}, frame.half_size};
  if (const auto checked = check(mesh.connectivity(), in_plane); !checked) return checked.error();
  const Subject subject(mesh, frame);
  ErrorReport report;
  static_cast<temper::ErrorReport&>(report) =
      report_of(subject, measure(subject.setting, *fields, options.condition), false);
  report.frame = frame;
  return report;
}

Expected<std::vector<FieldErrors>> error_ratios(const ErrorReport& after, const ErrorReport& before) {
  return error_detail::field_ratios(after.fields, before.fields, after.frame == before.frame);
}

}  // namespace surfaces
}  // namespace temper
