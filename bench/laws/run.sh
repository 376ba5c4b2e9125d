#!/usr/bin/env bash
# One specimen, three bond laws: compression between dry platens and direct tension of the same packing, and a table.
# Usage: bench/laws/run.sh BUILD FOLDER [SEED ...]
set -euo pipefail
[ $# -ge 2 ] || { echo "usage: $0 BUILD FOLDER [SEED ...]" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
scenes=$here/../../scenes
build=$1 folder=$2
shift 2
mkdir -p "$folder"

for seed in "${@:-1}"; do
  packing=$folder/packing_$seed
  [ -e "$packing/specimen.csv" ] ||
    "$build/apps/platen-pack" "$scenes/three_laws_parallel_bond.prm" -o "$packing" --overwrite --quiet -s "Scene/Seed = $seed"
  for law in parallel_bond cohesive_beam elasto_damage_plastic; do
    common=(--overwrite --quiet -t 1 -s "Scene/Seed = $seed" -s "Specimen/Packing = file"
      -s "Specimen/File = $packing/specimen.csv" -s "Output/Fields = off")
    name=$folder/${law}_$seed
    grep -qs '"status": "done"' "$name/summary.json" ||
      "$build/apps/platen-compress" "$scenes/three_laws_$law.prm" -o "$name" "${common[@]}"
    grep -qs '"status": "done"' "${name}_tension/summary.json" ||
      "$build/apps/platen-compress" "$scenes/three_laws_$law.prm" -o "${name}_tension" "${common[@]}" \
        -s "Loading/Test = tension" -s "Platens/Attachment = glued" -s "Loading/Axial rate = 0.012 m/s" \
        -s "Loading/Target strain = 0.001"
  done
done
python3 "$here/table.py" "$folder"
