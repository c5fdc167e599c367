#!/usr/bin/env bash
# Checks what no compiler reads: workflows, scripts, recipes, the container file, the citation, the version, and the messages of
# commits.
#
#   scripts/lint.sh             exit code 77 if a tool could not be installed; all others have run
#
# Tools come from Debian, PyPI and the Go module proxy, in pinned versions, into build/tools. TEMPER_WINGET_SCHEMAS: see
# scripts/check_recipes.py.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1
scripts/bootstrap.sh build lint || exit 1
source scripts/tools.sh

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
count=0 failed=0 missing=()
check() {  # NAME COMMAND …
  count=$((count + 1))
  "${@:2}" >"$scratch/log" 2>&1 && return
  failed=$((failed + 1))
  cat "$scratch/log"
  echo "lint: $1 failed"
}

recipes() {  # of a release that has no more than their names
  mkdir "$scratch/temper" && touch "$scratch/temper/temper.exe" "$scratch/temper-$(scripts/version.py).tar.gz" &&
    (cd "$scratch" && zip -qr "temper-$("$OLDPWD/scripts/version.py")-windows-x86_64.zip" temper) &&
    scripts/recipes.sh "$scratch" &&
    ruby -c "$scratch/recipes/homebrew/temper.rb" &&
    "$python" scripts/check_recipes.py "$scratch/recipes" && "$python" -m yamllint -s -c .yamllint "$scratch/recipes"
}

# Commits since the main branch, or the last one: the subject is `area: Do this`, and a large change has its reasons in a body.
messages() {
  local base commit subject lines wrong=0
  base=$(base_of_change)
  for commit in $(git rev-list --no-merges "$base..HEAD"); do
    subject=$(git log -1 --format=%s "$commit")
    lines=$(git show --numstat --format= "$commit" | awk '{ n += $1 + $2 } END { print n + 0 }')
    if ! [[ "$subject" =~ ^[^:]+:\ [A-Z] ]] || ((${#subject} > 72)); then
      echo "${commit:0:8} '$subject': expected 'area: Do this', at most 72 letters"; wrong=1
    fi
    if ((lines > 30)) && [[ -z "$(git log -1 --format=%b "$commit")" ]]; then
      echo "${commit:0:8} '$subject': $lines lines changed, and no body. Next: give problem, choice and evidence"; wrong=1
    fi
  done
  return "$wrong"
}

mapfile -t shells < <(git ls-files '*.sh' .ci/run 'packaging/debian/*/p*')
check "messages of commits" messages
check "version" scripts/version.py --check
check "shellcheck" shellcheck "${shells[@]}"
if actionlint=$(tool_actionlint); then check "actionlint" "$actionlint"; else missing+=(actionlint); fi
if python=$(tool_python lint); then
  check "zizmor" "$(dirname "$python")/zizmor" --offline --quiet .github
  check "yamllint" "$python" -m yamllint -s -c .yamllint .github CITATION.cff mkdocs.yml
  check "citation" "$(dirname "$python")/cffconvert" --validate
  check "hadolint" "$(dirname "$python")/hadolint" packaging/Containerfile
  check "recipes" recipes
else
  missing+=("Python packages")
fi

((failed == 0)) || exit 1
if ((${#missing[@]})); then echo "the registries do not give: ${missing[*]}"; exit 77; fi
echo "$count checks"
