#!/usr/bin/env bash
# The whole test in Platen and in Yade: one packing crushed to its peak and past it, from command to prompt, in turn (Platen,
# Yade, Platen, ...), and a table of seconds, ratios and what both measured. README.md says what is the same and what is not.
# Usage: bench/peers/whole.sh BUILD OUT   (BUILD holds apps/platen-compress and platen-pack; writes OUT/whole.md, whole.csv,
# runs.csv, the packing, a folder and a log of each run)
# Environment: RADIUS of the spheres ("1.78 mm"; "3 mm" for a quick look), PAIRS of runs (1), THREADS ("1 2"),
# WITHIN (nothing; a command that runs each program, such as "flock FILE").
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/common.sh"
[ $# -eq 2 ] || fail "usage: whole.sh BUILD OUT"
build=$1 out=$2
radius=${RADIUS:-1.78 mm} pairs=${PAIRS:-1}
check_machine
for apps in "$build"/{apps,bin,.}; do
  [ -x "$apps/platen-compress" ] && [ -x "$apps/platen-pack" ] && break
done
[ -x "$apps/platen-compress" ] || fail "no platen-compress in $build: configure with PLATEN_APPS=ON and build it"
mkdir -p "$out"
out=$(cd "$out" && pwd)

run() { # program threads pair command...
  local program=$1 threads=$2 pair=$3 name=$1_$2_$3 figures
  shift 3
  figures=$("${within[@]}" python3 "$here/measured.py" "$out/$name.log" "$@") ||
    fail "$program failed; its last lines ($out/$name.log):"$'\n'"$(tail -n 5 "$out/$name.log")"
  echo "$program,$threads,$pair,${figures// /,},$name" >>"$out/runs.csv"
  echo "$program, $threads threads, run $pair: ${figures%% *} s"
}

echo "packing spheres of $radius"
"$apps/platen-pack" "$here/whole.prm" -o "$out/packing" --overwrite --quiet -s "Specimen/Sphere radius = $radius"
specimen=$out/packing/specimen.csv

echo "program,threads,pair,seconds,processor_seconds,memory_mb,folder" >"$out/runs.csv"
for threads in "${thread_counts[@]}"; do
  for pair in $(seq "$pairs"); do
    run platen "$threads" "$pair" "$apps/platen-compress" "$here/whole.prm" -o "$out/platen_${threads}_$pair" --overwrite \
      -t "$threads" -s "Specimen/Sphere radius = $radius" -s "Specimen/Packing = file" -s "Specimen/File = $specimen"
    run yade "$threads" "$pair" yade -n -x "-j$threads" "$here/yade_test.py" "$out/platen_${threads}_$pair" "$specimen" \
      "$out/yade_${threads}_$pair"
  done
done

{
  table_head "A whole test in Platen and in Yade"
  python3 "$here/whole_table.py" "$out"
} >"$out/whole.md.part"
mv "$out/whole.md.part" "$out/whole.md"
cat "$out/whole.md"
