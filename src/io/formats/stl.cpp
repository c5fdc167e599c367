// STL, text and binary: triangles with three places each, without numbers of points.
//
//   solid NAME
//     facet normal nx ny nz     binary: a title of 80 bytes, the number of triangles, and for each 50 bytes:
//       outer loop              twelve floats, the normal and three places, and two bytes that mean nothing here
//         vertex x y z          (three times)
//       endloop
//     endfacet
//   endsolid NAME
//
// Corners at one place become one point. Normals are dropped: corners say which side is which.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <unordered_map>

#include "io/formats/format.hpp"
#include "io/text/names.hpp"
#include "io/text/scanner.hpp"

namespace temper::io {
namespace {

constexpr std::size_t kStlTitle = 80, kStlHeader = 84, kStlTriangle = 50;

std::uint32_t little_endian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i > 0; --i) value = value << 8 | static_cast<unsigned char>(bytes[i - 1]);
  return value;
}

/// Some programs write all words in upper case.
bool is_word(std::string_view found, std::string_view word) { return lower_case(found) == word; }

/// The number of triangles of binary STL, which may be cut short. Nothing if the bytes there are of a text.
std::optional<std::uint32_t> n_of_binary(std::string_view beginning) {
  if (beginning.size() < kStlHeader) return std::nullopt;
  // Titles of texts can have any letters.
  const auto is_text = [](unsigned char c) { return (c >= '\t' && c <= '\r') || (c >= ' ' && c != 0x7f); };
  if (std::ranges::all_of(beginning, is_text)) return std::nullopt;
  return little_endian(beginning.substr(kStlTitle, 4));
}

bool is_finite(Vec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }
std::string fault_of(Vec3 p) {
  return text("a corner has coordinates (", p.x, ", ", p.y, ", ", p.z,
              "), expected finite numbers. Next: give its place");
}

class StlReader {
 public:
  explicit StlReader(Source& source) : source_(source), document_(new_document(source.path)), plane_(document_) {}

  Document read() {
    is_binary_stl(source_.bytes, source_.bytes.size()) ? read_binary() : read_text();
    FileNames& names = *document_.names;
    names.points = RunLength(1, document_.file.points.size());
    names.triangles = RunLength(1, document_.file.triangles.size());
    if (n_flat_ > 0)
      document_.file.warnings.push_back(text(source_.path, ": ", n_flat_,
                                             n_flat_ == 1 ? " triangle is" : " triangles are",
                                             " dropped: two corners are at one place"));
    return std::move(document_);
  }

 private:
  void read_binary() {
    std::string_view bytes = std::string_view(source_.bytes).substr(kStlHeader);
    for (; !bytes.empty(); bytes.remove_prefix(kStlTriangle)) {
      ++n_read_;
      std::array<Vec3, 3> corners;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto coordinate = [&](std::size_t axis) {
          return double{std::bit_cast<float>(little_endian(bytes.substr(12 + 12 * k + 4 * axis, 4)))};
        };
        corners[k] = {coordinate(0), coordinate(1), coordinate(2)};
        if (!is_finite(corners[k]))
          fail(ErrorCode::not_finite, source_.path, text("triangle ", n_read_, ": ", fault_of(corners[k])));
      }
      add(corners);
    }
  }

  void read_text() {
    Scanner scanner(source_.path, source_.bytes, '\0');
    const auto expect = [&](std::string_view word) {
      if (const std::string_view found = scanner.word(word); !is_word(found, word))
        scanner.fail_here(ErrorCode::syntax, "expected '", word, "', found ", in_quotes(found));
    };
    while (!scanner.at_end()) {
      expect("solid");
      scanner.next_line();
      while (is_word(scanner.peek(), "facet")) {
        const auto line = static_cast<std::int64_t>(scanner.line());
        expect("facet"), expect("normal");
        for (int k = 0; k < 3; ++k) static_cast<void>(scanner.real("a normal"));
        expect("outer"), expect("loop");
        std::array<Vec3, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) {
          Vec3& p = corners[k];
          expect("vertex");
          corner_lines_[k] = static_cast<std::int64_t>(scanner.line());
          p.x = scanner.real("the x coordinate of a vertex");
          p.y = scanner.real("the y coordinate of a vertex");
          p.z = scanner.real("the z coordinate of a vertex");
          if (!is_finite(p)) scanner.fail_here(ErrorCode::not_finite, fault_of(p));
        }
        expect("endloop"), expect("endfacet");
        if (add(corners)) document_.names->triangle_lines.push_back(line);
      }
      expect("endsolid");
      scanner.next_line();
    }
  }

  /// False: it is dropped, because two corners are at one place.
  bool add(const std::array<Vec3, 3>& corners) {
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) {
      ++n_flat_;
      return false;
    }
    document_.file.triangles.corners.push_back({point(corners, 0), point(corners, 1), point(corners, 2)});
    return true;
  }

  std::int32_t point(const std::array<Vec3, 3>& corners, std::size_t k) {
    const Vec3 p = corners[k] + Vec3{};  // −0 is the same place as 0
    MeshFile& f = document_.file;
    const auto [found, is_new] = points_.try_emplace(p, static_cast<std::int32_t>(f.points.size()));
    if (is_new) {
      f.points.push_back({p.x, p.y});
      plane_.add(f.points.size() - 1, p.z);
      if (corner_lines_[k] > 0) document_.names->point_lines.push_back(corner_lines_[k]);
    }
    return found->second;
  }

  Source& source_;
  Document document_;
  PlaneCheck plane_;
  std::unordered_map<Vec3, std::int32_t, PlaceHash> points_;
  std::array<std::int64_t, 3> corner_lines_ = {};  ///< Of a text
  std::size_t n_read_ = 0, n_flat_ = 0;
};

}  // namespace

bool is_binary_stl(std::string_view beginning, std::uint64_t bytes) {
  // The size is exact. A text is never taken for binary this way, because its number of triangles would be too large.
  if (beginning.size() < kStlHeader) return false;
  const std::uint64_t n = little_endian(beginning.substr(kStlTitle, 4));
  return n > 0 && bytes == kStlHeader + kStlTriangle * n;
}

std::string fault_of_stl(std::string_view beginning, std::uint64_t bytes) {
  if (const std::optional<std::uint32_t> n = n_of_binary(beginning)) {
    const std::uint64_t wanted = kStlHeader + kStlTriangle * *n;
    const std::string expected = text("expected ", wanted, " bytes for the ", *n, " triangles of binary STL, found ");
    if (*n == 0) return "binary STL of 0 triangles, expected at least one";
    if (bytes > wanted) return text(expected, bytes);
    return text(expected, "the end of the file after ", bytes, ", in triangle ",
                (bytes - kStlHeader) / kStlTriangle + 1);
  }
  if (is_word(beginning.substr(0, 5), "solid")) return "expected 'facet' or 'endsolid' in the line after 'solid'";
  return bytes < kStlHeader ? text("expected the ", kStlHeader, " bytes with which binary STL begins, found ", bytes)
                            : std::string();
}

bool sniff_stl(std::string_view head) {
  Scanner scanner("", head, '\0');
  if (!is_word(scanner.peek(), "solid")) return false;
  scanner.next_line();
  return is_word(scanner.peek(), "facet") || is_word(scanner.peek(), "endsolid");
}

Document read_stl(Source& source) { return StlReader(source).read(); }

}  // namespace temper::io
