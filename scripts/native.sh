#!/usr/bin/env bash
# Builds the program and the tests with the compiler of this system, and runs the unit tests and the golden bytes: Apple's clang
# on macOS, MSVC on Windows (in Git's bash), g++ on Linux. Workflows call it on systems that scripts/test.sh does not know.
#
# Homebrew, vcpkg (VCPKG_INSTALLATION_ROOT) or apt-get brings the libraries.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

build=build/native configuration=Release arguments=()
case "$(uname -s)" in
  Darwin)
    brew install --quiet cmake ninja pkgconf cli11 fmt nlohmann-json pugixml eigen tbb clp netcdf hdf5 googletest
    ;;
  MINGW* | MSYS*)
    vcpkg=${VCPKG_INSTALLATION_ROOT:?folder of vcpkg}
    "$vcpkg/vcpkg" install --triplet x64-windows cli11 fmt nlohmann-json pugixml zlib eigen3 tbb coin-or-clp gtest
    arguments=(-G "Visual Studio 17 2022" -A x64 -DCMAKE_TOOLCHAIN_FILE="$vcpkg/scripts/buildsystems/vcpkg.cmake")
    ;;
  *)
    scripts/bootstrap.sh build test
    ;;
esac

cmake --preset release "${arguments[@]}" -B "$build" -DTEMPER_BUILD_TESTS=ON
cmake --build "$build" --config "$configuration" --parallel
ctest --test-dir "$build" -C "$configuration" -R '^(unit_|golden)' --no-tests=error --output-on-failure
