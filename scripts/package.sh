#!/usr/bin/env bash
# Makes what users install: the archive of the sources, wheels, Debian packages, the npm package, a zip for Windows.
#
#   scripts/package.sh [--output DIR] [source] [wheel] [debian] [npm] [windows] [container]
#                                           default: packages/, and all but the container
#
# source: temper-X.Y.Z.tar.gz, the commit that is checked out. All recipes build from it.
# wheel:  the source distribution and wheels for Linux and Windows, by scripts/wheels.sh.
# debian: packages for the release of Debian or Ubuntu that runs this.
# npm:    temper-mesh-X.Y.Z.tgz, for browsers and Node. npm installs what builds it.
# windows: temper-X.Y.Z-windows-x86_64.zip, by scripts/windows.sh.
# container: temper-X.Y.Z-container.tar.gz, for `podman load`, by podman or docker.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

output=$PWD/packages wanted=()
while (($#)); do
  case "$1 ${2:-}" in
    "--output "?*) output=$(realpath -m "$2"); shift ;;
    "source "* | "wheel "* | "debian "* | "npm "* | "windows "* | "container "*) wanted+=("$1") ;;
    *) echo "package: expected source, wheel, debian, npm, windows, container or --output DIR, found '$1'" >&2; exit 2 ;;
  esac
  shift
done
((${#wanted[@]})) || wanted=(source wheel debian npm windows)

# Archives and packages carry the time of the commit.
export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null || date +%s)}
mkdir -p "$output" build
if command -v ccache >/dev/null; then export CMAKE_CXX_COMPILER_LAUNCHER=ccache; fi
CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
export CMAKE_BUILD_PARALLEL_LEVEL

package_source() {
  local name
  name=temper-$(scripts/version.py)
  git archive --format=tar --prefix="$name/" HEAD | gzip -9n >"$output/$name.tar.gz"
}

package_wheel() { scripts/wheels.sh --output "$output"; }

package_debian() {
  scripts/bootstrap.sh build debian
  rm -rf build/debian/package
  scripts/build.sh debian
  (cd build/debian && cpack -B "$PWD/package")
  cp build/debian/package/*.deb "$output"
}

package_npm() {
  scripts/bootstrap.sh build wasm
  scripts/build.sh wasm
  (cd web && npm ci --no-audit --no-fund --loglevel=error && npm run build --workspace npm &&
    npm pack --workspace npm --pack-destination "$output")
}

package_windows() {
  scripts/windows.sh zip
  cp "build/windows/temper-$(scripts/version.py)-windows-x86_64.zip" "$output"
}

package_container() {
  local engine version
  engine=$(command -v podman || command -v docker)
  version=$(scripts/version.py)
  "$engine" build -f packaging/Containerfile -t "temper:$version" .
  "$engine" run --rm "temper:$version" --version
  "$engine" save "temper:$version" | gzip -9n >"$output/temper-$version-container.tar.gz"
}

for kind in "${wanted[@]}"; do "package_$kind"; done
ls -l "$output"
