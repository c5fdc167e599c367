#!/usr/bin/env bash
# Completions really complete, and manual pages are well-formed: manual.sh PROGRAM
#
# What a shell offers after `temper VERB --` must be the options of `temper VERB --help-all`. Shells and mandoc that are not
# there are named in the last line.
set -uo pipefail
program=$1
PATH=$(dirname "$program"):$PATH
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch" || exit 1
mkdir here here/folder && touch here/in.vtu

checks=0 wrong=0 missing=()
expect() {  # WHAT EXPECTED FOUND
  checks=$((checks + 1))
  if [[ "$2" != "$3" ]]; then
    wrong=$((wrong + 1))
    printf '%s\n  expected: %s\n  found:    %s\n' "$1" "${2//$'\n'/ }" "${3//$'\n'/ }"
  fi
}
there() { command -v "$1" >/dev/null || { missing+=("$1"); false; }; }

mapfile -t verbs < <("$program" --help | sed -n '/^Verbs:/,/^$/s/^  \([a-z]*\) .*/\1/p')
((${#verbs[@]} > 5)) || { echo "no verbs in $program --help"; exit 1; }
options_of() {  # VERB: the options of its own, not those of the words after it
  { "$program" "$1" --help-all 2>/dev/null || "$program" "$1" --help; } | sed '/^[a-z-]*: /,$d' | sed -nE 's/^  ((-[a-z], )?--[a-z0-9-]+).*/\1/p' | sed 's/, /\n/' | sort
}

# --- bash: the function itself, with the words of a command line -------------------------------------------
"$program" --help=bash >temper.bash
# shellcheck source=/dev/null
source temper.bash
offers() {  # WORD …: what is offered for the last one
  cd here || exit
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
  _temper 2>&1
  printf '%s\n' "${COMPREPLY[@]}" | sort
}
expect "bash: verbs" "$(printf '%s\n' "${verbs[@]}" --help --version | sort)" "$(offers temper '')"
for verb in "${verbs[@]}"; do
  expect "bash: options of $verb" "$(options_of "$verb")" "$(offers temper "$verb" -)"
done
expect "bash: values with names" normal "$(offers temper optimize in.vtu --effort n)"
expect "bash: nothing for a number" "" "$(offers temper optimize in.vtu --time-limit '')"
expect "bash: files" $'folder\nin.vtu' "$(offers temper optimize '')"
expect "bash: files of an option" "in.vtu" "$(offers temper optimize -o in)"
expect "bash: words before files" "all" "$(offers temper weights in.vtu --edges al)"
expect "bash: folders" "folder" "$(offers temper operators in.vtu -o '')"
expect "bash: examples" $'random\nrandom-periodic\nrandom-sphere' "$(offers temper example rand)"
expect "bash: options of an example" $'--polygon\n--seed\n--vertices' \
  "$(offers temper example random -- | grep -vxF -f <(options_of example))"

# --- zsh and fish --------------------------------------------------------------------------------------------
"$program" --help=zsh >_temper
if there zsh; then
  zsh_offers() {  # WORD ...: what the function hands to those of zsh
    zsh -fc 'compdef() { }; _files() { print files $* }; _describe() { print -l -- $offers }; source ./_temper
             words=("$@") CURRENT=$# compstate=; _temper' zsh "$@" 2>/dev/null | sed -E 's/:.*//' | sort
  }
  expect "zsh: syntax" "" "$(zsh -n _temper 2>&1)"
  expect "zsh: verbs" "$(printf '%s\n' "${verbs[@]}" --help --version | sort)" "$(zsh_offers temper '')"
  expect "zsh: options" "$(options_of operators)" "$(zsh_offers temper operators -)"
  expect "zsh: values with names" $'high\nnormal\nquick' "$(zsh_offers temper optimize --effort '' | grep .)"
  expect "zsh: words beside files" $'all\nfiles\nlines' "$(zsh_offers temper weights in.vtu --edges '')"
  expect "zsh: folders" 'files -/' "$(zsh_offers temper operators in.vtu -o '' | grep .)"
fi
"$program" --help=fish >temper.fish
if there fish; then
  fish_offers() { HOME=$scratch fish --no-config -c "source temper.fish; cd here; complete -C '$1'" 2>&1 | cut -f 1 | sort -u; }
  expect "fish: syntax" "" "$(fish -n temper.fish 2>&1)"
  expect "fish: verbs" "$(printf '%s\n' "${verbs[@]}" | sort)" "$(fish_offers 'temper ')"
  expect "fish: options" "$(options_of operators | grep ^--)" "$(fish_offers 'temper operators --')"
  expect "fish: values with names" $'high\nnormal\nquick' "$(fish_offers 'temper optimize --effort ')"
  expect "fish: files" $'folder/\nin.vtu' "$(fish_offers 'temper check ')"
fi

# --- manual pages: no complaint but of the date, which would make each build another, and of long NAMEs -------
for verb in '' "${verbs[@]}"; do
  page=temper${verb:+-$verb}.1
  # shellcheck disable=SC2086 # no word where there is no verb
  "$program" $verb --help=man >"$page"
  if command -v mandoc >/dev/null; then expect "mandoc: $page" "" "$(mandoc -Tlint "$page" 2>&1 | grep -v -e 'missing date' -e ':3:.* longer than 80')"; fi
  if command -v groff >/dev/null; then expect "groff: $page" "" "$(groff -ww -man -Tascii "$page" 2>&1 >/dev/null)"; fi
  for option in $([[ -z "$verb" ]] || options_of "$verb"); do
    grep -qF -- "\\fB${option//-/\\-}\\fR" "$page" || expect "$page has $option" yes no
  done
done
there mandoc && there groff

echo "$checks checks, $wrong wrong${missing:+; not there: ${missing[*]}}"
((wrong == 0 && checks > 20))
