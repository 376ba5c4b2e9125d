#!/usr/bin/env bash
# One step of Platen and one of Yade on the same packing, in turn (Platen, Yade, Platen, ...), and a table of the ratios.
# Usage: bench/peers/run.sh BUILD OUT   (BUILD holds bin/bench_step; writes OUT/peers.md, peers.csv, specimen.csv, logs)
# Environment: PARTICLES (22500), STEPS a repeat (500), REPEATS a run (3), PAIRS of runs (5), THREADS ("1 2"),
# WITHIN (nothing; a command that runs each program, such as "flock FILE"), BASELINE (0; 1: Platen with the kernels of
# plain x86-64, which is what Debian builds Yade for).
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/common.sh"
[ $# -eq 2 ] || fail "usage: run.sh BUILD OUT"
build=$1 out=$2
particles=${PARTICLES:-22500} steps=${STEPS:-500} repeats=${REPEATS:-3} pairs=${PAIRS:-5}
platen_options=(--alone)
[ "${BASELINE:-0}" = 0 ] || platen_options+=(--baseline)
check_machine
for bench in "$build"/{bench,bin,.}/bench_step; do
  [ -x "$bench" ] && break
done
[ -x "$bench" ] || fail "no bench_step in $build: configure with PLATEN_APPS=ON and build it"
mkdir -p "$out"

# Runs a command with its output in a log; prints the peak of its resident memory, MB. Fails as the command does.
measured() { # log command...
  local memory
  read -r _ _ memory < <("${within[@]}" python3 "$here/measured.py" "$@") && echo "$memory"
}

found() { # log pattern: what the pattern's group holds in the log's last such line
  local text
  text=$(sed -nE "s|$2|\\1|p" "$1" | tail -n 1)
  [ -n "$text" ] || fail "$1 holds no line like: $2"
  echo "$text"
}

run() { # program threads pair command...
  local program=$1 threads=$2 pair=$3 log=$out/$1_$2_$3.log memory rate counts
  shift 3
  memory=$(measured "$log" "$@") || fail "$program failed; its last lines ($log):"$'\n'"$(tail -n 5 "$log")"
  rate=$(found "$log" '^([0-9.]+) M bond-steps/s$')
  counts=$(found "$log" '^([0-9]+ particles, [0-9]+ bonds),.*')
  counts=${counts//[!0-9,]/}
  echo "$program,$threads,$pair,$counts,$rate,$memory" >>"$out/peers.csv"
  echo "$program, $threads threads, run $pair: $rate M bond-steps/s, $memory MB"
}

echo "packing $particles spheres"
specimen=$out/specimen.csv
measured "$out/packing.log" "$bench" "${platen_options[@]}" --particles "$particles" --steps 1 --repeats 1 --write-specimen "$specimen" \
  >/dev/null || fail "bench_step failed; its last lines:"$'\n'"$(tail -n 5 "$out/packing.log")"
time_step=$(found "$out/packing.log" '^.*step ([0-9.e+-]+) s$')

echo "program,threads,pair,particles,bonds,rate,memory_mb" >"$out/peers.csv"
for threads in "${thread_counts[@]}"; do
  for pair in $(seq "$pairs"); do
    run platen "$threads" "$pair" "$bench" "${platen_options[@]}" --specimen "$specimen" --threads "$threads" --steps "$steps" \
      --repeats "$repeats"
    run yade "$threads" "$pair" yade -n -x "-j$threads" "$here/yade_step.py" "$specimen" --steps "$steps" \
      --repeats "$repeats" --time-step "$time_step"
  done
done

{
  table_head "One step of Platen and of Yade"
  echo "- kernels of Platen: $(found "$out/packing.log" '^.*threads, (.*) kernels.*$'); step $time_step s in both"
  echo "- $steps steps a repeat, median of $repeats repeats a run, $pairs pairs of runs in turn"
  echo
  python3 "$here/table.py" "$out/peers.csv"
} >"$out/peers.md.part"
mv "$out/peers.md.part" "$out/peers.md"
cat "$out/peers.md"
