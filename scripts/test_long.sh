#!/usr/bin/env bash
# Sets up (Clang, valgrind, chromium, Slurm and GNU parallel too), builds everything into build/ and runs all tests with their long forms: hours on two
# cores. What they find is kept in tests/verification/found.json and written to docs/verification.md. Then some single
# faults are made in a copy of the sources, and the tests asked whether they notice (build-mutation/). Arguments are
# those of verification.py:
#   scripts/test_long.sh --rows 34 35
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/setup.sh --cluster clang libclang-rt-dev llvm valgrind chromium chromium-driver lintian debootstrap buildah python3-nbconvert python3-ipykernel python3-matplotlib python3-pandas # fuzzing, sanitizers, memcheck, pages, packages, notebooks
scripts/build.sh
status=0
scripts/verification.py build --long --write "$@" || status=$?
scripts/mutation.py build-mutation --count 36 || status=$?
exit $status
