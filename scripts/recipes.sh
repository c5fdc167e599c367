#!/usr/bin/env bash
# Fills the recipes of packaging/ for conda-forge, Spack, vcpkg, Homebrew and winget: the version, where the files of the
# release are, and their checksums.
#
#   scripts/recipes.sh RELEASE [OUTPUT]     RELEASE: a folder with what scripts/package.sh made;
#                                           default OUTPUT: RELEASE/recipes
#
# TEMPER_URL: where the files of RELEASE are, default the release's page on GitHub. file://RELEASE names the local files, for a
# test. The recipe of winget is left out if RELEASE has no zip for Windows.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

(($# == 1 || $# == 2)) || { echo "usage: scripts/recipes.sh RELEASE [OUTPUT]" >&2; exit 2; }
[[ -d "$1" ]] || { echo "recipes: $1 is no folder" >&2; exit 1; }
release=$(realpath "$1")
output=$(realpath -m "${2:-$release/recipes}")
version=$(scripts/version.py)
url=${TEMPER_URL:-https://github.com/temper-mesh/temper/releases/download/v$version}
source=temper-$version.tar.gz
zip=$(cd "$release" && find . -maxdepth 1 -name "temper-$version-*windows*.zip" -printf '%f\n' | sort | head -n 1)
[[ -f "$release/$source" ]] || { echo "recipes: $release has no $source; scripts/package.sh source makes it" >&2; exit 1; }

declare -A values=(
  [VERSION]=$version
  [SOURCE_URL]=$url/$source
  [SOURCE_SHA256]=$(sha256sum "$release/$source" | cut -d ' ' -f 1)
  [SOURCE_SHA512]=$(sha512sum "$release/$source" | cut -d ' ' -f 1)
)
if [[ -n "$zip" ]]; then
  values[WINDOWS_URL]=$url/$zip
  values[WINDOWS_SHA256]=$(sha256sum "$release/$zip" | cut -d ' ' -f 1 | tr a-f A-F)
  values[WINDOWS_PROGRAM]=$(unzip -Z1 "$release/$zip" | grep -m 1 '\(^\|/\)temper\.exe$' | sed 's|/|\\|g')
fi

fill() {  # TEMPLATE FILE
  local name text
  text=$(<"$1")
  for name in "${!values[@]}"; do text=${text//@$name@/"${values[$name]}"}; done
  mkdir -p "$(dirname "$2")"
  printf '%s\n' "$text" >"$2"
}

[[ ! -e "$output" ]] || { echo "recipes: $output is there already" >&2; exit 1; }
for template in packaging/{conda,spack,vcpkg,homebrew}/*.in; do
  file=${template#packaging/}
  fill "$template" "$output/${file%.in}"
done
cp packaging/vcpkg/usage "$output/vcpkg/"
if [[ -n "$zip" ]]; then
  for template in packaging/winget/*.in; do
    file=$(basename "${template%.in}")
    fill "$template" "$output/winget/TemperMesh.Temper${file#temper}"
  done
else
  echo "recipes: no zip for Windows in $release, so no recipe of winget"
fi
if grep -rlE '@[A-Z0-9_]+@' "$output"; then echo "recipes: these have unknown names" >&2; exit 1; fi
echo "recipes: $(find "$output" -type f | wc -l) files for temper $version in $output"
