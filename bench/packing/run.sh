#!/bin/sh
# The tables of bench/results/packing.md: run.sh BUILD [THREADS]. Some twenty minutes on two free cores; "all" as third word
# adds ten million spheres, half an hour and 5 GB.
set -e
build=${1:?build folder}
threads=${2:-2}
pack() { echo "== $*"; "$build/bin/bench_packing" "$@"; }
for kind in grown tiled; do
  for spheres in 5000 22500 100000; do
    pack --kind "$kind" --spheres "$spheres" --tile "$((spheres / 5))" --shape cylinder --threads 1
    pack --kind "$kind" --spheres "$spheres" --tile "$((spheres / 5))" --shape cylinder --threads "$threads"
  done
done
pack --kind front --spheres 1000000
pack --kind grown --spheres 1000000 --threads "$threads" --slabs
for seed in 1 2; do
  pack --kind tiled --spheres 1000000 --threads "$threads" --seed "$seed" --slabs
done
if [ "$3" = all ]; then
  pack --kind tiled --spheres 10000000 --tile 100000 --threads "$threads" --at-rest 3e-2
fi
