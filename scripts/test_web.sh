#!/usr/bin/env bash
# What temper is in browsers and Node: builds the native program (preset release) and the module (preset wasm), and tests
# the npm package against the program. Installs what it needs; npm brings the rest, pinned.
#
#   scripts/test_web.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/bootstrap.sh build wasm browser
scripts/build.sh release
scripts/build.sh wasm
export TEMPER_PROGRAM=$PWD/build/release/apps/temper/temper

cd web
npm ci --no-audit --no-fund --loglevel=error
npm run build
npm run check
(cd npm && node --test tests/)
