#!/usr/bin/env bash
# Installs what Platen needs on Debian 12 and is not there yet, and further packages that are named. Where all is there it
# says so and touches nothing, the network included. --cluster: what tests of studies over nodes need too, Slurm and GNU
# parallel. --manual: what scripts/manual.sh makes the manual with, Sphinx and Doxygen.
#   scripts/setup.sh [--cluster] [--manual] [PACKAGE...]
set -euo pipefail

further=()
while true; do
  case "${1:-}" in
    --cluster) further+=(munge slurmctld slurmd slurm-client parallel) ;;
    --manual) further+=(python3-sphinx python3-myst-parser furo doxygen groff man-db mandoc) ;;
    *) break ;;
  esac
  shift
done

packages=(
  git g++ cmake ninja-build pkg-config # tools
  libdeal.ii-dev                       # finite elements; brings Trilinos, MPI and UMFPACK
  libopenmpi-dev openmpi-bin libtrilinos-zoltan-dev # specimens over MPI ranks
  libvtk9-dev                          # VTU files
  libeigen3-dev voro++-dev             # particle library
  libcli11-dev nlohmann-json3-dev libfmt-dev libxxhash-dev libssl-dev # apps
  libnlopt-dev libnlopt-cxx-dev # the search of platen-calibrate
  pybind11-dev python3-dev python3-numpy python3-matplotlib # the Python package, pictures
  libgtest-dev                         # tests; holds GTest's CMake configuration too
  "${further[@]}"
  "$@"
)

is_installed() { [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }

missing=()
for package in "${packages[@]}"; do
  is_installed "$package" || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  echo "setup: all ${#packages[@]} Debian packages that Platen needs are installed"
  exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || {
    echo "setup: run this as root, or install sudo; missing packages: ${missing[*]}" >&2
    exit 1
  }
  as_root=(sudo)
fi
echo "setup: installing ${missing[*]}"
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" apt-get update
"${as_root[@]}" apt-get install -y --no-install-recommends "${missing[@]}"
