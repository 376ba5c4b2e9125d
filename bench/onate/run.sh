#!/usr/bin/env bash
# The laboratory tests of Onate et al. 2015 with the paper's parameters: cement, concrete, shale. Ends with the table of
# table.py. Runs that are whole are not made again. `scalars` leaves the curves under cell pressure out: what the paper
# gives as single figures, for several seeds (seeds.py FOLDER ... makes mean and scatter of them).
# Usage: bench/onate/run.sh BUILD FOLDER [SEED [all | scalars]]
set -euo pipefail
[ $# -ge 2 ] || { echo "usage: $0 BUILD FOLDER [SEED [all | scalars]]" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
scenes=$here/../../scenes
apps=$1/apps
folder=$2
seed=${3:-1}
what=${4:-all}
[ "$what" = all ] || [ "$what" = scalars ] || { echo "$0: all or scalars, not $what" >&2; exit 2; }
mkdir -p "$folder"

# run NAME APP SCENE [ENTRY ...]
run() {
  local name=$1 app=$2 scene=$3
  shift 3
  if grep -qs '"status": "done"' "$folder/$name/summary.json"; then return; fi
  local entries=(-s "Scene/Seed = $seed" -s "Output/Fields = off")
  for entry in "$@"; do entries+=(-s "$entry"); done
  echo "== $name"
  "$apps/$app" "$scenes/$scene.prm" -o "$folder/$name" --overwrite --quiet "${entries[@]}" ||
    echo "== $name: failed with status $?" >&2
}

run concrete_ucs platen-compress onate_concrete
run concrete_brazilian platen-brazilian onate_concrete_brazilian
run shale_ucs platen-compress onate_shale
run shale_brazilian platen-brazilian onate_shale_brazilian
run cement_ucs platen-compress onate_cement
run cement_brazilian platen-brazilian onate_cement_brazilian
run cement_uniaxial_strain platen-compress onate_cement_uniaxial_strain
if [ "$what" = scalars ]; then
  python3 "$here/table.py" "$folder"
  exit
fi
run concrete_4.5MPa platen-compress onate_concrete_triaxial "Loading/Confining pressure = 4.5 MPa"
run concrete_9MPa platen-compress onate_concrete_triaxial
run concrete_60MPa platen-compress onate_concrete_triaxial "Loading/Confining pressure = 60 MPa" "Loading/Target strain = 0.04"
run concrete_40MPa_cycled platen-compress onate_concrete_triaxial "Loading/Confining pressure = 40 MPa" \
  "Specimen/Sphere radius = 6 mm" "Loading/Unload at = 0.01, 0.02" "Loading/Unload to = 0.5"
# Limits of compression as the paper fits them to each pressure, then those of the unconfined test at all.
while read -r psi pressure limits; do
  run "cement_${psi}psi" platen-compress onate_cement_triaxial "Loading/Confining pressure = $pressure MPa" \
    "Bond/Compression limits = $limits"
  run "cement_${psi}psi_one_set" platen-compress onate_cement_triaxial "Loading/Confining pressure = $pressure MPa" \
    "Bond/Compression limits = 8.5 MPa, 9 MPa, 11 MPa" "Loading/Target strain = 0.08" # the cell alone closes by 3 %
done <<'PRESSURES'
500 3.447 9.5 MPa, 11 MPa, 13 MPa
1000 6.895 10 MPa, 11 MPa, 14 MPa
2000 13.79 13 MPa, 14 MPa, 15 MPa
4000 27.58 21 MPa, 23 MPa, 26 MPa
PRESSURES
python3 "$here/table.py" "$folder"
