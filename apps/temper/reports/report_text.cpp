#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "console.hpp"
#include "options/options.hpp"
#include "reports/quality_report.hpp"
#include "reports/reports.hpp"
#include "system/system.hpp"

namespace temper::app {
namespace {

constexpr std::size_t kEnergyColumns = 24;
constexpr std::size_t kRangeColumns = 12;
constexpr std::size_t kBarColumns = 10;
constexpr std::size_t kPanelGap = 3;

template <class Report>
std::string measure_text(const MeasureRow<Report>& measure, const Report& quality) {
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

std::string energy_table(const Quality& quality, const TextStyle& style) {
  std::string text = pad_right("energy", 8);
  for (std::size_t star = 0; star < 3; ++star) text += pad_left(star_name(star, style), kEnergyColumns);
  text += "\n";
  for (std::size_t row = 0; row < energies().size(); ++row) {
    text += pad_right("E_" + std::string(energies()[row].name), 8);
    for (const double value : quality.energy[row]) text += pad_left(energy_text(value, style), kEnergyColumns);
    text += "\n";
  }
  return text;
}

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

std::string worst_text(const tets::Quality& quality, const TetInput& input, const TextStyle& style) {
  if (quality.worst.empty()) return "";
  std::string text = "\nworst tetrahedra\n";
  for (const tets::WorstTet& worst : quality.worst) {
    const auto name = [&input](VertexId v) { return input.vertex_number(v); };
    text += fmt::format("  {} ({} {} {} {}) at {:.9g} {:.9g} {:.9g}: h/l {:.4g}, largest dihedral {:.5g}\n",
                        input.element_number(worst.tetrahedron), name(worst.vertices[0]), name(worst.vertices[1]),
                        name(worst.vertices[2]), name(worst.vertices[3]), worst.at.x, worst.at.y, worst.at.z,
                        worst.h_over_l, worst.dihedral_deg);
    text += why_text(worst.why, name, style);
  }
  return text;
}

std::string worst_text(const Quality& quality, const Input& input, const TextStyle& style) {
  if (quality.worst.empty()) return "";
  std::string text = "\nworst triangles\n";
  for (const WorstTriangle& worst : quality.worst) {
    const auto name = [&input](VertexId v) { return input.vertex_number(v); };
    text += fmt::format("  {} ({} {} {}) at {:.9g} {:.9g}: h/l {:.4g}, largest angle {:.5g}\n",
                        input.element_number(worst.triangle), name(worst.vertices[0]), name(worst.vertices[1]),
                        name(worst.vertices[2]), worst.at.x, worst.at.y, worst.h_over_l, worst.angle_deg);
    text += why_text(worst.why, name, style);
  }
  return text;
}

/// A row of the short report.
template <class Report>
struct BriefRow {
  const char* label;
  std::string (*text)(const Report&);
};

std::string brief_number(double value) { return std::isfinite(value) ? fmt::format("{:.4g}", value) : "infinite"; }

const BriefRow<tets::Quality> kBriefTetRows[] = {
    {"tetrahedra not well-centered", [](const tets::Quality& q) { return std::to_string(q.orthocenters_outside); }},
    {"least h/l", [](const tets::Quality& q) { return brief_number(q.min_h_over_l); }},
    {"completely well-centered",
     [](const tets::Quality& q) { return fmt::format("{:.1f} %", 100 * q.completely_well_centered_fraction); }},
    {"transmissibility, max/median",
     [](const tets::Quality& q) { return brief_number(q.max_transmissibility_over_median); }},
    {"dihedral angles (degrees)",
     [](const tets::Quality& q) { return fmt::format("{:.1f} - {:.1f}", q.min_dihedral_deg, q.max_dihedral_deg); }},
};

const BriefRow<Quality> kBriefRows[] = {
    {"triangles not well-centered", [](const Quality& q) { return std::to_string(bad_elements(q)); }},
    {"least margin", [](const Quality& q) { return brief_number(std::min(q.min_h_over_l, q.min_d_over_l)); }},
    {"transmissibility, max/median", [](const Quality& q) { return brief_number(q.max_transmissibility_over_median); }},
    {"angles (degrees)",
     [](const Quality& q) { return fmt::format("{:.1f} - {:.1f}", q.min_angle_deg, q.max_angle_deg); }},
    {"least edge/size", [](const Quality& q) { return brief_number(q.min_edge_over_size); }},
};

}  // namespace

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
  for (const HalfedgeId h : mesh.halfedges()) n += mesh.is_diagonal(h) && mesh.is_edge_representative(h) ? 1 : 0;
  return n;
}

std::string halves_text(const Mesh& mesh) {
  const std::size_t n = count_quadrilaterals(mesh);
  if (n == 0) return {};
  return fmt::format("{} of these triangles are halves of {}\n", 2 * n, plural(n, "quadrilateral", "quadrilaterals"));
}

void show_places_of_file(Quality& quality, const Input& input) {
  for (WorstTriangle& worst : quality.worst) worst.at = place_in_file(input.file, worst.at);
}

namespace {

std::string well_centered(std::size_t bad, std::size_t all, const char* one, const char* several) {
  if (bad == 0)
    return all == 1 ? fmt::format("the {} is well-centered", one)
                    : fmt::format("all {} {} are well-centered", all, several);
  return fmt::format("{} of {} {} not well-centered", bad, plural(all, one, several), bad == 1 ? "is" : "are");
}

}  // namespace

std::string well_centered(std::size_t bad, std::size_t triangles) {
  return well_centered(bad, triangles, "triangle", "triangles");
}

std::string verdict(const tets::Quality& quality) {
  return well_centered(quality.orthocenters_outside, quality.tetrahedra, "tetrahedron", "tetrahedra") +
         (quality.non_regular_faces == 0
              ? ", every face is regular"
              : ", " + plural(quality.non_regular_faces, "face is not regular", "faces are not regular"));
}

namespace {

std::string mesh_size(std::size_t vertices, std::size_t elements, std::string_view one, std::string_view several) {
  return fmt::format("{}, {}", plural(vertices, "vertex", "vertices"), plural(elements, one, several));
}

}  // namespace

std::string mesh_size(const Mesh& mesh) {
  return mesh_size(mesh.n_vertices(), mesh.n_triangles(), "triangle", "triangles");
}
std::string mesh_size(const tets::TetMesh& mesh) {
  return mesh_size(mesh.n_vertices(), mesh.n_tetrahedra(), "tetrahedron", "tetrahedra");
}
std::string mesh_size(const Quality& quality) {
  return mesh_size(quality.vertices, quality.triangles, "triangle", "triangles");
}
std::string mesh_size(const tets::Quality& quality) {
  return fmt::format("{} ({} inside), {}", plural(quality.vertices, "vertex", "vertices"), quality.inner_vertices,
                     plural(quality.tetrahedra, "tetrahedron", "tetrahedra"));
}

std::string verdict(const Quality& quality) {
  const std::size_t bad = bad_elements(quality);
  std::string text = well_centered(bad, quality.triangles);
  text += quality.non_regular_edges == 0
              ? ", every edge is regular"
              : ", " + plural(quality.non_regular_edges, "edge is not regular", "edges are not regular");
  if (quality.inverted_triangles > 0) {
    text += ", " + plural(quality.inverted_triangles, "triangle is inverted", "triangles are inverted");
  }
  return text;
}

namespace {

template <class Rows, class Report>
std::string rows_text(const Rows& rows, const Report& quality) {
  std::string text;
  for (const auto& row : rows)
    text += pad_right(row.label, kLabelColumns) + pad_left(row.text(quality), kNumberColumns) + "\n";
  return text;
}

template <class Report>
std::string measures_text(std::span<const MeasureRow<Report>> rows, const Report& quality) {
  std::string text;
  for (const MeasureRow<Report>& measure : rows)
    text += pad_right(measure.label, kLabelColumns) + pad_left(measure_text(measure, quality), kNumberColumns) + "\n";
  return text;
}

std::string two_numbers(std::string_view label, const std::string& from, const std::string& to) {
  return pad_right(std::string(label), kLabelColumns) + pad_left(from, kNumberColumns) + pad_left(to, kNumberColumns) +
         "\n";
}

template <class Rows, class Report>
std::string two_columns(const Rows& rows, const Report& before, const Report& after) {
  std::string text = two_numbers("", "before", "after");
  for (const auto& row : rows) text += two_numbers(row.label, row.text(before), row.text(after));
  return text;
}

template <class Report>
std::string measures_text(std::span<const MeasureRow<Report>> rows, const Report& before, const Report& after) {
  std::string text = two_numbers("", "before", "after");
  for (const MeasureRow<Report>& measure : rows)
    text += two_numbers(measure.label, measure_text(measure, before), measure_text(measure, after));
  return text;
}

}  // namespace

std::string brief_text(const Quality& quality) { return rows_text(kBriefRows, quality); }

std::string brief_text(const tets::Quality& quality) { return rows_text(kBriefTetRows, quality); }

std::string brief_text(const Quality& before, const Quality& after) { return two_columns(kBriefRows, before, after); }

std::string brief_text(const tets::Quality& before, const tets::Quality& after) {
  return two_columns(kBriefTetRows, before, after);
}

std::string quality_text(const Quality& quality, const Input& input, const TextStyle& style) {
  std::string text = fmt::format("{}: {}\n\n", input.path, verdict(quality));
  text += measures_text(quality_measures(), quality);
  text += "\n" + energy_table(quality, style);
  text += "\n" + histograms({histogram_panel("angles (degrees)", quality.histograms.angles, style),
                             histogram_panel("h/" + ell(style), quality.histograms.h_over_l, style),
                             histogram_panel("d/" + ell(style), quality.histograms.d_over_l, style)},
                            style);
  return text + worst_text(quality, input, style);
}

std::string quality_text(const tets::Quality& quality, const TetInput& input, const TextStyle& style) {
  std::string text = fmt::format("{}: {}\n\n", input.path, verdict(quality));
  text += measures_text(tets::quality_measures(), quality);
  text += "\n" + histograms({histogram_panel("dihedrals (degrees)", quality.histograms.dihedrals, style),
                             histogram_panel("h/" + ell(style), quality.histograms.h_over_l, style)},
                            style);
  return text + worst_text(quality, input, style);
}

std::string comparison_text(const Quality& before, const Quality& after, int star, const TextStyle& style) {
  std::string text = measures_text(quality_measures(), before, after);
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

std::string comparison_text(const tets::Quality& before, const tets::Quality& after) {
  return measures_text(tets::quality_measures(), before, after);
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

}  // namespace temper::app
