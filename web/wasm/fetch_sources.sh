#!/usr/bin/env bash
# Fetches source archives of Debian packages (or Ubuntu's), from where this machine's own packages come from, signed as those are:
#   web/wasm/fetch_sources.sh FOLDER PACKAGE ...
# Neither root nor a change of the machine's sources is needed. What FOLDER has already stays.
set -euo pipefail
folder=$1
shift
mkdir -p "$folder"
cd "$folder"

missing=()
for package in "$@"; do
  compgen -G "${package}_*.orig.tar.*" >/dev/null || missing+=("$package")
done
((${#missing[@]})) || exit 0

# The distribution's own release, as sources: point releases bring what its security updates had.
apt-get indextargets --format '$(ORIGIN) deb-src $(REPO_URI) $(CODENAME) $(COMPONENT)' 'Created-By: Packages' |
  sed -nE 's/^(Debian|Ubuntu) (deb-src [^ ]+ [a-z]+ .*)/\2/p' | sort -u >sources.list
mkdir -p lists/partial
options=(-qq -o "Dir::Etc::SourceList=$PWD/sources.list" -o Dir::Etc::SourceParts=/dev/null -o "Dir::State::Lists=$PWD/lists"
         -o "Dir::Cache=$PWD" -o APT::Sandbox::User="$(id -un)")
apt-get "${options[@]}" update
apt-get "${options[@]}" source --download-only "${missing[@]}"
