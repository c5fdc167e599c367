#include "optimize_options.hpp"

namespace temper::python {
namespace {

/// Reads one option; says which one it was when the type is wrong.
class OptionReader {
 public:
  explicit OptionReader(const py::dict& dict) : dict_(dict) {}

  template <class T>
  void operator()(const char* name, T& target) const {
    if (!dict_.contains(name)) return;
    const py::object value = dict_[name];
    try {
      read(name, value, target);
    } catch (const py::cast_error&) {
      throw py::type_error(std::string(name) + ": " + std::string(py::repr(value)) + " is of the wrong type");
    }
  }

 private:
  template <class T>
  static void read(const char* name, const py::object& value, T& target) {
    if constexpr (std::is_enum_v<T>) {
      target = from_name<T>(
          name, py::isinstance<py::int_>(value) ? py::str(value).cast<std::string>() : value.cast<std::string>());
    } else {
      target = value.cast<T>();
    }
  }
  static void read(const char* /*name*/, const py::object& value, AccuracyOptions& target) {
    const auto dict = value.cast<py::dict>();
    each_accuracy_option(target, OptionReader(dict));
  }
  static void read(const char* /*name*/, const py::object& value, Softening& target) { target = softening_from(value); }
  static void read(const char* name, const py::object& value, VertexId& target) {
    target = {};
    if (value.is_none()) return;
    const auto number = value.cast<std::int64_t>();
    if (number < 0) {
      fail(ErrorCode::invalid_option, std::string(name) + ": expected 0 or more, found " + std::to_string(number));
    }
    target = VertexId(static_cast<std::size_t>(number));
  }
  template <class T>
  static void read(const char* name, const py::object& value, std::optional<T>& target) {
    target.reset();
    if (value.is_none()) return;
    T given{};
    read(name, value, given);
    target = given;
  }

  const py::dict& dict_;
};

struct OptionWriter {
  py::dict& dict;
  template <class T>
  void operator()(const char* name, const T& value) const {
    if constexpr (std::is_enum_v<T>) {
      if (std::is_same_v<T, Star> && value != static_cast<T>(Star::all)) {
        dict[name] = py::int_(static_cast<int>(value));
      } else {
        dict[name] = to_python(name_of(value));
      }
    } else if constexpr (std::is_same_v<T, VertexId>) {
      dict[name] = value.valid() ? to_python(value) : py::none();
    } else if constexpr (std::is_same_v<T, AccuracyOptions>) {
      py::dict nested;
      each_accuracy_option(value, OptionWriter{nested});
      dict[name] = nested;
    } else {
      dict[name] = to_python(value);
    }
  }
  template <class T>
  requires std::is_enum_v<T>
  void operator()(const char* name, const std::optional<T>& value) const {
    dict[name] = value ? to_python(name_of(*value)) : py::none();
  }
};

py::dict spread_to_dict(const Spread& s) {
  return Record()("min", s.min)("p05", s.p05)("median", s.median)("p95", s.p95)("max", s.max).dict;
}

}  // namespace

OptimizeOptions options_from(const py::dict& dict, OptimizeOptions options) {
  each_option(options, OptionReader(dict));
  return options;
}

py::dict options_to_dict(const OptimizeOptions& options) {
  py::dict dict;
  each_option(options, OptionWriter{dict});
  return dict;
}

py::dict record_to_dict(const SweepRecord& r) {
  return Record()("sweep", r.sweep)("energy", r.energy)("bad", r.bad)("flips", r.flips)("softening", r.softening)(
             "seconds", r.seconds)("objective", name_of(r.objective))
      .dict;
}

py::dict size_report_to_dict(const SizeReport& report) {
  return Record()("over_field", py::object(spread_to_dict(report.over_field)))(
             "gradation", py::object(spread_to_dict(report.gradation)))(
             "largest_edge_ratio", report.largest_edge_ratio)("outside", report.outside)("band", report.band())
      .dict;
}

py::dict report_to_dict(const OptimizeReport& r) {
  py::list history;
  for (const SweepRecord& record : r.history) history.append(record_to_dict(record));
  return Record()("stopped", name(r.stopped))("sweeps", r.sweeps)("flips", r.flips)(
             "vertices_removed", r.vertices_removed)("vertices_inserted", r.vertices_inserted)("vertices", r.vertices)(
             "hidden", r.hidden)("seconds", r.seconds)("initial_energy", r.initial_energy)(
             "final_energy", r.final_energy)("size_before", py::object(size_report_to_dict(r.size.before)))(
             "size_after", py::object(size_report_to_dict(r.size.after)))("history", py::object(history))("notes",
                                                                                                          r.notes)
      .dict;
}

}  // namespace temper::python
