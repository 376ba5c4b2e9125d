#!/bin/bash
# Leaves out one effect after the other (and all together) from a build of its own, and compares history.csv of
# a scene in which that effect is off with that of the full build: they must agree to the byte.
#   scripts/compare_effects.sh BUILD WORK [EFFECT...]
# BUILD: folder of the full build; WORK: folder for builds and results. About two minutes an effect on two cores.
set -euo pipefail
[[ $# -ge 2 ]] || { sed -n '2,5s/^# //p' "$0" >&2; exit 2; }
source_folder=$(cd "$(dirname "$0")/.." && pwd)
build=$(cd "$1" && pwd)
mkdir -p "$2"
work=$(cd "$2" && pwd)
shift 2
all=(rotation bond_moments friction rolling hertz bond_dashpots contact_dashpots local_damping gravity energy_ledger
  crack_log)
[[ $# -gt 0 ]] && chosen=("$@") || chosen=("${all[@]}" all)

# What switches an effect off, from a scene that has it on (all but hertz, which is off unless asked for).
off() {
  case $1 in
    rotation) echo "Effects/Rotation = off;Effects/Tangential = coulomb" ;;
    bond_moments) echo "Effects/Bond moments = off" ;;
    friction) echo "Effects/Tangential = none;Contact/Rolling friction = 0" ;;
    rolling) echo "Effects/Tangential = coulomb;Contact/Rolling friction = 0" ;;
    hertz) echo "Effects/Contact = linear" ;;
    bond_dashpots) echo "Bond/Damping = 0" ;;
    contact_dashpots) echo "Contact/Damping = 0" ;;
    local_damping) echo "Integration/Damping = 0" ;;
    gravity) echo "Effects/Gravity = off" ;;
    energy_ledger) echo "Effects/Energy ledger = off" ;;
    crack_log) echo "Effects/Crack log = off" ;;
    all)
      for effect in "${all[@]}"; do [[ $effect == rolling ]] || off "$effect"; done | paste -sd ';'
      ;;
    *) echo "there is no effect $1" >&2; exit 2 ;;
  esac
}
on="Effects/Tangential = coulomb with rolling resistance;Contact/Rolling friction = 0.1;Bond/Damping = 0.05"
on+=";Effects/Gravity = on;Output/Fields = off;Loading/Target strain = 0.002"

run() { # BINARY FOLDER ENTRIES; of two entries with one key the last holds
  local arguments=() entries entry
  local -A last=()
  IFS=';' read -ra entries <<<"$3"
  for entry in "${entries[@]}"; do last[${entry%% = *}]=$entry; done
  for entry in "${last[@]}"; do arguments+=(-s "$entry"); done
  "$1" "$source_folder/tests/apps/scenes/crushed.prm" -o "$2" --overwrite --quiet "${arguments[@]}"
}

failed=0
for effect in "${chosen[@]}"; do
  without="$on;$(off "$effect")"
  left=
  [[ $effect == all ]] || left=$(printf '%s\n' "${all[@]}" | grep -vx "$effect" | paste -sd ';')
  # Rolling needs rotation and friction, moments need rotation.
  [[ $effect == rotation ]] && left=$(tr ';' '\n' <<<"$left" | grep -vx -e rolling -e bond_moments | paste -sd ';')
  cmake -S "$source_folder" -B "$work/build_$effect" -G Ninja -DPLATEN_TESTS=OFF -DPLATEN_BENCH=OFF \
    "-DPLATEN_EFFECTS=$left" >"$work/configure_$effect.log"
  ninja -C "$work/build_$effect" platen-compress >"$work/build_$effect.log"
  run "$build/apps/platen-compress" "$work/off_$effect" "$without"
  run "$work/build_$effect/apps/platen-compress" "$work/without_$effect" "$without"
  # A scene that calls for what is left out is refused.
  if [[ $effect != hertz ]] && run "$work/build_$effect/apps/platen-compress" "$work/refused" "$on" 2>"$work/refused.txt"
  then echo "$effect: the build without it ran a scene that calls for it"; failed=1
  elif [[ $effect != hertz ]] && ! grep -q PLATEN_EFFECTS "$work/refused.txt"
  then echo "$effect: refused for another reason: $(head -1 "$work/refused.txt")"; failed=1
  fi
  if cmp -s "$work/off_$effect/history.csv" "$work/without_$effect/history.csv"; then
    echo "$effect: the same $(wc -l <"$work/off_$effect/history.csv") lines"
  else
    echo "$effect: history.csv differs"
    failed=1
  fi
done
exit $failed
