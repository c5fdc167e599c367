// Writes Selafin, in big-endian. Numbers have 4 bytes (SERAFIN) if they all fit, and 8 (SERAFIND) otherwise, or if the
// file that was read had 8.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>

#include "io/formats/selafin.hpp"
#include "io/text/values.hpp"

namespace temper::io {

namespace {

template <class T>
void put_swapped(Output& out, T value) {
  if constexpr (std::endian::native == std::endian::little) {
    auto* const bytes = reinterpret_cast<unsigned char*>(&value);
    std::reverse(bytes, bytes + sizeof value);
  }
  out.put_raw(value);
}

template <class T>
void put_record(Output& out, const std::vector<T>& numbers) {
  const auto bytes = static_cast<std::uint32_t>(numbers.size() * sizeof(T));
  put_swapped(out, bytes);
  for (const T number : numbers) put_swapped(out, number);
  put_swapped(out, bytes);
}

void put_record(Output& out, std::string_view characters) {
  const auto bytes = static_cast<std::uint32_t>(characters.size());
  put_swapped(out, bytes);
  out.put(characters);
  put_swapped(out, bytes);
}

std::string padded_to(std::string_view text, std::size_t n) {
  std::string result(text.substr(0, n));
  result.resize(n, ' ');
  return result;
}

/// A variable: its values at each point, one for each time step or one for all.
struct SelafinVariable {
  std::string name;
  std::size_t components;
  std::vector<double> values;

  [[nodiscard]] double at(std::size_t point, std::size_t step) const {
    return values[point * components + std::min(step, components - 1)];
  }
};

class SelafinWriter {
 public:
  explicit SelafinWriter(const WriteJob& job) : job_(job), file_(job.file) {}

  void write() {
    if (const auto* const origin = field<std::int32_t>(kSelafinOrigin, 2))
      origin_ = {static_cast<double>((*origin)[0]), static_cast<double>((*origin)[1])};
    const DataArray* const time = find(file_.field_data, kSelafinTime);
    if (time != nullptr && is_floating(time->values) && size(time->values) > 0)
      times_ = to_doubles(Values(time->values));
    collect_variables();
    const auto edges = boundary_edges(job_.measured);
    const NodeString nodes = boundary_nodes(job_.measured, edges);
    const bool was_double = time != nullptr && std::holds_alternative<std::vector<double>>(time->values);
    const bool is_double = was_double || !fit_single();
    if (is_double && !was_double && file_.format == job_.row.name)
      job_.warn(
          "numbers need double precision (SERAFIND). Next: GEOMETRY FILE FORMAT = 'SERAFIND' in TELEMAC's "
          "steering file");
    Output& out = job_.outputs.open(job_.path);
    header(out, is_double, nodes);
    is_double ? numbers<double>(out) : numbers<float>(out);
    write_selafin_boundary(job_, edges, nodes);
  }

 private:
  /// Field data of this type and number of values, or null. 0: any number.
  template <class T>
  [[nodiscard]] const std::vector<T>* field(std::string_view name, std::size_t n) const {
    const DataArray* const array = find(file_.field_data, name);
    const auto* const values = array == nullptr ? nullptr : std::get_if<std::vector<T>>(&array->values);
    return values == nullptr || (n > 0 && values->size() != n) ? nullptr : values;
  }
  [[nodiscard]] std::string text_of(std::string_view name, std::string_view otherwise) const {
    const auto* const bytes = field<std::uint8_t>(name, 0);
    return bytes == nullptr ? std::string(otherwise) : std::string(bytes->begin(), bytes->end());
  }
  void collect_variables() {
    std::vector<std::string_view> lost;
    for (const DataArray& a : file_.point_data) {
      const auto components = static_cast<std::size_t>(a.components);
      if (!is_floating(a.values)) continue;  // warn_of_losses() names it
      if (components != 1 && components != times_.size()) {
        lost.push_back(a.name);
        continue;
      }
      const bool is_bed = a.name == kHeight && file_.z_is_data;
      const std::string name = is_bed ? text_of(kSelafinBed, kSelafinBottom) : a.name;
      if (const std::string again = selafin_name(selafin_record(name)); again != name)
        job_.warn("the name '", name, "' is written as '", again,
                  "': there is room for 16 characters, and 16 of a unit");
      variables_.push_back({name, components, to_doubles(Values(a.values))});
    }
    warn_of_arrays(job_, text("point data without ", times_.size(), times_.size() == 1 ? " component" : " components"),
                   lost);
  }
  [[nodiscard]] bool fit_single() const {
    const auto fits = [](double number) {
      return std::isnan(number) || static_cast<double>(static_cast<float>(number)) == number;
    };
    return std::ranges::all_of(times_, fits) &&
           std::ranges::all_of(file_.points, [&](Vec2 p) { return fits(p.x - origin_.x) && fits(p.y - origin_.y); }) &&
           std::ranges::all_of(variables_,
                               [&](const SelafinVariable& v) { return std::ranges::all_of(v.values, fits); });
  }
  void header(Output& out, bool is_double, const NodeString& boundary) const {
    put_record(out, padded_to(text_of(kSelafinTitle, ""), kSelafinTitleBytes) + (is_double ? "SERAFIND" : "SERAFIN "));
    put_record(out, std::vector<std::int32_t>{static_cast<std::int32_t>(variables_.size()), 0});
    for (const SelafinVariable& v : variables_) put_record(out, selafin_record(v.name));
    const auto* const date = field<std::int32_t>(kSelafinDate, 6);
    const auto x = static_cast<std::int32_t>(origin_.x), y = static_cast<std::int32_t>(origin_.y);
    put_record(out, std::vector<std::int32_t>{1, 0, x, y, 0, 0, 0, 0, 0, date != nullptr});
    if (date != nullptr) put_record(out, *date);
    const std::size_t n = file_.points.size();
    put_record(out, std::vector<std::int32_t>{static_cast<std::int32_t>(file_.triangles.size()),
                                              static_cast<std::int32_t>(n), 3, 1});
    std::vector<std::int32_t> corners;
    corners.reserve(3 * file_.triangles.size());
    for (const auto& t : file_.triangles) {
      for (const std::int32_t p : t) corners.push_back(p + 1);
    }
    put_record(out, corners);
    std::vector<std::int32_t> numbers(n);
    for (std::size_t i = 0; i < boundary.size(); ++i)
      numbers[static_cast<std::size_t>(boundary[i])] = static_cast<std::int32_t>(i) + 1;
    put_record(out, numbers);
  }
  /// Coordinates, and all time steps.
  template <class T>
  void numbers(Output& out) const {
    const std::size_t n = file_.points.size();
    std::vector<T> values(n);
    const auto put = [&](const auto& at) {
      for (std::size_t i = 0; i < n; ++i) values[i] = static_cast<T>(at(i));
      put_record(out, values);
    };
    put([&](std::size_t i) { return file_.points[i].x - origin_.x; });
    put([&](std::size_t i) { return file_.points[i].y - origin_.y; });
    for (std::size_t s = 0; s < times_.size(); ++s) {
      put_record(out, std::vector<T>{static_cast<T>(times_[s])});
      for (const SelafinVariable& v : variables_) put([&](std::size_t i) { return v.at(i, s); });
    }
  }

  const WriteJob& job_;
  const MeshFile& file_;
  Vec2 origin_ = {};
  std::vector<double> times_ = {0};
  std::vector<SelafinVariable> variables_;
};

}  // namespace

std::string selafin_record(std::string_view name) {
  const std::size_t open = name.rfind(" [");
  const bool has_unit = name.ends_with(']') && open != std::string_view::npos && open <= kSelafinNameBytes;
  if (!has_unit) return padded_to(name, 2 * kSelafinNameBytes);
  return padded_to(name.substr(0, open), kSelafinNameBytes) +
         padded_to(name.substr(open + 2, name.size() - open - 3), kSelafinNameBytes);
}

bool selafin_keeps(Content of, const DataArray& array) {
  if (of == kPointData) return is_floating(array.values);
  if (of == kMarkedPointData) return array.name == kSelafinBoundary;
  constexpr std::array kFields = {kSelafinTitle, kSelafinDate, kSelafinOrigin, kSelafinBed, kSelafinTime};
  return of == kFieldData && std::ranges::find(kFields, array.name) != kFields.end();
}

std::vector<std::string> selafin_files(const std::string& path) { return {path, selafin_boundary_path(path)}; }

void write_selafin(const WriteJob& job) { SelafinWriter(job).write(); }

}  // namespace temper::io
