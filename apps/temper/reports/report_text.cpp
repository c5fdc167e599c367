#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "console.hpp"
#include "options/options.hpp"
#include "reports/json_of.hpp"
#include "reports/quality_report.hpp"
#include "reports/reports.hpp"
#include "system/system.hpp"

namespace temper::app {
namespace {

constexpr std::size_t kEnergyColumns = 24;
constexpr std::size_t kRangeColumns = 12;
constexpr std::size_t kBarColumns = 10;
constexpr std::size_t kPanelGap = 3;

template <class Row, class Report>
std::string measure_text(const Row& measure, const Report& quality) {
  const double value = measure.of(quality);
  return measure.count ? fmt::format("{}", static_cast<std::size_t>(value)) : fmt::format("{:.6g}", value);
}

/// Twelve decimals where they are all significant, fifteen digits elsewhere: enough to compare with a publication.
std::string energy_text(double value, const TextStyle& style) {
  if (std::isinf(value)) return std::string(value < 0 ? "-" : "+") + (style.utf8 ? "∞" : "inf");
  const double size = std::abs(value);
  return value == 0 || (size >= 0.1 && size < 1e6) ? fmt::format("{:.12f}", value) : fmt::format("{:.14e}", value);
}

std::string star_name(std::size_t star, const TextStyle& style) {
  return fmt::format("{}{}", style.utf8 ? "★" : "star ", star);
}

/// The energies, which not all kinds of cells have.
std::string energy_table(const Quality& quality, const TextStyle& style) {
  std::string text = "\n" + pad_right("energy", 8);
  for (std::size_t star = 0; star < 3; ++star) text += pad_left(star_name(star, style), kEnergyColumns);
  text += "\n";
  for (std::size_t row = 0; row < energies().size(); ++row) {
    text += pad_right("E_" + std::string(energies()[row].name), 8);
    for (const double value : quality.energy[row]) text += pad_left(energy_text(value, style), kEnergyColumns);
    text += "\n";
  }
  return text;
}

std::string energy_table(const tets::Quality& /*quality*/, const TextStyle& /*style*/) { return {}; }
std::string energy_table(const surfaces::Quality& /*quality*/, const TextStyle& /*style*/) { return {}; }

/// A bar of count / most of the full width; a count other than 0 always shows something.
std::string bar(std::size_t count, std::size_t most, const TextStyle& style) {
  static constexpr std::array<const char*, 8> kEighths = {"", "▏", "▎", "▍", "▌", "▋", "▊", "▉"};
  if (count == 0 || most == 0) return "";
  const double full = static_cast<double>(kBarColumns) * static_cast<double>(count) / static_cast<double>(most);
  std::string text;
  if (!style.utf8) return text.assign(std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(full))), '#');
  const std::size_t eighths = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(8 * full)));
  for (std::size_t i = 0; i < eighths / 8; ++i) text += "█";
  return text + kEighths[eighths % 8];
}

std::vector<std::string> histogram_panel(const std::string& title, const Histogram& histogram, const TextStyle& style) {
  std::vector<std::string> lines = {title};
  const std::size_t bins = histogram.counts.size();
  if (bins == 0) return lines;
  const std::size_t most = *std::max_element(histogram.counts.begin(), histogram.counts.end());
  const double step = (histogram.high - histogram.low) / static_cast<double>(bins);
  const int decimals = step >= 1 ? 0 : step >= 0.1 ? 1 : 2;
  const auto edge = [&](std::size_t i) {
    const double value = histogram.low + step * static_cast<double>(i);
    return std::abs(value) < 1e-9 * step ? 0.0 : value;  // no "-0.0" from rounding
  };
  for (std::size_t bin = 0; bin < bins; ++bin) {
    const std::string range = fmt::format("{:>5.{}f}..{:.{}f}", edge(bin), decimals, edge(bin + 1), decimals);
    lines.push_back(fmt::format("{} {} {:>7}", pad_right(range, kRangeColumns),
                                pad_right(bar(histogram.counts[bin], most, style), kBarColumns),
                                histogram.counts[bin]));
  }
  return lines;
}

std::string beside(const std::vector<std::vector<std::string>>& panels) {
  std::size_t rows = 0;
  std::vector<std::size_t> widths;
  for (const auto& panel : panels) {
    rows = std::max(rows, panel.size());
    std::size_t width = 0;
    for (const std::string& line : panel) width = std::max(width, display_width(line));
    widths.push_back(width + kPanelGap);
  }
  std::string text;
  for (std::size_t row = 0; row < rows; ++row) {
    std::string line;
    for (std::size_t i = 0; i < panels.size(); ++i) {
      line += pad_right(row < panels[i].size() ? panels[i][row] : "", widths[i]);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

std::string ell(const TextStyle& style) { return style.utf8 ? "ℓ" : "l"; }

const Histogram& angles(const Quality& quality) { return quality.histograms.angles; }
const Histogram& angles(const tets::Quality& quality) { return quality.histograms.dihedrals; }

std::string histograms(const std::vector<std::vector<std::string>>& panels, const TextStyle& style) {
  std::string text;
  if (style.columns >= 90 + 2 * kPanelGap) {
    text = beside(panels);
  } else {
    for (const auto& panel : panels) text += beside({panel});
  }
  return text + "The first and the last bar also count all values beyond them.\n";
}

/// The reason that is given for an element, in the numbers of the file.
std::string why_text(const std::string& why, const std::function<std::string(VertexId)>& name, const TextStyle& style) {
  const std::string renumbered = renumber(why, name);
  std::string text;
  for (const std::string& line :
       wrap(style.utf8 ? renumbered : in_ascii(renumbered), style.columns > 20 ? style.columns - 4 : 20)) {
    text += "    " + line + "\n";
  }
  return text;
}

std::string place_text(Vec2 at) { return fmt::format("{:.9g} {:.9g}", at.x, at.y); }
std::string place_text(Vec3 at) { return fmt::format("{:.9g} {:.9g} {:.9g}", at.x, at.y, at.z); }

/// The place of a bad element. Reports on surfaces have two coordinates of it alone.
template <class Subject, class Place>
Place shown_place(const InputOf<Subject>& /*input*/, typename Subject::Element /*element*/, const Place& at) {
  return at;
}
Vec3 shown_place(const SurfaceInput& input, TriangleId t, Vec2 /*at*/) {
  const auto [a, b, c] = input.mesh().points(t);
  return (1.0 / 3) * (a.position() + b.position() + c.position());
}

std::pair<TriangleId, double> element_and_angle(const WorstTriangle& w) { return {w.triangle, w.angle_deg}; }
std::pair<tets::TetId, double> element_and_angle(const tets::WorstTet& w) { return {w.tetrahedron, w.dihedral_deg}; }

template <class Subject>
std::string worst_text(const typename Subject::Quality& quality, const InputOf<Subject>& input,
                       const TextStyle& style) {
  if (quality.worst.empty()) return "";
  std::string text = fmt::format("\nworst {}\n", Subject::elements);
  for (const auto& worst : quality.worst) {
    const auto [element, angle] = element_and_angle(worst);
    text += fmt::format("  {} ({}) at {}: h/l {:.4g}, largest {} {:.5g}\n", input.element_number(element),
                        input.vertex_numbers(worst.vertices, " "), place_text(shown_place(input, element, worst.at)),
                        worst.h_over_l, Subject::angle, angle);
    text += why_text(
        worst.why, [&input](VertexId v) { return input.vertex_number(v); }, style);
  }
  return text;
}

/// A row of the short report.
template <class Report>
struct BriefRow {
  std::string label;
  std::string (*text)(const Report&);
};

std::string brief_number(double value) { return std::isfinite(value) ? fmt::format("{:.4g}", value) : "infinite"; }

std::string range(double low, double high) { return fmt::format("{:.1f} - {:.1f}", low, high); }

/// The rows below the number of bad elements.
std::vector<BriefRow<tets::Quality>> further_rows(const tets::Quality& /*quality*/) {
  using Q = tets::Quality;
  return {{"least h/l", [](const Q& q) { return brief_number(q.min_h_over_l); }},
          {"completely well-centered",
           [](const Q& q) { return fmt::format("{:.1f} %", 100 * q.completely_well_centered_fraction); }},
          {"transmissibility, max/median", [](const Q& q) { return brief_number(q.max_transmissibility_over_median); }},
          {"dihedral angles (degrees)", [](const Q& q) { return range(q.min_dihedral_deg, q.max_dihedral_deg); }}};
}
std::vector<BriefRow<surfaces::Quality>> further_rows(const surfaces::Quality& /*quality*/) {
  using Q = surfaces::Quality;
  return {{"least margin", [](const Q& q) { return brief_number(std::min(q.min_h_over_l, q.min_d_over_l)); }},
          {"transmissibility, max/median", [](const Q& q) { return brief_number(q.max_transmissibility_over_median); }},
          {"angles (degrees)", [](const Q& q) { return range(q.min_angle_deg, q.max_angle_deg); }}};
}
std::vector<BriefRow<Quality>> further_rows(const Quality& /*quality*/) {
  using Q = Quality;
  return {{"least margin", [](const Q& q) { return brief_number(std::min(q.min_h_over_l, q.min_d_over_l)); }},
          {"transmissibility, max/median", [](const Q& q) { return brief_number(q.max_transmissibility_over_median); }},
          {"angles (degrees)", [](const Q& q) { return range(q.min_angle_deg, q.max_angle_deg); }},
          {"least edge/size", [](const Q& q) { return brief_number(q.min_edge_over_size); }}};
}

template <class AnyQuality>
std::vector<BriefRow<AnyQuality>> brief_rows(const AnyQuality& quality) {
  std::vector<BriefRow<AnyQuality>> rows = further_rows(quality);
  rows.insert(rows.begin(), {fmt::format("bad {}", SubjectOf<AnyQuality>::elements),
                             [](const AnyQuality& q) { return std::to_string(bad_elements(q)); }});
  return rows;
}

}  // namespace

std::string text_line(std::string_view label, std::string_view value, LineWidths columns) {
  return pad_right(label, columns.label) + pad_left(value, columns.value) + "\n";
}

std::string labeled_text(const ReportView& report, LineWidths columns) {
  std::string text;
  for (const ReportRow& row : report.table->rows) {
    const FieldValue value = row.of(report.report.get());
    if (row.display.label.empty() || std::holds_alternative<std::monostate>(value.is)) continue;
    const auto* number = std::get_if<double>(&value.is);
    const auto* word = std::get_if<std::string>(&value.is);
    text += text_line(row.display.label,
                      number != nullptr ? fmt::format("{:.9g}", *number)
                      : word != nullptr ? *word
                                        : json_of(value).dump(),
                      columns);
  }
  return text;
}

std::string in_ascii(std::string text) {
  const auto replace = [&text](std::string_view from, std::string_view to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at)) {
      text.replace(at, from.size(), to);
    }
  };
  replace("°", " degrees");
  replace("ℓ", "l");
  replace("…", "...");
  return text;
}

TextStyle text_style() { return {utf8_terminal(), output_width()}; }

std::size_t count_quadrilaterals(const Mesh& mesh) {
  std::size_t n = 0;
  for (const HalfedgeId h : mesh.halfedges()) n += mesh.joins_halves(h) && mesh.is_edge_representative(h) ? 1 : 0;
  return n;
}

std::string halves_text(const Mesh& mesh) {
  const std::size_t n = count_quadrilaterals(mesh);
  if (n == 0) return {};
  return fmt::format("{} of these triangles are halves of {}\n", 2 * n, plural(n, "quadrilateral", "quadrilaterals"));
}

void show_places_of_file(Quality& quality, const Input& input) {
  EdgePlace& least = quality.min_coefficient_place;
  least.at = place_in_file(input.file, least.at);
  for (WorstTriangle& worst : quality.worst) worst.at = place_in_file(input.file, worst.at);
}

template <class Subject>
std::string well_centered(std::size_t bad, std::size_t elements) {
  if (bad == 0)
    return elements == 1 ? fmt::format("the {} is well-centered", Subject::element)
                         : fmt::format("all {} {} are well-centered", elements, Subject::elements);
  return fmt::format("{} of {} {} bad (not well-centered)", bad, plural(elements, Subject::element, Subject::elements),
                     bad == 1 ? "is" : "are");
}

template <class AnyQuality>
std::string verdict(const AnyQuality& quality) {
  using Subject = SubjectOf<AnyQuality>;
  const std::size_t irregular = n_irregular_links(quality);
  std::string text = well_centered<Subject>(bad_elements(quality), n_elements(quality));
  text += irregular == 0 ? fmt::format(", every {} is regular", Subject::link)
                         : fmt::format(", {} not regular", plural(irregular, fmt::format("{} is", Subject::link),
                                                                  fmt::format("{} are", Subject::links)));
  if constexpr (requires { quality.inverted_triangles; }) {
    if (quality.inverted_triangles > 0)
      text += ", " + plural(quality.inverted_triangles, "triangle is inverted", "triangles are inverted");
  }
  return text;
}

template <class MeshOrQuality>
std::string mesh_size(const MeshOrQuality& of) {
  using Subject = SubjectOf<MeshOrQuality>;
  std::size_t vertices = 0;
  std::string inside;
  if constexpr (std::is_same_v<MeshOrQuality, typename Subject::Mesh>)
    vertices = of.n_vertices();
  else
    vertices = of.vertices;
  if constexpr (requires { of.inner_vertices; }) inside = fmt::format(" ({} inside)", of.inner_vertices);
  return fmt::format("{}{}, {}", plural(vertices, "vertex", "vertices"), inside,
                     plural(n_elements(of), Subject::element, Subject::elements));
}

namespace {

std::string one_number(std::string_view label, const std::string& number) {
  return text_line(label, number, {kLabelColumns, kNumberColumns});
}
std::string two_numbers(std::string_view label, const std::string& from, const std::string& to) {
  return pad_right(label, kLabelColumns) + pad_left(from, kNumberColumns) + pad_left(to, kNumberColumns) + "\n";
}

}  // namespace

template <class AnyQuality>
std::string brief_text(const AnyQuality& quality) {
  std::string text;
  for (const auto& row : brief_rows(quality)) text += one_number(row.label, row.text(quality));
  return text;
}

template <class AnyQuality>
std::string brief_text(const AnyQuality& before, const AnyQuality& after) {
  std::string text = two_numbers("", "before", "after");
  for (const auto& row : brief_rows(after)) text += two_numbers(row.label, row.text(before), row.text(after));
  return text;
}

std::string turns_text(const surfaces::Turns& before, const surfaces::Turns& after) {
  return two_numbers("edges sharper than creases", std::to_string(before.sharp), std::to_string(after.sharp)) +
         two_numbers("largest turn (degrees)", fmt::format("{:.1f}", before.largest_deg),
                     fmt::format("{:.1f}", after.largest_deg));
}

template <class Subject>
std::string quality_text(const typename Subject::Quality& quality, const InputOf<Subject>& input,
                         const TextStyle& style) {
  std::string text = fmt::format("{}: {}\n\n", input.path, verdict(quality));
  for (const auto& measure : Subject::measures()) text += one_number(measure.label, measure_text(measure, quality));
  std::vector panels = {histogram_panel(fmt::format("{}s (degrees)", Subject::angle), angles(quality), style),
                        histogram_panel("h/" + ell(style), quality.histograms.h_over_l, style)};
  if constexpr (requires { quality.histograms.d_over_l; })
    panels.push_back(histogram_panel("d/" + ell(style), quality.histograms.d_over_l, style));
  return text + energy_table(quality, style) + "\n" + histograms(panels, style) + worst_text(quality, input, style);
}

template <class AnyQuality>
std::string comparison_text(const AnyQuality& before, const AnyQuality& after) {
  std::string text = two_numbers("", "before", "after");
  for (const auto& measure : SubjectOf<AnyQuality>::measures())
    text += two_numbers(measure.label, measure_text(measure, before), measure_text(measure, after));
  return text;
}

std::string energies_text(const Quality& before, const Quality& after, int star, const TextStyle& style) {
  std::string text;
  const auto number = [&style](double value) {
    return std::isinf(value) ? energy_text(value, style) : fmt::format("{:.6g}", value);
  };
  const auto column = static_cast<std::size_t>(star);
  for (std::size_t i = 0; i < energies().size(); ++i) {
    const std::string label = fmt::format("E_{}, {}", energies()[i].name, star_name(column, style));
    text += two_numbers(label, number(before.energy[i][column]), number(after.energy[i][column]));
  }
  return text;
}

std::string size_text(const SizeChange& size) {
  const auto row = [&size](const char* label, double (*of)(const SizeReport&)) {
    return pad_right(label, kLabelColumns) + pad_left(fmt::format("{:.6g}", of(size.before)), kNumberColumns) +
           pad_left(fmt::format("{:.6g}", of(size.after)), kNumberColumns) + "\n";
  };
  return row("size over field, least", [](const SizeReport& r) { return r.over_field.min; }) +
         row("size over field, median", [](const SizeReport& r) { return r.over_field.median; }) +
         row("size over field, greatest", [](const SizeReport& r) { return r.over_field.max; }) +
         row("gradation, 95 %", [](const SizeReport& r) { return r.gradation.p95; }) +
         row("gradation, greatest", [](const SizeReport& r) { return r.gradation.max; });
}

#define TEMPER_MAKE(S)                                                                       \
  template std::string quality_text(const S::Quality&, const InputOf<S>&, const TextStyle&); \
  template std::string comparison_text(const S::Quality&, const S::Quality&);                \
  template std::string brief_text(const S::Quality&);                                        \
  template std::string brief_text(const S::Quality&, const S::Quality&);                     \
  template std::string verdict(const S::Quality&);                                           \
  template std::string well_centered<S>(std::size_t, std::size_t);                           \
  template std::string mesh_size(const S::Quality&);                                         \
  template std::string mesh_size(const S::Mesh&);
TEMPER_EACH_SUBJECT(TEMPER_MAKE)
#undef TEMPER_MAKE

}  // namespace temper::app
