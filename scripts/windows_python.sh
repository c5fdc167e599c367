#!/usr/bin/env bash
# Prints the folder of CPython for Windows on x86-64: scripts/windows_python.sh 3.14
#
# With python.exe, which Wine runs, and with what a module compiles and links with: include/ and the DLL. Maven Central
# has it, as a part of JavaCPP. It goes into build/windows-python.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

declare -A releases=(
  [3.10]="3.10.8-1.5.8 1e7d342425c87184fbedd8754045db556c63765678a0f11b4539465642ab018b"
  [3.11]="3.11.3-1.5.9 3263a50b256447bb7b9e604d6587627e419891370fc33b94469e6a06ff4de834"
  [3.12]="3.12.1-1.5.10 e69bc4491c311e19ea7169bafc5efbbe03b980d69c6962b049daf1fcb4913391"
  [3.13]="3.13.5-1.5.12 cfe5502ffa7ea369be707b6d88bf68344732a7800450665080fb4267c01bfeae"
  [3.14]="3.14.3-1.5.13 3291bf3d8f405335ac21dbe55780521fdfd295b0f9f43f7e6e8c55bedd709cb3"
)
[[ -n ${1:-} && -n ${releases[$1]:-} ]] || { echo "windows_python: expected 3.10, 3.11, 3.12, 3.13 or 3.14, found '${1:-}'" >&2; exit 2; }
read -r release checksum <<<"${releases[$1]}"
folder=$PWD/build/windows-python/$1
inside=org/bytedeco/cpython/windows-x86_64

if [[ ! -e $folder/python.exe ]]; then
  scratch=$(mktemp -d)
  trap 'rm -rf "$scratch"' EXIT
  curl -fsS --retry 3 -o "$scratch/python.jar" \
    "https://repo1.maven.org/maven2/org/bytedeco/cpython/$release/cpython-$release-windows-x86_64.jar"
  sha256sum --check --quiet <<<"$checksum  $scratch/python.jar"
  unzip -q "$scratch/python.jar" "$inside/*" -x '*/lib/test/*' '*/lib/setuptools/*' -d "$scratch"
  mkdir -p "${folder%/*}"
  rm -rf "$folder"
  mv "$scratch/$inside" "$folder"
fi
echo "$folder"
