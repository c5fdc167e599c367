#include "io/npz.hpp"

#include <bit>

namespace temper::io {
namespace {

/// Magic, version, length and the dictionary, padded so that the numbers start at a multiple of 64 bytes.
std::string npy_header(char kind, std::size_t bytes_each, const std::vector<std::size_t>& shape) {
  const char order = bytes_each == 1 || kind == 'S' ? '|' : std::endian::native == std::endian::little ? '<' : '>';
  std::string sizes;
  for (const std::size_t n : shape) sizes += text(n, ", ");
  if (shape.size() > 1) sizes.resize(sizes.size() - 2);  // (3, 2), but (3, )
  std::string dictionary = text("{'descr': '", std::string_view(&order, 1), std::string_view(&kind, 1), bytes_each,
                                "', 'fortran_order': False, 'shape': (", sizes, "), }");
  constexpr std::size_t kStart = 10, kAlign = 64;
  while ((kStart + dictionary.size() + 1) % kAlign != 0) dictionary += ' ';
  dictionary += '\n';
  std::string header = "\x93NUMPY";
  header += '\x01';
  header += '\x00';
  header += static_cast<char>(dictionary.size() & 0xff);
  header += static_cast<char>(dictionary.size() >> 8);
  return header + dictionary;
}

}  // namespace

void NpzWriter::add_bytes(std::string_view name, char kind, std::size_t bytes_each, std::string_view bytes,
                          const std::vector<std::size_t>& shape) {
  const std::string header = npy_header(kind, bytes_each, shape);
  zip_.add(text(name, ".npy"), {header, bytes});
}

}  // namespace temper::io
