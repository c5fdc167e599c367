#!/usr/bin/env bash
# Prints a block of the README's section "Try it", for scripts that run it: scripts/readme.sh 1    the commands
#                                                                            scripts/readme.sh 2    what they print
set -euo pipefail
[[ "${1:-}" =~ ^[1-9]$ ]] || { echo "usage: scripts/readme.sh 1|2" >&2; exit 2; }
cd "$(dirname "${BASH_SOURCE[0]}")/.."
awk -v n="$1" '/^## Try it/ {on = 1} on && /^```/ {inside = !inside; if (inside) ++block; next} on && inside && block == n {print; ++lines}
               END {exit lines < 3}' README.md || { echo "readme: block $1 of \"Try it\" in README.md has fewer than three lines" >&2; exit 1; }
