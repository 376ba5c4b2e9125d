#!/usr/bin/env bash
# The script in a fresh output folder draws its picture in plain pvpython, without a warning.
# Usage: view_script.sh PLATEN_COMPRESS SCENE PVPYTHON
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$1" "$2" -o "$folder/run" --quiet -s "Loading/Confinement = sleeve" -s "Loading/Confining pressure = 1 MPa" -s "Loading/Target strain = 0.001"
display=()
[ -n "${DISPLAY:-}" ] || display=(xvfb-run -a)
for by in damage displacement; do
  "${display[@]}" "$3" "$folder/run/view.py" --by $by --png "$folder/$by.png" >"$folder/said" 2>&1 || { cat "$folder/said"; exit 1; }
  [ -s "$folder/$by.png" ] || { echo "no picture"; exit 1; }
  if grep -iE "warn|error|traceback" "$folder/said"; then exit 1; fi
done
