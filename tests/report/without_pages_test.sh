#!/bin/sh
# without_pages_test.sh PROGRAM PROJECT: a program without pages does all but report.html, and says so.
set -u
program=$1 project=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
fail() { echo "FAIL: $*"; exit 1; }

"$program" run "$project/tests/web/small.yaml" --out run > said || fail "run ends with $?"
[ -s run/summary.json ] || fail "no summary.json"
[ ! -e run/report.html ] || fail "a report.html is there"
grep -q "no report.html: this program was built without pages" said || fail "run does not say that there is no page: $(tail -n 1 said)"
"$program" sweep "$project/tests/web/sampled.yaml" --set runs.per_direction=1 --out sweep > said || fail "sweep ends with $?"
if [ ! -s sweep/sweep.json ] || [ -e sweep/report.html ]; then fail "sweep: $(ls sweep)"; fi
grep -q "built without pages" said || fail "sweep does not say it"
"$program" calibrate run --out calibration > said || fail "calibrate ends with $?"
if [ ! -s calibration/calibration.json ] || [ -e calibration/report.html ]; then fail "calibrate: $(ls calibration)"; fi
"$program" report run > said 2>&1 && fail "report makes a page out of nothing"
grep -q "built without pages" said || fail "report says: $(cat said)"
echo "ok"
