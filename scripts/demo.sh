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

# Status 1: the run is whole, but a figure that its scene expects did not come out; worth looking at all the same.
worst=0
run() { # NAME COMMAND...: into results/demo/NAME
  local name=$1 status=0
  shift
  echo "== $name"
  "$@" -o "results/demo/$name" --overwrite || status=$?
  if [ "$status" -gt 1 ]; then
    echo "demo: the $name run failed with status $status; see results/demo/$name/run.log" >&2
    exit "$status"
  elif [ "$status" -eq 1 ]; then
    echo "demo: the $name run did not give all the figures that its scene expects" >&2
    worst=1
  fi
}
run dry "$apps"/platen-compress "$root/scenes/facet_dry.prm"
run lubricated "$apps"/platen-compress "$root/scenes/facet_lubricated.prm"
"$apps"/platen-report results/demo/lubricated
"$apps"/platen-report results/demo/dry --compare results/demo/lubricated

run friction "$apps"/platen-study friction "$root/scenes/study_friction_quick.prm"
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
