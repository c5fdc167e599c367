// Writes HDF5. See hdf5_file.hpp.
//
//   image   what the library writes to memory: headers of groups and datasets, names, attributes
//   file    the image, and after it the numbers of one dataset after the other
//
// Datasets get their room in the file as soon as they are made, and nothing is put there. The library takes room for
// headers in blocks so large that the first one is enough: it is before all numbers. (If it were not enough, the image
// would grow as far as the last header, and the file would still be right.)
#include <algorithm>
#include <array>
#include <cstdlib>

#include "io/containers/foreign_library.hpp"
#include "io/containers/hdf5_file.hpp"
#include "io/text/scanner.hpp"

namespace temper::io {

// For a library in C: no exception may get through.
H5FD_file_image_callbacks_t Hdf5Writer::callbacks(Image* image) {
  const auto allocate = [](std::size_t size, H5FD_file_image_op_t, void*) { return std::malloc(size); };
  const auto copy = [](void* to, const void* from, std::size_t size, H5FD_file_image_op_t, void*) {
    return std::memcpy(to, from, size);
  };
  const auto grow = [](void* bytes, std::size_t size, H5FD_file_image_op_t, void* image_of) {
    void* const moved = std::realloc(bytes, size);
    if (moved != nullptr) static_cast<Image*>(image_of)->size = size;
    return moved;
  };
  const auto release = [](void* bytes, H5FD_file_image_op_t why, void* image_of) -> herr_t {
    if (why == H5FD_FILE_IMAGE_OP_FILE_CLOSE) {
      static_cast<Image*>(image_of)->bytes.reset(static_cast<char*>(bytes));
    } else {
      std::free(bytes);
    }
    return 0;
  };
  const auto same = [](void* image_of) { return image_of; };
  const auto keep = [](void*) -> herr_t { return 0; };
  return {allocate, copy, grow, release, same, keep, image};
}

Hdf5Writer::Hdf5Writer(std::string path, std::size_t objects)
    : path_(std::move(path)), library_(hdf5_library(path_)), turn_(foreign_tables()), quiet_(library_) {
  const auto properties = [&](hid_t kind) {
    return Hdf5Id(check(library_.H5Pcreate(kind), "begin"), library_.H5Pclose);
  };
  ordered_ = properties(library_.H5P_CLS_GROUP_CREATE_ID_g);
  check(library_.H5Pset_link_creation_order(ordered_, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED), "begin");
  utf8_ = properties(library_.H5P_CLS_LINK_CREATE_ID_g);
  check(library_.H5Pset_char_encoding(utf8_, H5T_CSET_UTF8), "begin");
  without_numbers_ = properties(library_.H5P_CLS_DATASET_CREATE_ID_g);
  check(library_.H5Pset_alloc_time(without_numbers_, H5D_ALLOC_TIME_EARLY), "begin");
  check(library_.H5Pset_fill_time(without_numbers_, H5D_FILL_TIME_NEVER), "begin");
  check(library_.H5Pset_obj_track_times(without_numbers_, false), "begin");  // the same bytes at any time

  const Hdf5Id access = properties(library_.H5P_CLS_FILE_ACCESS_ID_g);
  H5FD_file_image_callbacks_t own = callbacks(&image_);
  // A dataset of temper's takes 300 bytes, its name, and twice the bytes of its attributes. Lists of names take
  // kilobytes.
  constexpr std::size_t kIncrement = std::size_t{1} << 14, kOfLists = std::size_t{1} << 13, kEach = 1024;
  check(library_.H5Pset_fapl_core(access, kIncrement, false), "begin");
  check(library_.H5Pset_fclose_degree(access, H5F_CLOSE_STRONG), "begin");
  check(library_.H5Pset_file_image_callbacks(access, &own), "begin");
  check(library_.H5Pset_meta_block_size(access, kOfLists + kEach * objects), "begin");
  check(library_.H5Pset_small_data_block_size(access, 0), "begin");  // the file ends where the last numbers do
  file_ = {check(library_.H5Fcreate(path_.c_str(), kHdf5Truncate, H5P_DEFAULT, access), "make a file"),
           library_.H5Fclose};
}

hid_t Hdf5Writer::check(hid_t status, std::string_view doing) const {
  if (status < 0) fail(ErrorCode::not_writable, path_, "HDF5 cannot ", doing);
  return status;
}

Hdf5Id Hdf5Writer::group(const Hdf5Id& in, const std::string& name) const {
  return {check(library_.H5Gcreate2(in, name.c_str(), utf8_, ordered_, H5P_DEFAULT), text("make the group ", name)),
          library_.H5Oclose};
}

void Hdf5Writer::attribute(const Hdf5Id& of, const char* name, const std::vector<std::int64_t>& values) const {
  const std::string doing = text("write the attribute ", name);
  const hsize_t n = values.size();
  const Hdf5Id space = {check(library_.H5Screate_simple(1, &n, nullptr), doing), library_.H5Sclose};
  const hid_t type = hdf5_type(library_, Scalar::i64);
  const Hdf5Id made = {check(library_.H5Acreate2(of, name, type, space, H5P_DEFAULT, H5P_DEFAULT), doing),
                       library_.H5Aclose};
  check(library_.H5Awrite(made, type, values.data()), doing);
}

void Hdf5Writer::attribute(const Hdf5Id& of, const char* name, std::string_view value) const {
  const std::string doing = text("write the attribute ", name), bytes(value);
  const Hdf5Id space = {check(library_.H5Screate(H5S_SCALAR), doing), library_.H5Sclose};
  const Hdf5Id type = {check(library_.H5Tcopy(library_.H5T_C_S1_g), doing), library_.H5Tclose};
  check(library_.H5Tset_size(type, std::max<std::size_t>(bytes.size(), 1)), doing);
  const Hdf5Id made = {check(library_.H5Acreate2(of, name, type, space, H5P_DEFAULT, H5P_DEFAULT), doing),
                       library_.H5Aclose};
  check(library_.H5Awrite(made, type, bytes.c_str()), doing);
}

Hdf5Id Hdf5Writer::dataset(const Hdf5Id& in, const std::string& name, VtkArray array) {
  const std::string doing = text("make the dataset ", in_quotes(name));
  const auto columns = static_cast<hsize_t>(array.components);
  const std::array<hsize_t, 2> sizes = {array.n_values / columns, columns};
  const Hdf5Id space = {check(library_.H5Screate_simple(columns > 1 ? 2 : 1, sizes.data(), nullptr), doing),
                        library_.H5Sclose};
  Hdf5Id made = {check(library_.H5Dcreate2(in, name.c_str(), hdf5_type(library_, array.scalar), space, utf8_,
                                           without_numbers_, H5P_DEFAULT),
                       doing),
                 library_.H5Oclose};
  if (array.n_values == 0) return made;
  const haddr_t offset = library_.H5Dget_offset(made);
  if (offset == HADDR_UNDEF) check(-1, text("make room for the dataset ", in_quotes(name)));
  waiting_.push_back({offset, std::move(array)});
  return made;
}

void Hdf5Writer::put_layout(Output& out, std::uint64_t from, std::uint64_t to) const {
  constexpr std::array<char, 4096> kZeros = {};
  while (from < to) {
    const bool inside = from < image_.size;
    const std::uint64_t end = inside ? std::min<std::uint64_t>(to, image_.size) : std::min(to, from + kZeros.size());
    out.put(std::string_view(inside ? image_.bytes.get() + from : kZeros.data(), static_cast<std::size_t>(end - from)));
    from = end;
  }
}

void Hdf5Writer::finish(Output& out) {
  hsize_t size = 0;
  check(library_.H5Fget_filesize(file_, &size), "finish the file");
  check(file_.close(), "finish the file");
  std::sort(waiting_.begin(), waiting_.end(), [](const Waiting& a, const Waiting& b) { return a.offset < b.offset; });
  std::uint64_t at = 0;
  std::vector<char> buffer(kVtkBlockBytes);
  for (const auto& [offset, array] : waiting_) {
    put_layout(out, at, offset);
    const std::size_t each = info(array.scalar).bytes, block = kVtkBlockBytes / each;
    for (std::size_t first = 0; first < array.n_values; first += block) {
      const std::size_t n = std::min(block, array.n_values - first);
      array.fill(first, n, buffer.data());
      out.put(std::string_view(buffer.data(), n * each));
    }
    at = offset + array.bytes();
  }
  put_layout(out, at, size);
}

}  // namespace temper::io
