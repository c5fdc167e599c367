# shellcheck shell=bash
# Tools that Debian does not have, in pinned versions, in build/tools: `source scripts/tools.sh`. Each function installs a tool if
# it is missing, prints its path, and fails if its registry does not give it.

tool_actionlint() {
  local version=1.7.12 folder=$PWD/build/tools/bin go
  if [[ $("$folder/actionlint" -version 2>/dev/null | head -n 1) != v$version ]]; then
    # PyPI has Go itself.
    go=$(command -v go) || go=$(dirname "$(tool_python go)")/go || return
    GOBIN=$folder GOFLAGS=-modcacherw "$go" install "github.com/rhysd/actionlint/cmd/actionlint@v$version" >&2 || return
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
