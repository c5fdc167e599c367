#!/usr/bin/env bash
# Makes all figures of the paper with full effort, tests every claim, and compares gallery/claims.md and
# gallery/readings.md with what was found: one minute after the build. scripts/release.sh runs it.
# scripts/test.sh tests the same claims with fewer samples and shorter runs.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
scripts/bootstrap.sh build test
scripts/build.sh dev --target claims_whole
# Thousands of short runs: memory goes back to the system and comes again, a quarter of the time, unless told to stay.
MALLOC_TRIM_THRESHOLD_=1000000000 MALLOC_MMAP_THRESHOLD_=1000000000 build/dev/tests/claims/claims_whole
