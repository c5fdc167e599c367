#!/usr/bin/env bash
# What temper is in browsers and Node: builds the native program (preset release) and the module (preset wasm), and tests
# the npm package and, in Chromium, the playground against the program, and the HTML report. tests/callers compares the
# package with the program for the objectives, too. Installs what it needs; npm brings the rest, pinned.
# The page in web/report/dist, which is in the repository, must be what npm makes.
#
#   scripts/test_web.sh               TEMPER_SHARED: public meshes, TEMPER_PICTURES: where screenshots go
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/bootstrap.sh build wasm browser
scripts/build.sh release
scripts/build.sh wasm
export TEMPER_PROGRAM=$PWD/build/release/apps/temper/temper

cd web
npm ci --no-audit --no-fund --loglevel=error
npm run build
git diff --exit-code --stat report/dist || { echo "test_web: web/report/dist is not what npm run build makes" >&2; exit 1; }
npm run check
node --test tests/*.test.mjs
(cd npm && node --test tests/)
python3 ../tests/callers/callers.py --program "$TEMPER_PROGRAM" --npm npm
(cd playground && node --test tests/)
