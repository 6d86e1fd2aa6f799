#!/bin/sh
# again.sh PROGRAM RECORDING FOLDER: `umbsim report` on a plain recording, and on a run's result whose page is gone; the list of results.
set -eu
program=$1 recording=$2 folder=$3
rm -rf "$folder"
mkdir -p "$folder/recording" "$folder/results"
cp -r "$recording/recording.yaml" "$recording/runs" "$recording"/*.urdf "$folder/recording"
"$program" report "$folder/recording"
"$program" run "$(dirname "$0")/small.yaml" --out "$folder/results/run"
rm "$folder/results/run/report.html"
"$program" report "$folder/results/run"
[ -s "$folder/results/index.html" ]
