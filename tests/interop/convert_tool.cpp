// convert_tool IN OUT FORMAT ENCODING: io::read and io::write, nothing else.
#include <cstdio>
#include <string_view>

#include "temper/io.hpp"

int main(int argc, char** argv) {
  using namespace temper::io;
  if (argc != 5) return 2;
  const auto file = read(argv[1]);
  if (!file) {
    std::fprintf(stderr, "%s\n", file.error().what().c_str());
    return 1;
  }
  const std::string_view encoding = argv[4];
  WriteOptions options{argv[3], encoding == "ascii"      ? Encoding::ascii
                                : encoding == "appended" ? Encoding::appended
                                                         : Encoding::base64};
  const auto warnings = write(argv[2], *file, options);
  if (!warnings) {
    std::fprintf(stderr, "%s\n", warnings.error().what().c_str());
    return 1;
  }
  return 0;
}
