"""effects_page.py RESULTS PAGE: writes the page of all effects. docs/make-effects.sh calls it."""
import json
import math
import os
import re
import sys

from effects_oracles import ORACLES

# What is tested of every effect, in tests/effects: where no closed form of the return error exists, and beside it.
TESTED = {
    "wheel_radius_scale": "exact kinematics of the square",
    "wheel_radius_difference": "exact kinematics of the square",
    "wheelbase": "exact kinematics of the square",
    "wheel_misalignment": "force balance: sideways drift by the mean toe; lost distance and turn of second order",
    "wheel_eccentricity": "exact kinematics of the ticks; heading ripple e/b; lost distance (e/b)²/4",
    "load_shift": "statics: heading per metre c (N_L - N_R) / (b R); nothing on hard tyres",
    "wear": "exact kinematics of each run's radii; linear in the run number",
    "backlash": "the play's place after every leg and turn; nothing between reversals",
    "motor_response": "first-order response; commands by the gain's ratio; dead band; torque as a force; droop on a slope",
    "over_acceleration": "stops slip first, where demanded traction exceeds friction",
    "fast_turning": "skids where the centre of mass pulls the wheels off; turns alone",
    "encoder_resolution": "heading within a tick / b everywhere; in proportion to the tick",
    "encoder_sampling": "exact where curvature is constant; else with the square of the interval",
    "encoder_missed_counts": "a radius error in the mean (this is one drawing); scatter as N p (1 - p)",
    "encoder_latency": "the driver's law alone gives the overshoot; none is left at the return",
    "tyre_compliance": "statics: the radius under each wheel's load; the same at every step",
    "contact_patch": "turns lose about w^2 / (2 b^2); nothing on a straight leg",
    "tyre_creep": "slip in proportion to traction up to the friction limit, then sliding",
    "caster_swivel": "follows its trail; kicks in the first trail-lengths with the sign of the last turn, as the plane's equations "
                     "say; not on a first leg that starts aligned; none without friction or creep",
    "caster_drag": "off the middle, yaw in proportion to distance; in the middle, a shorter leg alone",
    "slippery_floor": "slip begins where demanded traction exceeds friction",
    "slippery_patch": "acts inside the disc and under demand only",
    "bump": "rigid wheel over a round cable: centre's way minus floor, over b",
    "uneven_floor": "the same in every run; error with the square of the height",
    "floor_slope": "nothing without creep; with it the drift downhill; turns with the floor",
    "carpet_drift": "drift vector times the way of the wheels, cw as ccw",
    "push": "momentum by its impulse where nothing holds; nothing below friction; the named run alone",
    "wheel_lift": "one wheel turns for nothing; needs a demand and a place",
}

HEAD = """# The effects

Every source of odometry error in the catalogue, as physics in the robot, its drive, its encoders, its contacts or its floor.
`docs/make-effects.sh` makes this page: the catalogue from the program (`./umbsim effects`, `./umbsim effects NAME`), the
figures from `./umbsim run scenarios/effects/NAME.yaml`. An effect goes into a scenario by its name and
parameters (`effects: {wheelbase: {relative: 0.01}}`) or onto the command line (`--set effects.wheelbase.relative=0.01`).

## Return errors at typical severity

Absolute minus calculated pose at the end of the square, (x, y) in mm and heading in degrees, mean of the scenario's runs;
beside it the closed form where there is one (docs/effects_oracles.py). Scenarios whose effect acts through slip or drag have
these too, and steps of 1 ms: [physics](physics.md#steps). All effects are mirrored, turned with the start heading, and taken two at a time by tests/effects as well.

| effect | cw | ccw | cw, closed form | ccw, closed form | what the tests hold it to |
|---|---|---|---|---|---|
"""


def pose(x_m, y_m, rad):
    number = lambda value, digits: f"{round(value, digits) + 0.0:.{digits}f}"   # no -0.00
    return f"({number(1000 * x_m, 2)}, {number(1000 * y_m, 2)}) {number(math.degrees(rad), 3)}"


def measured(out, name):
    u = json.load(open(os.path.join(out, name, "summary.json")))["umbmark"]
    return [pose(u[d]["centroid_x_m"], u[d]["centroid_y_m"], u[d]["heading_rad"]) for d in ("cw", "ccw")]


def unwrapped(text):
    """Lines of a text whose continuations are indented by more than two blanks."""
    return re.sub(r"\n {3,}", " ", text).splitlines()


def description(out, name):
    """`umbsim effects NAME` as Markdown."""
    lines = unwrapped(open(os.path.join(out, name + ".txt")).read())
    stage = re.search(r"\((.*)\)", lines[0]).group(1)
    text = [f"## {name}", "", lines[1].strip(), ""]
    facts, parameters = {"stage": stage}, []
    for line in lines[2:]:
        match = re.match(r"  (\w+) \[(.*?)\]: (.*)", line)
        if match:
            values = dict(re.findall(r"(neutral|plausible|allowed:?) ([^,]*(?:, [^a-z][^,]*)?)", match.group(3)))
            parameters.append((match.group(1), match.group(2), values.get("neutral", ""), values.get("plausible", "")))
        else:
            key, value = line.strip().split(":", 1)
            facts[key.strip()] = value.strip()
    text += [f"- {key}: {value}" for key, value in facts.items()]
    text += ["", "| parameter | unit | neutral | plausible |", "|---|---|---|---|"]
    text += [f"| {name} | {unit} | {neutral} | {plausible} |" for name, unit, neutral, plausible in parameters]
    return "\n".join(text) + "\n"


def main(out, page):
    names = [line.split()[0] for line in open(os.path.join(out, "list")) if line[:1].strip()]
    rows, sections = [], []
    for name in names:
        exact = [pose(*ORACLES[name](cw)) for cw in (True, False)] if name in ORACLES else ["-", "-"]
        rows.append(f"| [{name}](#{name}) | " + " | ".join(measured(out, name) + exact + [TESTED[name]]) + " |\n")
        sections.append(description(out, name))
    open(page, "w").write(HEAD + "".join(rows) + "\n" + "\n".join(sections))


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
