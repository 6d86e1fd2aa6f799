#!/bin/sh
# report_page_test.sh REPORT.html: opens the page in headless Chromium and checks that figures and tables were drawn.
# Exit code 77 (skipped) without Chromium; the program is $CHROMIUM, or found.
set -u
page=${1:?usage: report_page_test.sh REPORT.html}
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

# What the reader sees: the document without its scripts and style.
awk '/<(script|style)/ {hidden = 1} !hidden {print} /<\/(script|style)>/ {hidden = 0}' "$folder/dom.html" \
  >"$folder/seen.html"
data=$(grep -F 'id="report-data"' "$page")

failures=0
fail() { echo "FAIL: $*"; failures=$((failures + 1)); }
in_data() { printf '%s' "$data" | grep -oF "$1" | wc -l; }
seen() { grep -oF "$1" "$folder/seen.html" | wc -l; }
at_least() { [ "$(seen "$1")" -ge "$2" ] || fail "$3: found $(seen "$1") of $2 ($1)"; }

grep -q 'data-drawn="true"' "$folder/seen.html" || fail "the script did not reach its end"
grep -q '<div id="page-error" role="alert" hidden' "$folder/seen.html" ||
  fail "error banner: $(grep -F 'id="page-error"' "$folder/seen.html")"
for word in NaN undefined Infinity '\[object'; do
  ! grep -q "$word" "$folder/seen.html" ||
    fail "'$word' on the page: $(grep -o ".\{40\}$word" "$folder/seen.html" | head -n 1)"
done
at_least '<h1>' 1 "title"

directions=0
for direction in cw ccw; do
  [ "$(in_data "\"direction\":\"$direction\",")" -eq 0 ] || directions=$((directions + 1))
done
if [ "$(in_data '"error":{')" -gt 0 ]; then
  shown=$(($(in_data '"stage":"before"') + $(in_data '"stage":"after"')))
  at_least 'class="pt ' "$shown" "return errors in figure 1"
  at_least 'class="icon pt ' "$(in_data '"error":{')" "rows of return errors"
  [ "$directions" -lt 2 ] || at_least 'class="emax"' 1 "E_max circle"
fi
if [ "$(in_data '"truth":[[')" -gt 0 ]; then
  at_least 'class="truth ' "$directions" "true paths in figure 2"
  at_least 'class="odometry" d=' "$directions" "odometry paths in figure 2"
  at_least 'class="series ' $((2 * directions)) "curves in figure 3"
fi
if [ "$(in_data '"e_max_syst_m":')" -gt 0 ]; then
  at_least '<caption>' 2 "tables"
fi

[ "$failures" -eq 0 ] || exit 1
echo "ok: $(seen 'role="img"') figures, $(seen 'class="pt ') points, $(seen '<caption>') tables"
