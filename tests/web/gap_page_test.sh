#!/bin/sh
# gap_page_test.sh REPORT.html: opens the page of a gap diagnosis in headless Chromium and checks that what the data holds was
# drawn: a plan view of every run, bands of the parts that score, a bar of every explanation, end-point errors, sections.
. "$(dirname "$0")/page.sh"
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
at_least '<p class="headline">[A-Z][^<]*\.' 1 "verdict"
at_least '<td class="bar-cell">' 1 "bars of probability"
[ "$(in_data '"place_m":')" -eq 0 ] || at_least '<circle class="place"' "$runs" "the place"
[ "$failures" -eq 0 ] || exit 1
echo "ok: $runs runs, $twins with a twin, $(seen 'role="img"') figures, $(seen '<caption>') tables"
