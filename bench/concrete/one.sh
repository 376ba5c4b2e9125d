#!/usr/bin/env bash
# One concrete in every test, on the packings 1 to 5 and on 6 and 7, which no calibration has seen: cylinders, cubes and prisms between dry and greased
# platens, cores, flat specimens, tension, splitting, bending, triaxial tests in a rubber sleeve, squares under biaxial stress; studies of platen-study.
# Ends with the table of one.py, beside what laboratories find. Goes on where it was stopped. About 40 minutes a packing on one core.
# Usage: bench/concrete/one.sh BUILD FOLDER CONCRETE [STUDY...], by default all of them. CONCRETE is `-`, that of the scenes, or a file of entries that
# follow those of each scene: bench/concrete/facet.prm.
set -euo pipefail
[ $# -ge 3 ] || { echo "usage: $0 BUILD FOLDER CONCRETE [STUDY...]" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
apps=$1/apps
folder=$2
concrete=$3
shift 3
only=" $* "
mkdir -p "$folder/scenes"

scene() { # NAME: its file, followed by the entries of the concrete
  local file=$folder/scenes/$1.prm
  { echo "include $here/../../scenes/$1.prm"; [ "$concrete" = - ] || sed "s|^include |include $here/../../scenes/|" "$concrete"; } >"$file"
  echo "$file"
}

study() { # NAME SCENE "ENTRY: VALUES" [ENTRY = VALUE ...]
  local name=$1 scene entries=(-s "Study/Seeds = 7" -s "Output/Fields = off" -s "Study/Vary 1 = $3") entry
  [[ $only = "  " || $only = *" $name "* ]] || return 0
  scene=$(scene "$2")
  shift 3
  for entry in "$@"; do entries+=(-s "$entry"); done
  [ ! -d "$folder/$name" ] || entries+=(--resume)
  "$apps/platen-study" vary "$scene" -o "$folder/$name" "${entries[@]}" || echo "$name: status $?" >&2 # 1: not what the scene expects
}

cores=("Loading/Target strain = 0.012" "Loading/Stop at residual = 0.7")
bare="Loading/Test: compression"
study concrete concrete_dry "Platens/Friction static: 0.57, 0, 0.3" # dry steel, grease, between them
study concrete-more concrete_dry "Platens/Friction static: 0.1, 1"
for form in cube prism; do # what laboratories do not tell: free ends are greased sheets (0.0048) or Teflon (0.03)
  study $form ${form}_dry "Platens/Friction static: 0.57, 0, 0.3"
  study $form-free ${form}_dry "Platens/Friction static: 0.0048, 0.03"
done
study core concrete_dry "Specimen/Height: 50 mm, 62.5 mm, 75 mm, 87.5 mm" "${cores[@]}"
study smooth_core concrete_dry "Specimen/Height: 62.5 mm" "${cores[@]}" "Platens/Friction static = 0.1"
study flat flat_dry "$bare"
study tension concrete_tension "Loading/Test: tension"
study bending bending_concrete "Loading/Test: three point bending"
study hydrostatic hydrostatic_concrete "Loading/Test: hydrostatic"
study uniaxial_strain uniaxial_strain_concrete "Loading/Test: uniaxial strain"
study triaxial_0 concrete_dry "$bare" "Specimen/Sphere radius = 1.78 mm" # the packing of the next, bare, at the same speed
study triaxial triaxial_concrete "Loading/Confining pressure: 1.5 MPa, 3 MPa, 9 MPa, 30 MPa"
study triaxial-more triaxial_concrete "Loading/Confining pressure: 4.5 MPa, 60 MPa"
sides="Loading/Stage 1/Lateral x: free, share of Axial 0.5, share of Axial 1"
study biaxial_smooth biaxial_steel "$sides" "Platens/Friction static = 0"
study biaxial_steel biaxial_steel "$sides"
study biaxial_brush biaxial_brush "$sides"
for platens in steel brush; do
  study biaxial_$platens-more biaxial_$platens "Loading/Stage 1/Lateral x: share of Axial 0.25"
done
study layer concrete_dry "Platens/Friction static: 0.57, 0" "Specimen/End layer = 0.6"
study half_rate concrete_dry "$bare" "Loading/Axial rate = 0.0375 m/s"
for seed in 1 2 3 4 5 6 7; do
  [ -e "$folder/splitting/runs/seed_$seed/summary.json" ] || [[ $only != "  " && $only != *" splitting "* ]] ||
    "$apps/platen-brazilian" "$(scene brazilian_concrete)" -o "$folder/splitting/runs/seed_$seed" --overwrite --quiet -s "Output/Fields = off" \
      -s "Scene/Seed = $seed" || echo "splitting, seed $seed: status $?" >&2
done
python3 "$here/one.py" "$folder"
