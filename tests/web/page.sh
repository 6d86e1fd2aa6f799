# Sourced by the page tests with the page as $1: opens it in headless Chromium and gives what a reader sees (without scripts and
# style) as $folder/seen.html, the embedded data as $folder/data, and checks of both. Exit code 77 (skipped) without Chromium; the
# program is $CHROMIUM, or found.
set -u
page=${1:?usage: $0 REPORT.html}
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
in_data() { grep -oF -- "$1" "$folder/data" | wc -l; }
seen() { grep -oE -- "$1" "$folder/seen.html" | wc -l; }
at_least() { [ "$(seen "$1")" -ge "$2" ] || fail "$3: found $(seen "$1") of $2 ($1)"; }

grep -q 'data-drawn="true"' "$folder/seen.html" || fail "the script did not reach its end"
grep -q '<div id="page-error" role="alert" hidden' "$folder/seen.html" ||
  fail "error banner: $(grep -F 'id="page-error"' "$folder/seen.html")"
for word in NaN undefined Infinity '\[object'; do
  ! grep -q "$word" "$folder/seen.html" ||
    fail "'$word' on the page: $(grep -o ".\{40\}$word" "$folder/seen.html" | head -n 1)"
done
