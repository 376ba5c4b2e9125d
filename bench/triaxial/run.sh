#!/usr/bin/env bash
# Triaxial compression at the cell pressures of Sfer et al. 2002 (0 ... 60 MPa): a concrete of parallel bonds and one of
# elasto-damage-plastic interfaces, in a rubber sleeve and with the pressure on the skin. Ends with the table of table.py.
# Runs that are whole are not made again.
# Usage: bench/triaxial/run.sh BUILD FOLDER [SEED [THREADS [KINDS]]], kinds by default "sleeve particles"
set -euo pipefail
[ $# -ge 2 ] || { echo "usage: $0 BUILD FOLDER [SEED [THREADS [KINDS]]]" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
scenes=$here/../../scenes
apps=$1/apps
folder=$2
seed=${3:-1}
threads=${4:-1}
kinds=${5:-sleeve particles}
mkdir -p "$folder"

# run LAW SCENE CONFINEMENT PRESSURE_IN_MPa TARGET_STRAIN AXIAL_RATE
run() {
  local name=$1_$3_$4
  if grep -qs '"status": "done"' "$folder/$name/summary.json"; then return; fi
  echo "== $name"
  "$apps/platen-compress" "$scenes/$2.prm" -o "$folder/$name" --overwrite --quiet -t "$threads" \
    -s "Scene/Seed = $seed" -s "Loading/Confinement = $3" -s "Loading/Confining pressure = $4 MPa" \
    -s "Loading/Target strain = $5" -s "Loading/Axial rate = $6 m/s" -s "Loading/Stop at residual = 0" -s "Output/Fields = off" ||
    echo "== $name: failed with status $?" >&2
}

# A specimen without pressure has fallen before the others have come to their peak; those take the time for more haste.
for kind in $kinds; do
  run parallel_bond brittle_concrete_triaxial none 0 0.01 0.08
  run parallel_bond brittle_concrete_triaxial $kind 4.5 0.015 0.1
  run parallel_bond brittle_concrete_triaxial $kind 60 0.04 0.2
  run parallel_bond brittle_concrete_triaxial $kind 9 0.02 0.1
  run parallel_bond brittle_concrete_triaxial $kind 30 0.03 0.2
  run parallel_bond brittle_concrete_triaxial $kind 1.5 0.01 0.1
  run elasto_damage_plastic onate_concrete_triaxial none 0 0.01 0.3
  run elasto_damage_plastic onate_concrete_triaxial $kind 60 0.05 0.6
  run elasto_damage_plastic onate_concrete_triaxial $kind 4.5 0.02 0.3
  run elasto_damage_plastic onate_concrete_triaxial $kind 9 0.025 0.3
  run elasto_damage_plastic onate_concrete_triaxial $kind 30 0.04 0.6
  run elasto_damage_plastic onate_concrete_triaxial $kind 1.5 0.015 0.3
done
python3 "$here/table.py" "$folder"
