#!/usr/bin/env bash
# Installs what building and testing need on Debian 12 or Ubuntu 24.04; only what is missing, quietly. Several groups may be named.
#
#   scripts/bootstrap.sh          the groups build, test and lint
#   scripts/bootstrap.sh build    what the library and the program need
#   scripts/bootstrap.sh test     what the tests need in addition
#   scripts/bootstrap.sh lint     what scripts/lint.sh needs in addition; scripts/test.sh runs that
#   scripts/bootstrap.sh clients  what scripts/clients.sh needs
#   scripts/bootstrap.sh fortran  what builds MODFLOW 6 in scripts/clients.sh
#   scripts/bootstrap.sh desktop  QGIS and ParaView, for scripts/clients.sh
#   scripts/bootstrap.sh docs     what scripts/docs.sh needs
#   scripts/bootstrap.sh wasm     what the preset wasm needs besides build, and what builds web/
#   scripts/bootstrap.sh cross    what scripts/cross.sh and scripts/wheels.sh need besides build
#   scripts/bootstrap.sh debian   what builds and tests Debian packages
#   scripts/bootstrap.sh native   what scripts/native.sh needs besides build
#   scripts/bootstrap.sh browser  what tests of pages need
#   scripts/bootstrap.sh windows  what scripts/windows.sh needs besides build and test
set -euo pipefail

build=(g++ cmake ninja-build pkg-config libcli11-dev libfmt-dev nlohmann-json3-dev libpugixml-dev zlib1g-dev libnetcdf-dev
       libhdf5-dev
       coinor-libclp-dev libtbb-dev libeigen3-dev
       pybind11-dev python3-dev python3-numpy python3-pip)
test=(ccache libgtest-dev libcgal-dev libgmp-dev libmpfr-dev python3 python3-h5py python3-meshio python3-scipy python3-matplotlib
      python3-pytest python3-jsonschema zsh fish mandoc groff-base gmsh librsvg2-bin clang-format-14 clang-tidy-14 clang-19 lld-19
      libclang-rt-19-dev libopenmpi-dev openmpi-bin python3-mpi4py)
lint=(python3-venv shellcheck ruby zip unzip)
clients=(python3-venv liblapack3 libblas3 libglu1-mesa libgl1 libegl1 libxcursor1 libxft2 libxinerama1 libxrender1)
fortran=(gfortran)
desktop=(qgis python3-qgis paraview python3-paraview xvfb xauth libgl1-mesa-dri)
docs=(python3-venv doxygen python3-meshio python3-scipy python3-matplotlib)
wasm=(clang-19 lld-19 llvm-19 wasi-libc libc++-19-dev-wasm32 libc++abi-19-dev-wasm32 libclang-rt-19-dev-wasm32)
# A Node that does not come from Debian has its own npm.
command -v npm >/dev/null || wasm+=(nodejs npm)
cross=(googletest python3-venv python3-pip mmdebstrap qemu-user libc6-arm64-cross file unzip curl ca-certificates)
debian=(git file dpkg-dev debootstrap)
native=(libgtest-dev)
browser=(chromium)
windows=(g++-mingw-w64-x86-64-posix wine wine64 googletest zip unzip curl ca-certificates)

wanted=()
for group in "${@:-all}"; do
  case "$group" in
    build) wanted+=("${build[@]}") ;;
    test) wanted+=("${test[@]}") ;;
    lint) wanted+=("${lint[@]}") ;;
    clients) wanted+=("${clients[@]}") ;;
    fortran) wanted+=("${fortran[@]}") ;;
    desktop) wanted+=("${desktop[@]}") ;;
    docs) wanted+=("${docs[@]}") ;;
    wasm) wanted+=("${wasm[@]}") ;;
    cross) wanted+=("${cross[@]}") ;;
    debian) wanted+=("${debian[@]}") ;;
    native) wanted+=("${native[@]}") ;;
    browser) wanted+=("${browser[@]}") ;;
    windows) wanted+=("${windows[@]}") ;;
    all) wanted+=("${build[@]}" "${test[@]}" "${lint[@]}") ;;
    *) echo "bootstrap: no group '$group'; there are build, test, lint, clients, fortran, desktop, docs, wasm, cross, debian, native, browser, windows and all" >&2; exit 2 ;;
  esac
done

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "bootstrap: no apt here; install by hand what these Debian packages hold: ${wanted[*]}" >&2
  exit 0  # the build itself says what is really missing
fi

missing=()
for package in "${wanted[@]}"; do
  status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ "$status" == installed ]] || missing+=("$package")
done
((${#missing[@]})) || exit 0

as_root=()
if ((EUID != 0)); then as_root=(sudo); fi
echo "bootstrap: installing ${missing[*]}"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! { "${as_root[@]}" apt-get update -qq &&
       "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
         apt-get install -y -qq --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
  tail -n 20 "$log" >&2
  echo "bootstrap: apt-get failed" >&2
  exit 1
fi
