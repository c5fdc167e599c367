#!/usr/bin/env bash
# Compiles each public header alone: it brings what it needs. What that is does not depend on the compiler.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

mapfile -t headers < <(find include/temper -name "*.hpp" | sort)
((${#headers[@]} > 0)) || { echo "headers: none found" >&2; exit 1; }

# Each is in the list of one library, by which it is installed.
listed=$(cat src/CMakeLists.txt src/*/CMakeLists.txt | tr '\n' ' ' | grep -o 'temper_headers([^)]*)' |
  sed 's/.*(temper[a-z_]*//; s/)//' | xargs -n 1 | sort)
there=$(printf '%s\n' "${headers[@]}" | sed 's|^include/temper/||; s|\.hpp$||' | sort)
diff <(echo "$listed") <(echo "$there") || { echo "headers: lists of CMakeLists.txt (<) differ from include/temper (>)" >&2; exit 1; }

flags=(-std=c++20 -fsyntax-only -Iinclude -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Werror)
printf '%s\0' "${headers[@]#include/}" |
  xargs -0 -P 2 -I '{}' sh -c 'printf "#include \"%s\"\n" "$1" | clang++-19 '"${flags[*]}"' -x c++ - ||
    { echo "headers: $1 does not compile alone" >&2; exit 1; }' sh '{}'
echo "headers: ${#headers[@]} public headers, each alone"
