#!/usr/bin/env bash
# docs/make-contact.sh: measures the tables of docs/contact.md again and writes them there.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
build=${UMBSIM_BUILD:-build/release}   # another build folder
[ -f "$build/build.ninja" ] || cmake --preset release -B "$build" > /dev/null
cmake --build "$build" --target umbsim_contact_tables > /dev/null
tables=$(mktemp)
trap 'rm -f "$tables" "$tables.md"' EXIT
"$build/bench/umbsim_contact_tables" > "$tables"
awk -v tables="$tables" '
  /<!-- tables: end -->/ {inside = 0}
  !inside {print}
  /<!-- tables: begin -->/ {inside = 1; print ""; while ((getline line < tables) > 0) print line; print ""}
' docs/contact.md > "$tables.md"
cat "$tables.md" > docs/contact.md
