// Reports of the library as records of Python, by the rows of their tables.
#pragma once

#include "convert.hpp"
#include "temper/detail/report.hpp"
#include "temper/feasibility.hpp"

namespace temper::python {

/// The fields of temper.types.Certificate.
py::dict certificate_to_dict(const Certificate& certificate);

/// A record of the class that the table names. It is a dictionary if the table has no name.
py::object to_python(const ReportView& report);
/// The fields of a report by their keys.
py::dict fields_of(const ReportView& report);

template <class Report>
py::object report_to_python(const Report& report) {
  return to_python(view_of(report));
}

}  // namespace temper::python
