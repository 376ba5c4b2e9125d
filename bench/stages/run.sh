#!/usr/bin/env bash
# Boxes between four and six platens, and tests by stages: biaxial strength between dry steel and brushes, true triaxial
# compression beside a cell, with the packing turned and with the loads turned with it, one specimen at several pressures
# beside one at each, a specimen led through its fall, soft and stiff machines. Finished runs are skipped; the table at the end
# is table.py's.
# Usage: bench/stages/run.sh BUILD FOLDER [GROUP...], groups: biaxial true_triaxial turned multistage class_two machine
set -euo pipefail
[ $# -ge 2 ] || { echo "usage: $0 BUILD FOLDER [GROUP...]" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
scenes=$here/../../scenes
apps=$1/apps
folder=$2
shift 2
groups=${*:-biaxial true_triaxial turned multistage class_two machine}
jobs=$(nproc)
mkdir -p "$folder"

run() { # NAME SCENE OPTIONS...
  local name=$1 scene=$2
  shift 2
  if grep -qs '"status": "done"' "$folder/$name/summary.json"; then return; fi
  "$apps/platen-compress" "$scenes/$scene.prm" -o "$folder/$name" --overwrite -t 1 --quiet "$@" ||
    echo "$name: exit status $?" >&2
}

queue() { # waits for a free core
  while [ "$(jobs -rp | wc -l)" -ge "$jobs" ]; do wait -n || true; done
  run "$@" &
}

biaxial() {
  for platens in brush steel; do
    for share in 0.25 0.5 1; do
      queue "biaxial_${platens}_$share" "biaxial_$platens" -s "Loading/Stage 1/Lateral x = share of Axial $share"
    done
    queue "biaxial_${platens}_0" "biaxial_$platens" -s "Loading/Stage 1/Lateral x = free"
  done
}

true_triaxial() { # six greased platens beside the same pressure on the skin
  for seed in 1 2 3 4 5; do
    queue "six_$seed" true_triaxial -s "Scene/Seed = $seed" -s "Output/Fields = off"
    queue "cell_$seed" true_triaxial -s "Scene/Seed = $seed" -s "Output/Fields = off" \
      -s "Platens/Sides = two" -s "Loading/Confinement = particles" \
      -s "Loading/Stage 1/Lateral = pressure 5 MPa" -s "Loading/Stage 2/Lateral = pressure 5 MPa"
  done
}

# The packings of true_triaxial, turned by 90 degrees about each axis; and turned so that what lay along z lies along x, the
# loads with it.
turned() {
  for seed in 1 2 3; do
    if [ ! -e "$folder/packing_$seed/specimen.csv" ]; then
      "$apps/platen-pack" "$scenes/true_triaxial.prm" -o "$folder/packing_$seed" --overwrite --quiet -s "Scene/Seed = $seed"
    fi
    for turn in none x y z cycle; do
      python3 "$here/turn.py" "$folder/packing_$seed/specimen.csv" $turn "$folder/turned_${seed}_$turn.csv"
      file=(-s "Specimen/Packing = file" -s "Specimen/File = $(realpath "$folder")/turned_${seed}_$turn.csv" -s "Output/Fields = off")
      if [ $turn != cycle ]; then
        queue "equal_${seed}_$turn" true_triaxial "${file[@]}" -s "Loading/Stage 2/Until = time 1 us"
      else
        queue "loads_${seed}_z" true_triaxial "${file[@]}" -s "Specimen/File = $(realpath "$folder")/turned_${seed}_none.csv" \
          -s "Loading/Stage 2/Lateral = " -s "Loading/Stage 2/Lateral x = stress 5 MPa" -s "Loading/Stage 2/Lateral y = stress 5 MPa"
        queue "loads_${seed}_x" true_triaxial "${file[@]}" -s "Loading/Stage 2/Lateral = " -s "Loading/Stage 2/Lateral x = rate" \
          -s "Loading/Stage 2/Lateral y = stress 5 MPa" -s "Loading/Stage 2/Axial = stress 5 MPa" \
          -s "Loading/Stage 2/Until = Lateral x share of peak 0.8, Lateral x strain 1.5 %"
      fi
    done
  done
}

multistage() {
  for seed in 1 2 3; do
    queue "multistage_$seed" multistage_triaxial -s "Scene/Seed = $seed" -s "Output/Fields = off"
    for pressure in 2 5 10; do
      queue "single_${pressure}_$seed" concrete_dry -s "Scene/Seed = $seed" -s "Output/Fields = off" \
        -s "Specimen/Sphere radius = 2.4 mm" -s "Loading/Axial rate = 0.08 m/s" -s "Loading/Confinement = particles" \
        -s "Loading/Confining pressure = $pressure MPa" -s "Loading/Target strain = 2.5 %" -s "Loading/Stop at residual = 0.7"
    done
  done
}

class_two() {
  for seed in 1 2 3; do
    queue "led_$seed" class_two_concrete -s "Scene/Seed = $seed" -s "Output/Fields = off"
    queue "not_led_$seed" class_two_concrete -s "Scene/Seed = $seed" -s "Output/Fields = off" -s "Loading/Stage 1/Axial = rate" \
      -s "Loading/Stage 1/Until = strain 1 %"
  done
}

machine() {
  queue machine_rigid demo_dry -s "Output/Fields = off" -s "Loading/Target strain = 0.02"
  for stiffness in 3e9 4.5e8 1e8; do
    queue "machine_$stiffness" demo_dry -s "Output/Fields = off" -s "Loading/Target strain = 0.02" \
      -s "Platens/Machine stiffness = $stiffness"
  done
}

for group in $groups; do $group; done
wait
python3 "$here/table.py" "$folder"
