// The page of HTML reports, without data: web/report/dist/report.html, which the build puts into the library.
#pragma once

#include <string_view>

namespace temper::io {

[[nodiscard]] std::string_view html_page();

}  // namespace temper::io
