#!/usr/bin/env bash
# Installs the solvers that docs/howto is about, as the package index has them, in versions that are pinned. Then scripts/docs/pages.py
# runs examples/python with their clients, the pages that need them, and examples/benchmarks, and compares what pages and benchmarks
# print. Not a part of scripts/test.sh, which runs examples/python with light clients.
#
#   scripts/clients.sh                       all pages
#   scripts/clients.sh fipy landlab          these
#   scripts/clients.sh --plugins             only the plugins in their hosts: QGIS, ParaView, and those of tests/python/test_hosts.py
#   scripts/clients.sh --write               puts numbers and pictures into the pages, and the table into docs/explanation/measured.md
#   scripts/clients.sh --from DIR …          also installs a client that the index lacks, from its sources in DIR (PorePy, PyDEC,
#                                            MODFLOW 6)
#
# Clients go to build/clients. The program and the module are built (preset python), unless TEMPER_BUILD names a build.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

from=() arguments=() plugins_only=false
while (($#)); do
  case "$1" in
    --from) [[ -d "${2:-}" ]] || { echo "clients: --from wants a folder, not '${2:-}'" >&2; exit 2; }
            from+=("$(realpath "$2")"); shift ;;
    --plugins) plugins_only=true ;;
    *) arguments+=("$1") ;;
  esac
  shift
done

scripts/bootstrap.sh build clients desktop
if [[ -z "${TEMPER_BUILD:-}" ]]; then
  scripts/build.sh python
  TEMPER_BUILD=build/python
fi
TEMPER_BUILD=$(realpath "$TEMPER_BUILD")

# The module is built for Debian's Python; the environment must be of the same version.
venv=$PWD/build/clients
requirements=tests/clients/requirements.txt constraints=tests/clients/constraints.txt
stamp=$(cat "$requirements" "$constraints" | sha256sum)
if [[ "$(cat "$venv/stamp" 2>/dev/null)" != "$stamp" ]]; then
  /usr/bin/python3 -m venv --clear "$venv"
  "$venv/bin/pip" install --quiet --disable-pip-version-check -r "$requirements" -c "$constraints"
  echo "$stamp" >"$venv/stamp"
fi
modflow() {  # SOURCES: the environment gets the program mf6
  [[ -x "$venv/bin/mf6" ]] && return
  command -v gfortran >/dev/null || scripts/bootstrap.sh fortran
  "$venv/bin/pip" install --quiet --disable-pip-version-check meson==1.12.1
  FC=gfortran "$venv/bin/meson" setup --buildtype=release "$venv/mf6" "$1" >/dev/null
  ninja -C "$venv/mf6" --quiet src/mf6
  cp "$venv/mf6/src/mf6" "$venv/bin/"
}
for folder in "${from[@]}"; do
  if [[ -f "$folder/src/mf6.f90" ]]; then
    modflow "$folder"
    continue
  fi
  "$venv/bin/pip" install --quiet --disable-pip-version-check -c "$constraints" "$folder"
done

# One BLAS: the last digits are the same from run to run.
export DEVSIM_MATH_LIBS=liblapack.so.3:libblas.so.3
tests() {
  PYTHONPATH="$TEMPER_BUILD/python" TEMPER_PROGRAM_DIR="$TEMPER_BUILD/apps/temper" \
    "$venv/bin/python" -m pytest -q -p no:cacheprovider -rs "$@"
}
tests tests/python/test_hosts.py tests/clients
if $plugins_only; then exit; fi
tests tests/python/test_docs.py -k an_example_runs
exec "$venv/bin/python" scripts/docs/pages.py --clients "$TEMPER_BUILD/apps/temper/temper" "${arguments[@]}"
