#!/usr/bin/env bash
# Crushes the same specimen twice, between dry and between lubricated platens, and shows what friction does; then asks how
# much of the strength is the platen's, short and slender, from dry steel to grease.
# Results: results/demo/dry, results/demo/lubricated and results/demo/friction; of an installed demo where it is called.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"

if [ -f "$root/scripts/build.sh" ]; then
  cd "$root"
  # What the demo runs, and what the lessons of docs/tutorial type after it.
  scripts/build.sh platen platen-pack platen-compress platen-study platen-calibrate platen-report platen_core
  apps=build/apps
else
  apps="$root/../../bin"
fi

# One thread each, side by side; every line says whose it is.
mkdir -p results/demo
crush() {
  "$apps"/platen-compress "$root/scenes/demo_$1.prm" -o "results/demo/$1" --overwrite -t 1 \
    > >(sed -u "s/^/$1: /") 2>&1 &
}
crush dry
dry=$!
crush lubricated
lubricated=$!
trap 'kill "$dry" "$lubricated" 2>/dev/null || true; wait || true; exit 130' INT TERM

# Status 1: the run is whole, but a figure that its scene expects did not come out; worth looking at all the same.
worst=0
finish() {
  local status=0
  wait "$2" || status=$?
  if [ "$status" -gt 1 ]; then
    echo "demo: the $1 run failed with status $status; see results/demo/$1/run.log" >&2
    kill "$dry" "$lubricated" 2>/dev/null || true
    exit "$status"
  fi
  if [ "$status" -eq 1 ]; then
    echo "demo: the $1 run did not give all the figures that its scene expects" >&2
    worst=1
  fi
}
finish dry "$dry"
finish lubricated "$lubricated"
trap - INT TERM

"$apps"/platen-report results/demo/lubricated
"$apps"/platen-report results/demo/dry --compare results/demo/lubricated

status=0
"$apps"/platen-study friction "$root/scenes/study_friction_quick.prm" -o results/demo/friction --overwrite || status=$?
[ "$status" -le 1 ] || exit "$status"
[ "$status" -eq 0 ] || worst=1
"$apps"/platen-report results/demo/friction

cat <<'END'

Pictures:        results/demo/dry/pictures/*.png, results/demo/lubricated/pictures/*.png
For ParaView:    results/demo/dry/specimen.pvd (also bonds.pvd, platens.pvd), the same under lubricated/
Numbers:         results/demo/dry/summary.json, history.csv, cracks.csv, the same under lubricated/

Two pages, open them in a browser:
  dry beside lubricated:                  results/demo/dry/pictures/report.html
  how much strength is the platen's:      results/demo/friction/pictures/report.html
END
exit "$worst"
