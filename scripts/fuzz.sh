#!/usr/bin/env bash
# Fuzzes the readers and optimize() by libFuzzer, with AddressSanitizer and UndefinedBehaviorSanitizer. Prints one row per
# target: executions, coverage (edges of the program that were run), inputs kept, and finds, which are inputs that fail. Exit code
# 1 if there are finds.
#
#   scripts/fuzz.sh 600                    ten minutes, all targets
#   scripts/fuzz.sh 1h vtu optimize        an hour for each of these
#
# Corpora stay in build/fuzz/corpus and grow from run to run. Finds go to build/fuzz/finds. Make a find small
# (temper_fuzz -minimize_crash=1), repair the program, and copy the find to tests/fuzz/finds. TEMPER_FUZZ_JOBS: targets at a time,
# default all processors.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1

usage="usage: scripts/fuzz.sh SECONDS|HOURSh [TARGET …]"
[[ "${1:-}" =~ ^([0-9]+)(h?)$ ]] || { echo "$usage" >&2; exit 2; }
seconds=${BASH_REMATCH[1]}
[[ -z "${BASH_REMATCH[2]}" ]] || seconds=$((seconds * 3600))
shift
jobs=${TEMPER_FUZZ_JOBS:-$(nproc)}
launcher=()
if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi

cmake --preset fuzz "${launcher[@]}" >/dev/null && cmake --build --preset fuzz -j "$jobs" --target temper_fuzz >/dev/null || exit 1
program=$PWD/build/fuzz/tests/fuzz/temper_fuzz
folder=$PWD/build/fuzz
mkdir -p "$folder/logs" "$folder/finds"

targets=("$@")
if ((${#targets[@]} == 0)); then mapfile -t targets < <("$program" --list); fi

fuzz() {  # TARGET
  export TEMPER_FUZZ_TARGET=$1 UBSAN_OPTIONS=print_stacktrace=1
  mkdir -p "$folder/corpus/$1"
  "$program" --seeds "$folder/corpus/$1" >"$folder/logs/$1" 2>&1 || return
  "$program" "$folder/corpus/$1" -max_total_time="$seconds" -max_len=20000 -timeout=20 -rss_limit_mb=4096 -print_final_stats=1 \
    -artifact_prefix="$folder/finds/$1-" >>"$folder/logs/$1" 2>&1
}
export -f fuzz
export program folder seconds
touch "$folder/start"
printf '%s\0' "${targets[@]}" | xargs -0 -P "$jobs" -n 1 bash -c 'fuzz "$0" || echo "fuzz: ended with exit code $?" >>"$folder/logs/$0"'

total=0 finds=0
printf '| target | executions | a second | coverage | corpus | finds |\n|-|-|-|-|-|-|\n'
for target in "${targets[@]}"; do
  log=$folder/logs/$target
  last=$(grep -E '^#[0-9]+' "$log" | tail -n 1)
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  [[ -n "$executions" ]] || executions=$(sed -n 's/^#\([0-9]*\).*/\1/p' <<<"$last")
  coverage=$(grep -oE 'cov: [0-9]+' <<<"$last" | grep -oE '[0-9]+')
  corpus=$(find "$folder/corpus/$target" -type f 2>/dev/null | wc -l)
  n=$(find "$folder/finds" -name "$target-*" -newer "$folder/start" | wc -l)
  # A target that fails without an input is a find, too.
  if ((n == 0)) && grep -q '^fuzz: ended' "$log"; then n=1; fi
  printf '| %s | %s | %s | %s | %s | %s |\n' "$target" "${executions:-none}" $((${executions:-0} / (seconds > 0 ? seconds : 1))) "${coverage:-}" "$corpus" "$n"
  total=$((total + ${executions:-0})) finds=$((finds + n))
done
echo "${#targets[@]} targets, $total executions, $finds finds"
((finds == 0))
