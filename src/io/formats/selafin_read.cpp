#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "io/formats/selafin.hpp"
#include "io/text/scanner.hpp"
#include "io/text/values.hpp"

namespace temper::io {

namespace {

constexpr std::size_t kSelafinTitleRecord = 80, kRecordLengthBytes = 4;

/// The records of a file.
class SelafinRecords {
 public:
  SelafinRecords(const std::string& path, std::string_view bytes)
      : path_(path), bytes_(bytes), order_(bytes.starts_with('\0') ? std::endian::big : std::endian::little) {}

  [[nodiscard]] std::size_t remaining() const { return bytes_.size() - at_; }
  /// The next record, of this many bytes.
  std::string_view next(std::size_t expected, std::string_view what) {
    const std::size_t found = length(what);
    if (found != expected)
      fail(ErrorCode::syntax, path_, what, found == 1 ? " is a record of " : " are a record of ", found,
           " bytes at byte ", at_ - kRecordLengthBytes, "; expected ", expected);
    return body(found, what);
  }
  /// The next record, of any length.
  std::string_view next(std::string_view what) { return body(length(what), what); }

  template <class T>
  [[nodiscard]] std::vector<T> numbers(std::string_view record) const {
    std::vector<T> all(record.size() / sizeof(T));
    if (all.empty()) return all;
    std::memcpy(all.data(), record.data(), all.size() * sizeof(T));
    if (order_ == std::endian::native) return all;
    for (T& number : all) {
      auto* const bytes = reinterpret_cast<unsigned char*>(&number);
      std::reverse(bytes, bytes + sizeof(T));
    }
    return all;
  }

 private:
  std::size_t length(std::string_view what) {
    const std::string_view four = take(kRecordLengthBytes, what);
    return static_cast<std::size_t>(numbers<std::uint32_t>(four)[0]);
  }
  std::string_view body(std::size_t n, std::string_view what) {
    const std::string_view record = take(n, what);
    if (length(what) != n)
      fail(ErrorCode::syntax, path_, "the record of ", what, " ends with another length at byte ",
           at_ - kRecordLengthBytes, "; expected ", n, " bytes. Next: write the file again, in binary");
    return record;
  }
  std::string_view take(std::size_t n, std::string_view what) {
    if (n > remaining()) fail(ErrorCode::truncated, path_, "the file ends within ", what);
    at_ += n;
    return bytes_.substr(at_ - n, n);
  }

  const std::string& path_;
  std::string_view bytes_;
  std::endian order_;
  std::size_t at_ = 0;
};

class SelafinReader {
 public:
  explicit SelafinReader(Source& source) : records_(source.path, source.bytes), document_(new_document(source.path)) {}

  Document read() {
    title();
    variables();
    parameters();
    triangles();
    points();
    if (number_bytes_ == sizeof(float))
      steps<float>();
    else
      steps<double>();
    document_.may_be_degrees = true;
    read_selafin_boundary(document_);
    return std::move(document_);
  }

 private:
  void add_field(std::string_view name, Values values) {
    document_.file.field_data.push_back({std::string(name), 1, std::move(values)});
  }
  void title() {
    const std::string_view record = records_.next(kSelafinTitleRecord, "the title and the format");
    const std::string_view text = trimmed(record.substr(0, kSelafinTitleBytes));
    if (!text.empty()) add_field(kSelafinTitle, std::vector<std::uint8_t>(text.begin(), text.end()));
  }
  void variables() {
    const auto counts = records_.numbers<std::int32_t>(records_.next(8, "the numbers of variables"));
    const std::int64_t n = std::int64_t{counts[0]} + counts[1];
    if (counts[0] < 0 || counts[1] < 0 || static_cast<std::size_t>(n) > records_.remaining() / (2 * kSelafinNameBytes))
      fail(ErrorCode::truncated, path(), "announces ", n, " variables, but only ", records_.remaining(),
           " bytes follow");
    for (std::int64_t i = 0; i < n; ++i)
      names_.push_back(selafin_name(records_.next(2 * kSelafinNameBytes, "the name of a variable")));
  }
  void parameters() {
    constexpr std::size_t kX = 2, kPlanes = 6, kHasDate = 9;
    const auto p = records_.numbers<std::int32_t>(records_.next(40, "the ten parameters"));
    if (p[kPlanes] > 1)
      fail(ErrorCode::unsupported, path(), "is a mesh of prisms between ", p[kPlanes],
           " planes; expected triangles. Next: take one plane of it, as slf_3d_to_2d of PyTelTools does");
    origin_ = {static_cast<double>(p[kX]), static_cast<double>(p[kX + 1])};
    if (p[kX] != 0 || p[kX + 1] != 0) add_field(kSelafinOrigin, std::vector<std::int32_t>{p[kX], p[kX + 1]});
    if (p[kHasDate] == 1) add_field(kSelafinDate, records_.numbers<std::int32_t>(records_.next(24, "the date")));
  }
  void triangles() {
    const auto counts = records_.numbers<std::int32_t>(records_.next(16, "the numbers of triangles and points"));
    if (counts[2] != 3)
      fail(ErrorCode::unsupported, path(), "has elements of ", counts[2], " points; expected triangles");
    if (counts[0] < 0 || counts[1] < 0)
      fail(ErrorCode::syntax, path(), "has ", counts[0], " triangles and ", counts[1], " points");
    n_points_ = static_cast<std::size_t>(counts[1]);
    const auto n = static_cast<std::size_t>(counts[0]);
    const auto corners = records_.numbers<std::int32_t>(records_.next(12 * n, "the corners of triangles"));
    document_.file.triangles.corners.reserve(n);
    for (std::size_t t = 0; t < n; ++t) {
      const auto corner = [&](std::size_t k) {
        return static_cast<std::int32_t>(std::int64_t{corners[3 * t + k]} - 1);
      };
      document_.file.triangles.corners.push_back({corner(0), corner(1), corner(2)});
    }
    records_.next(4 * n_points_, "the numbers of boundary points");
    document_.names->points = RunLength(1, n_points_);
    document_.names->triangles = RunLength(1, n);
  }
  void points() {
    const std::string_view record = records_.next("the x coordinates of points");
    number_bytes_ = n_points_ == 0 ? sizeof(float) : record.size() / n_points_;
    if (record.size() != n_points_ * number_bytes_ ||
        (number_bytes_ != sizeof(float) && number_bytes_ != sizeof(double)))
      fail(ErrorCode::syntax, path(), "the x coordinates of ", n_points_, " points are a record of ", record.size(),
           " bytes; expected 4 or 8 bytes for each");
    const std::vector<double> x = reals(record);
    const std::vector<double> y = reals(records_.next(record.size(), "the y coordinates of points"));
    document_.file.points.reserve(n_points_);
    const auto add = [](double part, double origin) { return origin == 0 ? part : part + origin; };  // −0 stays
    for (std::size_t i = 0; i < n_points_; ++i)
      document_.file.points.push_back({add(x[i], origin_.x), add(y[i], origin_.y)});
  }
  [[nodiscard]] std::vector<double> reals(std::string_view record) const {
    if (number_bytes_ == sizeof(double)) return records_.numbers<double>(record);
    const auto numbers = records_.numbers<float>(record);
    return {numbers.begin(), numbers.end()};
  }

  /// All time steps. A run that was stopped may leave a part of the last one.
  template <class T>
  void steps() {
    const std::size_t frame = 2 * kRecordLengthBytes, values = n_points_ * sizeof(T);
    const std::size_t n = records_.remaining() / (frame + sizeof(T) + names_.size() * (frame + values));
    std::vector<std::vector<T>> variables(names_.size(), std::vector<T>(n * n_points_));
    std::vector<T> times;
    for (std::size_t s = 0; s < n; ++s) {
      times.push_back(records_.numbers<T>(records_.next(sizeof(T), "the time of a step"))[0]);
      for (std::vector<T>& variable : variables) {
        const auto numbers = records_.numbers<T>(records_.next(values, "the values of a variable"));
        for (std::size_t i = 0; i < n_points_; ++i) variable[i * n + s] = numbers[i];
      }
    }
    if (n == 0 && !names_.empty())
      warn("has no whole time step, so its variables are left out");
    else if (records_.remaining() > frame)
      warn("ends within time step ", n + 1, ", which is left out");
    if (n == 0) return;
    for (std::size_t v = 0; v < names_.size(); ++v) add_variable(names_[v], n, std::move(variables[v]));
    if (n > 1 || times[0] != 0 || sizeof(T) == sizeof(double)) add_field(kSelafinTime, std::move(times));
  }
  template <class T>
  void add_variable(const std::string& name, std::size_t steps, std::vector<T>&& values) {
    MeshFile& f = document_.file;
    const std::string_view word = std::string_view(name).substr(0, name.find(" ["));
    const bool is_bed = !f.z_is_data && (word == "BOTTOM" || word == "FOND");
    bool is_constant = true;
    for (std::size_t i = 0; i < values.size(); ++i)
      is_constant = is_constant && std::isfinite(values[i]) && values[i] == values[i - i % steps];
    if (!is_bed || !is_constant) {
      if (is_bed)
        warn("the bed '", name, "' is not the same finite number in all time steps: it is kept as data alone");
      f.point_data.push_back({name, static_cast<int>(steps), std::move(values)});
      return;
    }
    std::vector<double> heights;
    for (std::size_t i = 0; i < n_points_; ++i) heights.push_back(values[i * steps]);
    f.z_is_data = true;
    f.positive = Positive::up;
    f.point_data.push_back({std::string(kHeight), 1, std::move(heights)});
    if (name != kSelafinBottom) add_field(kSelafinBed, std::vector<std::uint8_t>(name.begin(), name.end()));
  }

  [[nodiscard]] const std::string& path() const { return document_.names->path; }
  template <class... Parts>
  void warn(const Parts&... message) {
    document_.file.warnings.push_back(text(path(), ": ", message...));
  }

  SelafinRecords records_;
  Document document_;
  std::vector<std::string> names_;
  std::size_t n_points_ = 0, number_bytes_ = 0;
  Vec2 origin_ = {};
};

}  // namespace

std::string selafin_name(std::string_view record) {
  std::string whole(record.substr(0, record.find_last_not_of(' ') + 1));
  if (record[kSelafinNameBytes - 1] != ' ' && record[kSelafinNameBytes] != ' ') return whole;
  const std::string_view unit = trimmed(record.substr(kSelafinNameBytes));
  if (unit.empty()) return whole;
  const std::string name = text(trimmed(record.substr(0, kSelafinNameBytes)), " [", unit, "]");
  return selafin_record(name) == record ? name : whole;
}

bool sniff_selafin(std::string_view head) {
  using namespace std::string_view_literals;
  constexpr std::size_t kEnd = kRecordLengthBytes + kSelafinTitleRecord;
  const std::string_view next = head.substr(std::min(kEnd, head.size()));
  return (head.starts_with("\0\0\0\x50"sv) && next.starts_with("\0\0\0\x50\0\0\0\x8"sv)) ||
         (head.starts_with("\x50\0\0\0"sv) && next.starts_with("\x50\0\0\0\x8\0\0\0"sv));
}

Document read_selafin(Source& source) { return SelafinReader(source).read(); }

}  // namespace temper::io
