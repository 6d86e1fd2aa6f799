#!/usr/bin/env python3
"""Table of lines and branches reached, by folder, and of the files below 90 % of lines, from gcovr's summary (JSON)."""
import collections
import json
import sys

BAR = 90  # per cent of a file's lines


def percent(part, whole):
    return 100 * part / whole if whole else 100


def main():
    with open(sys.argv[1]) as file:
        files = json.load(file)["files"]
    sums = collections.defaultdict(lambda: [0, 0, 0, 0])
    for f in files:
        counts = [f["line_covered"], f["line_total"], f["branch_covered"], f["branch_total"]]
        for folder in (f["filename"].split("/")[0] + "/", "all"):
            sums[folder] = [a + b for a, b in zip(sums[folder], counts)]
    print("| folder | lines | reached, % | branches | reached, % |\n|---|---|---|---|---|")
    for folder, (hit, lines, taken, branches) in sorted(sums.items(), key=lambda item: (item[0] == "all", item[0])):
        print(f"| {folder} | {lines} | {percent(hit, lines):.1f} | {branches} | {percent(taken, branches):.1f} |")
    print(f"\n| file below {BAR} % | lines not reached | of |\n|---|---|---|")
    for f in sorted(files, key=lambda f: f["line_covered"] - f["line_total"]):
        if percent(f["line_covered"], f["line_total"]) < BAR:
            print(f"| {f['filename']} | {f['line_total'] - f['line_covered']} | {f['line_total']} |")


main()
