#!/usr/bin/env bash
# docs/make-gap.sh [FOLDER]: diagnoses the recordings of another engine below FOLDER/second-engine (default ../shared/recordings),
# compares with FOLDER/labels.yaml, and writes the table of docs/gap-results.md again. Needs python3 with yaml. Diagnoses that lie in
# $UMBSIM_RESULTS already are not made again.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
folder=$(cd "${1:-$root/../shared/recordings}" && pwd)
cd "$root"
umbsim=${UMBSIM:-./umbsim}   # another build of the program
out=${UMBSIM_RESULTS:-$(mktemp -d)}
[ -n "${UMBSIM_RESULTS:-}" ] || trap 'rm -rf "$out"' EXIT

for recording in "$folder"/second-engine/*/; do
  name=$(basename "$recording")
  [ -f "$out/$name/diagnosis.json" ] || "$umbsim" gap diagnose "$recording" --out "$out/$name" > /dev/null
done
python3 docs/gap_table.py "$folder" "$out" docs/gap-results.md
