#!/usr/bin/env bash
# Tables 3 and 4 and the figures 6 to 8, 11 to 17 and 19 to 21 of Andre et al. 2012, from one command. Half an hour on one
# core: eight minutes for five bars of 10 000 spheres, twelve for cubes of 500 to 20 000 spheres on four seeds each, three
# for spreads of radii, two for the abacus. Finished runs are skipped. Cubes of 500 to 2000 spheres may miss what
# silica_bulk.prm expects of 10 000: that is told, and is figure 17.
# Usage: bench/andre/run.sh FOLDER [BUILD]
# FOLDER/bars: errors at rest and swinging, shares of the energy; bulks: moduli; packings: isotropy.csv, histogram.csv (isotropy.py);
# abacus/abacus.csv. Energies and waves of figures 19 to 21: history.csv of a bar.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
folder=$(realpath -m "${1:?folder for the results}")
programs=${2:-$root/build}/apps
mkdir -p "$folder"

run() { # name program scene [entry...]
  local name=$1 program=$2 scene=$3 entries=() entry
  shift 3
  grep -qs '"status": "done"' "$folder/$name/summary.json" && return
  for entry in "$@"; do entries+=(-s "$entry"); done
  nice -n 5 "$programs/$program" "$root/scenes/$scene.prm" -o "$folder/$name" --overwrite -t 1 --quiet "${entries[@]}" ||
    echo "$name: exit status $?" >&2
}

pack() { # number kappa seed: the cube of silica_bulk.prm, in which 1 mm makes 10 000 spheres
  run "packings/pack_$1_$2_seed_$3" platen-pack silica_bulk "Scene/Seed = $3" "Specimen/Radius spread = $2" \
    "Specimen/Sphere radius = $(awk "BEGIN { printf \"%.6g\", (10000 / $1) ^ (1 / 3) }") mm"
}

for seed in 1 2 3 4 5; do
  run "bars/bar_seed_$seed" platen-bar bar_silica "Scene/Seed = $seed"
  for number in 10000 500 1000 2000 4000 7500 15000 20000; do # moduli by static solves on that cube
    [ $seed -lt 5 ] || [ $number = 10000 ] || continue
    pack $number 0.25 $seed
    run "bulks/bulk_${number}_seed_$seed" platen-bar silica_bulk "Specimen/Packing = file" \
      "Specimen/File = $folder/packings/pack_${number}_0.25_seed_$seed/specimen.csv"
  done
done
for seed in 1 2 3; do
  for kappa in 0 0.025 0.05 0.1 0.15 0.2 0.25 0.3 0.4 0.5; do pack 4000 $kappa $seed; done
done
python3 -B "$root/bench/specimen.py" lattice 0.041 20 >"$folder/lattice.csv" # the ordered packing: 4000 spheres in the cube
run packings/lattice platen-pack silica_bulk "Specimen/Packing = file" "Specimen/File = $folder/lattice.csv"
run abacus platen-calibrate abacus_silica

table() { python3 -B "$root/bench/figures.py" "$@"; }
table --median "$folder/bars" tension/static_error {bending,torsion}/static_error{,_effective} tension/dynamic_error \
  {bending,torsion}/dynamic_error{,_effective} impact/wave_error {tension,bending,torsion}/{axial,bending,torsion}_energy_share
table "$folder/bulks" youngs_modulus_gauge_pa poisson_ratio bulk/youngs_modulus_pa bulk/poisson_ratio
python3 -B "$root/bench/andre/isotropy.py" "$folder/packings"
