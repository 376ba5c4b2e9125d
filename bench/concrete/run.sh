#!/usr/bin/env bash
# The runs behind the calibrated concrete: cylinders, cubes, prisms and tension, five seeds; platen friction, end layers
# and half the rate, three seeds. About 50 runs of one to two minutes each on one core; finished runs are skipped.
# Usage: bench/concrete/run.sh FOLDER [platen-compress]; then bench/concrete/table.py FOLDER.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
folder=${1:?folder for the results}
program=${2:-$root/build/apps/platen-compress}
jobs=$(nproc)
mkdir -p "$folder"

run() { # name scene options...
  local name=$1 scene=$2
  shift 2
  [ -e "$folder/$name/summary.json" ] && return
  "$program" "$root/scenes/$scene.prm" -o "$folder/$name" --overwrite -t 1 --quiet -s "Output/Fields = off" "$@" ||
    echo "$name: exit status $?" >&2
}

queue() { # waits for a free core
  while [ "$(jobs -rp | wc -l)" -ge "$jobs" ]; do wait -n || true; done
  run "$@" &
}

for seed in 1 2 3 4 5; do
  for scene in concrete_dry concrete_lubricated concrete_tension cube_dry cube_lubricated prism_dry prism_lubricated; do
    queue "${scene}_$seed" $scene -s "Scene/Seed = $seed"
  done
done
for seed in 1 2 3; do
  for friction in 0.1 0.3 1; do
    queue "friction_${friction}_$seed" concrete_dry -s "Scene/Seed = $seed" -s "Platens/Friction static = $friction"
  done
  queue "layer_dry_$seed" concrete_dry -s "Scene/Seed = $seed" -s "Specimen/End layer = 0.6"
  queue "layer_lubricated_$seed" concrete_lubricated -s "Scene/Seed = $seed" -s "Specimen/End layer = 0.6"
  queue "half_rate_$seed" concrete_dry -s "Scene/Seed = $seed" -s "Loading/Axial rate = 0.0375 m/s"
done
wait
