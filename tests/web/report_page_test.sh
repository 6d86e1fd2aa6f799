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

[ "$failures" -eq 0 ] || exit 1
echo "ok: $(seen 'role="img"') figures, $(seen 'class="pt ') points, $(seen '<caption>') tables"
