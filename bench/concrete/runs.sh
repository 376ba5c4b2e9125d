# Of one.sh and sizes.sh, which source it: runs of scenes into FOLDER, as many at a time as there are JOBS (all cores). Finished ones are
# skipped, and those of FOLDER/runs.csv. Call as `source runs.sh BUILD FOLDER`; sets here, apps, folder, jobs.
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
apps=$1/apps
folder=$2
jobs=${JOBS:-$(nproc)}
mkdir -p "$folder"

run() { # NAME SCENE SEED OPTIONS...
  local scene=$2 seed=$3 name=$1_$3 program=platen-compress
  shift 3
  if grep -qs '"status": "done"' "$folder/$name/summary.json" || grep -qs "^$name," "$folder/runs.csv"; then return; fi
  [ "$scene" = brazilian_concrete ] && program=platen-brazilian
  "$apps/$program" "$here/../../scenes/$scene.prm" -o "$folder/$name" --overwrite -t 1 --quiet -s "Output/Fields = off" \
    -s "Scene/Seed = $seed" "$@" 2> "$folder/$name.log" ||
    [ $? -eq 1 ] || { echo "$name: $(tail -n 1 "$folder/$name.log")" >&2; } # 1: not what the scene expects
}

queue() { # waits for a free core
  while [ "$(jobs -rp | wc -l)" -ge "$jobs" ]; do wait -n || true; done
  run "$@" &
}
