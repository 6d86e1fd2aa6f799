#!/bin/sh
# sweep_page_test.sh REPORT.html: opens the page of a sweep in headless Chromium and checks that what the data holds was
# drawn: a cell, a point or a dot for every place, marks for failed points and unmet expectations, recovered errors, tables.
# Exit code 77 (skipped) without Chromium; the program is $CHROMIUM, or found.
set -u
page=${1:?usage: sweep_page_test.sh REPORT.html}
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
at_least '<h1>Sweep ' 1 "title"
at_least '<select data-control' 4 "controls"
points=$(in_data '"point":')
drawn=$(($(seen 'class="cell"') + $(seen 'class="sample"') + $(seen '<circle cx=')))
[ "$drawn" -ge 20 ] || fail "only $drawn places of the figure were drawn, of $points points"
[ "$(in_data '"status"')" -eq 0 ] || fail "the data holds more than the page reads"
[ "$(in_data '"failed":true')" -eq 0 ] || at_least 'class="fault"' "$(in_data '"failed":true')" "crosses of failed points"
if grep -q '"unmet":\[[0-9]' "$folder/data"; then at_least 'class="unmet' 1 "marks of unmet expectations"; fi
if grep -q '"effects.wheelbase.relative"' "$folder/data"; then
  at_least 'recovered against injected' 4 "figures of recovered errors"
  at_least 'class="pt ' "$((points / 2))" "recovered errors"
fi
[ "$(in_data '"expectation":')" -eq 0 ] || at_least '<caption>' 1 "table of expectations"
[ "$failures" -eq 0 ] || exit 1
echo "ok: $drawn places, $(seen 'role="img"') figures, $(seen '<caption>') tables"
