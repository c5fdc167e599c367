#!/usr/bin/env bash
# Compiles each public header alone, with each compiler that is there: a header brings what it needs.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

headers=(include/temper/*.hpp)
((${#headers[@]} > 0)) || { echo "headers: none found" >&2; exit 1; }
flags=(-std=c++20 -fsyntax-only -Iinclude -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Werror)

compilers=0
for compiler in g++ clang++-19; do
  command -v "$compiler" >/dev/null || continue
  compilers=$((compilers + 1))
  printf '%s\0' "${headers[@]#include/}" |
    xargs -0 -P 2 -I '{}' sh -c 'printf "#include \"%s\"\n" "$1" | "$2" '"${flags[*]}"' -x c++ - ||
      { echo "headers: $1 does not compile alone with $2" >&2; exit 1; }' sh '{}' "$compiler"
done
((compilers > 0)) || { echo "headers: no compiler" >&2; exit 1; }
echo "headers: ${#headers[@]} public headers, each alone, with $compilers compilers"
