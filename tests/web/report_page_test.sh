#!/bin/sh
# report_page_test.sh REPORT.html: checks that the page of a run drew figures and tables of what its data holds.
. "$(dirname "$0")/page.sh"
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

# The tiles show the form whose corrections were applied, and so does the first column of the table.
forms=$(grep -oE '"calibration":\{"applied":"[a-z]+","endpoint":\{[^}]*\},"heading":\{[^}]*\}' "$folder/data")
applied=$(printf %s "$forms" | sed -n 's/.*"applied":"\([a-z]*\)".*/\1/p')
if [ -n "$applied" ] && [ "$applied" != none ]; then
  number() { printf '%.5f' "$(printf %s "$forms" | sed -n "s/.*\"$applied\":{[^}]*\"$1\":\([^,}]*\).*/\1/p")"; }
  at_least "wheel diameters</dt><dd><div class=\"value\">$(number e_d)<" 1 "applied E_d on its tile"
  at_least "wheelbase</dt><dd><div class=\"value\">$(number e_b)<" 1 "applied E_b on its tile"
  at_least "<div class=\"more\">$applied form, applied" 2 "applied form named on the tiles"
  at_least "Quantity</th><th scope=\"col\">$applied form, applied<" 1 "applied form first in the table"
fi
if [ "$(in_data '"calibration":{')" -gt 0 ]; then
  [ -n "$applied" ] || fail "the data do not say which form was applied"
  at_least '<b>(endpoint|heading) form</b>: ' 2 "when to trust which form"
fi

[ "$failures" -eq 0 ] || exit 1
echo "ok: $(seen 'role="img"') figures, $(seen 'class="pt ') points, $(seen '<caption>') tables"
