// Writes legacy VTK: an UNSTRUCTURED_GRID of triangles, lines and marked points, as in VTU, with all data in FIELDs.
//
// Every reader of the format accepts version 3.0: a cell is its number of points and the points. Version 5.1 has
// OFFSETS and CONNECTIVITY, and names for 64-bit integers that mean the same on every system.
#include "io/formats/vtk/vtk_arrays.hpp"
#include "io/text/names.hpp"

namespace temper::io {
namespace {

/// The number types in the order of Scalar.
constexpr std::string_view kLegacyTypeNames[] = {"double", "float", "long",           "int",          "unsigned_char",
                                                 "char",   "short", "unsigned_short", "unsigned_int", "unsigned_long"};

/// Names end at a blank, so blanks and all that is not ASCII are written as %20.
std::string encoded(std::string_view name) {
  std::string result;
  for (const char c : name) {
    const auto code = static_cast<unsigned char>(c);
    if (code > 32 && code < 127 && c != '%' && c != '"') {
      result += c;
    } else {
      append_percent(result, c);
    }
  }
  return result;
}

class LegacyVtkWriter {
 public:
  LegacyVtkWriter(const WriteJob& job, bool offsets)
      : job_(job),
        file_(job.file),
        cells_(job),
        out_(job.outputs.open(job.path)),
        binary_(job.encoding.value_or(Encoding::ascii) != Encoding::ascii),
        offsets_(offsets) {}
  void write() {
    out_.put("# vtk DataFile Version ", offsets_ ? "5.1" : "3.0", "\ntemper\n", binary_ ? "BINARY" : "ASCII",
             "\nDATASET UNSTRUCTURED_GRID\n");
    if (const auto fields = vtk_field_data(file_); !fields.empty()) field(fields);
    out_.put("POINTS ", file_.points.size(), " double\n");
    values(vtk_points(job_));
    offsets_ ? cells_with_offsets() : counted_cells();
    out_.put("CELL_TYPES ", cells_.size(), '\n');
    const VtkArray types = vtk_cell_types(job_);
    values(computed_vtk_array<std::int32_t>("types", Scalar::i32, types.n_values, [&types](std::size_t i) {
      std::uint8_t type = 0;
      types.fill(i, 1, reinterpret_cast<char*>(&type));
      return std::int32_t{type};
    }));
    data("POINT_DATA ", file_.points.size(), vtk_point_data(job_));
    data("CELL_DATA ", cells_.size(), vtk_cell_data(job_));
  }

 private:
  // Bytes begin right behind the line that announces them, and end with a line of their own.
  void values(const VtkArray& array) {
    if (!binary_) return put_ascii(out_, array);
    put_big_endian(out_, array);
    out_.put('\n');
  }
  // Each cell: its number of points, and these.
  void counted_cells() {
    const VtkArray points = vtk_connectivity(job_);
    std::vector<std::int32_t> numbers(points.n_values);
    points.fill(0, numbers.size(), reinterpret_cast<char*>(numbers.data()));
    const std::size_t n = cells_.size();
    out_.put("CELLS ", n, ' ', n + numbers.size(), '\n');
    std::vector<std::int32_t> all;
    all.reserve(n + numbers.size());
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t first = cells_.points_of_first(i), end = cells_.points_of_first(i + 1);
      all.push_back(static_cast<std::int32_t>(end - first));
      for (std::size_t k = first; k < end; ++k) all.push_back(numbers[k]);
      if (binary_) continue;
      for (std::size_t k = all.size() - (end - first) - 1; k < all.size(); ++k)
        out_.put(all[k], k + 1 == all.size() ? '\n' : ' ');
      all.clear();
    }
    if (binary_)
      values(
          computed_vtk_array<std::int32_t>("cells", Scalar::i32, all.size(), [&all](std::size_t i) { return all[i]; }));
  }
  void cells_with_offsets() {
    const VtkArray points = vtk_connectivity(job_);
    // The first offset belongs to the first cell; as in VTK there is one more than cells.
    const VtkArray offsets = computed_vtk_array<std::int64_t>(
        "OFFSETS", Scalar::i64, cells_.size() + 1,
        [this](std::size_t i) { return static_cast<std::int64_t>(cells_.points_of_first(i)); });
    const VtkArray connectivity =
        computed_vtk_array<std::int64_t>("CONNECTIVITY", Scalar::i64, points.n_values, [&points](std::size_t i) {
          std::int32_t point = 0;
          points.fill(i, 1, reinterpret_cast<char*>(&point));
          return std::int64_t{point};
        });
    out_.put("CELLS ", offsets.n_values, ' ', connectivity.n_values, '\n');
    for (const VtkArray* array : {&offsets, &connectivity}) {
      out_.put(array->name, " vtktypeint64\n");
      values(*array);
    }
  }
  void data(std::string_view title, std::size_t n, const std::vector<VtkArray>& arrays) {
    if (arrays.empty()) return;
    out_.put(title, n, '\n');
    field(arrays);
  }
  void field(const std::vector<VtkArray>& arrays) {
    out_.put("FIELD FieldData ", arrays.size(), '\n');
    for (const VtkArray& a : arrays) {
      const std::string name = a.name.empty() ? "unnamed" : encoded(a.name);
      out_.put(name, ' ', a.components, ' ', a.n_values / static_cast<std::size_t>(a.components), ' ',
               type_name(a.scalar), '\n');
      values(a);
    }
  }
  [[nodiscard]] std::string_view type_name(Scalar scalar) const {
    if (offsets_ && scalar == Scalar::i64) return "vtktypeint64";
    if (offsets_ && scalar == Scalar::u64) return "vtktypeuint64";
    return kLegacyTypeNames[static_cast<std::size_t>(scalar)];
  }

  const WriteJob& job_;
  const MeshFile& file_;
  VtkCells cells_;
  Output& out_;
  bool binary_, offsets_;
};

}  // namespace

void write_legacy_vtk(const WriteJob& job) { LegacyVtkWriter(job, false).write(); }
void write_vtk51(const WriteJob& job) { LegacyVtkWriter(job, true).write(); }

}  // namespace temper::io
