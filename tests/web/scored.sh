#!/bin/sh
# scored.sh PROGRAM trial TRIAL.yaml FOLDER, or scored.sh PROGRAM WORLDS PLAN.yaml FOLDER (WORLDS: the program umbsim_worlds):
# draws the cases, has them diagnosed, scores. The page is made again by `umbsim report`, from what lies in the score's folder.
set -eu
program=$1 kind=$2 plan=$3 folder=$4
rm -rf "$folder"
if [ "$kind" = trial ]; then
  "$program" gap trial "$plan" --out "$folder"
else
  "$kind" draw "$plan" --out "$folder"
  "$program" gap trial diagnose "$folder"
  "$kind" score "$folder"
fi
cp "$folder/score/report.html" "$folder/first.html"
"$program" report "$folder/score"
