#!/usr/bin/env bash
# One concrete in every test, on as many packings as seeds are named: cylinders, cubes and prisms between dry and greased
# platens, cores, flat specimens, tension, splitting, bending, triaxial tests in a rubber sleeve, squares under biaxial stress.
# Ends with the table of one.py, beside what laboratories find; seeds named after `unseen` stand in a column of their own.
# Finished runs are skipped, and those of FOLDER/runs.csv, which keeps what the table takes from each: to go on elsewhere, put that
# file into an empty folder (bench/results/one_concrete.csv is the one behind bench/results/one_concrete.md). About 40 minutes a seed on one core.
# Usage: bench/concrete/one.sh BUILD FOLDER [SEED...] [unseen SEED...], by default 1 2 3 4 5 unseen 6 7.
# GROUPS_RUN="uniaxial friction cores ends plain triaxial biaxial recipe" names what is run.
set -euo pipefail
[ $# -ge 2 ] || { echo "usage: $0 BUILD FOLDER [SEED...] [unseen SEED...]" >&2; exit 2; }
source "$(dirname "$0")/runs.sh" "$1" "$2"
shift 2
[ $# -gt 0 ] || set -- 1 2 3 4 5 unseen 6 7
seeds=${*//unseen/}
groups=${GROUPS_RUN:-uniaxial friction cores ends plain triaxial biaxial recipe}

uniaxial() {
  for scene in concrete_dry concrete_lubricated concrete_tension cube_dry cube_lubricated prism_dry prism_lubricated flat_dry; do
    queue $scene $scene "$1"
  done
}

cores() {
  for height in 50 62.5 75 87.5; do
    queue core_$height concrete_dry "$1" -s "Specimen/Height = $height mm" -s "Loading/Target strain = 0.012" \
      -s "Loading/Stop at residual = 0.7"
  done
}

plain() {
  for scene in brazilian_concrete bending_concrete hydrostatic_concrete uniaxial_strain_concrete; do
    queue $scene $scene "$1"
  done
}

triaxial() { # beside them the same packing bare, at the same speed of platens
  queue triaxial_0 concrete_dry "$1" -s "Specimen/Sphere radius = 1.78 mm"
  for pressure in 1.5 3 4.5 9 30 60; do
    queue triaxial_$pressure triaxial_concrete "$1" -s "Loading/Confining pressure = $pressure MPa"
  done
}

biaxial() {
  for platens in steel brush; do
    queue biaxial_${platens}_0 biaxial_$platens "$1" -s "Loading/Stage 1/Lateral x = free"
    for share in 0.25 0.5 1; do
      queue biaxial_${platens}_$share biaxial_$platens "$1" -s "Loading/Stage 1/Lateral x = share of Axial $share"
    done
  done
}

friction() { # between dry steel (0.57) and grease (0): 0.1 and 0.3
  for friction in 0.1 0.3; do
    queue friction_$friction concrete_dry "$1" -s "Platens/Friction static = $friction"
  done
}

ends() { # what laboratories do not tell: free ends are greased sheets (0.0048) or Teflon (0.03), capped cores smoother than dry steel
  for friction in 0.0048 0.03; do
    queue cube_$friction cube_lubricated "$1" -s "Platens/Friction static = $friction"
    queue prism_$friction prism_lubricated "$1" -s "Platens/Friction static = $friction"
  done
  queue core_62.5_0.1 concrete_dry "$1" -s "Specimen/Height = 62.5 mm" -s "Loading/Target strain = 0.012" \
    -s "Loading/Stop at residual = 0.7" -s "Platens/Friction static = 0.1"
}

recipe() { # what should not matter: rougher steel, a thicker end layer, half the speed
  queue friction_1 concrete_dry "$1" -s "Platens/Friction static = 1"
  queue layer_dry concrete_dry "$1" -s "Specimen/End layer = 0.6"
  queue layer_lubricated concrete_lubricated "$1" -s "Specimen/End layer = 0.6"
  queue half_rate concrete_dry "$1" -s "Loading/Axial rate = 0.0375 m/s"
}

for group in $groups; do
  for seed in $seeds; do $group "$seed"; done
done
wait
python3 "$here/one.py" "$folder" "$@"
