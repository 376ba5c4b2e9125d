#!/usr/bin/env bash
# Everything behind docs/accuracy.md and the five speeds of docs/theory.md: what each knob errs by and costs on two cylinders, with platens that yield and with a
# sleeve, and how strength goes with the size of spheres. Reports with plots are made of each study; ends with the tables of tables.py.
# Studies go on where they were stopped. About half an hour on two cores.
# Usage: bench/accuracy/run.sh BUILD FOLDER
set -euo pipefail
[ $# -eq 2 ] || { echo "usage: $0 BUILD FOLDER" >&2; exit 2; }
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
scenes=$(cd "$(dirname "$0")/../../scenes" && pwd)
apps=$(cd "$1/apps" && pwd)
mkdir -p "$2"
cd "$2"

# study NAME KIND SCENE [ENTRY ...]. What the scene expects need not hold (status 1): some runs are too fast on purpose.
study() {
  local name=$1 kind=$2 scene=$3 entries=() resume=()
  shift 3
  for entry in "$@"; do entries+=(-s "$entry"); done
  [ ! -d "$name" ] || resume=(--resume)
  echo "== $name"
  "$apps/platen-study" "$kind" "$scenes/$scene.prm" -o "$name" "${resume[@]}" "${entries[@]}" || [ $? -eq 1 ]
  "$apps/platen-report" "$name"
}

study quality accuracy study_quality_concrete
study knobs accuracy study_accuracy_concrete
study cylinder accuracy study_quality_cylinder
alone=("Study/Quality list =" "Study/Wave crossings list =" "Study/Seeds = 3")
study speeds rate brittle_concrete_dry "Specimen/Sphere radius = 1.78 mm" "Study/Axial rate list = 0.08 m/s, 0.16 m/s, 0.32 m/s, 0.8 m/s, 2 m/s" "Study/Seeds = 1" "Output/Fields = off"
python3 "$here/speeds.py" speeds # docs/theory.md, 5.3
study platens accuracy study_quality_concrete "${alone[@]}" "Platens/Kind = deformable" "Platens/Motion = quasi-static" \
  "Study/Steps per solve list = 100, 50, 20, 5" "Study/Platen mesh list = 4, 8, 16"
study sleeve accuracy study_quality_concrete "${alone[@]}" "Loading/Confinement = sleeve" \
  "Loading/Confining pressure = 4.5 MPa" "Loading/Target strain = 0.02" "Loading/Stop at residual = 0.7" \
  "Study/Sleeve mass scaling list = 1000, 100, 10, 1" "Study/Sleeve mesh list = 8, 10, 12, 16"
study size size study_size_concrete
python3 "$here/tables.py" quality knobs cylinder platens sleeve
