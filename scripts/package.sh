#!/usr/bin/env bash
# Makes the Debian packages of Platen for the Debian that it runs on, into build-package/: platen, libplaten-dev, platen-doc and
# python3-platen; and lets lintian judge them.
#   scripts/package.sh [BUILD]
# Their maintainer is DEBFULLNAME with the address DEBEMAIL, where both are set.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=${1:-build-package}

scripts/setup.sh lintian dpkg-dev file gzip
launcher=()
if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=/usr -DPLATEN_APPS=ON -DPLATEN_PYTHON=ON \
  -DPLATEN_TESTS=OFF -DPLATEN_BENCH=OFF "${launcher[@]}"
cmake --build "$build"
scripts/manual.sh "$build"
(cd "$build" && rm -f ./*.deb && cpack -G DEB)
# The compiled part of each package is checked; what lintian calls an error ends this with its status.
lintian --fail-on error --suppress-tags bad-distribution-in-changes-file "$build"/*.deb
ls -l "$build"/*.deb
