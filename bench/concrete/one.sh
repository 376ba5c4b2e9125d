#!/usr/bin/env bash
# One concrete in every test: cylinders, cubes and prisms between dry and greased platens, flat specimens, tension, and
# triaxial tests in a rubber sleeve, on as many packings as seeds are named. Ends with the table of one.py, beside what
# laboratories find. Finished runs are skipped. About 25 minutes a seed on one core.
# Usage: bench/concrete/one.sh BUILD FOLDER [SEED...], seeds by default 1 2 3 4 5
set -euo pipefail
[ $# -ge 2 ] || { echo "usage: $0 BUILD FOLDER [SEED...]" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
scene=$here/../../scenes/yielding_concrete.prm
program=$1/apps/platen-compress
folder=$2
shift 2
seeds=${*:-1 2 3 4 5}
jobs=${JOBS:-$(nproc)}
mkdir -p "$folder"

run() { # NAME OPTIONS...
  local name=$1
  shift
  if grep -qs '"status": "done"' "$folder/$name/summary.json"; then return; fi
  "$program" "$scene" -o "$folder/$name" --overwrite -t 1 --quiet -s "Output/Fields = off" "$@" 2> "$folder/$name.log" ||
    [ $? -eq 1 ] || { echo "$name: $(tail -n 1 "$folder/$name.log")" >&2; } # 1: not what the cylinder expects
}

queue() { # waits for a free core
  while [ "$(jobs -rp | wc -l)" -ge "$jobs" ]; do wait -n || true; done
  run "$@" &
}

box() { # NAME HEIGHT_IN_MM SPHERE_IN_MM OPTIONS...
  local name=$1 height=$2 sphere=$3
  shift 3
  queue "$name" -s "Specimen/Shape = box" -s "Specimen/Radius =" -s "Specimen/Width x = 50 mm" -s "Specimen/Width y = 50 mm" \
    -s "Specimen/Height = $height mm" -s "Specimen/Sphere radius = $sphere mm" -s "Loading/Target strain = 0.012" "$@"
}

grease="Platens/Friction static = 0"
for seed in $seeds; do
  s=(-s "Scene/Seed = $seed")
  queue "dry_$seed" "${s[@]}"
  queue "lub_$seed" "${s[@]}" -s "$grease"
  queue "tension_$seed" "${s[@]}" -s "Platens/Attachment = glued" -s "Loading/Test = tension" -s "Loading/Axial rate = 0.012 m/s" \
    -s "Loading/Target strain = 0.001"
  box "cube_dry_$seed" 50 1.53 "${s[@]}"
  box "cube_lub_$seed" 50 1.53 "${s[@]}" -s "$grease"
  box "prism_dry_$seed" 120 1.6 "${s[@]}"
  box "prism_lub_$seed" 120 1.6 "${s[@]}" -s "$grease"
  queue "flat_$seed" "${s[@]}" -s "Specimen/Height = 25 mm" -s "Loading/Target strain = 0.05"
  # Half as many spheres, the unconfined strength of the same packing beside them.
  coarse=("${s[@]}" -s "Specimen/Sphere radius = 1.78 mm")
  queue "coarse_$seed" "${coarse[@]}"
  for pressure in 1.5 3 4.5 9 30; do
    queue "tri_${pressure}_$seed" "${coarse[@]}" -s "Loading/Confinement = sleeve" -s "Loading/Confining pressure = $pressure MPa" \
      -s "Sleeve/Thickness = 3 mm" -s "Sleeve/Modulus = 1.5 MPa" -s "Sleeve/Poisson ratio = 0.4995" \
      -s "Loading/Target strain = 0.035" -s "Loading/Stop at residual = 0.5"
  done
done
wait
python3 "$here/one.py" "$folder"
