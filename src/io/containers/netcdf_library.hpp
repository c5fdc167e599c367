// libnetcdf, loaded when the first NetCDF file comes: it brings fifty other libraries along.
#pragma once

#include <netcdf.h>
#include <netcdf_mem.h>

#include <string>

namespace temper::io {

/// Every function of it that is called here.
#define TEMPER_NETCDF_FUNCTIONS(use)                                                                               \
  use(nc_abort) use(nc_close_memio) use(nc_create_mem) use(nc_def_dim) use(nc_def_var) use(nc_enddef)              \
      use(nc_free_string) use(nc_get_att_double) use(nc_get_att_string) use(nc_get_att_text) use(nc_get_var)       \
          use(nc_inq_att) use(nc_inq_dimid) use(nc_inq_dimlen) use(nc_inq_dimname) use(nc_inq_libvers)             \
              use(nc_inq_nvars) use(nc_inq_var) use(nc_inq_vardimid) use(nc_inq_varid) use(nc_open_mem)            \
                  use(nc_put_att_double) use(nc_put_att_int) use(nc_put_att_text) use(nc_put_var) use(nc_set_fill) \
                      use(nc_strerror)

/// Its functions by their own names, as members. Null as long as it is not loaded.
struct NetcdfLibrary {
// NOLINTNEXTLINE(bugprone-macro-parentheses): the name of a member has none
#define TEMPER_MEMBER(function) decltype(&::function) function = nullptr;
  TEMPER_NETCDF_FUNCTIONS(TEMPER_MEMBER)
#undef TEMPER_MEMBER
};

/// The library; a failure about the file `path` when there is none. From several threads at once, too.
const NetcdfLibrary& netcdf_library(const std::string& path);

}  // namespace temper::io
