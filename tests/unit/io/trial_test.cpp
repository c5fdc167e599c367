// The child process in which a foreign library tries a file: what happens to it never happens to the parent.
#include "io/trial.hpp"

#include <atomic>
#include <csignal>
#include <functional>
#include <thread>

#include "io/failure.hpp"
#include "support.hpp"
#include "support/sanitizers.hpp"

#if TEMPER_NETCDF
#include <netcdf.h>
#endif

namespace temper::io {
namespace {

using Work = std::function<void()>;

/// The error that the trial ends with; nothing when there is none.
std::string error_of(const Work& work, TrialBudget budget = {1, std::uint64_t{1} << 29}) {
  try {
    try_in_child(budget, {"m.nc", "lib", "is too long"}, work);
    return "";
  } catch (const Failure& failure) {
    return failure.error.what();
  }
}

TEST(Trial, WorkThatEndsIsDoneAndLeavesNoTraceHere) {
  int here = 0;
  EXPECT_EQ(error_of([&] { here = 1; }), "");
  EXPECT_EQ(here, 0);
}

TEST(Trial, AFailureInTheChildIsTheFailureHere) {
  const std::string longer(100000, 'x');  // than a pipe holds
  EXPECT_EQ(error_of([&] { fail(ErrorCode::truncated, "m.nc:7", longer); }), "m.nc:7: " + longer);
  try {
    try_in_child({1, 1 << 29}, {"m.nc", "lib", "is too long"}, [] { fail(ErrorCode::size_mismatch, "", "too few"); });
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.error.code, ErrorCode::size_mismatch);
    EXPECT_EQ(failure.error.where, "");
  }
}

TEST(Trial, WorkWithoutEndIsEnded) {
  const std::string error = error_of([] {
    for (std::atomic<int> i = 0;; ++i) {
    }
  });
  EXPECT_EQ(error, "m.nc: lib does not get to its end within 1 s: the file is damaged, or is too long");
}

TEST(Trial, WorkThatDiesIsTold) {
  for (const int signal : {SIGSEGV, SIGABRT, SIGFPE}) {
    const std::string error = error_of([&] {
      std::signal(signal, SIG_DFL);
      std::raise(signal);
    });
    EXPECT_EQ(error, "m.nc: lib dies of it: the file is damaged") << signal;
  }
}

#if !TEMPER_SANITIZED  // AddressSanitizer ends the process itself where there is no memory
TEST(Trial, WorkThatWantsAllMemoryIsStopped) {
  const std::string error = error_of([] {
    std::vector<std::vector<char>> all;
    for (;;) all.emplace_back(std::size_t{1} << 26, 'x');
  });
  EXPECT_EQ(error, "m.nc: lib needs too much memory for it");
}
#endif

TEST(Trial, ThreadsOfTheParentThatAllocateDoNotDisturbIt) {
  std::atomic<bool> stop = false;
  std::thread busy([&] {
    while (!stop) static_cast<void>(std::string(1000, 'x'));
  });
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(error_of([] { static_cast<void>(std::string(100000, 'y')); }), "");
  }
  stop = true;
  busy.join();
}

#if TEMPER_NETCDF
/// The least MPAS file, in NetCDF-4.
void make_netcdf4(const std::string& path) {
  int id = -1, cells = -1, vertices = -1, degree = -1, x = -1, y = -1, corners = -1;
  ASSERT_EQ(nc_create(path.c_str(), NC_CLOBBER | NC_NETCDF4, &id), NC_NOERR);
  nc_def_dim(id, "nCells", 3, &cells), nc_def_dim(id, "nVertices", 1, &vertices),
      nc_def_dim(id, "vertexDegree", 3, &degree);
  const int table[] = {vertices, degree};
  nc_def_var(id, "xCell", NC_DOUBLE, 1, &cells, &x), nc_def_var(id, "yCell", NC_DOUBLE, 1, &cells, &y);
  nc_def_var(id, "cellsOnVertex", NC_INT, 2, table, &corners);
  const double xs[] = {0, 1, 0}, ys[] = {0, 0, 1};
  const int numbers[] = {1, 2, 3};
  nc_put_var(id, x, xs), nc_put_var(id, y, ys), nc_put_var(id, corners, numbers);
  ASSERT_EQ(nc_close(id), NC_NOERR);
}

using Netcdf4 = FileTest;

TEST_F(Netcdf4, IsReadAsClassicFilesAre) {
  make_netcdf4(path("m.nc"));
  const auto f = read(path("m.nc"));
  ASSERT_TRUE(f) << f.error().what();
  EXPECT_EQ(f->format, "mpas");
  EXPECT_EQ(f->points.size(), 3u);
  EXPECT_EQ(f->triangles.size(), 1u);
}

TEST_F(Netcdf4, DamagedAnywhereGivesAMeshOrAnError) {
  make_netcdf4(path("m.nc"));
  const std::string whole = slurp(path("m.nc"));
  int errors = 0;
  for (std::size_t at = 8; at < whole.size(); at += whole.size() / 60) {
    std::string bytes = whole;
    for (std::size_t i = at; i < std::min(at + 4, bytes.size()); ++i) bytes[i] = static_cast<char>(~bytes[i]);
    const auto f = read(make("d.nc", bytes));
    if (f) continue;
    ++errors;
    EXPECT_FALSE(f.error().message.empty());
  }
  EXPECT_GT(errors, 5);
}

TEST_F(Netcdf4, OnWhichLibhdf5NeverReturnsIsRefused) {
  const std::string file = TEMPER_SHARED "/hostile/hdf5_hang.ugrid.nc";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  const auto f = read(file);
  ASSERT_FALSE(f);
  EXPECT_EQ(f.error().code, ErrorCode::syntax);
}
#endif

}  // namespace
}  // namespace temper::io
