#!/usr/bin/env bash
# Builds temper and shows it at work: a mesh with all triangles bad, before and after.
# Writes demo-output/: the two meshes, a picture of both, the report as a page and as JSON.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/bootstrap.sh build
scripts/build.sh release
temper=$(find build/release -name temper -type f -perm -u+x | head -n 1)
[[ -n "$temper" ]] || { echo "demo: the build made no program" >&2; exit 1; }

run() { printf '\n$ temper'; printf ' %q' "$@"; printf '\n'; "$temper" "$@"; }

mkdir -p demo-output
run example sheared-grid --nx 16 --ny 10 --shear 1 -o demo-output/sheared.vtu
run check demo-output/sheared.vtu
run optimize demo-output/sheared.vtu -o demo-output/tempered.vtu \
  --write demo-output/before-after.svg demo-output/report.html demo-output/report.json
run check demo-output/tempered.vtu --require outside=0,nonregular=0,not_crossed=0

echo
echo "Open demo-output/report.html in a browser, or demo-output/tempered.vtu in ParaView."
