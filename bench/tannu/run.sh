#!/usr/bin/env bash
# How far the packing and the stiffness between broken spheres move the cylinder of Tannu 2017, spheres of 1.25 mm, ground
# ends: an advancing front in the cylinder's own mould, the core of one in a larger mould, and a packing grown until it jams; each
# with the thesis' stiffness of contacts (1e-4 of the bond's) and with the bond's. docs/tannu_cylinder.md has the table.
# Usage: bench/tannu/run.sh BUILD FOLDER [SEED ...]     three to ten minutes a run on one core
set -euo pipefail
[ $# -ge 2 ] || { echo "usage: $0 BUILD FOLDER [SEED ...]" >&2; exit 2; }
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
scene=$here/../../scenes/tannu_r1.25_ground.prm
build=$1 folder=$2
shift 2
mkdir -p "$folder"

for seed in "${@:-1}"; do
  common=(--overwrite --quiet -t 1 -s "Scene/Seed = $seed")
  core=$folder/core_$seed.csv
  if [ ! -e "$core" ]; then
    "$build/apps/platen-pack" "$scene" -o "$folder/large_$seed" "${common[@]}" -s "Specimen/Radius = 32 mm" -s "Specimen/Height = 96 mm"
    python3 "$here/core.py" "$folder/large_$seed/specimen.csv" 0.025 0.08 > "$core"
  fi
  for packing in front core jammed; do
    case $packing in
      front) specimen=() ;;
      core) specimen=(-s "Specimen/Packing = file" -s "Specimen/File = $core") ;;
      jammed) specimen=(-s "Specimen/Packing = random close") ;;
    esac
    for stiffness in thesis bond; do
      [ $stiffness = thesis ] && contact=() || contact=(-s "Contact/Stiffness = 1")
      name=$folder/${packing}_${stiffness}_$seed
      grep -qs '"status": "done"' "$name/summary.json" ||
        "$build/apps/platen-compress" "$scene" -o "$name" "${common[@]}" "${specimen[@]}" "${contact[@]}" -s "Output/Fields = off" ||
        [ $? -eq 1 ] # not what the scene expects
    done
  done
done
python3 "$here/table.py" "$folder"
