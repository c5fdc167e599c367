#!/usr/bin/env bash
# Configures and builds one preset: scripts/build.sh [PRESET] [cmake --build arguments …]. Default: release.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=${1:-release}
shift || true

launcher=()
if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
# The program needs no tests; only the presets made for testing build them.
extra=()
if [[ "$preset" == release ]]; then extra=(-DTEMPER_BUILD_TESTS=OFF); fi

cmake --preset "$preset" "${launcher[@]}" "${extra[@]}" >/dev/null
cmake --build --preset "$preset" "$@"
