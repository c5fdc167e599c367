#include "temper/detail/build_info.hpp"

#include <coin/Clp_C_Interface.h>
#include <zlib.h>

#include <pugixml.hpp>
#ifdef TEMPER_WITH_TBB
#include <tbb/info.h>
#include <tbb/version.h>
#endif

#include <span>
#include <thread>

#include "build_info/commit.hpp"
#include "temper/detail/instruction_set.hpp"
#include "temper/detail/version.hpp"
#include "temper/io.hpp"

namespace temper {
namespace {

std::string set_names(std::span<const InstructionSet> sets) {
  std::string names;
  for (const InstructionSet set : sets) names += (names.empty() ? "" : ", ") + std::string(name(set));
  return names;
}

std::string instruction_sets_text() {
  return std::string(name(instruction_set())) + " in use; compiled in: " + set_names(compiled_instruction_sets());
}

std::string threads_text() {
  const std::string machine = std::to_string(std::thread::hardware_concurrency()) + " of the machine";
#ifdef TEMPER_WITH_TBB
  return machine + ", " + std::to_string(tbb::info::default_concurrency()) + " in the pool";
#else
  return machine + ", 1 in use: built without oneTBB, whatever --threads says";
#endif
}

/// Of 1130: 1.13.
std::string pugixml_version() {
  return std::to_string(PUGIXML_VERSION / 1000) + "." + std::to_string(PUGIXML_VERSION % 1000 / 10);
}

std::string tbb_version() {
#ifdef TEMPER_WITH_TBB
  return TBB_runtime_version();
#else
  return "none";
#endif
}

std::string eigen_version() {
#ifdef TEMPER_WITH_ERRORS
  return TEMPER_EIGEN_VERSION;
#else
  return "none, so there is no verb errors";
#endif
}

std::string netcdf_text() {
#ifdef TEMPER_WITH_NETCDF
  const std::string version = io::netcdf_version();
  return version.empty() ? "not found, so MPAS and UGRID are neither read nor written" : version;
#else
  return "none, so MPAS and UGRID are neither read nor written";
#endif
}

std::string hdf5_text() {
#ifdef TEMPER_WITH_HDF5
  const std::string version = io::hdf5_version();
  return version.empty() ? "not found, so VTKHDF is neither read nor written" : version;
#else
  return "none, so VTKHDF is neither read nor written";
#endif
}

std::string gdal_text() {
  const std::string version = io::gdal_version();
  return version.empty() ? "not found, so GeoTIFF, shapefiles and GeoPackages are not read" : version;
}

}  // namespace

std::vector<BuildFact> build_info() {
  return {
      {"version", std::string(version())},
      {"commit", std::string(commit())},
      {"compiler", TEMPER_COMPILER},
      {"processor", TEMPER_PROCESSOR},
      {"instructions", instruction_sets_text()},
      {"threads", threads_text()},
      {"oneTBB", tbb_version()},
      {"NetCDF", netcdf_text()},
      {"HDF5", hdf5_text()},
      {"GDAL", gdal_text()},
      {"zlib", zlibVersion()},
      {"pugixml", pugixml_version()},
      {"Clp", Clp_Version()},
      {"Eigen", eigen_version()},
  };
}

}  // namespace temper
