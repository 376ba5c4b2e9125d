#!/usr/bin/env bash
# Elastic platens on the cylinder of scenes/elastic_platens.prm: steel beside rigid on three seeds, meshes of 3 (the least that a round plate has) to 16
# elements across, platens from ten times to a twentieth as stiff as the concrete, and what they cost side by side.
# Ends with the tables of table.py. Runs that are whole are not made again, costs are.
# Usage: bench/platens/run.sh BUILD FOLDER [THREADS]
set -euo pipefail
[ $# -ge 2 ] || { echo "usage: $0 BUILD FOLDER [THREADS]" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
scene=$here/../../scenes/elastic_platens.prm
app=$1/apps/platen-compress
folder=$2
threads=${3:-1}
mkdir -p "$folder"

# run NAME [ENTRY ...]
run() {
  local name=$1
  shift
  if grep -qs '"status": "done"' "$folder/$name/summary.json"; then return; fi
  local entries=()
  for entry in "$@"; do entries+=(-s "$entry"); done
  echo "== $name"
  "$app" "$scene" -t "$threads" -o "$folder/$name" --overwrite --quiet -s "Output/Fields every = 0.5 ms" \
    "${entries[@]}" 2>"$folder/$name.log" || echo "== $name: status $?" >&2 # 1: not the scene's own numbers
}

rigid="Platens/Kind = rigid"
for seed in 1 2 3; do
  run "rigid_$seed" "Scene/Seed = $seed" "$rigid"
  packed=("Scene/Seed = $seed" "Specimen/Packing = file" "Specimen/File = $(realpath "$folder")/rigid_$seed/specimen.csv")
  for across in 8 4 3 16; do
    run "across_${across}_$seed" "${packed[@]}" "Platens/Elements across = $across"
  done
done
packed=("Specimen/Packing = file" "Specimen/File = $(realpath "$folder")/rigid_1/specimen.csv")
concrete=23 # GPa
for ratio in 10 3 1 0.05; do
  modulus=$(python3 -c "print($ratio * $concrete)")
  run "ratio_$ratio" "${packed[@]}" "Platens/Young modulus = $modulus GPa"
done
# Costs: few steps, one after the other, so that both see the same machine.
for size in 1.78 1.121; do
  run "pack_$size" "$rigid" "Specimen/Sphere radius = $size mm" "Loading/Target strain = 2e-5"
  for turn in 1 2 3; do
    for kind in rigid deformable; do
      rm -f "$folder/cost_${size}_${kind}_$turn/summary.json"
      run "cost_${size}_${kind}_$turn" "Platens/Kind = $kind" "Specimen/Sphere radius = $size mm" \
        "Specimen/Packing = file" "Specimen/File = $(realpath "$folder")/pack_$size/specimen.csv" \
        "Loading/Target strain = 2e-4" "Output/Every = 100" "Output/Fields = off"
    done
  done
done
python3 "$here/table.py" "$folder"
