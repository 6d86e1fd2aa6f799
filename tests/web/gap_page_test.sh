#!/bin/sh
# gap_page_test.sh REPORT.html: opens the page of a gap diagnosis in headless Chromium and checks that what the data holds was
# drawn: a plan view of every run, bands of the parts that score, a bar of every explanation, end-point errors, sections.
# Exit code 77 (skipped) without Chromium; the program is $CHROMIUM, or found.
set -u
page=${1:?usage: gap_page_test.sh REPORT.html}
[ -r "$page" ] || { echo "FAIL: cannot read $page"; exit 1; }
case $page in /*) ;; *) page=$PWD/$page ;; esac
for candidate in "${CHROMIUM:-}" chromium chromium-browser google-chrome; do
  browser=$(command -v "$candidate" 2>/dev/null) && break
done
[ -n "$browser" ] || { echo "SKIPPED: no chromium"; exit 77; }

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
timeout 120 "$browser" --headless --no-sandbox --disable-gpu --disable-quic --no-first-run \
  --disable-background-networking --disable-component-update --disable-sync --user-data-dir="$folder/profile" \
  --dump-dom "file://$page" >"$folder/dom.html" 2>"$folder/browser.log" \
  || { echo "FAIL: $browser could not open the page"; tail -n 5 "$folder/browser.log"; exit 1; }
awk '/<(script|style)/ {hidden = 1} !hidden {print} /<\/(script|style)>/ {hidden = 0}' "$folder/dom.html" \
  >"$folder/seen.html"
grep -F 'id="report-data"' "$page" >"$folder/data"

failures=0
fail() { echo "FAIL: $*"; failures=$((failures + 1)); }
in_data() { grep -oF "$1" "$folder/data" | wc -l; }
seen() { grep -oE "$1" "$folder/seen.html" | wc -l; }
at_least() { [ "$(seen "$1")" -ge "$2" ] || fail "$3: found $(seen "$1") of $2 ($1)"; }

grep -q 'data-drawn="true"' "$folder/seen.html" || fail "the script did not reach its end"
grep -q '<div id="page-error" role="alert" hidden' "$folder/seen.html" ||
  fail "error banner: $(grep -F 'id="page-error"' "$folder/seen.html")"
for word in NaN undefined Infinity '\[object'; do
  ! grep -q "$word" "$folder/seen.html" ||
    fail "'$word' on the page: $(grep -o ".\{40\}$word" "$folder/seen.html" | head -n 1)"
done
runs=$(in_data '"recorded":')
[ "$runs" -ge 2 ] || fail "the data holds $runs runs"
for heading in Where Which 'How far' 'What next'; do at_least "<h2>$heading</h2>" 1 "section"; done
at_least 'aria-label="Run [^"]*: recorded path solid' "$runs" "plan views"
at_least '<path class="truth ' "$runs" "recorded paths"
at_least '<path class="odometry"' "$runs" "the scenario's paths"
at_least '<path class="scored"' "$(in_data '"from":')" "parts that score"
at_least 'class="pt [a-z]+ before"' "$runs" "end-point errors before"
twins=$(in_data '"after":[[')
at_least '<path class="twin"' "$twins" "the twin's paths"
at_least 'class="pt [a-z]+ after"' "$twins" "end-point errors after"
at_least '<td class="bar-cell">' 1 "bars of probability"
[ "$(in_data '"place_m":')" -eq 0 ] || at_least '<circle class="place"' "$runs" "the place"
[ "$failures" -eq 0 ] || exit 1
echo "ok: $runs runs, $twins with a twin, $(seen 'role="img"') figures, $(seen '<caption>') tables"
