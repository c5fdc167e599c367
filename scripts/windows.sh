#!/usr/bin/env bash
# temper for Windows: compiles the program, the libraries and their tests with MinGW-w64, and runs them under Wine.
# Installs what it needs. The last line says how many checks passed, failed and were skipped.
#
#   scripts/windows.sh            all
#   scripts/windows.sh zip        only the zip for users: build/windows/temper-VERSION-windows-x86_64.zip
#   scripts/windows.sh programs   checks of the program, without unit tests
#
# TEMPER_PROGRAM: a program for this machine, whose files must have the same bytes. Default: it is built (preset release).
# TEMPER_TEST_JOBS: parallel jobs, default all processors.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1
root=$PWD build=$PWD/build/windows what=${1:-all}
[[ $# -le 1 && $what =~ ^(all|zip|programs)$ ]] || { echo "windows: expected zip, programs or nothing, found '$*'" >&2; exit 2; }

jobs=${TEMPER_TEST_JOBS:-$(nproc)}
# The times in the zip are local.
export TZ=UTC LC_ALL=C.UTF-8 WINEPREFIX=$build/wine
source scripts/wine.sh
scratch=$(mktemp -d)
trap 'stop_wine; rm -rf "$scratch"' EXIT

passed=0 failed=0 skipped=0
check() {  # NAME COMMAND …: exit code 77 means that it is skipped
  local status=0
  ("${@:2}") >"$scratch/log" 2>&1 </dev/null || status=$?
  case $status in
    0) passed=$((passed + 1)); printf '%-60s ok\n' "$1" ;;
    77) skipped=$((skipped + 1)); printf '%-60s skipped: %s\n' "$1" "$(tail -n 1 "$scratch/log")" ;;
    *) failed=$((failed + 1)); tail -n 60 "$scratch/log"; printf '%-60s FAILED\n' "$1" ;;
  esac
  return $((status != 0 && status != 77))
}

finish() {
  echo "$passed passed, $failed failed, $skipped skipped"
  exit $((failed > 0))
}

configure() {
  local launcher=()
  if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache -DCMAKE_C_COMPILER_LAUNCHER=ccache); fi
  cmake --preset windows "${launcher[@]}"
}

# The zip: the program, whose libraries are inside it, and their licenses.
make_zip() {
  local version name folder
  version=$(sed -n 's/^CMAKE_PROJECT_VERSION:.*=//p' "$build/CMakeCache.txt")
  name=temper-$version-windows-x86_64 folder=$scratch/$name
  mkdir -p "$folder" && x86_64-w64-mingw32-strip -o "$folder/temper.exe" "$build/apps/temper/temper.exe" &&
    cp LICENSE CITATION.cff "$folder" && cp -r "$build/licenses" "$folder" && cp web/report/dist/NOTICE "$folder/licenses/report.txt" || return 1
  rm -f "$build/$name.zip"
  find "$folder" -exec touch -d @"${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct)}" {} +  # the same bytes each time
  (cd "$scratch" && find "$name" | LC_ALL=C sort | zip -X -q "$build/$name.zip" -@) && du -h "$build/$name.zip"
}

# Windows itself has these libraries.
needs_only_windows() {
  local program=$1 extra
  extra=$(x86_64-w64-mingw32-objdump -p "$program" | sed -n 's/.*DLL Name: //p' |
    grep -viE '^(kernel32|msvcrt|user32|advapi32|shell32|ws2_32|bcrypt|ole32)\.dll$')
  [[ -z "$extra" ]] || { echo "needs $extra"; return 1; }
}

# netCDF4 1.6.5 is the last with HDF5 1. HDF5 2 calls feholdexcept(), which Wine 8 does not have.
netcdf_and_hdf5() {
  local wheel=$build/netCDF4-1.6.5.whl library
  echo 'netCDF4==1.6.5 --hash=sha256:de4dc973fae9e2bbdf42e094125e423a4c25393172a61958314969b055a38889' >"$scratch/requirements.txt"
  [[ -f $wheel ]] ||
    { python3 -m pip download -q --no-deps --require-hashes --only-binary :all: --platform win_amd64 --python-version 3.11 \
        -d "$scratch" -r "$scratch/requirements.txt" && mv "$scratch"/netCDF4-*.whl "$wheel"; } || return 1
  rm -rf "$build/netcdf" && unzip -q "$wheel" 'netCDF4.libs/*' -d "$build/netcdf" || return 1
  for library in netcdf hdf5; do ls "$build"/netcdf/netCDF4.libs/"$library"-*.dll || return 1; done
}

temper() { wine "$build/apps/temper/temper.exe" "$@"; }
tool() { wine "$build/tests/unit/app/windows_tool.exe" "$@"; }

# A folder of its own for each check, with the README's outline.
in_folder() {  # NAME COMMAND …
  mkdir -p "$scratch/$1/examples" && cp examples/aquifer.geojson "$scratch/$1/examples" && cd "$scratch/$1" && "${@:2}"
}

without_times() { sed -E 's/ in [0-9.]+ s,/ in T s,/'; }

readme() {
  "$root/scripts/readme.sh" 1 >commands && "$root/scripts/readme.sh" 2 | without_times >expected
  { source ./commands; } 2>&1 | without_times >printed || return 1
  diff expected printed && ! grep -q $'\r' printed valley.vtu better.vtu before-after.svg
}

version() {
  temper --version >printed && cat printed && grep -q 'oneTBB *2021' printed && grep -q 'NetCDF *4' printed && grep -q 'HDF5 *1' printed
}

# Files of many formats: the bytes that the program for this machine writes.
same_files() {
  local native=${TEMPER_PROGRAM:-$root/build/release/apps/temper/temper} program suffix files=0
  for program in "$native" temper; do
    mkdir "of_${program##*/}_$files" && cd "of_${program##*/}_$files" || return 1
    "$program" mesh ../examples/aquifer.geojson -o mesh.vtu --size 300 --quiet || return 1
    "$program" optimize mesh.vtu -o cell.vtu --for cell --write cell.json trace.jsonl page.html --quiet || return 1
    "$program" weights mesh.vtu -o weights.vtu --quiet || return 1
    "$program" operators mesh.vtu -o operators --quiet || return 1
    "$program" draw mesh.vtu -o mesh.svg || return 1
    for suffix in vtk msh off obj ply mesh 2dm 14 node; do
      "$program" convert cell.vtu -o "cell.$suffix" --quiet 2>warnings || { cat warnings; return 1; }
    done
    "$program" convert cell.vtu -o compressed.vtu --encoding appended --quiet || return 1
    cd .. && files=1
  done
  # Reports name the build and its times.
  sed -E -i 's/"(commit|compiler|processor|seconds|[a-z_]*_seconds|instructions|threads)": [^,}]*//g' of_*/cell.json
  rm -f of_*/page.html
  diff -r "of_${native##*/}_0" of_temper_1 && find of_temper_1 -type f | wc -l
}

spaces_and_umlauts() {
  local folder='Größe 1 km/日本 € mesh'
  mkdir -p "$folder" && cp examples/aquifer.geojson "$folder/Gewässer.geojson"
  temper mesh "$folder/Gewässer.geojson" -o "$folder/mesh ü.vtu" --size 300 --quiet || return 1
  temper optimize "$folder/mesh ü.vtu" -o "$folder/besser ü.vtu" --write "$folder/report ß.json" "$folder/before after.svg" --quiet &&
    temper operators "$folder/besser ü.vtu" -o "$folder/Operatoren ö" --quiet && [[ -s "$folder/Operatoren ö/star1.mtx" || -s "$folder/Operatoren ö/operators.npz" ]] &&
    temper check "$folder/fehlt ä.vtu" 2>message; grep -q 'fehlt ä.vtu: .*No such file' message && ls "$folder" &&
    (cd "$folder" && temper check 'besser ü.vtu' --require outside=0 && temper check "$(winepath -w 'besser ü.vtu')" --require outside=0)
}

crlf() {
  local suffix
  temper mesh examples/aquifer.geojson -o a.vtu --size 300 --quiet || return 1
  for suffix in obj off msh mesh 2dm 14 ply vtk vtu; do
    temper convert a.vtu -o "lf.$suffix" --encoding ascii --quiet 2>warnings || { cat warnings; return 1; }
    sed 's/$/\r/' "lf.$suffix" >"crlf.$suffix"
    if [[ -e lf.$suffix.weights.csv ]]; then sed 's/$/\r/' "lf.$suffix.weights.csv" >"crlf.$suffix.weights.csv"; fi
    if grep -qa 'binary' "lf.$suffix"; then continue; fi
    temper check "lf.$suffix" >lf.txt
    temper check "crlf.$suffix" | sed 's/crlf/lf/' >crlf.txt || return 1
    diff lf.txt crlf.txt && echo "$suffix" || return 1
  done
  sed 's/$/\r/' examples/aquifer.geojson >crlf.geojson
  temper mesh crlf.geojson -o b.vtu --size 300 --quiet && cmp a.vtu b.vtu || return 1
  printf '{\r\n"for": "cell"\r\n}\r\n' >options.json
  temper optimize a.vtu -o c.vtu --options options.json --quiet && temper optimize a.vtu -o d.vtu --for cell --quiet && cmp c.vtu d.vtu
}

held_open() {
  temper example letter-a -o a.vtu --quiet && cp a.vtu before.vtu || return 1
  tool hold a.vtu "$(winepath -w "$build/apps/temper/temper.exe")" optimize before.vtu -o a.vtu --quiet 2>message
  [[ $? == 1 ]] && cat message && grep -q 'another program has it open' message && cmp a.vtu before.vtu && [[ $(ls) == $(printf '%s\n' a.vtu before.vtu examples message) ]] &&
    temper optimize before.vtu -o a.vtu --quiet && ! cmp -s a.vtu before.vtu
}

# The first Ctrl-C of a run keeps its best mesh. A run that is killed leaves no file.
interrupts() {
  local program
  program=$(winepath -w "$build/apps/temper/temper.exe")
  temper example random --vertices 200000 -o big.vtu --quiet || return 1
  local status=0
  # Only a console has a Ctrl-C.
  script -qec "wine '$build/tests/unit/app/windows_tool.exe' press 5 '$program' optimize big.vtu -o out.vtu --quiet" console.txt || status=$?
  if [[ $status != 4 || ! -s out.vtu ]]; then cat console.txt; echo "exit status $status"; ls; return 1; fi
  temper check out.vtu | head -1
  rm out.vtu
  tool kill 3 "$program" optimize big.vtu -o out.vtu --write trace.jsonl --quiet
  ls && [[ ! -e out.vtu && -z $(find . -maxdepth 1 -name '*tmp*') ]]
}

standard_streams() {
  temper example letter-a -o a.obj --quiet || return 1
  temper convert - -o - --format off <a.obj >piped.off 2>messages || { cat messages; return 1; }
  temper convert a.obj -o named.off --quiet && cmp piped.off named.off && ! grep -q $'\r' piped.off && temper check a.obj --json | python3 -m json.tool >/dev/null
}

programs_of_tests() { find "$build/tests" \( -name 'unit_*.exe' -o -name golden.exe -o -name threads.exe \) | sort; }

# unit_app and unit_io_hostile start processes as POSIX does, and unit_gallery needs the gallery.
every_test_program_is_there() {
  diff <(git ls-files 'tests/unit/*CMakeLists.txt' tests/{golden,threads}/CMakeLists.txt | xargs sed -n 's/^ *temper_test(\([A-Za-z0-9_]*\).*/\1/p' |
           grep -vxE 'unit_app|unit_io_hostile|unit_gallery' | sort) <(programs_of_tests | sed 's|.*/||; s|\.exe$||' | sort)
}

outcome_of_tests() {  # PROGRAM: runs it, and counts its tests one by one
  local name=${1##*/} n_passed n_failed n_skipped status=0
  (cd "${1%/*}" && timeout 1200 wine "$1") >"$scratch/log" 2>&1 </dev/null || status=$?
  n_passed=$(grep -ac '^\[       OK \]' "$scratch/log") n_failed=$(grep -ac '^\[  FAILED  \] .*ms)' "$scratch/log")
  n_skipped=$(grep -ac '^\[  SKIPPED \] .*ms)' "$scratch/log")
  if ((status != 0 && n_failed == 0)) || ((n_passed + n_failed + n_skipped == 0)); then n_failed=1; fi
  passed=$((passed + n_passed)) failed=$((failed + n_failed)) skipped=$((skipped + n_skipped))
  if ((n_failed > 0)); then grep -aE -B 12 '^\[  FAILED  \]' "$scratch/log" | tail -n 80; tail -n 3 "$scratch/log"; fi
  tr -d '\r' <"$scratch/log" | grep -aA 1 'Skipped$' | grep -avE '^--|Skipped$' | sort | uniq -c
  printf '%-60s %d passed, %d failed, %d skipped\n' "${name%.exe}" "$n_passed" "$n_failed" "$n_skipped"
}

{ check "bootstrap" scripts/bootstrap.sh build test windows && check "configure" configure; } || finish
check "build: the program" cmake --build --preset windows -j "$jobs" --target temper_app || finish
check "the program needs nothing but Windows" needs_only_windows "$build/apps/temper/temper.exe"
check "zip" make_zip
if [[ $what == zip ]]; then finish; fi

check "build: a tool of the tests" cmake --build --preset windows -j "$jobs" --target windows_tool || finish
check "wine" start_wine || finish
check "NetCDF and HDF5, from a Python package" netcdf_and_hdf5 || finish
for library in netcdf hdf5; do declare -x "TEMPER_${library^^}=Z:$(echo "$build"/netcdf/netCDF4.libs/$library-*.dll)"; done
check "temper --version" in_folder version version
check "the README's commands print what the README says" in_folder readme readme
[[ -n ${TEMPER_PROGRAM:-} ]] || check "build: the program for this machine" scripts/build.sh release -j "$jobs" --target temper_app
check "files have the bytes that they have on Linux" in_folder same_files same_files
check "paths with spaces, umlauts and other letters" in_folder paths spaces_and_umlauts
check "files with CRLF" in_folder crlf crlf
check "an output that another program holds open" in_folder held held_open
check "Ctrl-C, and a run that is killed" in_folder interrupts interrupts
check "standard input and output" in_folder streams standard_streams
if [[ $what == programs ]]; then finish; fi

check "build: tests" cmake --build --preset windows -j "$jobs" || finish
check "golden bytes" wine "$build/tests/golden/golden_bytes.exe" "$root/tests/golden/bytes.txt" && tail -n 1 "$scratch/log"
check "every test program is there" every_test_program_is_there
while read -r program; do outcome_of_tests "$program"; done < <(programs_of_tests)
finish
