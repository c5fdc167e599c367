#!/usr/bin/env bash
# Builds the documentation as a site, strictly: any warning, of Doxygen or MkDocs, is an error, and so is a dead link or anchor.
# Not a part of scripts/test.sh, which checks the links of the pages alone.
#
#   scripts/docs.sh            to build/site: open index.html, or serve the folder
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

# The module is built for Debian's Python; the environment must be of the same version.
venv=$PWD/build/docs
stamp=$(sha256sum <scripts/docs/requirements.txt)
if [[ "$(cat "$venv/stamp" 2>/dev/null)" != "$stamp" ]]; then
  /usr/bin/python3 -m venv --clear "$venv"
  "$venv/bin/pip" install --quiet --disable-pip-version-check -r scripts/docs/requirements.txt
  echo "$stamp" >"$venv/stamp"
fi

export PYTHONPATH=$(realpath "$TEMPER_BUILD")/python PYTHONDONTWRITEBYTECODE=1 PATH="$venv/bin:$PATH" NO_MKDOCS_2_WARNING=1
mkdocs build --strict --quiet
python3 scripts/check_links.py --site build/site
