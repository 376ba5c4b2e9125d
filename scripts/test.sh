#!/usr/bin/env bash
# Sets up, builds everything into build/ (scripts/build.sh) and runs all tests; the exit status is that of ctest.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/build.sh
exec ctest --test-dir build --output-on-failure -j2
