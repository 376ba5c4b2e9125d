#!/usr/bin/env bash
# Makes the manual, a folder of pages that are read without a network: OUT/index.html, and the reference of the library in
# OUT/api. Entries of scenes, options and man pages are what the programs in BUILD say of themselves.
#   scripts/manual.sh [BUILD] [OUT]     default: build, build/manual
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
build="$(realpath -m "${1:-$root/build}")"
out="$(realpath -m "${2:-$build/manual}")"
pages="$out.pages" # what Sphinx reads

"$root"/scripts/setup.sh --manual
if [ ! -x "$build/apps/platen-compress" ]; then
  echo "manual: there are no programs in $build/apps; build them by scripts/build.sh" >&2
  exit 2
fi

# Debian's, whatever python3 comes first on the PATH: its packages are those that were installed.
python=/usr/bin/python3
rm -rf "$out" "$pages"
"$python" "$root"/scripts/manual_pages.py "$build" "$pages"
"$python" -m sphinx -b html -W --keep-going -q -j auto -c "$root/docs/manual" -d "$pages/.doctrees" "$pages" "$out"

mkdir -p "$out/api"
(
  cd "$root"
  cat docs/manual/Doxyfile - <<END | doxygen -
OUTPUT_DIRECTORY = "$out/api"
STRIP_FROM_PATH  = "$root"
INPUT_FILTER     = "$python $root/docs/manual/doxygen_filter.py"
END
)
"$python" "$root"/scripts/man_pages.py "$build" "$out/man"
rm -rf "$pages"
echo "manual: open $out/index.html"
