// Writes PLY: weights as a property of type double, lines as elements edge, in ASCII or in the machine's byte order.
#include <algorithm>
#include <bit>
#include <set>

#include "io/conversion/globe.hpp"
#include "io/formats/format.hpp"
#include "io/formats/ply.hpp"
#include "io/text/names.hpp"

namespace temper::io {
namespace {

std::string_view ply_type_name(Scalar scalar) {
  return std::find_if(kPlyTypes.begin(), kPlyTypes.end(), [&](const PlyType& t) { return t.scalar == scalar; })->name;
}

class PlyWriter {
 public:
  explicit PlyWriter(const WriteJob& job)
      : job_(job),
        file_(job.file),
        out_(job.outputs.open(job.path)),
        binary_(job.encoding.value_or(Encoding::ascii) != Encoding::ascii) {}
  void write() {
    const MeshFile& f = file_;
    tags_ = one_tag_a_point(job_);
    header();
    for (std::size_t i = 0; i < f.points.size(); ++i) {
      const Vec3 p = job_.place(i);
      put(p.x, true);
      put(p.y);
      put(p.z);
      if (!f.weights.empty()) put(f.weights[i]);
      if (!f.marked_points.empty()) put(tags_[i]);
      put_row(point_data_, i);
      end_row();
    }
    for (std::size_t i = 0; i < f.triangles.size(); ++i) {
      put(std::uint8_t{3}, true);
      for (const std::int32_t p : f.triangles[i]) put(p);
      if (!f.triangles.tags.empty()) put(f.triangles.tags[i]);
      put_row(cell_data_, i);
      end_row();
    }
    for (std::size_t i = 0; i < f.lines.size(); ++i) {
      put(f.lines[i][0], true);
      put(f.lines[i][1]);
      put(f.lines.tags[i]);
      put_row(line_data_, i);
      end_row();
    }
  }

 private:
  using Arrays = std::vector<const DataArray*>;
  /// The arrays that PLY can hold next to the properties in `taken`; warnings name the others.
  Arrays choose(const std::vector<DataArray>& arrays, std::string_view element, std::set<std::string> taken) {
    Arrays chosen;
    std::vector<std::string_view> dropped;
    std::string comments;
    for (const DataArray& a : arrays) {
      const Scalar scalar = scalar_of(a.values);
      bool fits = scalar != Scalar::i64 && scalar != Scalar::u64 && !a.name.empty() &&
                  std::all_of(a.name.begin(), a.name.end(), [](char c) { return c > 32 && c < 127; });
      std::vector<std::string> names;
      names.reserve(static_cast<std::size_t>(a.components));
      for (int k = 0; k < a.components; ++k) names.push_back(a.components == 1 ? a.name : text(a.name, "_", k));
      for (const std::string& name : names) fits = fits && !taken.contains(name);
      if (!fits) {
        dropped.push_back(a.name);
        continue;
      }
      taken.insert(names.begin(), names.end());
      chosen.push_back(&a);
      if (a.components > 1)
        comments += text("comment ", kPlyArrayComment, element, " ", a.components, " ", a.name, "\n");
    }
    out_.put(comments);
    warn_of_arrays(job_, text("data of elements ", element), dropped);
    return chosen;
  }
  void declare(const Arrays& arrays) {
    for (const DataArray* a : arrays) {
      for (int k = 0; k < a->components; ++k) {
        out_.put("property ", ply_type_name(scalar_of(a->values)), ' ', a->name);
        if (a->components > 1) out_.put('_', k);
        out_.put('\n');
      }
    }
  }
  void header() {
    const MeshFile& f = file_;
    const char* order = std::endian::native == std::endian::little ? "binary_little_endian" : "binary_big_endian";
    out_.put("ply\nformat ", binary_ ? order : "ascii", " 1.0\n");
    for (const PhysicalName& n : f.names) out_.put("comment ", kPlyNameComment, line_of(n), '\n');
    point_data_ = choose(f.point_data, "vertex", {"x", "y", "z", std::string(kPlyWeight), std::string(kPlyTag)});
    const std::string region(kPlyRegion);
    cell_data_ = choose(f.triangles.data, "face", {"vertex_indices", "vertex_index", region});
    line_data_ = choose(f.lines.data, "edge", {"vertex1", "vertex2", region});
    out_.put("element vertex ", f.points.size(), "\nproperty double x\nproperty double y\nproperty double z\n");
    if (!f.weights.empty()) out_.put("property double ", kPlyWeight, '\n');
    if (!f.marked_points.empty()) out_.put("property int ", kPlyTag, '\n');
    declare(point_data_);
    out_.put("element face ", f.triangles.size(), "\nproperty list uchar int vertex_indices\n");
    if (!f.triangles.tags.empty()) out_.put("property int ", kPlyRegion, '\n');
    declare(cell_data_);
    if (!f.lines.empty()) {
      out_.put("element edge ", f.lines.size(), "\nproperty int vertex1\nproperty int vertex2\nproperty int ",
               kPlyRegion, '\n');
      declare(line_data_);
    }
    out_.put("end_header\n", "");
  }
  template <class T>
  void put(T value, bool first = false) {
    if (binary_) {
      out_.put_raw(value);
      return;
    }
    if (!first) out_.put(' ');
    out_.put(value);
  }
  void put_row(const Arrays& arrays, std::size_t row) {
    for (const DataArray* a : arrays) {
      const auto c = static_cast<std::size_t>(a->components);
      std::visit(
          [&](const auto& v) {
            for (std::size_t k = 0; k < c; ++k) put(v[row * c + k]);
          },
          a->values);
    }
  }
  /// The end of an element, behind its last number.
  void end_row() {
    if (!binary_) out_.put('\n');
  }

  const WriteJob& job_;
  const MeshFile& file_;
  Output& out_;
  bool binary_;
  Arrays point_data_, cell_data_, line_data_;
  std::vector<std::int32_t> tags_;
};

}  // namespace

void write_ply(const WriteJob& job) { PlyWriter(job).write(); }

}  // namespace temper::io
