#!/usr/bin/env bash
# Do the spheres' sizes matter? The cylinder of 50 mm x 100 mm of parts/concrete.prm between dry and greased platens, of
# spheres of each radius (mm), all other entries as they are. Ends with the table of sizes.py. Finished runs are skipped, and those
# of FOLDER/runs.csv, as in one.sh (bench/results/sizes.csv is the one behind bench/results/sizes.md).
# Usage: bench/concrete/sizes.sh BUILD FOLDER [SEED...], by default 1 2 3 4 5.
# RADII="1.78 1.41 1.25 1" names the radii, ENDS="dry lubricated" the platens; EXPONENTS="0.08 0.07" corrects modulus and strengths
# of the bonds, calibrated at 1.41 mm, by these powers (into a folder of its own).
# One core, by spheres across the diameter: 14: 20 s, 18: 45 s, 20: 75 s, 25: 3 minutes, 35: 12, 50: 50 a run.
set -euo pipefail
[ $# -ge 2 ] || { echo "usage: $0 BUILD FOLDER [SEED...]" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
scenes=$here/../../scenes
apps=$1/apps
folder=$2
shift 2
[ $# -gt 0 ] || set -- 1 2 3 4 5
jobs=${JOBS:-$(nproc)}
mkdir -p "$folder"
corrected=()
if [ -n "${EXPONENTS:-}" ]; then
  read -r modulus strength <<< "$EXPONENTS"
  corrected=(-s "Bond/Calibrated radius = 1.41 mm" -s "Bond/Modulus exponent = $modulus" -s "Bond/Strength exponent = $strength")
fi

run() { # NAME SCENE SEED RADIUS
  local name=$1_$3
  if grep -qs '"status": "done"' "$folder/$name/summary.json" || grep -qs "^$name," "$folder/runs.csv"; then return; fi
  "$apps/platen-compress" "$scenes/$2.prm" -o "$folder/$name" --overwrite -t 1 --quiet -s "Output/Fields = off" \
    -s "Scene/Seed = $3" -s "Specimen/Sphere radius = $4 mm" "${corrected[@]}" 2> "$folder/$name.log" ||
    [ $? -eq 1 ] || { echo "$name: $(tail -n 1 "$folder/$name.log")" >&2; } # 1: not what the scene expects
}

for radius in ${RADII:-1.78 1.41 1.25 1}; do
  for seed in "$@"; do
    for ends in ${ENDS:-dry lubricated}; do
      while [ "$(jobs -rp | wc -l)" -ge "$jobs" ]; do wait -n || true; done
      run "${ends}_$radius" "concrete_$ends" "$seed" "$radius" &
    done
  done
done
wait
python3 "$here/sizes.py" "$folder"
