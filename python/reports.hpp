// Reports of the library as records of Python, by the rows of their tables.
#pragma once

#include "convert.hpp"
#include "temper/detail/report.hpp"

namespace temper::python {

/// A record of the class that the table names. It is a dictionary if the table has no name.
py::object to_python(const ReportView& report);

template <class Report>
py::object report_to_python(const Report& report) {
  return to_python(view_of(report));
}

}  // namespace temper::python
