// The HTML report: the page that the build has put into the library, with data elements at its mark. An array is
//
//   <script type="text/plain" id="after.points" data-type="float64" data-length="12" data-delta="0">…</script>
//
// and its text is base64 of zlib's stream of planes: all first bytes of the little-endian numbers, then all second
// ones, and so on. Bytes of one place resemble each other. With data-delta="k" each number is the difference to the
// number k places before, in zigzag form: corners of neighbors are near each other.
#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "io/containers/vtu_codec.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/detail/html.hpp"
#include "temper/quality.hpp"
#include "temper/tets/quality.hpp"

namespace temper::io {

/// The page without data: web/report/dist/report.html, which the build puts into the library.
[[nodiscard]] std::string_view html_page();

namespace {

constexpr std::string_view kMark = "<!--data-->";  // in the page
constexpr std::string_view kTitle = "<title>temper</title>";

struct ArrayText {
  std::string name;
  const char* type;
  std::size_t bytes_each;
  std::size_t delta;
  std::string planes;  ///< before compression
};

template <class T>
std::string planes_of(std::span<const T> values) {
  std::string planes(values.size() * sizeof(T), '\0');
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(values[i]);
    for (std::size_t b = 0; b < sizeof(T); ++b) {
      const std::size_t place = std::endian::native == std::endian::little ? b : sizeof(T) - 1 - b;
      planes[place * values.size() + i] = bytes[b];
    }
  }
  return planes;
}

/// Differences to the number `delta` places before, wrapped around; small ones of either sign become small numbers.
std::vector<std::uint32_t> differences(std::span<const std::int32_t> values, std::size_t delta) {
  std::vector<std::uint32_t> result(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::uint32_t former = i < delta ? 0 : static_cast<std::uint32_t>(values[i - delta]);
    const std::uint32_t step = static_cast<std::uint32_t>(values[i]) - former;
    result[i] = step << 1 ^ (step >> 31 != 0 ? ~std::uint32_t{0} : 0);
  }
  return result;
}

/// The arrays of one mesh, whose names begin with the side.
class Arrays {
 public:
  explicit Arrays(std::string side) : side_(std::move(side)) {}
  [[nodiscard]] std::vector<ArrayText> take() { return std::move(arrays_); }

  void add(const char* name, std::span<const double> values) {
    arrays_.push_back({side_ + name, "float64", sizeof(double), 0, planes_of(values)});
  }
  void add(const char* name, std::span<const std::uint8_t> values) {
    arrays_.push_back({side_ + name, "uint8", 1, 0, planes_of(values)});
  }
  void add(const char* name, std::span<const std::int32_t> values, std::size_t delta) {
    const std::vector<std::uint32_t> steps = differences(values, delta);
    arrays_.push_back({side_ + name, "int32", 4, delta, planes_of(std::span<const std::uint32_t>(steps))});
  }

  template <class AnyMesh>
  void add_vertices(const AnyMesh& mesh) {
    std::vector<double> points, weights;
    points.reserve(3 * mesh.n_vertices());
    weights.reserve(mesh.n_vertices());
    for (const VertexId v : mesh.vertices()) {
      append(points, mesh.position(v));
      weights.push_back(mesh.weight(v));
    }
    add("points", std::span<const double>(points));
    if (std::ranges::any_of(weights, [](double w) { return w != 0; })) add("weights", std::span<const double>(weights));
  }

  void add_regions(std::span<const std::int32_t> regions) {
    if (std::ranges::any_of(regions, [](std::int32_t r) { return r != 0; })) add("regions", regions, 1);
  }

  /// The number at the end of each name, unless they count from 0.
  template <class NameOf>
  void add_numbers(const char* what, std::size_t n, const NameOf& name_of) {
    std::vector<std::int32_t> numbers(n);
    bool from_0 = true;
    for (std::size_t i = 0; i < n; ++i) {
      const std::string name = name_of(i);
      numbers[i] = static_cast<std::int32_t>(i);
      std::from_chars(name.data() + name.rfind(' ') + 1, name.data() + name.size(), numbers[i]);
      from_0 = from_0 && numbers[i] == static_cast<std::int32_t>(i);
    }
    if (!from_0) add(what, numbers, 1);
  }

 private:
  static void append(std::vector<double>& places, Vec2 p) { places.insert(places.end(), {p.x, p.y}); }
  static void append(std::vector<double>& places, Vec3 p) { places.insert(places.end(), {p.x, p.y, p.z}); }

  std::string side_;
  std::vector<ArrayText> arrays_;
};

constexpr std::uint8_t kInverted = 64;

/// Bit k: the orthocenter is not inside across edge k. Bit 3 + k: edge k is not crossed. Bit 6: not counter-clockwise.
std::uint8_t verdict(const std::array<WeightedPoint, 3>& p) {
  if (orient2d(p[0].position(), p[1].position(), p[2].position()) != Sign::positive) return kInverted;
  unsigned bits = 0;
  for (unsigned k = 0; k < 3; ++k) {
    const WeightedPoint &a = p[k], &b = p[(k + 1) % 3], &c = p[(k + 2) % 3];
    if (signed_height_sign(a, b, c) != Sign::positive) bits |= 1U << k;
    if (dual_crossing_sign(a, b) != Sign::positive || dual_crossing_sign(b, a) != Sign::positive) bits |= 8U << k;
  }
  return static_cast<std::uint8_t>(bits);
}

/// Bit k: the orthocenter is not inside across the face opposite corner k. Bit 6: not positive.
std::uint8_t verdict(const std::array<tets::WeightedPoint, 4>& p) {
  if (tets::orientation(p[0].position(), p[1].position(), p[2].position(), p[3].position()) != Sign::positive)
    return kInverted;
  unsigned bits = 0;
  for (unsigned k = 0; k < 4; ++k) {
    const auto [a, b, c] = tets::TetMesh::kFaceCorners[k];
    if (signed_height_sign(p[std::size_t(a)], p[std::size_t(b)], p[std::size_t(c)], p[k]) != Sign::positive)
      bits |= 1U << k;
  }
  return static_cast<std::uint8_t>(bits);
}

std::vector<ArrayText> arrays_of(const HtmlMesh& from, const std::string& side) {
  const Mesh& mesh = from.mesh;
  const std::size_t n = mesh.n_triangles();
  std::vector<std::int32_t> corners(3 * n), regions(n);
  std::vector<std::uint8_t> verdicts(n), constrained(3 * n);
  for (const TriangleId t : mesh.triangles()) {
    const std::array<VertexId, 3> c = mesh.corners(t);
    for (std::size_t k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(t, static_cast<int>(k));
      corners[h.index] = static_cast<std::int32_t>(c[k].index);
      constrained[h.index] = mesh.is_constrained(h) && !mesh.is_boundary(h) ? 1 : 0;
    }
    regions[t.index] = mesh.region(t);
    verdicts[t.index] = verdict({mesh.point(c[0]), mesh.point(c[1]), mesh.point(c[2])});
  }
  Arrays arrays(side);
  arrays.add_vertices(mesh);
  arrays.add("triangles", corners, 3);
  arrays.add("verdicts", std::span<const std::uint8_t>(verdicts));
  arrays.add_regions(regions);
  if (std::ranges::count(constrained, 1) > 0) arrays.add("constrained", std::span<const std::uint8_t>(constrained));
  if (const InputNames* const names = from.names; names != nullptr) {
    arrays.add_numbers("vertex_numbers", mesh.n_vertices(), [names](std::size_t i) { return names->point(i); });
    arrays.add_numbers("triangle_numbers", n, [names](std::size_t i) { return names->triangle(i); });
  }
  return arrays.take();
}

std::vector<ArrayText> arrays_of(const HtmlTets& from, const std::string& side) {
  const tets::TetMesh& mesh = from.mesh;
  const std::size_t n = mesh.n_tetrahedra();
  std::vector<std::int32_t> corners, regions(n);
  std::vector<std::uint8_t> verdicts(n);
  corners.reserve(4 * n);
  for (const tets::TetId t : mesh.tetrahedra()) {
    for (const VertexId v : mesh.corners(t)) corners.push_back(static_cast<std::int32_t>(v.index));
    regions[t.index] = mesh.region(t);
    verdicts[t.index] = verdict(mesh.points(t));
  }
  Arrays arrays(side);
  arrays.add_vertices(mesh);
  arrays.add("tetrahedra", corners, 4);
  arrays.add("verdicts", std::span<const std::uint8_t>(verdicts));
  arrays.add_regions(regions);
  if (const tets::InputNames* const names = from.names; names != nullptr) {
    arrays.add_numbers("vertex_numbers", mesh.n_vertices(), [names](std::size_t i) { return names->point(i); });
    arrays.add_numbers("tetrahedron_numbers", n, [names](std::size_t i) { return names->tetrahedron(i); });
  }
  return arrays.take();
}

std::string element(const ArrayText& array) {
  const std::string packed = compress_block(array.planes, Redundancy::strings);
  return text("<script type=\"text/plain\" id=\"", array.name, "\" data-type=\"", array.type, "\" data-length=\"",
              array.planes.size() / array.bytes_each, "\" data-delta=\"", array.delta, "\">", base64(packed),
              "</script>\n");
}

/// Text that may stand in an element: `<` could end it.
std::string escaped(std::string_view plain, std::string_view less, std::string_view ampersand) {
  std::string result;
  for (const char c : plain) {
    if (c == '<') {
      result += less;
    } else if (c == '&') {
      result += ampersand;
    } else {
      result += c;
    }
  }
  return result;
}

std::string_view name_of(Preference better) {
  switch (better) {
    case Preference::larger:
      return "larger";
    case Preference::less:
      return "less";
    case Preference::equal:
      break;
  }
  return "equal";
}

/// The rows of a table of measures as JSON: the page itself has no list of measures. No word of the table needs
/// escapes.
template <class Report>
std::string measures_json(std::span<const MeasureRow<Report>> rows) {
  std::string json;
  for (const MeasureRow<Report>& m : rows) {
    json += text(json.empty() ? "[" : ",", "\n{\"key\":\"", m.key, "\",\"label\":\"", m.label, "\",\"community\":\"",
                 m.community, "\",\"definition\":\"", m.definition, "\",\"better\":\"", name_of(m.better),
                 "\",\"wanted\":", m.wanted ? text(*m.wanted) : "null", "}");
  }
  return json + "]";
}

}  // namespace

std::string html_report(const HtmlReport& report) {
  const auto elements = [](const AnyHtmlMesh& mesh, const std::string& side) {
    std::string text;
    for (const ArrayText& array : std::visit([&](const auto& m) { return arrays_of(m, side); }, mesh))
      text += element(array);
    return text;
  };
  const bool tetrahedra = std::holds_alternative<HtmlTets>(report.mesh);
  const std::string measures = tetrahedra ? measures_json(tets::quality_measures()) : measures_json(quality_measures());
  const std::string_view page = html_page();
  const std::size_t title = page.find(kTitle), mark = page.find(kMark);
  std::string html(page.substr(0, title));
  html += text("<title>", escaped(report.title, "&lt;", "&amp;"), "</title>");
  html += page.substr(title + kTitle.size(), mark - title - kTitle.size());
  html += text("<script type=\"application/json\" id=\"report\">", escaped(report.json, "\\u003c", "&"), "</script>\n");
  html += text("<script type=\"application/json\" id=\"measures\">", escaped(measures, "\\u003c", "&"), "</script>\n");
  html += elements(report.mesh, "after.");
  if (report.before) html += elements(*report.before, "before.");
  html += page.substr(mark + kMark.size());
  return html;
}

}  // namespace temper::io
