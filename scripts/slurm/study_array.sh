#!/usr/bin/env bash
# A study over the nodes of a Slurm cluster: one task of an array job for each run of its plan, then the tables.
#   study_array.sh FOLDER KIND SCENE.prm [-s "Section/Key = value"]...
# Called at a prompt it plans the study in FOLDER, submits itself as array jobs and, behind them, as a job that collects.
# Called again it goes on: tasks whose run is done end at once. By hand:
#   platen-study KIND SCENE.prm -o FOLDER --plan
#   sbatch --array=1-$(($(wc -l < FOLDER/plan.csv) - 1)) study_array.sh FOLDER KIND SCENE.prm
# Environment: PLATEN_STUDY, the program (platen-study); CPUS, threads of a run (1); all that sbatch reads, as SBATCH_PARTITION,
# SBATCH_TIMELIMIT, SBATCH_MEM_PER_CPU (plan.csv has an estimate). docs/clusters.md tells the rest.
#SBATCH --job-name=platen-study
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --signal=B:TERM@60
set -euo pipefail

usage() {
  sed -n '2,9s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
  exit 2
}

offset=0 collects=no
case "${1:-}" in
  --offset) offset=$2 && shift 2 ;; # of array jobs beyond the first, where the plan is longer than one may be
  --collect) collects=yes && shift ;;
esac
[ $# -ge 3 ] || usage
folder=$1
shift
study=${PLATEN_STUDY:-platen-study}

# On a node. The run replaces this shell, so that it is the one that is told when its time is over.
if [ "$collects" = yes ]; then
  exec "$study" "$@" -o "$folder" --collect
elif [ -n "${SLURM_ARRAY_TASK_ID:-}" ]; then
  exec "$study" "$@" -o "$folder" --run $((offset + SLURM_ARRAY_TASK_ID)) -t "${SLURM_CPUS_PER_TASK:-1}"
fi

"$study" "$@" -o "$folder" --plan
runs=$(($(wc -l <"$folder/plan.csv") - 1))
most=$(scontrol show config | sed -n 's/^MaxArraySize *= *//p') # numbers of tasks are below it
most=$((${most:-1001} - 1))
after=
while [ "$offset" -lt "$runs" ]; do
  tasks=$((runs - offset < most ? runs - offset : most))
  job=$(sbatch --parsable --cpus-per-task="${CPUS:-1}" --output="$folder/task_%A_%a.log" --array=1-$tasks \
    "${BASH_SOURCE[0]}" --offset "$offset" "$folder" "$@")
  after+=:${job%%;*}
  offset=$((offset + tasks))
done
sbatch --dependency="afterany$after" --job-name=platen-collect --output="$folder/collect_%j.log" \
  "${BASH_SOURCE[0]}" --collect "$folder" "$@"
