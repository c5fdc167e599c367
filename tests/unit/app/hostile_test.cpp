// Files of HDF5 are read in a child process first: what libhdf5 does there never happens to the program.
#include <algorithm>
#include <random>

#include "support/sanitizers.hpp"
#include "temper/io.hpp"
#include "workshop.hpp"

#if TEMPER_NETCDF
#include <netcdf.h>
#endif

namespace temper::test {
namespace {

class Hostile : public Workshop {
 protected:
  /// A mesh or an error comes of each of n damaged copies; of some an error.
  static void survive(const std::string& name, int n) {
    const std::string whole = read(name);
    std::mt19937 random(5);  // NOLINT: the same damage on every run
    int errors = 0;
    for (int i = 0; i < n; ++i) {
      std::string bytes = whole;
      for (int k = 0; k < 3; ++k) {
        // Zeros between the parts are of no interest. The first eight bytes say that it is HDF5.
        std::size_t at = 8 + random() % (bytes.size() - 8);
        while (at < 8 || bytes[at] == 0) at = (at + 1) % bytes.size();
        bytes[at] = static_cast<char>(random());
      }
      write(name, bytes);
      const Outcome outcome = temper({"check", name});
      ASSERT_TRUE(outcome.exit == 0 || outcome.exit == 1) << i << ": " << outcome.exit << outcome.err;
      errors += outcome.exit;
      EXPECT_EQ(outcome.exit == 0, !contains(outcome.err, "temper: error: ")) << outcome.err;
    }
    EXPECT_GT(errors, n / 10);
  }
};

TEST_F(Hostile, DamagedVtkhdfGivesAMeshOrAnError) {
  if (io::hdf5_version().empty()) GTEST_SKIP() << "no libhdf5";
  make_input();
  temper_ok({"convert", "in.vtu", "-o", "m.vtkhdf"});
  survive("m.vtkhdf", 60);
}

#if TEMPER_NETCDF
TEST_F(Hostile, DamagedNetcdf4GivesAMeshOrAnError) {
  // The least MPAS file.
  int id = -1, cells = -1, vertices = -1, degree = -1, x = -1, y = -1, corners = -1;
  ASSERT_EQ(nc_create("m.nc", NC_CLOBBER | NC_NETCDF4, &id), NC_NOERR);
  nc_def_dim(id, "nCells", 3, &cells), nc_def_dim(id, "nVertices", 1, &vertices),
      nc_def_dim(id, "vertexDegree", 3, &degree);
  const int table[] = {vertices, degree};
  nc_def_var(id, "xCell", NC_DOUBLE, 1, &cells, &x), nc_def_var(id, "yCell", NC_DOUBLE, 1, &cells, &y);
  nc_def_var(id, "cellsOnVertex", NC_INT, 2, table, &corners);
  const double xs[] = {0, 1, 0}, ys[] = {0, 0, 1};
  const int numbers[] = {1, 2, 3};
  nc_put_var(id, x, xs), nc_put_var(id, y, ys), nc_put_var(id, corners, numbers);
  ASSERT_EQ(nc_close(id), NC_NOERR);
  EXPECT_TRUE(contains(temper_ok({"check", "m.nc"}).out, "m.nc"));
  survive("m.nc", 60);
}

TEST_F(Hostile, AFileThatLibhdf5NeverReturnsFromIsRefused) {
  const std::string file = TEMPER_SHARED "/hostile/hdf5_hang.ugrid.nc";
  if (!exists(file)) GTEST_SKIP() << "no " << file;
  const Outcome outcome = temper({"check", file});
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_TRUE(contains(outcome.err, "hdf5_hang.ugrid.nc: ")) << outcome.err;
}
#endif

// The library is one that crashes, or loops for ever, when it is loaded.
TEST_F(Hostile, TheEndOfTheChildIsAnError) {
  if (io::hdf5_version().empty()) GTEST_SKIP() << "no libhdf5";
  write("m.vtkhdf", "\x89HDF\r\n\x1a\nVTKHDF");
  const auto check = [](const std::string& does) {
    const Outcome outcome = shell("BAD_LIBRARY=" + does + " TEMPER_HDF5=" TEMPER_BAD_LIBRARY " temper check m.vtkhdf");
    EXPECT_EQ(outcome.exit, 1) << does;
    return outcome.err;
  };
  EXPECT_EQ(check("crash"), "temper: error: m.vtkhdf: libhdf5 crashes: the file is damaged\n");
  EXPECT_TRUE(contains(check("loop"), "temper: error: m.vtkhdf: libhdf5 does not finish within 3 s: "));
  EXPECT_TRUE(contains(check("nothing"), "temper: error: m.vtkhdf: VTKHDF files need libhdf5"));
}

TEST_F(Hostile, WhatComesThroughAPipeIsReadAtOnce) {
  if (io::hdf5_version().empty()) GTEST_SKIP() << "no libhdf5";
  make_input();
  temper_ok({"convert", "in.vtu", "-o", "m.vtkhdf"});
  EXPECT_EQ(shell("cat m.vtkhdf | temper check -").exit, 0);
}

}  // namespace
}  // namespace temper::test
