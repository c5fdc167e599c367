#!/usr/bin/env bash
# Publishes a release whose files are in FOLDER. Workflows call it; each step first verifies FOLDER/SHA256SUMS.
#
#   scripts/publish.sh draft FOLDER         drafts the release of tag vX.Y.Z on GitHub (needs gh and GH_TOKEN)
#   scripts/publish.sh registries FOLDER    downloads the published files and their provenance into FOLDER, verifies them, and
#                                           uploads wheels to PyPI and the npm package to npm, by trusted publishing
#   scripts/publish.sh rehearse FOLDER      uploads nothing: twine and npm check what they would upload
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

step=${1:-} folder=${2:-}
[[ "$step" =~ ^(draft|registries|rehearse)$ && -n "$folder" ]] || { echo "usage: scripts/publish.sh draft|registries|rehearse FOLDER" >&2; exit 2; }
source scripts/tools.sh
[[ "$step" == registries || -f "$folder/SHA256SUMS" ]] || { echo "publish: $folder has no SHA256SUMS; scripts/release.sh writes it" >&2; exit 1; }
folder=$(realpath -m "$folder")  # npm takes a/b for a repository on GitHub
tag=v$(scripts/version.py)
[[ "$step" == rehearse ]] || scripts/version.py --tag "${GITHUB_REF_NAME:?the tag}"

if [[ "$step" == registries ]]; then
  gh release download "$tag" --dir "$folder" --clobber
  for file in "$folder"/*; do
    [[ "$file" == */SHA256SUMS ]] || gh attestation verify "$file" --repo "${GITHUB_REPOSITORY:?}" \
      --signer-workflow "$GITHUB_REPOSITORY/.github/workflows/release.yml"
  done
fi
(cd "$folder" && sha256sum --check --quiet --strict SHA256SUMS)

case "$step" in
  draft)
    notes=$(mktemp)
    trap 'rm "$notes"' EXIT
    # Of the changes, those of this version: up to the next heading.
    awk -v heading="## ${tag#v}," 'index($0, heading) == 1 {inside = 1; next} /^## / {inside = 0} inside' CHANGELOG.md >"$notes"
    mapfile -t files < <(find "$folder" -maxdepth 1 -type f | sort)
    gh release create "$tag" --verify-tag --draft --title "temper ${tag#v}" --notes-file "$notes" "${files[@]}"
    ;;
  registries)
    python=$(tool_python release)
    # A second run, after a failure, uploads what is not there.
    package=$(ls "$folder"/temper-mesh-*.tgz)
    published=$(npm view "temper-mesh@${tag#v}" dist.shasum 2>/dev/null || true)
    if [[ -z "$published" ]]; then
      npm publish --provenance --access public "$package"
    elif [[ "$published" != "$(sha1sum "$package" | cut -d ' ' -f 1)" ]]; then
      echo "publish: npm has another temper-mesh ${tag#v}, with checksum $published" >&2
      exit 1
    fi
    "$python" -m twine upload --non-interactive --skip-existing "$folder"/temper_mesh-*
    ;;
  rehearse)
    python=$(tool_python release)
    "$python" -m twine check --strict "$folder"/temper_mesh-*
    npm publish --dry-run "$folder"/temper-mesh-*.tgz
    ;;
esac
