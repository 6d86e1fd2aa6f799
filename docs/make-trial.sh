#!/usr/bin/env bash
# docs/make-trial.sh FOLDER [TRIAL.yaml]: runs the trial (default scenarios/trials/published.yaml) in FOLDER, or goes on with what is
# there, keeps the score in results/reference/trial and puts its tables into docs/trial.md.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
folder=${1:?usage: docs/make-trial.sh FOLDER [TRIAL.yaml]}
trial=${2:-$root/scenarios/trials/published.yaml}
umbsim=${UMBSIM:-$root/umbsim}   # another build of the program

"$umbsim" gap trial generate "$trial" --out "$folder"
"$umbsim" gap trial diagnose "$folder"
"$umbsim" gap trial score "$folder" > /dev/null
kept="$root/results/reference/trial"
mkdir -p "$kept"
for file in summary.json summary.md table.txt confusion.csv confusion.svg provenance.json; do cp "$folder/score/$file" "$kept/"; done
cp "$folder/answers.sha256" "$folder/answers.json" "$kept/"

page="$root/docs/trial.md"
awk -v table="$kept/summary.md" '
  /<!-- published: begin -->/ {print; print ""; while ((getline line < table) > 0) print line; print ""; hidden = 1}
  /<!-- published: end -->/ {hidden = 0}
  !hidden && !/<!-- published: begin -->/ {print}' "$page" > "$page.new"
mv "$page.new" "$page"
