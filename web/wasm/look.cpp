// What only looks at a mesh: quality, energies, discrete exterior calculus, pictures.
#include <algorithm>
#include <limits>
#include <map>

#include "answer.hpp"
#include "held_mesh.hpp"
#include "records.hpp"
#include "temper/dec.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/detail/html.hpp"
#include "temper/draw.hpp"
#include "temper/quality.hpp"
#include "tensor.hpp"

namespace temper::wasm {

/// Options: gamma, h0, worst, tensor.
TEMPER_EXPORT(mesh_quality) int mesh_quality(const HeldMesh* held, const char* options, std::size_t size) {
  return done([&] {
    constexpr std::string_view kNames[] = {"gamma", "h0", "worst", "tensor"};
    const Json given = parse({options, size});
    expect_names(given, kNames);
    QualityOptions how;
    if (given.contains("gamma")) how.gamma = length_parameter_from("gamma", given["gamma"]);
    if (given.contains("h0")) how.h0 = length_parameter_from("h0", given["h0"]);
    take(given, "worst", how.worst);
    const auto tensors = tensors_from(given, held->mesh);
    answer(json_of(tensors ? quality(in_metric(*held, *tensors).mesh, how) : quality(held->mesh, how)));
  });
}

/// The least h/ℓ, d/ℓ or 1 − d/ℓ of each triangle, in doubles.
TEMPER_EXPORT(mesh_triangle_margins) int mesh_triangle_margins(const HeldMesh* held) {
  return done([&] {
    std::vector<double> margins;
    for (const TriangleId t : held->mesh.triangles()) {
      const auto c = held->mesh.corners(t);
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < 3; ++k) {
        const WeightedPoint a = held->mesh.point(c[k]), b = held->mesh.point(c[(k + 1) % 3]);
        const double l = length(b.position() - a.position()), d = dual_crossing(a, b) / l;
        least = std::min({least, signed_height(a, b, held->mesh.point(c[(k + 2) % 3])) / l, d, 1 - d});
      }
      margins.push_back(least);
    }
    answer_array(std::span<const double>(margins));
  });
}
/// A byte a triangle: well-centered, exactly.
TEMPER_EXPORT(mesh_well_centered_triangles) int mesh_well_centered_triangles(const HeldMesh* held) {
  return done([&] {
    std::vector<std::uint8_t> good;
    for (const TriangleId t : held->mesh.triangles()) {
      const auto c = held->mesh.corners(t);
      good.push_back(is_well_centered(held->mesh.point(c[0]), held->mesh.point(c[1]), held->mesh.point(c[2])) ? 1 : 0);
    }
    answer_array(std::span<const std::uint8_t>(good));
  });
}

TEMPER_EXPORT(energies) void answer_energies() { answer(energy_table()); }
TEMPER_EXPORT(mesh_total_energy) int mesh_total_energy(const HeldMesh* held, const char* model, std::size_t size) {
  return done([&] { answer(number(total_energy(held->mesh, model_from(parse({model, size}))))); });
}
TEMPER_EXPORT(mesh_vertex_energy)
int mesh_vertex_energy(const HeldMesh* held, const char* model, std::size_t size, std::uint32_t vertex) {
  return done([&] {
    if (vertex >= held->mesh.n_vertices())
      fail(ErrorCode::index_out_of_range, "there is no vertex " + std::to_string(vertex));
    const VertexDerivatives d =
        vertex_energy(held->mesh, model_from(parse({model, size})), VertexId(std::size_t{vertex}));
    answer(
        Json{{"value", number(d.value)}, {"feasible", d.feasible}, {"gradient", d.gradient}, {"hessian", d.hessian}});
  });
}

// --- dec ------------------------------------------------------------------------------------------------------------

namespace {

/// Operators, and the mesh that was measured: in the planes of tensors, if there are some.
struct HeldComplex {
  DecComplex complex;
  std::optional<MetricMesh> pieces;
};

/// One member of every edge.
template <class Member>
void answer_edges(const DecComplex& complex, Member member) {
  std::vector<std::decay_t<decltype(member(complex.edges[EdgeId(0)]))>> values;
  for (const DecEdge& e : complex.edges) values.push_back(member(e));
  answer_array(std::span<const typename decltype(values)::value_type>(values));
}
template <class T>
void answer_all(const std::vector<T>& values) {
  answer_array(std::span<const T>(values));
}

/// As 32 bits, of which there are enough in the memory of a module.
void answer_starts(const std::vector<std::int64_t>& starts) {
  answer_all(std::vector<std::int32_t>(starts.begin(), starts.end()));
}

using AnswerArray = void (*)(const DecComplex&);
using Ids = std::array<std::uint32_t, 2>;

/// The arrays of a complex by the names that JavaScript has for them.
const std::map<std::string_view, AnswerArray>& dec_arrays() {
  static const std::map<std::string_view, AnswerArray> arrays = {
      {"star0", [](const DecComplex& c) { answer_all(c.star0.raw()); }},
      {"star1", [](const DecComplex& c) { answer_all(c.star1.raw()); }},
      {"star2", [](const DecComplex& c) { answer_all(c.star2.raw()); }},
      {"transmissibility", [](const DecComplex& c) { answer_all(c.transmissibility.raw()); }},
      {"half_transmissibility", [](const DecComplex& c) { answer_all(c.half_transmissibility.raw()); }},
      {"areas", [](const DecComplex& c) { answer_all(c.areas.raw()); }},
      {"orthocenters", [](const DecComplex& c) { answer_all(c.orthocenters.raw()); }},
      {"edge_of_halfedge", [](const DecComplex& c) { answer_all(c.edge_of_halfedge.raw()); }},
      {"d0.starts", [](const DecComplex& c) { answer_starts(c.d0.starts); }},
      {"d0.columns", [](const DecComplex& c) { answer_all(c.d0.columns); }},
      {"d0.signs", [](const DecComplex& c) { answer_all(c.d0.signs); }},
      {"d1.starts", [](const DecComplex& c) { answer_starts(c.d1.starts); }},
      {"d1.columns", [](const DecComplex& c) { answer_all(c.d1.columns); }},
      {"d1.signs", [](const DecComplex& c) { answer_all(c.d1.signs); }},
      {"edges.vertices",
       [](const DecComplex& c) { answer_edges(c, [](const DecEdge& e) {
                                   return Ids{e.from.index, e.to.index};
                                 }); }},
      {"edges.triangles",
       [](const DecComplex& c) { answer_edges(c, [](const DecEdge& e) {
                                   return Ids{e.left.index, e.right.index};
                                 }); }},
      {"edges.length", [](const DecComplex& c) { answer_edges(c, [](const DecEdge& e) { return e.length; }); }},
      {"edges.crossing", [](const DecComplex& c) { answer_edges(c, [](const DecEdge& e) { return e.crossing; }); }},
      {"edges.left_height",
       [](const DecComplex& c) { answer_edges(c, [](const DecEdge& e) { return e.left_height; }); }},
      {"edges.right_height",
       [](const DecComplex& c) { answer_edges(c, [](const DecEdge& e) { return e.right_height; }); }},
      {"edges.dual_length",
       [](const DecComplex& c) { answer_edges(c, [](const DecEdge& e) { return e.dual_length; }); }},
      {"edges.midpoint", [](const DecComplex& c) { answer_edges(c, [](const DecEdge& e) { return e.midpoint; }); }},
  };
  return arrays;
}

}  // namespace

/// Options: tensor.
TEMPER_EXPORT(dec_make) const HeldComplex* dec_make(const HeldMesh* held, const char* options, std::size_t size) {
  return guarded<const HeldComplex*>(nullptr, [&] {
    constexpr std::string_view kNames[] = {"tensor"};
    const Json given = parse({options, size});
    expect_names(given, kNames);
    const auto tensors = tensors_from(given, held->mesh);
    if (!tensors) return new HeldComplex{dec_operators(held->mesh), {}};
    MetricMesh pieces = in_metric(*held, *tensors);
    DecComplex complex = mapped_back(dec_operators(pieces.mesh), pieces, held->mesh);
    return new HeldComplex{std::move(complex), std::move(pieces)};
  });
}
TEMPER_EXPORT(dec_release) void dec_release(const HeldComplex* held) { delete held; }
/// The answer is the bytes of the array.
TEMPER_EXPORT(dec_array) int dec_array(const HeldComplex* held, const char* name, std::size_t size) {
  return done([&] {
    const auto found = dec_arrays().find(std::string_view(name, size));
    if (found == dec_arrays().end()) throw WrongType{"there is no array " + std::string(name, size)};
    found->second(held->complex);
  });
}
TEMPER_EXPORT(dec_summary) int dec_summary(const HeldMesh* held, const HeldComplex* made) {
  return done([&] { answer(json_of(summarize(made->pieces ? made->pieces->mesh : held->mesh, made->complex))); });
}

// --- pictures
// ---------------------------------------------------------------------------------------------------------

namespace {

DrawOptions draw_options_from(const Json& given) {
  constexpr std::string_view kNames[] = {"primal",          "dual",           "fill", "weights", "weight_scale",
                                         "near_coincident", "vertex_numbers", "zoom", "width",   "title"};
  expect_names(given, kNames);
  DrawOptions o;
  take(given, "primal", o.primal), take(given, "dual", o.dual), take(given, "fill", o.fill);
  take(given, "weights", o.weights), take(given, "weight_scale", o.weight_scale);
  take(given, "near_coincident", o.near_coincident);
  take(given, "vertex_numbers", o.vertex_numbers), take(given, "width", o.width), take(given, "title", o.title);
  if (given.contains("zoom") && !given["zoom"].is_null()) {
    std::array<double, 4> z{};
    take(given, "zoom", z);
    o.zoom = Box{{z[0], z[1]}, {z[2], z[3]}};
  }
  return o;
}

}  // namespace

/// The answer is the picture. `after` may be null: one panel.
TEMPER_EXPORT(mesh_draw_svg)
int mesh_draw_svg(const HeldMesh* held, const HeldMesh* after, const char* options, std::size_t size) {
  return done([&] {
    const DrawOptions how = draw_options_from(parse({options, size}));
    answer(after == nullptr ? draw_svg(held->mesh, how) : draw_before_after_svg(held->mesh, after->mesh, how));
  });
}

/// The answer is the page. `before` may be null; `shown` is JSON: see docs/reference/formats/report.md.
TEMPER_EXPORT(mesh_html_report)
int mesh_html_report(const HeldMesh* held, const HeldMesh* before, const char* title, std::size_t title_size,
                     const char* shown, std::size_t shown_size) {
  return done([&] {
    io::HtmlReport report{.mesh = io::HtmlMesh{held->mesh}, .title = {title, title_size}, .json = {shown, shown_size}};
    if (before != nullptr) report.before.emplace(io::HtmlMesh{before->mesh});
    answer(io::html_report(report));
  });
}

}  // namespace temper::wasm
