#!/usr/bin/env bash
# Builds the documentation: scripts/docs/pages.py runs every command of the pages and compares numbers and pictures, and MkDocs makes
# a site. Any mistake on a page, any warning of Doxygen or MkDocs, and any dead link or anchor is an error.
#
#   scripts/docs.sh            to build/site: open index.html, or serve the folder
#   scripts/docs.sh --write    before that, puts what the program prints and draws into the pages
#
# The reference of options comes from the module, which is built (preset python), unless TEMPER_BUILD names a build.
# TEMPER_GALLERY names what `temper paper reproduce -o` wrote, TEMPER_PLAYGROUND the built playground: both go into the site.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/bootstrap.sh build docs
if [[ -z "${TEMPER_BUILD:-}" ]]; then
  scripts/build.sh python
  TEMPER_BUILD=build/python
fi

/usr/bin/python3 scripts/docs/pages.py "$TEMPER_BUILD/apps/temper/temper" "$@"

# The module is built for Debian's Python; the environment must be of the same version.
venv=$PWD/build/docs
stamp=$(sha256sum <scripts/docs/requirements.txt)
if [[ "$(cat "$venv/stamp" 2>/dev/null)" != "$stamp" ]]; then
  /usr/bin/python3 -m venv --clear "$venv"
  "$venv/bin/pip" install --quiet --disable-pip-version-check -r scripts/docs/requirements.txt
  echo "$stamp" >"$venv/stamp"
fi

PYTHONPATH=$(realpath "$TEMPER_BUILD")/python
export PYTHONPATH PYTHONDONTWRITEBYTECODE=1 PATH="$venv/bin:$PATH" NO_MKDOCS_2_WARNING=1
mkdocs build --strict --quiet
python3 scripts/check_links.py --site build/site
