#!/usr/bin/env bash
# The whole test in Platen and in Yade: one packing crushed to its peak and past it, from command to prompt, in turn (Platen,
# Yade, Platen, ...), and a table of seconds, ratios and what both measured. README.md says what is the same and what is not.
# Usage: bench/peers/whole.sh BUILD OUT   (BUILD holds apps/platen-compress and platen-pack; writes OUT/whole.md, whole.csv,
# runs.csv, the packing, a folder and a log of each run)
# Environment: RADIUS of the spheres ("1.78 mm"; "3 mm" for a quick look), PAIRS of runs (1), THREADS ("1 2"),
# WITHIN (nothing; a command that runs each program, such as "flock FILE").
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
fail() {
  echo "whole.sh: $1" >&2
  exit 1
}
[ $# -eq 2 ] || fail "usage: whole.sh BUILD OUT"
build=$1 out=$2
radius=${RADIUS:-1.78 mm} pairs=${PAIRS:-1}
read -ra thread_counts <<<"${THREADS:-1 2}"
read -ra within <<<"${WITHIN:-}"

command -v yade >/dev/null || fail "yade is missing: apt-get install yade"
command -v python3 >/dev/null || fail "python3 is missing: apt-get install python3"
for apps in "$build"/{apps,bin,.}; do
  [ -x "$apps/platen-compress" ] && [ -x "$apps/platen-pack" ] && break
done
[ -x "$apps/platen-compress" ] || fail "no platen-compress in $build: configure with PLATEN_APPS=ON and build it"
for threads in "${thread_counts[@]}"; do
  [ "$threads" -le "$(nproc)" ] || fail "$threads threads on $(nproc) cores would measure the scheduler; set THREADS"
done
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

commit=$(git -C "$here" rev-parse --short HEAD 2>/dev/null || echo unknown)
[ "$commit" = unknown ] || git -C "$here" diff --quiet HEAD || commit="$commit with changes"
{
  echo "# A whole test in Platen and in Yade, measured"
  echo
  echo "Written by \`bench/peers/whole.sh\`; bench/peers/README.md says what is the same and what is not."
  echo
  echo "- machine: $(LC_ALL=C lscpu | sed -n 's/^Model name: *//p' | head -n 1), $(nproc) cores," \
    "$(awk '/^MemTotal/ { printf "%.0f GB", $2 / 1048576 }' /proc/meminfo)," \
    "$(sed -nE 's/^PRETTY_NAME="?([^"]*)"?$/\1/p' /etc/os-release)"
  echo "- date: $(date -u +%Y-%m-%d); commit: $commit"
  echo "- Yade: $(yade --version 2>&1 </dev/null | sed -nE 's/^Yade version: *([^ ]+).*/\1/p' | head -n 1)," \
    "package $(dpkg-query -W -f '${Version}' yade 2>/dev/null || echo "not Debian's")"
  python3 "$here/whole_table.py" "$out"
} >"$out/whole.md.part"
mv "$out/whole.md.part" "$out/whole.md"
cat "$out/whole.md"
