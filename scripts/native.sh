#!/usr/bin/env bash
# Builds the program and the tests with the compiler of this system, and runs the unit tests and the golden bytes: Apple's clang
# on macOS, Visual Studio's clang-cl on Windows (in Git's bash), g++ on Linux. Workflows call it on systems that scripts/test.sh
# does not know.
#
# Homebrew, vcpkg (VCPKG_INSTALLATION_ROOT) or apt-get brings the libraries.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

build=build/native
case "$(uname -s)" in
  Darwin)
    brew install --quiet cmake ninja pkgconf cli11 fmt nlohmann-json pugixml eigen tbb clp netcdf hdf5 googletest
    arguments=(-G Ninja)
    ;;
  MINGW* | MSYS*)
    vcpkg=${VCPKG_INSTALLATION_ROOT:?folder of vcpkg}
    "$vcpkg/vcpkg" install --triplet x64-windows cli11 fmt nlohmann-json pugixml zlib eigen3 tbb coin-or-clp gtest
    arguments=(-T ClangCL -DCMAKE_TOOLCHAIN_FILE="$vcpkg/scripts/buildsystems/vcpkg.cmake")
    ;;
  *)
    scripts/bootstrap.sh build native
    arguments=(-G Ninja)
    ;;
esac

# On Windows the generator is that of the newest Visual Studio.
cmake -B "$build" "${arguments[@]}" -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON -DTEMPER_BUILD_TESTS=ON
cmake --build "$build" --config Release --parallel
ctest --test-dir "$build" -C Release -R '^(unit_|golden)' --no-tests=error --output-on-failure
