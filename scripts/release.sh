#!/usr/bin/env bash
# Makes each file of a release that this machine can make, and says which it cannot. Nothing leaves the machine. The workflow
# release.yml makes each kind on its own system, and ends with --finish.
#
#   scripts/release.sh [FOLDER]             default release/; scripts/test_packages.sh FOLDER installs each of them
#   scripts/release.sh --finish FOLDER      only recipes, bill of materials and checksums, for files that are there
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source scripts/tools.sh

make=1
if [[ "${1:-}" == --finish ]]; then make=0; shift; fi
[[ "${1:-}" != -* && $# -le 1 && ( $make == 1 || -d "${1:-}" ) ]] || { echo "usage: scripts/release.sh [FOLDER] | --finish FOLDER" >&2; exit 2; }
folder=$(realpath -m "${1:-release}")
version=$(scripts/version.py)
scripts/version.py --check

missing=()
if ((make)); then
  [[ ! -e "$folder" ]] || { echo "release: $folder is there already" >&2; exit 1; }
  [[ -z "$(git status --porcelain)" ]] || echo "release: some changes are not committed; the source archive has only the commit"
  scripts/claims.sh
  scripts/package.sh --output "$folder" source wheel debian npm windows
  if command -v podman docker >/dev/null; then
    scripts/package.sh --output "$folder" container || missing+=("container: no engine that builds")
  else
    missing+=("container: neither podman nor docker")
  fi
fi

# Recipes have the checksums of files; the other way round, SHA256SUMS has the archive of recipes.
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
scripts/recipes.sh "$folder" "$scratch/recipes"
tar -czf "$folder/temper-$version-recipes.tar.gz" -C "$scratch" recipes
"$(tool_python release)" scripts/sbom.py "$folder"
(cd "$folder" && find . -maxdepth 1 -type f ! -name SHA256SUMS -printf '%f\0' | sort -z | xargs -0 sha256sum >"$scratch/SHA256SUMS")
mv "$scratch/SHA256SUMS" "$folder/"

printf '\n%s:\n' "$folder"
(cd "$folder" && find . -maxdepth 1 -type f -printf '%f %s\n' | sort | awk '{printf "  %-70s %8.1f kB\n", $1, $2 / 1000}')
if ((make)); then printf 'not made here: %s\n' "${missing[@]}" "wheels for macOS: the workflow makes them" "provenance: the workflow signs it"; fi
