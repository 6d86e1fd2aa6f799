#!/usr/bin/env bash
# docs/make-calibration.sh [ROBOTS]: builds the proof of the calibration methods, runs it on a Latin hypercube of robots
# (200), and puts its table and picture into docs/calibration.md.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build="$root/build/release"
cmake -S "$root" --preset release > /dev/null
ninja -C "$build" umbsim_calibration_proof > /dev/null
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
"$build/bench/umbsim_calibration_proof" "$out" ${1:+"$1"}
cp "$out/picture.svg" "$root/docs/images/calibration-proof.svg"
page="$root/docs/calibration.md"
awk -v table="$out/table.md" '
  /<!-- proof: begin -->/ {print; print ""; while ((getline line < table) > 0) print line; print ""; hidden = 1}
  /<!-- proof: end -->/ {hidden = 0}
  !hidden && !/<!-- proof: begin -->/ {print}' "$page" > "$page.new"
mv "$page.new" "$page"
