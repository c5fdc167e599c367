#!/usr/bin/env bash
# Compiles temper for systems that this machine is not, by `zig c++`: Clang and libc++ of the Python package ziglang.
#
#   scripts/cross.sh macos      arm64 and x86-64: libraries and program, compiled and linked. None of them can run here
#   scripts/cross.sh aarch64    Linux: then golden bytes, unit tests and the README's commands run under qemu-user
#
# TEMPER_CROSS_JOBS: parallel jobs, default all processors. Emulated, the largest golden meshes take minutes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
[[ $# == 1 && $1 =~ ^(macos|aarch64)$ ]] || { echo "cross: expected macos or aarch64, found '$*'" >&2; exit 2; }
jobs=${TEMPER_CROSS_JOBS:-$(nproc)}
scripts/bootstrap.sh build cross

macos() {
  local machine
  for machine in arm64 x86_64; do
    scripts/build.sh "macos-$machine" -j "$jobs" --target temper_app
    file "build/macos-$machine/apps/temper/temper" | grep "Mach-O 64-bit.*$machine"
  done
}

aarch64() {
  local units=(unit_{base,geometry,mesh,energy,regularity,topology,quality,dec}) build=build/aarch64
  scripts/build.sh aarch64 -j "$jobs" --target temper_app golden_bytes "${units[@]}"
  local emulated=(qemu-aarch64 -L /usr/aarch64-linux-gnu)
  scratch=$(mktemp -d)
  trap 'rm -rf "$scratch"' EXIT

  # README's commands end with the same files as this machine's program writes, which compiles them with g++.
  scripts/build.sh release -j "$jobs" --target temper_app
  scripts/readme.sh 1 >"$scratch/readme.sh"
  local name
  for name in here emulated; do
    mkdir -p "$scratch/$name"
    ln -s "$PWD/examples" "$scratch/$name/examples"
  done
  (cd "$scratch/here" && temper() { "$OLDPWD/build/release/apps/temper/temper" "$@"; } && . ../readme.sh)
  (cd "$scratch/emulated" && temper() { "${emulated[@]}" "$OLDPWD/$build/apps/temper/temper" "$@"; } && . ../readme.sh)
  for name in valley.vtu better.vtu before-after.svg; do
    cmp "$scratch/here/$name" "$scratch/emulated/$name"
  done
  echo "README's commands: the same bytes"

  for name in "${units[@]}"; do
    printf '%s: ' "$name"
    "${emulated[@]}" "$build/tests/unit/${name#unit_}/$name" --gtest_brief=1 | tail -n 1
  done
  for name in $(cut -d ' ' -f 1 tests/golden/bytes.txt | uniq); do
    printf 'golden bytes: '
    "${emulated[@]}" "$build/tests/golden/golden_bytes" tests/golden/bytes.txt "$name"
  done
}

"$1"
