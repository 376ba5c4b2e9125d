#!/usr/bin/env bash
# Tables 3 and 4 of Andre et al. 2012 over five seeds, the moduli of the bulk, and the curves of his figures 12, 19, 20
# and 21, from one command: a bar of 10 000 spheres, two minutes a seed on one core; finished runs are skipped.
# Usage: bench/andre/run.sh FOLDER [platen-bar]
# Writes into FOLDER: runs.csv (one row a seed), tables.csv (medians beside the published figures), wave.csv,
# energy_static.csv and energy_dynamic.csv.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
folder=${1:?folder for the results}
program=${2:-$root/build/apps/platen-bar}
mkdir -p "$folder"

run() { # name scene seed
  [ -e "$folder/$1/summary.json" ] && return
  nice -n 5 "$program" "$root/scenes/$2.prm" -o "$folder/$1" --overwrite -t 1 --quiet -s "Scene/Seed = $3" ||
    echo "$1: exit status $?" >&2
}

for seed in 1 2 3 4 5; do
  run "bulk_$seed" silica_bulk "$seed"
  run "bar_$seed" bar_silica "$seed"
done
python3 "$root/bench/andre/table.py" "$folder"
