// A program as users of mesh files write it: it reads the file named on the command line with the installed library.
#include "temper/io.hpp"

#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const auto file = temper::io::read(argv[1]);
  if (!file) {
    std::printf("%s\n", file.error().what().c_str());
    return 1;
  }
  const auto loaded = temper::io::make_mesh(*file);
  std::printf("%s\n", loaded ? "read" : loaded.error().what().c_str());
  return loaded && loaded->mesh.n_triangles() == 1 ? 0 : 1;
}
