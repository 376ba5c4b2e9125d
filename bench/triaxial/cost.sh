#!/usr/bin/env bash
# What a sleeve costs beside the same pressure on the skin: 20 000 spheres, the cell's pressure rising to 9 MPa in 0.2 ms and
# a little axial strain, in turn; seconds a thousand steps, without set-up.
# Usage: bench/triaxial/cost.sh BUILD FOLDER [TURNS [THREADS]]
set -euo pipefail
[ $# -ge 2 ] || { echo "usage: $0 BUILD FOLDER [TURNS [THREADS]]" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
scene=$here/../../scenes/brittle_concrete_triaxial.prm
app=$1/apps/platen-compress
folder=$2
turns=${3:-3}
threads=${4:-2}
mkdir -p "$folder"

# run NAME [ENTRY ...]; the scene's own numbers do not hold for so short a run.
run() {
  local name=$1
  shift
  local entries=()
  for entry in "$@"; do entries+=(-s "$entry"); done
  "$app" "$scene" -t "$threads" -o "$folder/$name" --overwrite --quiet -s "Output/Fields = off" \
    -s "Specimen/Sphere radius = 1.121 mm" -s "Loading/Confining ramp = 0.2 ms" -s "Loading/Target strain = 2e-5" \
    "${entries[@]}" 2>"$folder/$name.log" || [ $? -eq 1 ]
}

if [ ! -e "$folder/pack/specimen.csv" ]; then run pack "Loading/Confinement = none" "Loading/Confining pressure = 0"; fi
packed=("Specimen/Packing = file" "Specimen/File = $(realpath "$folder")/pack/specimen.csv" "Output/Every = 100")
for turn in $(seq "$turns"); do
  for kind in particles sleeve; do run "${kind}_$turn" "${packed[@]}" "Loading/Confinement = $kind"; done
done
PYTHONPATH=$here/../../python python3 - "$folder" "$turns" <<'P'
import sys

import platen

print("| turn | particles | sleeve | |\n| --- | --- | --- | --- |")
for turn in range(1, int(sys.argv[2]) + 1):
    seconds = []
    for kind in ("particles", "sleeve"):
        s = platen.Run(f"{sys.argv[1]}/{kind}_{turn}").summary
        seconds.append(1000 * (s["wall_seconds"] - s["setup_seconds"]) / s["steps"])
    print(f"| {turn} | {seconds[0]:.3f} | {seconds[1]:.3f} | {100 * (seconds[1] / seconds[0] - 1):+.0f} % |")
P
