#!/usr/bin/env bash
# Writes the man pages of the programs in BUILD and has them checked by what formatters there are; then breaks one, which
# has to be told.
#   man_pages_test.sh PYTHON BUILD
set -euo pipefail
scripts="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)/scripts"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

"$1" -B "$scripts/man_pages.py" "$2" "$work"
"$1" -B "$scripts/man_pages.py" --lint "$work"
[ "$(ls "$work/man1" | wc -l)" -eq 9 ]
for section in NAME SYNOPSIS DESCRIPTION OPTIONS "EXIT STATUS" FILES EXAMPLES "SEE ALSO"; do
  grep -qx ".SH $section" "$work/man1/platen-compress.1" || { echo "no section $section"; exit 1; }
done
grep -q 'dry..run' "$work/man1/platen-compress.1"

printf '.nosuchmacro\n\\(zz\n' >> "$work/man1/platen.1"
if { command -v mandoc || command -v groff; } >/dev/null && "$1" -B "$scripts/man_pages.py" --lint "$work" >/dev/null; then
  echo "a page with a macro that there is not was let pass"
  exit 1
fi
