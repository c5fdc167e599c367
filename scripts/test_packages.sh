#!/usr/bin/env bash
# Installs each package that scripts/package.sh or scripts/release.sh has made in a clean environment, and tries it. Prints a table
# of sizes and seconds.
#
#   scripts/test_packages.sh [--only KIND] [DIR]      default: all kinds, packages/
#
# sums:    SHA256SUMS has each file; the bill of materials names each; recipes have the checksums; twine and npm accept their files
# wheel:   each one for x86-64, in a new virtual environment without a compiler
# aarch64: the wheel of Python 3.11 for aarch64, under qemu-user
# source:  the archive, built with shared libraries into a prefix of its own, used by pkg-config and CMake, uninstalled
# debian:  in a new root folder (debootstrap)
# npm:     in a new folder, in Node
# windows: unpacked into a new folder, under Wine
# windows_wheel: those for Python 3.10 to 3.12, which Wine can run
#
# Needs root, for chroot. TEMPER_CHROOT: a folder for the root folders, default a temporary one; the bare system that
# debootstrap makes there is used again, a copy for each run.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source_folder=$PWD
kinds=(sums wheel aarch64 windows_wheel source debian npm windows)
if [[ "${1:-}" == --only ]]; then
  [[ "${2:-}" != *" "* && " ${kinds[*]} " == *" ${2:-} "* ]] || { echo "test_packages: --only: expected one of ${kinds[*]}, found '${2:-}'" >&2; exit 2; }
  kinds=("$2")
  shift 2
fi
[[ -d "${1:-packages}" ]] || { echo "test_packages: ${1:-packages} is no folder; scripts/package.sh fills it" >&2; exit 1; }
packages=$(realpath "${1:-packages}")
launcher=()
if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
scratch=$(mktemp -d)
export WINEPREFIX=$scratch/wine
source scripts/wine.sh
source scripts/tools.sh
export LC_ALL=C.UTF-8
trap 'stop_wine; rm -rf "$scratch"' EXIT
rows=()
row() { rows+=("$(printf '%-58s %12s' "$1" "$2")"); }
# timed WHAT COMMAND …: its seconds become a row.
timed() {
  local what=$1 start=$EPOCHREALTIME
  shift
  "$@" >"$scratch/log" 2>&1 || { cat "$scratch/log" >&2; echo "test_packages: $what failed" >&2; exit 1; }
  row "$what" "$(awk "BEGIN {printf \"%.2f s\", $EPOCHREALTIME - $start}")"
}
size() { row "$1" "$(awk "BEGIN {printf \"%.0f kB\", $(stat -c %s "$2") / 1000}")"; }
must() { "$@" || { echo "test_packages: not so: $*" >&2; exit 1; }; }

# The first commands of the README, and their input.
readme_into() {  # FOLDER
  mkdir -p "$1/examples"
  scripts/readme.sh 1 >"$1/readme.sh"
  cp examples/aquifer.geojson "$1/examples"
}

# Each wheel for x86-64, in a virtual environment of its own. Its programs find no compiler, and pip builds nothing.
try_wheel() {
  local wheel version python pip found=0
  scripts/bootstrap.sh cross
  pip=$(tool_python wheels)
  pip=${pip%/*}/pip
  size "source distribution" "$(ls "$packages"/temper_mesh-*.tar.gz)"
  mkdir "$scratch/programs"
  for program in sh tail ldconfig find grep du awk; do ln -s "$(command -v $program)" "$scratch/programs"; done
  for wheel in "$packages"/temper_mesh-*manylinux*_x86_64.whl; do
    [[ -e $wheel ]] || continue
    version=$(sed -E 's/.*-cp3([0-9]+)-.*/3.\1/' <<<"$wheel")
    found=$((found + 1))
    python=$(scripts/python.sh "$version")
    try_one_wheel "$wheel" "$python/bin/python$version" "$version"
  done
  ((found > 0)) || { echo "test_packages: $packages has no such wheel" >&2; exit 1; }
}

try_one_wheel() {  # WHEEL INTERPRETER VERSION
  local venv=$scratch/venv-$3 here=$scratch/wheel-$3
  readme_into "$here"
  "$2" -m venv --without-pip "$venv"
  size "Python $3: $(basename "$1")" "$1"
  cd "$here"
  alone() { env -i HOME="$here" LC_ALL=C.UTF-8 PATH="$venv/bin:$scratch/programs" "$@"; }
  install() { "$pip" --python "$venv/bin/python" install -q --only-binary :all: "$@"; }
  timed "Python $3: pip install, with NumPy" install "$1"
  row "Python $3: installed, without NumPy" "$(du -sk "$venv"/lib/python3*/site-packages/temper | awk '{print $1 " kB"}')"
  alone "$venv/bin/python" "$source_folder/scripts/try_installed.py" >/dev/null  # a first time, for the byte code
  timed "Python $3: a mesh, by module and program" alone "$venv/bin/python" "$source_folder/scripts/try_installed.py"
  row "Python $3: import temper, without Python's start and NumPy" "$(cat "$scratch/log")"
  timed "Python $3: README's first commands" alone sh -e readme.sh
  # Without libnetcdf an error that says what to install; with pip's netCDF4 it works.
  if ! grep -q libnetcdf <(ldconfig -p); then
    must grep -q 'pip: netCDF4' <(alone temper convert ring.vtu -o ring.ugrid.nc 2>&1)
  fi
  must grep -q 'needs\? libnetcdf' <(TEMPER_NETCDF=/nowhere "$venv/bin/temper" convert ring.vtu -o ring.ugrid.nc 2>&1)
  must grep -q 'NetCDF *not found' <(TEMPER_NETCDF=/nowhere "$venv/bin/temper" --version)
  must test -z "$(find "$venv"/lib/python3*/site-packages/temper* -name '*netcdf*.so*')"
  "$pip" --python "$venv/bin/python" uninstall -q -y temper-mesh
  must test -z "$(find "$venv" -name '*temper*' -not -path '*/pip/*')"
  cd "$source_folder"
}

# The wheel for aarch64, by Debian's Python for aarch64 under qemu-user. NumPy needs libstdc++, temper does not.
try_aarch64() {
  local root=$scratch/aarch64 here=$scratch/emulated site wheel emulated
  wheel=$(ls "$packages"/temper_mesh-*-cp311-*aarch64.whl)
  scripts/bootstrap.sh cross
  mmdebstrap --quiet --variant=extract --architectures=arm64 --include=python3.11,libstdc++6 bookworm "$root" >/dev/null
  site=$root/site
  local platforms=()
  for glibc in 17 24 27 28; do platforms+=(--platform "manylinux_2_${glibc}_aarch64"); done
  python3 -m pip install -q --no-cache-dir --target "$site" "${platforms[@]}" --python-version 3.11 --only-binary :all: "$wheel"
  emulated=(qemu-aarch64 -L "$root")
  readme_into "$here"
  size "aarch64: $(basename "$wheel")" "$wheel"
  timed "aarch64, emulated: a mesh, by module" env -C "$here" PYTHONPATH="$site" "${emulated[@]}" "$root/usr/bin/python3.11" \
    "$source_folder/scripts/try_installed.py" --module
  row "aarch64, emulated: import temper, without NumPy" "$(cat "$scratch/log")"
  timed "aarch64, emulated: README's first commands" env -C "$here" bash -ec "temper() { ${emulated[*]} $site/temper/bin/temper \"\$@\"; }; . ./readme.sh"
}

in_root() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"; }
# What packages leave behind would be a difference; apt's and dpkg's own lists and logs are theirs.
files_of_root() {
  find "$root" -xdev \( -path "$root/var/lib/dpkg" -o -path "$root/var/lib/apt" -o -path "$root/var/cache" -o -path "$root/var/log" \
    -o -path "$root/proc" -o -path "$root/packages" -o -path "$root/tmp" \) -prune -o -print | sed "s|^$root||" | sort
}

try_debian() {
  local base=${TEMPER_CHROOT:-$scratch}/base release components debs=()
  root=$scratch/root
  # shellcheck source=/dev/null
  release=$(. /etc/os-release && echo "$VERSION_CODENAME")
  scripts/bootstrap.sh debian
  # Ubuntu has the libraries in the component universe.
  components=$(apt-get indextargets --format '$(ORIGIN) $(COMPONENT)' 'Created-By: Packages' | sed -nE 's/^(Debian|Ubuntu) //p' | sort -u)
  [[ -d $base ]] || timed "Debian: debootstrap $release" debootstrap --variant=minbase --components="${components//$'\n'/,}" "$release" "$base"
  cp -a "$base" "$root"
  cp /etc/resolv.conf "$root/etc/resolv.conf"
  cp -a /etc/apt/apt.conf.d/. "$root/etc/apt/apt.conf.d/" 2>/dev/null || true
  mkdir "$root/packages"
  cp "$packages"/*.deb "$root/packages"
  readme_into "$root/packages"
  for deb in "$packages"/*.deb; do
    size "Debian: $(basename "$deb")" "$deb"
    must grep -q . <(dpkg-deb --field "$deb" Depends)
    debs+=("/packages/$(basename "$deb")")
  done
  timed "Debian: apt-get update" in_root apt-get update -qq
  # The program alone, as most will have it.
  local library program
  library=$(cd "$root/packages" && ls libtemper0*.deb)
  program=$(cd "$root/packages" && ls temper_*.deb)
  files_of_root >"$scratch/before"
  local others
  others=$(in_root dpkg -l | grep -c ^ii)
  timed "Debian: apt-get install, the program" in_root apt-get install -y -qq --no-install-recommends "/packages/$library" "/packages/$program"
  row "Debian: packages that came with the program" "$(($(in_root dpkg -l | grep -c ^ii) - others - 2))"
  must test "$(in_root dpkg -l | grep -c libnetcdf)" = 0
  timed "Debian: README's first commands" in_root sh -ec 'cp -r /packages/examples /tmp; cd /tmp; . /packages/readme.sh'
  must grep -q "version\|commit" <(in_root temper --version)
  timed "Debian: apt-get install, all four packages" in_root apt-get install -y -qq --no-install-recommends "${debs[@]}"
  timed "Debian: import temper" in_root python3 -c 'import temper'
  in_root python3 -m temper check /tmp/better.vtu >/dev/null
  timed "Debian: apt-get purge" in_root sh -c 'apt-get purge -y -qq temper libtemper-dev "libtemper0*" python3-temper && apt-get autoremove --purge -y -qq'
  files_of_root >"$scratch/after"
  diff "$scratch/before" "$scratch/after" | grep -i temper && { echo "test_packages: purge leaves these" >&2; exit 1; }
  row "Debian: files of temper that purge leaves" 0
}

# Shared libraries in a prefix of their own run by RUNPATH, are found by pkg-config and CMake, and go by `uninstall`.
try_source() {
  local build prefix=$scratch/prefix archive sources
  archive=$(ls "$packages"/temper-[0-9]*[0-9].tar.gz)
  size "source: $(basename "$archive")" "$archive"
  # Folders in which ccache finds what scripts/package.sh debian has compiled: the sources are ../.. of the build in both.
  sources=$PWD/build/source build=$PWD/build/source/build/shared
  rm -rf "$sources" && mkdir -p "$sources"
  tar -xzf "$archive" -C "$sources" --strip-components=1
  scripts/bootstrap.sh build
  cmake -G Ninja -S "$sources" -B "$build" "${launcher[@]}" -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON -DBUILD_SHARED_LIBS=ON -DTEMPER_BUILD_PYTHON=ON \
    -DTEMPER_PYTHON=/usr/bin/python3 >/dev/null
  cmake --build "$build" >/dev/null
  timed "source: cmake --install" cmake --install "$build" --prefix "$prefix"
  must test -z "$(ldd "$prefix/bin/temper" "$prefix"/lib/libtemper*.so | grep 'not found')"
  must test "$(ldd "$prefix/bin/temper" | grep -c "$scratch/prefix/.*libtemper")" -ge 4
  must "$prefix/bin/temper" example annulus -o "$scratch/ring.vtu"
  PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$(echo "$prefix"/lib/python3*/site-packages) /usr/bin/python3 -c 'import temper; print(temper.read("'"$scratch"'/ring.vtu"))'
  # shellcheck disable=SC2046 # flags are words
  PKG_CONFIG_PATH=$prefix/lib/pkgconfig sh -ec 'g++ -std=c++20 tests/consumer/io.cpp $(pkg-config --cflags --libs temper-io) -Wl,-rpath,'"$prefix/lib"' -o '"$scratch/io"
  must "$scratch/io" tests/consumer/one_triangle.obj
  cmake -G Ninja -S tests/consumer/find_package -B "$scratch/find_package" -DCMAKE_PREFIX_PATH="$prefix" >/dev/null
  cmake --build "$scratch/find_package" >/dev/null
  must ctest --test-dir "$scratch/find_package" --output-on-failure --no-tests=error -Q
  cmake --build "$build" --target uninstall >/dev/null
  must test -z "$(find "$prefix" -type f -o -type l)"
  row "source: files that uninstall leaves" 0
}

try_sums() {
  local bill recipes=$scratch/recipes files
  files=$(cd "$packages" && find . -maxdepth 1 -type f ! -name SHA256SUMS -printf '%f\n' | sort)
  timed "sums: sha256sum --check" env -C "$packages" sha256sum --check --strict SHA256SUMS
  must diff <(cut -c 67- "$packages/SHA256SUMS" | sort) <(echo "$files")
  bill=$(ls "$packages"/temper-*.cdx.json)
  must diff <(grep -vF "$(basename "$bill")" <<<"$files") \
    <(python3 -c 'import json, sys; print("\n".join(sorted(c["name"] for c in json.load(open(sys.argv[1]))["components"])))' "$bill")
  row "sums: files" "$(wc -l <<<"$files")"
  tar -xzf "$packages"/temper-*-recipes.tar.gz -C "$scratch"
  must grep -q "$(grep ' temper-[0-9.]*[0-9].tar.gz$' "$packages/SHA256SUMS" | cut -c 1-64)" "$recipes/homebrew/temper.rb"
  timed "sums: twine and npm, without an upload" scripts/publish.sh rehearse "$packages"
}

try_npm() {
  local package folder=$scratch/npm
  package=$(ls "$packages"/temper-mesh-*.tgz)
  size "npm: $(basename "$package")" "$package"
  mkdir "$folder"
  echo '{"private": true, "type": "module"}' >"$folder/package.json"
  timed "npm: npm install" env -C "$folder" npm install --no-audit --no-fund --loglevel=error "$package"
  cat >"$folder/try.js" <<'JS'
import * as temper from 'temper-mesh';
const mesh = temper.generate.annulus();
temper.optimize(mesh);
if (temper.quality(mesh).well_centered_fraction !== 1) throw Error('not well-centered');
temper.write('ring.vtu', mesh);
console.log(temper.version());
JS
  timed "npm: a mesh in Node" env -C "$folder" node try.js
  must grep -qx "$(scripts/version.py)" "$scratch/log"
  must test -s "$folder/ring.vtu"
}

prepare_wine() {
  scripts/bootstrap.sh windows
  [[ -d $WINEPREFIX ]] || timed "Windows: wine wineboot" start_wine
}

try_windows() {
  local zip here=$scratch/windows
  zip=$(ls "$packages"/temper-*-windows-x86_64.zip)
  size "Windows: $(basename "$zip")" "$zip"
  readme_into "$here"
  unzip -q "$zip" -d "$here"
  printf '#!/bin/sh\nexec wine "%s" "$@"\n' "$(echo "$here"/temper-*/temper.exe)" >"$here/temper"
  chmod +x "$here/temper"
  prepare_wine
  timed "Windows: README's first commands" env -C "$here" PATH="$here:$PATH" sh -e readme.sh
  must test -s "$here/better.vtu"
}

try_windows_wheel() {
  local wheel version found=0
  scripts/bootstrap.sh cross
  prepare_wine
  for wheel in "$packages"/temper_mesh-*-win_amd64.whl; do
    [[ -e $wheel ]] || continue
    version=$(sed -E 's/.*-cp3([0-9]+)-.*/3.\1/' <<<"$wheel")
    if [[ $version == 3.1[012] ]]; then
      found=$((found + 1))
      try_one_windows_wheel "$wheel" "$version"
    else
      row "Windows, Python $version: needs NumPy 2, which Wine 8 cannot run" skipped
    fi
  done
  ((found > 0)) || { echo "test_packages: $packages has no such wheel" >&2; exit 1; }
}

# By a copy of the Python for Windows. Wine's programs need pipes. Wine does not have what Python 3.12 asks Windows for its
# version, as pip does, so this machine's pip installs.
try_one_windows_wheel() {  # WHEEL VERSION
  local here=$scratch/windows-$2 python
  in_wine() { env -C "$here" WINEPATH='python\Scripts' wine "$@" </dev/null 2>&1 | cat; return "${PIPESTATUS[0]}"; }
  readme_into "$here"
  size "Windows: $(basename "$1")" "$1"
  python=$(scripts/python.sh "$2" windows)
  cp -a "$python" "$here/python"
  timed "Windows, Python $2: pip install, with NumPy and netCDF4" python3 -m pip install -q --no-cache-dir --target "$here/python/lib/site-packages" \
    --only-binary :all: --platform win_amd64 --python-version "$2" "$1" 'numpy<2' netCDF4==1.6.5
  mv "$here/python/lib/site-packages/bin" "$here/python/Scripts"
  cp scripts/try_installed.py "$here"
  timed "Windows, Python $2: a mesh, by module and program" in_wine 'python\python.exe' try_installed.py
  row "Windows, Python $2: import temper, without NumPy" "$(tail -n 1 "$scratch/log" | tr -d '\r')"
  must grep -q 'NetCDF *4' <(in_wine 'python\python.exe' -m temper --version)
  printf '#!/bin/sh\nexec wine "%s" "$@"\n' "$here/python/Scripts/temper.exe" >"$here/temper"
  chmod +x "$here/temper"
  timed "Windows, Python $2: README's first commands" env -C "$here" PATH="$here:$PATH" sh -e readme.sh
}

for kind in "${kinds[@]}"; do "try_$kind"; done
printf '%s\n' "${rows[@]}"
echo "works: ${kinds[*]}"
