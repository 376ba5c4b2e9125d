#!/usr/bin/env bash
# Tables 3 and 4 and the figures 6 to 8, 11 to 17 and 19 to 21 of Andre et al. 2012, from one command. Half an hour on one
# core: eight minutes for five bars of 10 000 spheres, twelve for cubes of 500 to 20 000 spheres on four seeds each, three
# for spreads of radii, two for the abacus. Finished runs are skipped. Cubes of 500 to 2000 spheres may miss what
# silica_bulk.prm expects of 10 000: that is told, and is figure 17.
# Usage: bench/andre/run.sh FOLDER [PROGRAMS]   (PROGRAMS: folder of the programs, or platen-bar in it; default build/apps)
# Writes into FOLDER: runs.csv (one row a seed), tables.csv (medians beside the published figures), wave.csv,
# energy_static.csv, energy_dynamic.csv; isotropy.csv, histogram.csv, refinement.csv, scatter.csv, scatter_summary.csv
# (columns: curves.py) and abacus.csv.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
folder=${1:?folder for the results}
programs=${2:-$root/build/apps}
[ -d "$programs" ] || programs=$(dirname "$programs")
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)

run() { # name program scene [entry...]
  local name=$1 program=$2 scene=$3 entries=() entry
  shift 3
  grep -qs '"status": "done"' "$folder/$name/summary.json" && return
  for entry in "$@"; do entries+=(-s "$entry"); done
  nice -n 5 "$programs/$program" "$root/scenes/$scene.prm" -o "$folder/$name" --overwrite -t 1 --quiet "${entries[@]}" ||
    echo "$name: exit status $?" >&2
}

pack() { # number kappa seed: the cube of silica_bulk.prm, in which 1 mm makes 10 000 spheres
  run "pack_$1_$2_$3" platen-pack silica_bulk "Scene/Seed = $3" "Specimen/Radius spread = $2" \
    "Specimen/Sphere radius = $(awk "BEGIN { printf \"%.6g\", (10000 / $1) ^ (1 / 3) }") mm"
}

bulk() { # number seed: moduli by static solves on that cube
  pack "$1" 0.25 "$2"
  run "bulk_$1_$2" platen-bar silica_bulk "Specimen/Packing = file" \
    "Specimen/File = $folder/pack_$1_0.25_$2/specimen.csv"
}

for seed in 1 2 3 4 5; do
  run "bar_$seed" platen-bar bar_silica "Scene/Seed = $seed"
  bulk 10000 "$seed"
done
for seed in 1 2 3 4; do
  for number in 500 1000 2000 4000 7500 15000 20000; do bulk $number $seed; done
done
for seed in 1 2 3; do
  for kappa in 0 0.025 0.05 0.1 0.15 0.2 0.25 0.3 0.4 0.5; do pack 4000 $kappa $seed; done
done
python3 -B "$root/bench/andre/lattice.py" "$folder/lattice.csv"
run lattice platen-pack silica_bulk "Specimen/Packing = file" "Specimen/File = $folder/lattice.csv"
run abacus platen-calibrate abacus_silica
cp "$folder/abacus/abacus.csv" "$folder/abacus.csv"

python3 -B "$root/bench/andre/curves.py" "$folder"
python3 -B "$root/bench/andre/table.py" "$folder"
