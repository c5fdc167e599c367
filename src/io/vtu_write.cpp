// Writes VTU: triangles first, then lines, then marked points, so that cell i is triangle i.
//
// Every array is made block by block; only the compressed blocks of one array are kept until its header is known. Cell
// data `region` is the region of a triangle, the tag of a line, the tag of a point.
#include <cstring>
#include <functional>

#include "io/cells.hpp"
#include "io/format.hpp"
#include "io/vtu_codec.hpp"

namespace temper::io {

namespace {

constexpr std::size_t kBlockBytes = std::size_t{1} << 18;  // compressed on its own: what threads share out

/// One array to be written: `fill` puts the bytes of its values first … first + n − 1 to a buffer.
struct Array {
  std::string name;
  Scalar scalar = Scalar::f64;
  int components = 1;
  std::size_t n_values = 0;
  std::function<void(std::size_t first, std::size_t n, char* to)> fill;
  bool field = false;

  [[nodiscard]] std::size_t bytes() const { return n_values * info(scalar).bytes; }
};

std::string escaped(std::string_view name) {
  std::string result;
  for (const char c : name) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += static_cast<unsigned char>(c) < 32 ? ' ' : c;
    }
  }
  return result;
}

/// value(i) of type T for each i.
template <class T, class F>
Array computed(std::string name, Scalar scalar, int components, std::size_t n_values, F value) {
  return {std::move(name), scalar, components, n_values, [value](std::size_t first, std::size_t n, char* to) {
            for (std::size_t i = 0; i < n; ++i) {
              const T v = value(first + i);
              std::memcpy(to + i * sizeof(T), &v, sizeof(T));
            }
          }};
}

/// Arrays one after the other, as the data of one array; an absent one is zeros.
struct Part {
  const Values* values;
  std::size_t n_values;
};
Array joined(std::string name, Scalar scalar, int components, std::vector<Part> parts) {
  std::size_t total = 0;
  for (const Part& part : parts) total += part.n_values;
  const std::size_t each = info(scalar).bytes;
  return {std::move(name), scalar, components, total,
          [parts = std::move(parts), each](std::size_t first, std::size_t n, char* to) {
            std::size_t start = 0;
            for (const Part& part : parts) {
              const std::size_t low = std::max(first, start), high = std::min(first + n, start + part.n_values);
              if (low < high) {
                char* target = to + (low - first) * each;
                if (part.values == nullptr) {
                  std::memset(target, 0, (high - low) * each);
                } else {
                  std::visit([&](const auto& v) { std::memcpy(target, v.data() + (low - start), (high - low) * each); },
                             *part.values);
                }
              }
              start += part.n_values;
            }
          }};
}

class VtuWriter {
 public:
  explicit VtuWriter(const WriteJob& job)
      : job_(job),
        file_(job.file),
        out_(job.outputs.open(job.path)),
        encoding_(job.encoding.value_or(Encoding::base64)) {}
  void write();

 private:
  Array points() const;
  Array connectivity() const;
  Array offsets() const;
  Array types() const;
  Array regions() const;
  std::vector<Array> point_data() const;
  std::vector<Array> cell_data() const;
  std::vector<Array> field_data() const;
  [[nodiscard]] std::size_t n_cells() const {
    return file_.triangles.size() + file_.lines.size() + file_.marked_points.size();
  }

  void section(std::string_view name, std::vector<Array> arrays);
  void array(const Array& array);
  void ascii(const Array& array);
  static std::string packed_block(const Array& a, std::size_t i, Redundancy redundancy);
  static Redundancy redundancy_of(const Array& a);
  void base64(const Array& array);
  void appended();

  const WriteJob& job_;
  const MeshFile& file_;
  Output& out_;
  Encoding encoding_;
  std::vector<char> buffer_;
  std::vector<Array> waiting_;  // for the appended section
  std::uint64_t offset_ = 0;
};

void VtuWriter::write() {
  out_.put("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"",
           std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian", "\" header_type=\"UInt64\"");
  if (encoding_ == Encoding::base64) out_.put(std::string_view(" compressor=\"vtkZLibDataCompressor\""));
  out_.put(">\n<UnstructuredGrid>\n", "");
  if (auto fields = field_data(); !fields.empty()) section("FieldData", std::move(fields));
  out_.put("<Piece NumberOfPoints=\"", file_.points.size(), "\" NumberOfCells=\"", n_cells(), "\">\n");
  std::vector<Array> list;
  list.push_back(points());
  section("Points", std::move(list));
  list.clear();
  list.push_back(connectivity());
  list.push_back(offsets());
  list.push_back(types());
  section("Cells", std::move(list));
  section("PointData", point_data());
  section("CellData", cell_data());
  out_.put("</Piece>\n</UnstructuredGrid>\n", "");
  if (encoding_ == Encoding::appended) appended();
  out_.put("</VTKFile>\n", "");
}

// --- which arrays ----------------------------------------------------------------------------------------

Array VtuWriter::points() const {
  const MeshFile& f = file_;
  return computed<double>("Points", Scalar::f64, 3, 3 * f.points.size(), [&f](std::size_t i) {
    const Vec2 p = f.points[i / 3];
    return i % 3 == 0 ? p.x : i % 3 == 1 ? p.y : f.z;
  });
}

Array VtuWriter::connectivity() const {
  const MeshFile& f = file_;
  const std::size_t n3 = 3 * f.triangles.size(), n2 = 2 * f.lines.size();
  return computed<std::int32_t>("connectivity", Scalar::i32, 1, n3 + n2 + f.marked_points.size(),
                                [&f, n3, n2](std::size_t i) {
                                  if (i < n3) return f.triangles[i / 3][i % 3];
                                  if (i < n3 + n2) return f.lines[(i - n3) / 2][(i - n3) % 2];
                                  return f.marked_points[i - n3 - n2];
                                });
}

Array VtuWriter::offsets() const {
  const std::size_t t = file_.triangles.size(), l = file_.lines.size();
  return computed<std::int32_t>("offsets", Scalar::i32, 1, n_cells(), [t, l](std::size_t i) {
    const std::size_t end = i < t ? 3 * (i + 1) : i < t + l ? 3 * t + 2 * (i + 1 - t) : 3 * t + 2 * l + (i + 1 - t - l);
    return static_cast<std::int32_t>(end);
  });
}

Array VtuWriter::types() const {
  const std::size_t t = file_.triangles.size(), l = file_.lines.size();
  return computed<std::uint8_t>("types", Scalar::u8, 1, n_cells(), [t, l](std::size_t i) {
    return static_cast<std::uint8_t>(i < t ? kVtkTriangle : i < t + l ? kVtkLine : kVtkVertex);
  });
}

Array VtuWriter::regions() const {
  const MeshFile& f = file_;
  const std::size_t t = f.triangles.size(), l = f.lines.size();
  return computed<std::int32_t>("region", Scalar::i32, 1, n_cells(), [&f, t, l](std::size_t i) {
    if (i < t) return f.regions.empty() ? 0 : f.regions[i];
    return i < t + l ? f.line_tags[i - t] : f.point_tags[i - t - l];
  });
}

std::vector<Array> VtuWriter::point_data() const {
  std::vector<Array> list;
  const MeshFile& f = file_;
  if (!f.weights.empty()) {
    list.push_back(
        computed<double>("weight", Scalar::f64, 1, f.weights.size(), [&f](std::size_t i) { return f.weights[i]; }));
  }
  for (const DataArray& a : f.point_data) {
    if (a.name == "weight" && !f.weights.empty()) {
      job_.warn("point data 'weight' is not written: the name is that of the weights");
      continue;
    }
    list.push_back(joined(a.name, scalar_of(a.values), a.components, {{&a.values, size(a.values)}}));
  }
  return list;
}

std::vector<Array> VtuWriter::cell_data() const {
  const MeshFile& f = file_;
  std::vector<Array> list;
  const bool tagged = !f.regions.empty() || !f.lines.empty() || !f.marked_points.empty();
  if (tagged) list.push_back(regions());

  const std::vector<DataArray>* kinds[] = {&f.cell_data, &f.line_data, &f.marked_point_data};
  const std::size_t counts[] = {f.triangles.size(), f.lines.size(), f.marked_points.size()};
  std::vector<std::string> done;
  for (const auto* kind : kinds) {
    for (const DataArray& a : *kind) {
      if (std::find(done.begin(), done.end(), a.name) != done.end()) continue;
      done.push_back(a.name);
      if (a.name == "region" && tagged) {
        job_.warn("cell data 'region' is not written: the name is that of the regions");
        continue;
      }
      std::vector<Part> parts;
      for (std::size_t k = 0; k < 3; ++k) {
        const DataArray* other = find(*kinds[k], a.name);
        const bool alike =
            other != nullptr && other->components == a.components && other->values.index() == a.values.index();
        if (other != nullptr && !alike) {
          job_.warn(
              text("data ", a.name, " of lines or points differ in type from those of triangles and are not written"));
        }
        parts.push_back({alike ? &other->values : nullptr, counts[k] * static_cast<std::size_t>(a.components)});
      }
      list.push_back(joined(a.name, scalar_of(a.values), a.components, std::move(parts)));
    }
  }
  return list;
}

std::vector<Array> VtuWriter::field_data() const {
  std::vector<Array> list;
  if (!file_.names.empty()) {
    std::string all;
    for (const PhysicalName& n : file_.names) all += text(n.dimension, " ", n.tag, " ", n.name, "\n");
    const std::size_t n = all.size();
    list.push_back(computed<std::uint8_t>("physical_names", Scalar::u8, 1, n, [all = std::move(all)](std::size_t i) {
      return static_cast<std::uint8_t>(all[i]);
    }));
  }
  for (const DataArray& a : file_.field_data) {
    list.push_back(joined(a.name, scalar_of(a.values), a.components, {{&a.values, size(a.values)}}));
  }
  for (Array& a : list) a.field = true;
  return list;
}

// --- how an array is written -------------------------------------------------------------------------------

void VtuWriter::section(std::string_view name, std::vector<Array> arrays) {
  out_.put('<', name, ">\n");
  for (Array& a : arrays) array(a);
  out_.put("</", name, ">\n");
}

void VtuWriter::array(const Array& a) {
  out_.put("<DataArray type=\"", info(a.scalar).vtu, "\" Name=\"", escaped(a.name), '"');
  // Left out when it is 1, as VTK does: some readers make a column of one otherwise.
  if (a.components > 1) out_.put(" NumberOfComponents=\"", a.components, '"');
  if (a.field) out_.put(" NumberOfTuples=\"", a.n_values / static_cast<std::size_t>(a.components), "\"");
  switch (encoding_) {
    case Encoding::ascii:
      out_.put(" format=\"ascii\">\n", "");
      ascii(a);
      out_.put("</DataArray>\n", "");
      break;
    case Encoding::base64:
      out_.put(" format=\"binary\">\n", "");
      base64(a);
      out_.put("\n</DataArray>\n", "");
      break;
    case Encoding::appended:
      out_.put(" format=\"appended\" offset=\"", offset_, "\"/>\n");
      offset_ += sizeof(std::uint64_t) + a.bytes();
      waiting_.push_back(a);
      break;
  }
}

void VtuWriter::ascii(const Array& a) {
  constexpr std::size_t kScalarsALine = 10;
  const std::size_t a_line = a.components > 1 ? static_cast<std::size_t>(a.components) : kScalarsALine;
  with_scalar(a.scalar, [&](auto zero) {
    using T = decltype(zero);
    constexpr std::size_t kBlock = kBlockBytes / sizeof(T);
    buffer_.resize(kBlockBytes);
    for (std::size_t first = 0; first < a.n_values; first += kBlock) {
      const std::size_t n = std::min(kBlock, a.n_values - first);
      a.fill(first, n, buffer_.data());
      for (std::size_t i = 0; i < n; ++i) {
        T value;
        std::memcpy(&value, buffer_.data() + i * sizeof(T), sizeof(T));
        out_.put(value);
        out_.put((first + i + 1) % a_line == 0 || first + i + 1 == a.n_values ? '\n' : ' ');
      }
    }
  });
}

/// Block i of an array, compressed.
std::string VtuWriter::packed_block(const Array& a, std::size_t i, Redundancy redundancy) {
  const std::size_t each = info(a.scalar).bytes, block = kBlockBytes / each;
  const std::size_t first = i * block, n = std::min(block, a.n_values - first);
  std::vector<char> bytes(n * each);
  a.fill(first, n, bytes.data());
  return compress_block({bytes.data(), bytes.size()}, redundancy);
}

/// Strings of bytes come again in numbers of points and in the coordinates of grids, but not in those of other meshes.
Redundancy VtuWriter::redundancy_of(const Array& a) {
  if (a.scalar != Scalar::f64 && a.scalar != Scalar::f32) return Redundancy::strings;
  const std::size_t each = info(a.scalar).bytes, n = std::min(kBlockBytes / each, a.n_values);
  std::vector<char> bytes(n * each);
  a.fill(0, n, bytes.data());
  return choose_redundancy({bytes.data(), bytes.size()});
}

void VtuWriter::base64(const Array& a) {
  const std::size_t block = kBlockBytes / info(a.scalar).bytes;
  const std::size_t n = (a.n_values + block - 1) / block, rest = a.n_values % block;
  const Redundancy redundancy = redundancy_of(a);
  std::vector<std::string> packed(n);
  const auto pack = [&](std::size_t i) { packed[i] = packed_block(a, i, redundancy); };
  if (job_.executor != nullptr) {
    job_.executor->run(n, pack);
  } else {
    for (std::size_t i = 0; i < n; ++i) pack(i);
  }
  std::vector<std::uint64_t> header = {n, kBlockBytes, rest * info(a.scalar).bytes};
  for (const std::string& p : packed) header.push_back(p.size());
  Base64Encoder encoder(out_);
  encoder.put({reinterpret_cast<const char*>(header.data()), header.size() * sizeof(std::uint64_t)});
  encoder.finish();
  for (const std::string& p : packed) encoder.put(p);
  encoder.finish();
}

void VtuWriter::appended() {
  out_.put("<AppendedData encoding=\"raw\">\n_", "");
  buffer_.resize(kBlockBytes);
  for (const Array& a : waiting_) {
    const std::size_t each = info(a.scalar).bytes;
    const std::size_t block = kBlockBytes / each;
    out_.put_raw(static_cast<std::uint64_t>(a.bytes()));
    for (std::size_t first = 0; first < a.n_values; first += block) {
      const std::size_t n = std::min(block, a.n_values - first);
      a.fill(first, n, buffer_.data());
      out_.put(std::string_view(buffer_.data(), n * each));
    }
  }
  out_.put("\n</AppendedData>\n", "");
}

}  // namespace

void write_vtu(const WriteJob& job) { VtuWriter(job).write(); }

}  // namespace temper::io
