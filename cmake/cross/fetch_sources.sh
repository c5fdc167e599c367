#!/usr/bin/env bash
# Fills a folder with what TEMPER_CROSS_LIBRARIES compiles: source archives of Debian packages (or Ubuntu's), from where this
# machine's own packages come from, signed as those are; and the headers of NetCDF and HDF5.
#   cmake/cross/fetch_sources.sh FOLDER
# Neither root nor a change of the machine's sources is needed. What FOLDER has already stays. So another system needs no
# apt if it gets a full folder.
set -euo pipefail
folder=$1
mkdir -p "$folder"
cd "$folder"

missing=()
for package in pugixml zlib cli11 fmtlib nlohmann-json3 eigen3 coinutils clp onetbb; do
  compgen -G "${package}_*.orig.tar.*" >/dev/null || missing+=("$package")
done
if ((${#missing[@]})); then
  # The distribution's own release, as sources: point releases bring what its security updates had.
  apt-get indextargets --format '$(ORIGIN) deb-src $(REPO_URI) $(CODENAME) $(COMPONENT)' 'Created-By: Packages' |
    sed -nE 's/^(Debian|Ubuntu) (deb-src [^ ]+ [a-z]+ .*)/\2/p' | sort -u >sources.list
  mkdir -p lists/partial
  options=(-qq -o "Dir::Etc::SourceList=$PWD/sources.list" -o Dir::Etc::SourceParts=/dev/null -o "Dir::State::Lists=$PWD/lists"
           -o "Dir::Cache=$PWD" -o APT::Sandbox::User="$(id -un)")
  apt-get "${options[@]}" update
  apt-get "${options[@]}" source --download-only "${missing[@]}"
  rm -rf lists sources.list ./*.debian.tar.* ./*.dsc ./*.bin archives
fi

# The interfaces of both libraries are the same on all systems of 64 bits.
if [[ ! -d headers/netcdf && -f /usr/include/netcdf_mem.h ]]; then
  mkdir -p headers/netcdf
  cp /usr/include/netcdf.h /usr/include/netcdf_mem.h headers/netcdf
fi
if [[ ! -d headers/hdf5 && -f /usr/include/hdf5/serial/hdf5.h ]]; then
  mkdir -p headers
  cp -r /usr/include/hdf5/serial headers/hdf5
fi
