#!/usr/bin/env bash
# Do the spheres' sizes matter? The cylinder of 50 mm x 100 mm of parts/concrete.prm between dry and greased platens, of
# spheres of each radius (mm), all other entries as they are. Ends with the table of sizes.py. Finished runs are skipped, and those
# of FOLDER/runs.csv, as in one.sh (bench/results/sizes.csv is the one behind bench/results/sizes.md).
# Usage: bench/concrete/sizes.sh BUILD FOLDER [SEED...], by default 1 2 3 4 5.
# RADII="1.78 1.41 1.25 1" names the radii, ENDS="dry lubricated" the platens; EXPONENTS="0.08 0.07" corrects modulus and strengths
# of the bonds, calibrated at 1.41 mm, by these powers (into a folder of its own).
# One core, by spheres across the diameter: 14: 20 s, 18: 45 s, 20: 75 s, 25: 3 minutes, 35: 15, 50: four hours a run.
set -euo pipefail
[ $# -ge 2 ] || { echo "usage: $0 BUILD FOLDER [SEED...]" >&2; exit 2; }
source "$(dirname "$0")/runs.sh" "$1" "$2"
shift 2
[ $# -gt 0 ] || set -- 1 2 3 4 5
corrected=()
if [ -n "${EXPONENTS:-}" ]; then
  read -r modulus strength <<< "$EXPONENTS"
  corrected=(-s "Bond/Calibrated radius = 1.41 mm" -s "Bond/Modulus exponent = $modulus" -s "Bond/Strength exponent = $strength")
fi

for radius in ${RADII:-1.78 1.41 1.25 1}; do
  for seed in "$@"; do
    for ends in ${ENDS:-dry lubricated}; do
      queue "${ends}_$radius" "concrete_$ends" "$seed" -s "Specimen/Sphere radius = $radius mm" "${corrected[@]}"
    done
  done
done
wait
python3 "$here/sizes.py" "$folder"
