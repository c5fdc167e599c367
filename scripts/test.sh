#!/usr/bin/env bash
# Everything that must hold before a change goes in, from a clean clone. Fails when any stage fails. The last lines say which
# stages took longest, and how many checks and tests passed and failed, in all builds together.
#
#   scripts/test.sh                 all stages
#   scripts/test.sh --quick         without sanitizers: of the tests, only those that need an optimized library
#   scripts/test.sh --sanitizers    only what --quick leaves out
#   scripts/test.sh --clang         only: clang++ reads each source alone and builds everything, and bytes are compared
#
# Builds run one after the other in the background, at low priority, while this checks and tests what is there: no processor waits.
#
# TEMPER_TEST_JOBS: parallel jobs, default all processors.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1
source scripts/tools.sh

part=all
for argument in "$@"; do
  case "$argument" in
    --quick | --sanitizers | --clang) part=${argument#--} ;;
    *) echo "test: unknown argument '$argument'" >&2; exit 2 ;;
  esac
done
jobs=${TEMPER_TEST_JOBS:-$(nproc)}
scratch=$(mktemp -d)
builder=
trap 'signal_builds TERM; signal_builds CONT; rm -rf "$scratch"' EXIT

passed=0 failed=0 skipped=0
failures=() times=()

# stage NAME COMMAND …: runs it, shows its output only when it fails, counts it as one check. Exit code 77: it is skipped.
stage() {
  local name=$1 start=$SECONDS status=0
  shift
  "$@" >"$scratch/log" 2>&1 || status=$?
  times+=("$((SECONDS - start)) s  $name")
  if ((status == 0)); then
    passed=$((passed + 1))
    printf '%-44s ok      %4d s   %s\n' "$name" $((SECONDS - start)) "$(tail -n 1 "$scratch/log" | cut -c 1-90)"
  elif ((status == 77)); then
    skipped=$((skipped + 1))
    printf '%-44s skipped %4d s   %s\n' "$name" $((SECONDS - start)) "$(tail -n 1 "$scratch/log" | cut -c 1-90)"
  else
    failed=$((failed + 1))
    failures+=("$name")
    # Of a long build the errors, not the progress.
    grep -v -E '^\[[0-9]+/[0-9]+\] (Building|Linking|Generating|Scanning)' "$scratch/log" | tail -n 200
    printf '%-44s FAILED  %4d s\n' "$name" $((SECONDS - start))
    return 1
  fi
}

# signal_builds SIGNAL: sends it to the builds in the background, if there are any.
signal_builds() { [[ -z "$builder" ]] || kill -s "$1" -- "-$builder" 2>/dev/null || true; }
# suite NAME DIR ARGUMENT OF CTEST …: runs ctest there and counts its tests one by one; no test at all is a failure.
suite() {
  local name=$1 dir=$2 start=$SECONDS counts
  local results="$scratch/results.xml"
  rm -f "$results"
  env -u GTEST_FILTER -u GTEST_TOTAL_SHARDS ctest --test-dir "$dir" "${@:3}" -j "$jobs" --no-tests=error --output-on-failure \
    --test-output-size-passed 10000000 --output-junit "$results" >"$scratch/log" 2>&1
  local status=$?
  times+=("$((SECONDS - start)) s  $name")
  read -r -a counts < <(python3 scripts/count_tests.py "$results" 2>/dev/null || echo 0 1 0)
  if ((status != 0 && counts[1] == 0)); then counts[1]=1; fi
  passed=$((passed + counts[0])) failed=$((failed + counts[1])) skipped=$((skipped + counts[2]))
  local verdict=ok
  if ((counts[1] > 0)); then
    verdict=FAILED
    failures+=("$name")
    grep -v -E ' (Passed|Start +[0-9]+:)|^ +Start ' "$scratch/log" | tail -n 300
  fi
  printf '%-44s %-6s  %4d s   %d passed, %d failed, %d skipped\n' "$name" "$verdict" $((SECONDS - start)) "${counts[@]}"
}

# build_in_background NAME …: runs build_NAME for each name, in a process group of its own.
build_in_background() {
  set -m
  {
    renice -n 19 -p "$BASHPID" >/dev/null
    local name start status
    for name in "$@"; do
      start=$SECONDS status=0
      "build_$name" >"$scratch/$name.log" 2>&1 || status=$?
      echo "$((SECONDS - start)) s in the background" >>"$scratch/$name.log"
      echo "$status" >"$scratch/$name.part" && mv "$scratch/$name.part" "$scratch/$name.done"
    done
  } &
  builder=$!
  set +m
}

# Waits for the end of build_NAME, and takes its output and its exit code.
built() {  # NAME
  while [[ ! -e "$scratch/$1.done" ]] && kill -0 "$builder" 2>/dev/null; do sleep 0.2; done
  [[ -e "$scratch/$1.done" ]] || { echo "the builds in the background ended before that of $1"; return 1; }
  cat "$scratch/$1.log"
  return "$(<"$scratch/$1.done")"
}

configure_and_build() {  # PRESET ARGUMENT OF THE BUILD …
  local launcher=()
  if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
  cmake --preset "$1" "${launcher[@]}" && cmake --build --preset "$1" -j "$jobs" "${@:2}"
}

formatted() {
  local files
  mapfile -t files < <(git ls-files '*.cpp' '*.hpp' | while read -r file; do [[ -f "$file" ]] && echo "$file"; done)
  ((${#files[@]} > 0)) || return 1
  printf '%s\0' "${files[@]}" | xargs -0 -P "$jobs" -n 8 clang-format-14 --dry-run -Werror &&
    echo "${#files[@]} files"
}

# The core must do without exceptions and RTTI: not one of its sources may be compiled with them.
core_without_exceptions() {
  python3 - build/dev/compile_commands.json <<'PYTHON'
import json, sys
core = [c for c in json.load(open(sys.argv[1])) if " src/CMakeFiles/temper.dir/" in c["command"]]
wrong = [c["file"] for c in core if not all(f in c["command"] for f in ("-fno-exceptions", "-fno-rtti", "-ffp-contract=off"))]
print("\n".join(wrong) if wrong else f"{len(core)} sources")
sys.exit(bool(wrong) or not core)
PYTHON
}

# A library that is missing silently drops the tests that need it; here nothing may be dropped.
every_test_program_is_there() {  # BUILD LINES: which lines with temper_test, as sed names them
  local name missing=0 count=0
  while read -r name; do
    count=$((count + 1))
    find "$1/tests" -name "$name" -type f -perm -u+x | grep -q . || { echo "not built: $name"; missing=1; }
  done < <(git ls-files 'tests/*CMakeLists.txt' | xargs sed -n "$2"' s/^ *temper_test(\([A-Za-z0-9_]*\).*/\1/p')
  ((missing == 0 && count > 0)) && echo "$count programs"
}

# Tests by GoogleTest are in NAME_test.cpp, those in Python in test_NAME.py; a test is called by a SentenceInCamelCase.
names_of_tests() {
  local test='^(TEST|TEST_F|TEST_P)\('
  { git ls-files tests | grep -E '/test_[^/]*\.cpp$|_test\.py$'
    git grep -lE "$test" -- 'tests/*.cpp' ':!*_test.cpp'
    git grep -LE "$test" -- 'tests/*_test.cpp'
    git grep -nE "$test"'[A-Za-z0-9]+, ([^A-Z]|[A-Za-z0-9]*[^A-Za-z0-9)])' -- tests
    true  # git grep fails where it finds nothing
  } | { ! grep .; } && echo "$(git grep -hE "$test" -- tests | wc -l) tests by GoogleTest"
}

# What has changed since the main branch, or in the last commit: each source read alone, by clang. Not what is Windows' own.
tidy() {
  local base files
  cmake --preset clang >/dev/null || return 1
  base=$(base_of_change)
  mapfile -t files < <(git diff --name-only --diff-filter=d "$base" -- 'src/*.cpp' 'apps/*.cpp' ':!*/windows.cpp')
  ((${#files[@]} == 0)) || printf '%s\0' "${files[@]}" |
    xargs -0 -P "$jobs" -n 1 clang-tidy-14 -p build/clang --quiet --warnings-as-errors='*' || return 1
  echo "${#files[@]} sources"
}

# Those clients of examples/python that pip installs in seconds, for the test `python`. Debian has what they need, except pandas.
light_clients() {
  local folder=build/dev/clients pins=tests/clients/constraints.txt
  if [[ ! "$folder" -nt "$pins" ]]; then
    rm -rf "$folder"
    /usr/bin/python3 -m pip install --quiet --no-cache-dir --no-deps --retries 1 --timeout 20 --target "$folder" -c "$pins" \
      flopy FiPy devsim meshkernel pandas pytz tzdata || {
      echo "the package index does not give them: examples run without the checks of clients"
      return 77
    }
  fi
  echo "$(du -sm "$folder" | cut -f 1) MB"
}

consumer_find_package() {
  cmake --install build/dev --prefix "$scratch/prefix" >/dev/null &&
    readelf -d "$scratch/prefix/bin/temper" | grep -q 'RUNPATH.*\$ORIGIN/\.\./lib' && # where shared libraries would be
    [[ -s "$scratch/prefix/share/man/man1/temper-optimize.1" && -s "$scratch/prefix/share/bash-completion/completions/temper" ]] &&
    PKG_CONFIG_PATH="$scratch/prefix/lib/pkgconfig" pkg-config --exists --print-errors temper temper-tets temper-surfaces temper-io temper-lp temper-tbb temper-errors temper-solvers &&
    cmake -G Ninja -S tests/consumer/find_package -B "$scratch/find_package" -DCMAKE_PREFIX_PATH="$scratch/prefix" &&
    cmake --build "$scratch/find_package"
}

build_optimized() { configure_and_build dev --target optimized; }
build_sanitizers() { configure_and_build asan; }
# The core alone asks for nothing; with what ThreadSanitizer looks at, in the same project, it is built.
build_subdirectory() (
  cmake -G Ninja -S tests/consumer/subdirectory -B "$scratch/subdirectory" &&
    cmake --install "$scratch/subdirectory" --prefix "$scratch/nothing" && [[ ! -e "$scratch/nothing" ]] && cd tests/consumer/subdirectory &&
    configure_and_build subdirectory --target core threads
)

# All tests, by the other compiler, and what runs on threads: nothing else, in a project that holds temper in a subdirectory.
sanitizers() {
  if stage "build (sanitizers, clang++)" built sanitizers; then
    stage "every test program is there" every_test_program_is_there build/asan '/OPTIMIZED_ALONE/!'
    suite "tests (sanitizers)" build/asan
  fi
  if stage "consumer: subdirectory (ThreadSanitizer)" built subdirectory; then
    suite "threads (ThreadSanitizer)" build/subdirectory -R '^(subdirectory_core|threads_[01])$'
  fi
}

clang() {
  stage "build (clang++, each source alone)" configure_and_build clang
  stage "the same bytes by each compiler" scripts/same_bytes.sh
}

# Prints the counts; fails if anything has failed.
summary() {
  printf '\n'
  printf '%s\n' "${times[@]}" | sort -rn | head -n 8 | sed 's/^/  /'
  printf '%d s in all' "$SECONDS"
  if ((skipped > 0)); then printf '; %d skipped (they need clients, VTK, or meshes that are not in the repository)' "$skipped"; fi
  printf '\n'
  if ((${#failures[@]} > 0)); then printf 'failed: %s\n' "${failures[@]}"; fi
  echo "$passed passed, $failed failed"
  ((failed == 0))
}

if ! stage "bootstrap" scripts/bootstrap.sh build test; then
  echo "0 passed, 1 failed"
  exit 1
fi
if [[ "$part" == clang ]]; then
  clang
  summary
  exit
fi
case "$part" in
  all) build_in_background optimized sanitizers subdirectory ;;
  quick) build_in_background optimized ;;
  sanitizers)
    build_in_background sanitizers subdirectory
    sanitizers
    summary
    exit
    ;;
esac
stage "layers: the checker finds what it should" python3 scripts/check_layers.py --self-test
stage "layers: who includes whom" python3 scripts/check_layers.py
stage "links: the checker finds what it should" python3 scripts/check_links.py --self-test
stage "links: none is dead" python3 scripts/check_links.py
stage "site: navigation and links, by MkDocs" scripts/docs.sh --links
stage "prose: the checker finds what it should" python3 scripts/check_prose.py --self-test
stage "prose: sentences are plain" python3 scripts/check_prose.py
stage "pages: the checker finds what it should" python3 scripts/docs/pages.py --self-test
stage "lint: workflows, scripts, recipes, citation" scripts/lint.sh
stage "format" formatted
stage "names of tests" names_of_tests
stage "bench: the comparison finds what it should" python3 bench/compare.py --self-test
stage "bench: the rates are what they should be" python3 bench/rates.py --self-test
stage "headers, each alone" tests/consumer/headers.sh
stage "clang-tidy on what has changed" tidy
# Those tests whose findings depend on how the library is optimized.
if stage "build (optimized, -Werror)" built optimized; then
  stage "every test of the optimized build is there" every_test_program_is_there build/dev /OPTIMIZED/
  stage "core without exceptions and RTTI" core_without_exceptions
  stage "instruction sets keep to themselves" python3 scripts/check_instruction_sets.py build/dev
  stage "the Python module is tested" grep -q 'add_test.*python.*pytest' build/dev/tests/python/CTestTestfile.cmake
  stage "pages: commands, numbers and pictures" /usr/bin/python3 scripts/docs/pages.py build/dev/apps/temper/temper
  stage "clients of the examples" light_clients
  # Some of these tests limit the seconds of a processor, which grow on a busy machine.
  signal_builds STOP
  suite "tests (optimized)" build/dev -L optimized -E '^pages$'
  signal_builds CONT
  stage "consumer: install, find_package" consumer_find_package && suite "consumer: find_package runs" "$scratch/find_package"
fi
if [[ "$part" == all ]]; then sanitizers; fi
summary
