#!/usr/bin/env bash
# Prints the folder of a CPython for x86-64, with its headers: scripts/python.sh 3.14 [linux|windows]
#
# Maven Central has it, as a part of JavaCPP. It is unpacked into build/cpython, and nothing of the machine changes. For Linux
# the folder has bin/python3.14, which runs on Debian 12 or later. For Windows it has python.exe, which Wine runs, and the DLL.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# The release, and the SHA-256 of its archive for each system.
declare -A releases=(
  [3.10]="3.10.8-1.5.8
    linux 2f101b1aa06effdbda3c318c1728b13f22b571707c7b7704abaf5d19a33aa981
    windows 1e7d342425c87184fbedd8754045db556c63765678a0f11b4539465642ab018b"
  [3.11]="3.11.3-1.5.9
    linux 668b42f6a8b1a9789de7d3ca54a81fefb754cd8e885554b42858bbcbc0dd497c
    windows 3263a50b256447bb7b9e604d6587627e419891370fc33b94469e6a06ff4de834"
  [3.12]="3.12.1-1.5.10
    linux a135fcf4dc01adebf7ea439252276fc3196db80f7e0dd3da0b61f1ec489b68bd
    windows e69bc4491c311e19ea7169bafc5efbbe03b980d69c6962b049daf1fcb4913391"
  [3.13]="3.13.5-1.5.12
    linux 50ad91aa0baa57f0235bb666b87d8bf2a44e215d28c250de1030502906af143b
    windows cfe5502ffa7ea369be707b6d88bf68344732a7800450665080fb4267c01bfeae"
  [3.14]="3.14.3-1.5.13
    linux eb5f1a6fe2dc498ac18927189a37f28a47b0ba06ae6bd85112eff023fe2eb46f
    windows 3291bf3d8f405335ac21dbe55780521fdfd295b0f9f43f7e6e8c55bedd709cb3"
)
system=${2:-linux}
[[ $# -le 2 && -n ${1:-} && -n ${releases[$1]:-} && $system =~ ^(linux|windows)$ ]] ||
  { echo "python: expected 3.10, 3.11, 3.12, 3.13 or 3.14, then linux or windows, found '$*'" >&2; exit 2; }
read -r release _ <<<"${releases[$1]}"
checksum=$(sed -n "s/^ *$system //p" <<<"${releases[$1]}")
folder=$PWD/build/cpython/$1-$system
inside=org/bytedeco/cpython/$system-x86_64

if [[ ! -e $folder ]]; then
  mkdir -p "${folder%/*}"
  scratch=$(mktemp -d -p "${folder%/*}")
  trap 'rm -rf "$scratch"' EXIT
  curl -fsS --retry 3 -o "$scratch/python.jar" \
    "https://repo1.maven.org/maven2/org/bytedeco/cpython/$release/cpython-$release-$system-x86_64.jar"
  sha256sum --check --quiet <<<"$checksum  $scratch/python.jar"
  unzip -q "$scratch/python.jar" "$inside/*" -d "$scratch"
  if [[ $system == linux ]]; then chmod +x "$scratch/$inside"/bin/*; fi
  mv -T "$scratch/$inside" "$folder"
fi
echo "$folder"
