#include "io/format.hpp"
namespace temper::io {
void write_gmsh22(const WriteJob&) {}
void write_gmsh41(const WriteJob&) {}
}  // namespace temper::io
