#!/usr/bin/env bash
# docs/gap_excluded.sh [FOLDER]: diagnoses each recording below FOLDER/second-engine (default ../shared/recordings) without the
# first effect that FOLDER/labels.yaml names for it, prints what is named instead, and counts how often that is "unknown".
# Needs python3 with yaml.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
folder=$(cd "${1:-$root/../shared/recordings}" && pwd)
umbsim=${UMBSIM:-$root/umbsim}   # another build of the program
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

python3 - "$folder/labels.yaml" > "$out/cases" <<'PYTHON'
import sys, yaml
for name, case in yaml.safe_load(open(sys.argv[1])).items():
    if name.startswith("case-") and case.get("effects"):
        print(name, sorted(case["effects"])[0])
PYTHON
while read -r name effect; do
  "$umbsim" gap diagnose "$folder/second-engine/$name" --exclude "$effect" --out "$out/$name" > /dev/null
  named=$(python3 -c 'import json, sys; print("+".join(json.load(open(sys.argv[1]))["causes"][0]["effects"]))' "$out/$name/diagnosis.json")
  echo "$name without $effect: $named"
done < "$out/cases" | tee "$out/table"
echo "unknown: $(grep -c ': unknown$' "$out/table") of $(wc -l < "$out/table")"
