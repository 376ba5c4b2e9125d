#!/bin/sh
# What only checks a scene starts in milliseconds, without VTK and finite elements; a run with rigid platens loads VTK
# and no deal.II, which is in solids.so alone. What the engine takes from there is there. Without that file rigid
# platens work, and elastic ones are refused by its name.
#   loaded_libraries.sh FOLDER_OF_PROGRAMS FOLDER_OF_SCENES
set -e
scenes=$2
cd "$1"
ldd solids.so | grep -q deal.ii
ldd engine.so | grep -q vtk
if ldd engine.so | grep deal.ii || ldd platen | grep -E 'deal.ii|vtk'; then
  echo "is linked with more than it needs"
  exit 1
fi
own() { nm -D "$1" "$2" | sed -n "s/^[0-9a-f ]* [$3] \\(_Z.*6platen.*\\)/\\1/p" | sort -u; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
needed=$scratch/needed there=$scratch/there
own --undefined-only engine.so U >"$needed"
{ own --defined-only platen TWVBDRi && own --defined-only solids.so TWVBDRi; } | sort -u >"$there"
grep -q HyperelasticSolid "$needed"
if comm -23 "$needed" "$there" | grep .; then
  echo "is needed by engine.so and not there"
  exit 1
fi

cp platen engine.so "$scratch"
cd "$scratch"
./platen compress "$scenes/demo_dry.prm" --dry-run -o rigid >/dev/null
if ./platen compress "$scenes/elastic_platens.prm" --dry-run -o elastic >/dev/null 2>refusal; then
  echo "elastic platens without solids.so"
  exit 1
fi
grep -q "solids.so" refusal
