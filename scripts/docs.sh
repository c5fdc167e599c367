#!/usr/bin/env bash
# Builds the documentation: scripts/docs/pages.py runs every command of the pages and compares numbers and pictures, and MkDocs makes
# a site. Any mistake on a page, any warning of Doxygen or MkDocs, and any dead link or anchor is an error.
#
#   scripts/docs.sh            to build/site: open index.html, or serve the folder
#   scripts/docs.sh --write    before that, puts what the program prints and draws into the pages
#   scripts/docs.sh --links    only MkDocs, without what it takes from the program, the module and the headers: finds pages that
#                              the navigation lacks, and dead links. Exit 77 if the package index does not give MkDocs.
#
# The references come from the program and the module, which are built (preset python), unless TEMPER_BUILD names a build.
# TEMPER_GALLERY names what `temper paper reproduce -o` wrote, TEMPER_PLAYGROUND the built playground: both go into the site.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
export PYTHONDONTWRITEBYTECODE=1 NO_MKDOCS_2_WARNING=1

# environment FOLDER PACKAGE …: installs these there; with Debian's Python, for which the module is built.
environment() {
  local stamp
  stamp=$(cat scripts/docs/requirements.txt - <<<"$*" | sha256sum)
  [[ "$(cat "$1/stamp" 2>/dev/null)" != "$stamp" ]] || return 0
  /usr/bin/python3 -m venv --clear "$1" &&
    "$1/bin/pip" install --quiet --disable-pip-version-check --retries 1 -c scripts/docs/requirements.txt "${@:2}" || return
  echo "$stamp" >"$1/stamp"
}

# MkDocs with --quiet would not count its warnings, and nothing would be strict.
strict() { "$1/bin/mkdocs" build --strict "${@:2}" 2> >(grep -v '^INFO' >&2); }

if [[ "${1:-}" == --links ]]; then
  environment build/links mkdocs pymdown-extensions || { echo "the package index does not give MkDocs"; exit 77; }
  strict build/links -f scripts/docs/links.yml
  echo "$(find build/links/site -name '*.html' | wc -l) pages"
  exit
fi

scripts/bootstrap.sh build docs
if [[ -z "${TEMPER_BUILD:-}" ]]; then
  scripts/build.sh python
  TEMPER_BUILD=build/python
fi
TEMPER_BUILD=$(realpath "$TEMPER_BUILD")

/usr/bin/python3 scripts/docs/pages.py "$TEMPER_BUILD/apps/temper/temper" "$@"

environment build/docs -r scripts/docs/requirements.txt
export PYTHONPATH=$TEMPER_BUILD/python PATH="$PWD/build/docs/bin:$TEMPER_BUILD/apps/temper:$PATH"
strict build/docs
python3 scripts/check_links.py --site build/site
