#!/usr/bin/env bash
# Makes the wheels: one for each platform and each version of Python.
#
#   scripts/wheels.sh [--output DIR] [--platform PLATFORM]… [VERSION ...]     default: packages/, all, 3.10 to 3.14
#
# linux_x86_64, linux_aarch64: by `zig c++`, with glibc 2.28 (2018). auditwheel tags them for the oldest glibc that is enough.
# win_amd64: by MinGW-w64's g++.
#
# All libraries are inside a wheel, except those that temper loads when a file needs them. scripts/python.sh brings each
# version of Python. These interpreters run only on x86-64, and their headers also fit aarch64.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
glibc=2.28

output=$PWD/packages platforms=() versions=()
while (($#)); do
  case "$1 ${2:-}" in
    "--output "?*) output=$(realpath -m "$2"); shift ;;
    "--platform linux_x86_64" | "--platform linux_aarch64" | "--platform win_amd64") platforms+=("$2"); shift ;;
    "3.1"[0-4]" "*) versions+=("$1") ;;
    *) echo "wheels: expected --output DIR, --platform linux_x86_64|linux_aarch64|win_amd64 or a version of Python from 3.10 to 3.14, found '$*'" >&2; exit 2 ;;
  esac
  shift
done
((${#platforms[@]})) || platforms=(linux_x86_64 linux_aarch64 win_amd64)
((${#versions[@]})) || versions=(3.10 3.11 3.12 3.13 3.14)

scripts/bootstrap.sh build cross windows
work=$PWD/build/wheels stub=$PWD/build/wheels/linux_x86_64/python/temper/_options.pyi
mkdir -p "$output" "$work"
if command -v ccache >/dev/null; then export CMAKE_CXX_COMPILER_LAUNCHER=ccache CMAKE_C_COMPILER_LAUNCHER=ccache; fi
export CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}

source scripts/tools.sh
tools=$(tool_python wheels)
tools=${tools%/*}

make_wheel() {  # VERSION PLATFORM
  local environment=$work/env-$1 tag=cp${1/./} raw=$work/raw python suffix arguments
  python=$(scripts/python.sh "$1")
  "$python/bin/python$1" -m venv --clear --without-pip "$environment"
  "$tools/pip" --python "$environment/bin/python" install -q scikit-build-core==0.11.6 pybind11==3.0.1
  case $2 in
    linux_*)
      suffix=.cpython-${1/./}-${2#linux_}-linux-gnu.so
      arguments=(-DCMAKE_TOOLCHAIN_FILE="$PWD/cmake/cross/zig.cmake" -DTEMPER_ZIG_TARGET="${2#linux_}-linux-gnu.$glibc") ;;
    win_amd64)
      suffix=.$tag-$2.pyd
      python=$(scripts/python.sh "$1" windows)
      arguments=(-DCMAKE_TOOLCHAIN_FILE="$PWD/cmake/cross/x86_64-w64-mingw32.cmake" -DPython_INCLUDE_DIR="$python/include"
                 -DPython_LIBRARY="$python/libs/python${1/./}.lib") ;;
  esac
  if [[ $2 != linux_x86_64 ]]; then
    # A module for another platform cannot run here, so it takes the stub of the options from a wheel for linux_x86_64.
    if [[ ! -f $stub ]]; then
      mkdir -p "$work/for-stub"
      output=$work/for-stub make_wheel "$1" linux_x86_64
    fi
    arguments+=(-DTEMPER_OPTIONS_STUB="$stub")
  fi
  rm -rf "$raw"
  _PYTHON_HOST_PLATFORM=$2 SETUPTOOLS_EXT_SUFFIX=$suffix \
    CMAKE_ARGS="$(printf '%q ' "${arguments[@]}") -DTEMPER_CROSS_LIBRARIES=ON -DTEMPER_SOURCES=$PWD/build/archives -DPYTHON_MODULE_EXTENSION=$suffix
                -DPYTHON_MODULE_DEBUG_POSTFIX= -Dpybind11_DIR=$("$environment/bin/python" -m pybind11 --cmakedir)" \
    "$tools/pip" --python "$environment/bin/python" wheel -q --no-deps --no-build-isolation --wheel-dir "$raw" \
    --config-settings build-dir="$work/$2" "$source"
  if [[ $2 == win_amd64 ]]; then
    cp "$raw"/*-"$tag-$tag-$2.whl" "$output"
  else
    PATH=$tools:$PATH "$tools/auditwheel" repair -w "$output" --plat auto "$raw"/*-"$tag-$tag"-*.whl
  fi
}

# From the source distribution, as pip would. Its tool looks into all folders, so it gets what git knows alone.
source=$work/source
rm -rf "$source" "$work/tree" "$stub"
mkdir -p "$source" "$work/tree"
git ls-files -z --cached --others --exclude-standard | tar --null -T - -c | tar -x -C "$work/tree"
"$tools/python" -m build --sdist --outdir "$output" "$work/tree" >/dev/null
tar -xzf "$output/temper_mesh-$(scripts/version.py).tar.gz" -C "$source" --strip-components=1

for version in "${versions[@]}"; do
  for platform in "${platforms[@]}"; do make_wheel "$version" "$platform"; done
done
ls -l "$output"/*.whl
