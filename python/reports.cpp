#include "reports.hpp"

namespace temper::python {
namespace {

/// Makes a Python object of each kind of value.
struct Maker {
  py::object operator()(std::monostate) const { return py::none(); }
  py::object operator()(std::int64_t value) const { return py::int_(value); }
  py::object operator()(const NumberedText& text) const { return py::str(text.text); }
  py::object operator()(const TextWithOptions& text) const { return py::str(spelled(text.text)); }
  py::object operator()(const Certificate* proof) const {
    return py::module_::import("temper._certificate").attr("Certificate").attr("_of")(certificate_to_dict(*proof));
  }
  py::object operator()(const ReportView& report) const { return to_python(report); }
  template <class T>
  py::object operator()(std::span<const T> values) const {
    return array_of<T>(values);
  }
  py::object operator()(const FieldList& values) const {
    py::list list;
    for (const FieldValue& value : values.items) list.append(std::visit(*this, value.is));
    return values.is_fixed ? py::object(py::tuple(list)) : py::object(list);
  }
  template <class T>
  py::object operator()(const T& value) const {
    return to_python(value);
  }
};

}  // namespace

py::dict fields_of(const ReportView& report) {
  py::dict fields;
  for (const ReportRow& row : report.table->rows)
    fields[py::str(row.key.data(), row.key.size())] = std::visit(Maker(), row.of(report.report.get()).is);
  return fields;
}

py::object to_python(const ReportView& report) {
  py::dict fields = fields_of(report);
  if (report.table->name.empty()) return fields;
  return py::module_::import("temper._records").attr("made")(to_python(report.table->name), fields);
}

}  // namespace temper::python
