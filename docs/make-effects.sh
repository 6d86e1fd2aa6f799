#!/usr/bin/env bash
# docs/make-effects.sh: makes docs/effects.md again from the catalogue and from runs of scenarios/effects. Needs python3.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
umbsim=${UMBSIM:-./umbsim}   # another build of the program
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

"$umbsim" effects > "$out/list"
# shellcheck disable=SC2013  # words
for name in $(awk '/^[a-z]/ {print $1}' "$out/list"); do
  "$umbsim" effects "$name" > "$out/$name.txt"
  "$umbsim" run "scenarios/effects/$name.yaml" --out "$out/$name" --force > /dev/null
done
python3 docs/effects_page.py "$out" docs/effects.md
