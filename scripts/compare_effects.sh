#!/bin/bash
# Leaves out one effect after the other (and all together) from a build of its own, and compares history.csv of
# a scene in which that effect is off with that of the full build: they must agree to the byte.
#   scripts/compare_effects.sh BUILD WORK [EFFECT...]
# BUILD: folder of the full build; WORK: folder for builds and results. About two minutes an effect on two cores.
# COUNT=1 also counts, with valgrind, the instructions of all steps in both, on one thread: an effect that is off may
# cost one per cent. (Times on a shared machine scatter by more than that.)
set -euo pipefail
[[ $# -ge 2 ]] || { sed -n '2,7s/^# //p' "$0" >&2; exit 2; }
source_folder=$(cd "$(dirname "$0")/.." && pwd)
build=$(cd "$1" && pwd)
mkdir -p "$2"
work=$(cd "$2" && pwd)
shift 2
all=(rotation bond_moments friction rolling hertz bond_dashpots contact_dashpots local_damping gravity energy_ledger
  crack_log dissipative_scheme strength_factors)
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
    strength_factors) echo "Bond/Strength scatter = none;Phases/By = none" ;;
    dissipative_scheme) echo "Integration/Scheme = velocity verlet" ;;
    all)
      for effect in "${all[@]}"; do [[ $effect == rolling ]] || off "$effect"; done | paste -sd ';'
      ;;
    *) echo "there is no effect $1" >&2; exit 2 ;;
  esac
}
on="Effects/Tangential = coulomb with rolling resistance;Contact/Rolling friction = 0.1;Bond/Damping = 0.05"
on+=";Effects/Gravity = on;Integration/Scheme = tchamwa wielgosz;Bond/Strength scatter = weibull;Bond/Weibull modulus = 8;Output/Fields = off;Loading/Target strain = 0.002"

run() { # BINARY FOLDER ENTRIES [COMMAND BEFORE]; of two entries with one key the last holds
  local arguments=() entries entry
  local -A last=()
  IFS=';' read -ra entries <<<"$3"
  for entry in "${entries[@]}"; do last[${entry%% = *}]=$entry; done
  for entry in "${last[@]}"; do arguments+=(-s "$entry"); done
  "${@:4}" "$1" "$source_folder/tests/apps/scenes/crushed.prm" -t 1 -o "$2" --overwrite --quiet "${arguments[@]}"
}

# Long enough for grain contacts only where they matter.
instructions() { # BINARY FOLDER ENTRIES EFFECT
  local strain=0.0003
  [[ $4 =~ ^(friction|rolling|hertz|contact_dashpots|all)$ ]] && strain=0.0012
  local counter=(valgrind --tool=callgrind --callgrind-out-file=/dev/null
    '--toggle-collect=platen::coupling::Problem::advance*')
  run "$1" "$2" "$3;Loading/Target strain = $strain" "${counter[@]}" 2>&1 |
    sed -n 's/.*Collected : //p'
}

failed=0
differing=0
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
    differing=$((differing + 1))
  fi
  if [[ ${COUNT:-0} = 1 ]]; then
    with=$(instructions "$build/apps/platen-compress" "$work/counted_$effect" "$without" "$effect")
    least=$(instructions "$work/build_$effect/apps/platen-compress" "$work/counted_$effect" "$without" "$effect")
    awk -v name="$effect" -v with="$with" -v least="$least" 'BEGIN {
      printf "%s: off, it costs %+.2f %% of the instructions of a step\n", name, 100 * (with / least - 1)
      exit with > 1.01 * least
    }' || failed=1
  fi
done
echo "row 46 effects left out of a build whose scenes without them differ: $differing (0 of ${#chosen[@]})"
exit $failed
