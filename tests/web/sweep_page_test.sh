#!/bin/sh
# sweep_page_test.sh REPORT.html: opens the page of a sweep in headless Chromium and checks that what the data holds was
# drawn: a cell, a point or a dot for every place, marks for failed points and unmet expectations, recovered errors, tables.
. "$(dirname "$0")/page.sh"
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
