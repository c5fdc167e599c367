#!/usr/bin/env bash
# For each compiler, compares the results of ten meshes times twelve sets of options with the hashes of tests/golden/bytes.txt.
# Prints one line per compiler; fails if a hash differs.
#
#   scripts/same_bytes.sh             all that this machine has
#   scripts/same_bytes.sh --write     writes the table again, after a change that is meant to move bytes
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
table=tests/golden/bytes.txt

bytes() {  # NAME COMPILER ARGUMENT OF CMAKE …: builds the program, and says where it is
  local build=build/bytes-$1
  cmake -G Ninja -S tests/consumer/subdirectory -B "$build" -DCMAKE_CXX_COMPILER="$2" -DCMAKE_UNITY_BUILD=ON \
    -DCMAKE_BUILD_TYPE=Release "${@:3}" >/dev/null && cmake --build "$build" --target bytes >/dev/null && echo "$build/bytes"
}

if [[ ${1:-} == --write ]]; then
  "$(bytes g++ g++)" >"$table.new" && mv "$table.new" "$table"
  exit
fi

failed=0
row() {  # NAME COMMAND …
  printf '%-40s ' "$1"
  "${@:2}" "$table" || failed=1
}
row "g++ -O3" "$(bytes g++ g++)"
row "g++ -O0" "$(bytes debug g++ -DCMAKE_BUILD_TYPE=Debug)"
row "g++ -O3, registers in standard C++" "$(bytes plain g++ -DCMAKE_CXX_FLAGS=-DTEMPER_PLAIN_REGISTERS)"
if command -v clang++-19 >/dev/null; then row "clang++-19 -O3" "$(bytes clang clang++-19)"; fi
if command -v aarch64-linux-gnu-g++ >/dev/null && command -v qemu-aarch64 >/dev/null; then
  program=$(bytes aarch64 aarch64-linux-gnu-g++ -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=aarch64 -DCMAKE_EXE_LINKER_FLAGS=-static)
  for mesh in $(cut -d ' ' -f 1 "$table" | uniq); do  # emulated, the largest meshes take many minutes
    printf '%-40s ' "aarch64-linux-gnu-g++ -O3, qemu: $mesh"
    qemu-aarch64 "$program" "$table" "$mesh" || failed=1
  done
fi
exit $failed
