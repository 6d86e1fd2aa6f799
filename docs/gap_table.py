"""gap_table.py RECORDINGS RESULTS PAGE: compares the diagnoses in RESULTS with RECORDINGS/labels.yaml and writes the table
between the marks of PAGE."""
import json
import math
import statistics
import sys
import textwrap
from pathlib import Path

import yaml

PLACE = {"x_m", "y_m", "leg", "seconds_into_leg", "run"}  # where and when: judged by the place


def parameter_errors(truth, found):
    """Relative errors of the sizes that were injected and estimated; angles in radians, absolute."""
    errors = []
    for effect, values in truth.items():
        for name, value in values.items():
            if name in PLACE or name not in found.get(effect, {}):
                continue
            estimate = found[effect][name]["value"]
            if name.endswith("direction_rad"):
                errors.append(("rad", abs(math.remainder(estimate - value, 2 * math.pi))))
            else:
                errors.append(("%", 100 * abs(estimate - value) / abs(value)))
    return errors


def intervals(truth, found):
    """How many 95 % intervals hold what was injected, of how many, and those that do not, in words."""
    held, missed = 0, []
    for effect, values in truth.items():
        for name, value in values.items():
            estimate = found.get(effect, {}).get(name)
            if not isinstance(estimate, dict) or "ci95" not in estimate:
                continue
            low, high = estimate["ci95"]
            if name.endswith("direction_rad"):
                turns = round((estimate["value"] - value) / (2 * math.pi))
                value += 2 * math.pi * turns
            if low <= value <= high:
                held += 1
            else:
                missed.append(f"{name} {low:.3g} to {high:.3g} where {value:.3g} is true")
    return held, missed


def place_error(recordings, case, truth, diagnosis):
    """Distance of the place from a cable or from where the robot was pushed, metres."""
    place = diagnosis["where"].get("place_m")
    if not place:
        return None
    if "bump" in truth:
        return math.dist(place, (truth["bump"]["x_m"], truth["bump"]["y_m"]))
    return None


def row(recordings, results, case, truth):
    d = json.loads((results / case / "diagnosis.json").read_text())
    first = d["causes"][0]["effects"]
    name = "+".join(sorted(first))
    true_name = "+".join(sorted(truth)) or "none"
    errors = parameter_errors(truth, first)
    closure = d["closure"].get("held_out_fraction")
    place = place_error(recordings, case, truth, d)
    return {
        "case": case, "truth": true_name, "first": name, "right": name == true_name,
        "probability": d["causes"][0]["probability"], "set": d["set"], "in_set": true_name in d["set"],
        "errors": errors, "place": place, "closure": closure, "intervals": intervals(truth, first),
        "mm": (d["gap"]["before_mm"], d["closure"].get("after_mm"), d["gap"]["noise_floor_mm"]),
        "wall_s": d["cost"]["wall_s"],
    }


def cells(r):
    before, after, floor = r["mm"]
    errors = ", ".join(f"{e:.1f} %" if unit == "%" else f"{e:.3f} rad" for unit, e in r["errors"]) or "–"
    if r["place"] is not None:
        errors += f", {1000 * r['place']:.0f} mm off"
    return [
        r["case"][-2:], r["truth"].replace("+", " + "), ("" if r["right"] else "**") + r["first"].replace("+", " + ") + ("" if r["right"] else "**"),
        f"{100 * r['probability']:.0f} %", "yes" if r["in_set"] else "**no**", errors,
        "–" if r["closure"] is None else f"{100 * r['closure']:.1f} %",
        f"{before:.1f} → {'–' if after is None else f'{after:.1f}'} ({floor:.1f})", f"{r['wall_s']:.0f}",
    ]


def missed_intervals(rows):
    """What the intervals of right causes hold, and miss."""
    right = [r for r in rows if r["right"] and r["truth"] != "none"]
    held = sum(r["intervals"][0] for r in right)
    missed = [f"case {r['case'][-2:]} {text}" for r in right for text in r["intervals"][1]]
    text = (f"Of {held + len(missed)} 95 % intervals of right causes {held} hold the truth. They hold noise, nuisances, and "
            "how far the same effect comes out otherwise in other engines.")
    return text + (f" The others: {'; '.join(missed)}." if missed else "")


def table(rows):
    heads = ["case", "injected", "first cause", "probability", "in the set", "parameter off by", "closure", "mm: before → after (floor)", "s"]
    lines = ["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
    lines += ["| " + " | ".join(cells(r)) + " |" for r in rows]
    effects = [r for r in rows if r["truth"] != "none"]
    nulls = [r for r in rows if r["truth"] == "none"]
    relative = [e for r in effects if r["right"] for unit, e in r["errors"] if unit == "%"]
    closures = [r["closure"] for r in effects if r["closure"] is not None]
    summary = (
        f"First cause right in {sum(r['right'] for r in effects)} of {len(effects)}, truth in the set in "
        f"{sum(r['in_set'] for r in effects)} of {len(effects)}, \"none\" in {sum(r['right'] for r in nulls)} of {len(nulls)} "
        f"cases without an effect. Median parameter error {statistics.median(relative):.1f} % (largest {max(relative):.1f} %), "
        f"closure {100 * min(closures):.1f} % to {100 * max(closures):.1f} %, median time {statistics.median(r['wall_s'] for r in rows):.0f} s "
        f"(longest {max(r['wall_s'] for r in rows):.0f} s).")
    lines += ["", *textwrap.wrap(summary, 120), "", *textwrap.wrap(missed_intervals(rows), 120)]
    return "\n".join(lines)


def main():
    recordings, results, page = map(Path, sys.argv[1:4])
    labels = yaml.safe_load((recordings / "labels.yaml").read_text())
    rows = [row(recordings, results, case, label["effects"]) for case, label in sorted(labels.items())
            if (results / case / "diagnosis.json").exists()]
    text = page.read_text()
    begin, end = "<!-- cases: begin -->", "<!-- cases: end -->"
    head, rest = text.split(begin)
    page.write_text(head + begin + "\n\n" + table(rows) + "\n\n" + end + rest.split(end)[1])


main()
