#!/usr/bin/env bash
# Executes the notebooks of docs/tutorial/notebooks, whose cells assert what they say, and leaves none of it.
#   notebooks.sh BUILD      BUILD: build folder, or - where Platen is installed
set -euo pipefail
notebooks=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../docs/tutorial/notebooks" && pwd)
if [ "$1" != - ]; then
  build=$(cd "$1" && pwd)
  export PYTHONPATH=$build/python${PYTHONPATH:+:$PYTHONPATH} PATH=/usr/bin:$build/apps:$PATH
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
count=0
for notebook in "$notebooks"/*.ipynb; do
  cp "$notebook" .
  /usr/bin/python3 -m nbconvert --to notebook --execute --ExecutePreprocessor.timeout=1800 --output "done_$(basename "$notebook")" "$(basename "$notebook")"
  count=$((count + 1))
done
echo "$count notebooks executed"
[ "$count" -eq 3 ]
