// libhdf5, 1.10 or later, loaded when the first file needs it.
//
// Called are functions that have been the same in all versions since: none of those that the headers choose by macro.
#pragma once

#include <hdf5.h>

#include <string>

namespace temper::io {

static_assert(sizeof(hid_t) == 8, "the headers of HDF5 are those of 1.10 or later");

/// Every function of it that is called here.
#define TEMPER_HDF5_FUNCTIONS(use)                                                                                    \
  use(H5Aclose) use(H5Acreate2) use(H5Aexists) use(H5Aget_space) use(H5Aget_type) use(H5Aopen) use(H5Aread)           \
      use(H5Awrite) use(H5Dclose) use(H5Dcreate2) use(H5Dget_create_plist) use(H5Dget_offset) use(H5Dget_space)       \
          use(H5Dget_type) use(H5Dread) use(H5Eget_auto2) use(H5Eset_auto2) use(H5Fclose) use(H5Fcreate)              \
              use(H5Fget_filesize) use(H5Fopen) use(H5Gclose) use(H5Gcreate2) use(H5Gget_create_plist)                \
                  use(H5Gget_info) use(H5Iget_type) use(H5Lexists) use(H5Lget_name_by_idx) use(H5Oclose) use(H5Oopen) \
                      use(H5Pclose) use(H5Pcreate) use(H5Pget_external_count) use(H5Pget_layout)                      \
                          use(H5Pget_link_creation_order) use(H5Pset_alloc_time) use(H5Pset_char_encoding)            \
                              use(H5Pset_elink_cb) use(H5Pset_fclose_degree) use(H5Pset_fapl_core)                    \
                                  use(H5Pset_file_image) use(H5Pset_file_image_callbacks) use(H5Pset_fill_time)       \
                                      use(H5Pset_link_creation_order) use(H5Pset_meta_block_size)                     \
                                          use(H5Pset_obj_track_times) use(H5Pset_small_data_block_size) use(H5Sclose) \
                                              use(H5Screate) use(H5Screate_simple) use(H5Sget_simple_extent_dims)     \
                                                  use(H5Sget_simple_extent_ndims) use(H5Tclose) use(H5Tcopy)          \
                                                      use(H5Tget_class) use(H5Tget_sign) use(H5Tget_size)             \
                                                          use(H5Tis_variable_str) use(H5Tset_size) use(H5free_memory) \
                                                              use(H5get_libversion) use(H5open)

/// Classes of properties and types, which the library numbers when it is opened.
#define TEMPER_HDF5_NUMBERS(use)                                                                               \
  use(H5P_CLS_DATASET_CREATE_ID_g) use(H5P_CLS_FILE_ACCESS_ID_g) use(H5P_CLS_GROUP_CREATE_ID_g)                \
      use(H5P_CLS_LINK_ACCESS_ID_g) use(H5P_CLS_LINK_CREATE_ID_g) use(H5T_C_S1_g) use(H5T_NATIVE_DOUBLE_g)     \
          use(H5T_NATIVE_FLOAT_g) use(H5T_NATIVE_INT64_g) use(H5T_NATIVE_INT32_g) use(H5T_NATIVE_UINT8_g)      \
              use(H5T_NATIVE_INT8_g) use(H5T_NATIVE_INT16_g) use(H5T_NATIVE_UINT16_g) use(H5T_NATIVE_UINT32_g) \
                  use(H5T_NATIVE_UINT64_g)

/// H5F_ACC_RDONLY and H5F_ACC_TRUNC, whose macros call functions.
inline constexpr unsigned kHdf5ReadOnly = 0, kHdf5Truncate = 2;

/// Its functions and numbers by their own names, as members. Null as long as it is not loaded.
struct Hdf5Library {
// NOLINTBEGIN(bugprone-macro-parentheses): the name of a member has none
#define TEMPER_MEMBER(function) decltype(&::function) function = nullptr;
  TEMPER_HDF5_FUNCTIONS(TEMPER_MEMBER)
#undef TEMPER_MEMBER
#define TEMPER_MEMBER(number) hid_t number = -1;
  TEMPER_HDF5_NUMBERS(TEMPER_MEMBER)
#undef TEMPER_MEMBER
  // NOLINTEND(bugprone-macro-parentheses)
};

/// The library; a failure about the file `path` when there is none. From several threads at once, too.
const Hdf5Library& hdf5_library(const std::string& path);

}  // namespace temper::io
