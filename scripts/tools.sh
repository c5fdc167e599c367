# shellcheck shell=bash
# Tools that Debian does not have, in pinned versions, in build/tools: `source scripts/tools.sh`. Each function tool_NAME installs
# a tool if it is missing, prints its path, and fails if its registry does not give it.

# The commit before the change: where it left the main branch, or the one before the last.
base_of_change() {
  local base
  base=$(git merge-base HEAD origin/main 2>/dev/null || true)
  if [[ -z "$base" || "$base" == "$(git rev-parse HEAD)" ]]; then base=HEAD~1; fi
  echo "$base"
}

tool_actionlint() {
  local version=1.7.12 folder=$PWD/build/tools/bin python
  if [[ $("$folder/actionlint" -version 2>/dev/null | head -n 1) != v$version ]]; then
    python=$(tool_python go) || return  # Debian's Go is too old
    GOBIN=$folder GOFLAGS=-modcacherw "${python%/*}/go" install "github.com/rhysd/actionlint/cmd/actionlint@v$version" >&2 || return
  fi
  echo "$folder/actionlint"
}

# A Python with the packages of scripts/NAME-requirements.txt.
tool_python() {  # NAME
  local folder=$PWD/build/tools/$1 pins=scripts/$1-requirements.txt
  if [[ ! "$folder/stamp" -nt "$pins" ]]; then
    /usr/bin/python3 -m venv --clear "$folder" &&
      "$folder/bin/pip" install --quiet --disable-pip-version-check --retries 1 --timeout 20 -r "$pins" >&2 &&
      touch "$folder/stamp" || return
  fi
  echo "$folder/bin/python"
}
