#!/usr/bin/env bash
# docs/make-figures.sh: makes the table of docs/figures.md and the README's picture again. Runs every command that the
# table names. Needs python3 and chromium.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
umbsim=${UMBSIM:-./umbsim}   # another build of the program
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

# run NAME ARGS...: the result goes to $out/NAME.
run() { local name=$1; shift; "$umbsim" run "$@" --out "$out/$name" --force > /dev/null; }

for scenario in umbmark labmate_exact nominal extended_umbmark unidirectional_trap; do
  run "$scenario" "scenarios/$scenario.yaml"
done
for wheel in inner outer; do
  run "cable-labmate-$wheel" scenarios/nominal.yaml --set "bumps={count: 1, wheel: $wheel}"
  for speed in 0.1 0.2; do
    run "cable-small-$speed-$wheel" scenarios/nominal.yaml --set "bumps={count: 1, wheel: $wheel}" \
      --set robot.urdf=optiodom.urdf --set effects.wheelbase.relative=0.007 --set course.linear_speed_mps=$speed
  done
done
for d in -0.01 -0.005 0 0.005 0.01; do
  for b in -0.04 -0.02 0 0.02 0.04; do
    run "grid$d$b" scenarios/nominal.yaml --set "effects.wheel_radius_difference.relative=$d" \
      --set "effects.wheelbase.relative=$b"
  done
done
for i in 1 2 3 4 5; do run "time$i" scenarios/umbmark.yaml --set calibration.method=none; done
for side in 0.75 1.7; do
  recording="../shared/recordings/optiodom-square-${side}m"
  [ ! -d "$recording" ] || "$umbsim" calibrate "$recording" --out "$out/optiodom-$side" > /dev/null
done

python3 - "$out" docs/figures.md <<'PYTHON'
import glob, json, math, os, re, sys

out, page = sys.argv[1:]
load = lambda name, file="summary.json": json.load(open(os.path.join(out, name, file)))
mm = lambda metres: metres * 1000
deg = math.degrees
rows = []

def row(what, value, command):
    rows.append(f"| {what} | {value} | {command} |")

n = load("nominal")["umbmark"]
worst = max(math.hypot(n[d]["centroid_x_m"], n[d]["centroid_y_m"]) for d in ("cw", "ccw"))
turn = max(abs(n[d]["heading_rad"]) for d in ("cw", "ccw"))
mirror = max(abs(n["cw"]["centroid_x_m"] - n["ccw"]["centroid_x_m"]),
             abs(n["cw"]["centroid_y_m"] + n["ccw"]["centroid_y_m"]))
row("Perfect robot, 16 m: the simulator's own return error", f"{mm(worst):.5f} mm, {deg(turn):.6f}°",
    "`./umbsim run scenarios/nominal.yaml`")
row("The same: cw and ccw are mirror images to", f"{mirror:.0e} m", "as above")

e = load("labmate_exact")
u = e["umbmark"]
centroid = lambda c: f"({mm(c['centroid_x_m']):.3f}, {mm(c['centroid_y_m']):.3f}) mm, {deg(c['heading_rad']):.4f}°"
row("LabMate with the published errors, cw; exact kinematics: (63.420, 62.558) mm, -1.8118°", centroid(u["cw"]),
    "`./umbsim run scenarios/labmate_exact.yaml`")
row("ccw; exact kinematics: (229.995, -209.397) mm, 6.3912°", centroid(u["ccw"]), "as above")
row("E_max,syst; exact kinematics: 311.04 mm", f"{mm(u['e_max_syst_m']):.2f} mm", "as above")
r = e["recovery"]
row("Calibrated and driven again, without noise",
    f"{mm(r['e_max_before_m']):.1f} → {mm(r['e_max_after_m']):.3f} mm, {r['improvement']:.0f} times smaller",
    "as above")
s = load("umbmark")
r, spread = s["recovery"], max(s["umbmark"][d]["sd_m"] for d in ("cw", "ccw"))
row(f"With noise (spread of the clusters {mm(spread):.0f} mm)",
    f"{mm(r['e_max_before_m']):.1f} → {mm(r['e_max_after_m']):.1f} mm, {r['improvement']:.0f} times smaller",
    "`./umbsim run`")

d_error = b_error = 0
for path in glob.glob(os.path.join(out, "grid*")):
    g = load(os.path.basename(path))
    d_error = max(d_error, abs(g["calibration"]["heading"]["e_d"] - g["injected"]["e_d"]))
    b_error = max(b_error, abs(g["calibration"]["heading"]["e_b"] - g["injected"]["e_b"]))
row("Recovery, heading form: worst error over E_d 0.99 to 1.01 and E_b 0.96 to 1.04 (25 robots)",
    f"E_d {d_error:.1e}, E_b {b_error:.1e}",
    "`./umbsim run scenarios/nominal.yaml --set effects.wheel_radius_difference.relative=0.01 "
    "--set effects.wheelbase.relative=0.04` and so on")

def cable(R, b, h=0.010):
    psi = math.acos((R - h / 2) / (R + h / 2))
    return deg((2 * (R + h / 2) * psi - 4 * math.sqrt(R * h / 2)) / b)

small = " --set robot.urdf=optiodom.urdf --set effects.wheelbase.relative=0.007 --set course.linear_speed_mps="
for name, R, b, speed, more in (("labmate", 0.075, 0.340, 0.2, ""), ("small-0.1", 0.042, 0.2014, 0.1, small + "0.1"),
                                ("small-0.2", 0.042, 0.2014, 0.2, small + "0.2")):
    values = [deg(load(f"cable-{name}-{wheel}")["extended"][f"{d}_mean_abs_heading_error_rad"])
              for wheel in ("inner", "outer") for d in ("cw", "ccw")]
    exact = cable(R, b)
    row(f"One 10 mm cable, R {R * 1000:.0f} mm, b {b * 1000:.4g} mm, {speed} m/s, either wheel and direction; "
        f"closed form {exact:.3f}°",
        f"{min(values):.3f}° to {max(values):.3f}° ({100 * (sum(values) / 4 / exact - 1):+.1f} %)",
        f"`./umbsim run scenarios/nominal.yaml --set 'bumps={{count: 1}}'{more}`")
x = load("extended_umbmark")
row("Ten cables, per run",
    f"cw {deg(x['extended']['cw_mean_abs_heading_error_rad']):.2f}°, "
    f"ccw {deg(x['extended']['ccw_mean_abs_heading_error_rad']):.2f}°",
    "`./umbsim run scenarios/extended_umbmark.yaml`")
row("Extended UMBmark: the sum of both", f"{deg(x['extended']['mean_abs_heading_error_rad']):.2f}°", "as above")
t = load("unidirectional_trap")["umbmark"]
row("The trap: E_max seen one way, and the other way",
    f"cw {mm(t['cw']['r_cg_m']):.3f} mm, ccw {mm(t['ccw']['r_cg_m']):.0f} mm",
    "`./umbsim run scenarios/unidirectional_trap.yaml`")
flat = sum(load(f)["cost"]["solver_fallbacks"] for f in ("umbmark", "labmate_exact", "nominal", "unidirectional_trap"))
c = x["cost"]
row("Solver fallbacks on flat and rippled floors; on cables",
    f"{flat}; {c['solver_fallbacks']} in {c['steps']} steps", "all of the above")
published = {"0.75": "30.5 mm, 0.99890, 1.00729", "1.7": "104.4 mm, 0.99910, 1.00778"}
for side, expected in published.items():
    if not os.path.isdir(os.path.join(out, f"optiodom-{side}")): continue
    c = load(f"optiodom-{side}", "calibration.json")
    f = c["calibration"]["endpoint"]
    row(f"Real robot, {side} m squares: E_max, E_d, E_b; expected {expected}",
        f"{mm(c['umbmark']['e_max_syst_m']):.1f} mm, {f['e_d']:.5f}, {f['e_b']:.5f}",
        f"`./umbsim calibrate ../shared/recordings/optiodom-square-{side}m`")
times = [load(f"time{i}")["cost"] for i in range(1, 6)]
best = min(times, key=lambda c: c["wall_s"])
row(f"Time for ten runs, {best['simulated_s']:.0f} simulated seconds, {os.cpu_count()} cores, best of five",
    f"{best['wall_s']:.2f} s", "`./umbsim run --set calibration.method=none`")

text = open(page).read()
table = "| what | measured | command |\n|---|---|---|\n" + "\n".join(rows) + "\n"
begin, end = "<!-- figures: begin -->\n", "<!-- figures: end -->"
assert begin in text and end in text, f"{page} has lost its markers"
head, rest = text.split(begin, 1)
open(page, "w").write(head + begin + table + end + rest.split(end, 1)[1])
print(table)
PYTHON

# The pictures, from the pages. The diagnosis is of a recording that is not part of this project.
"$umbsim" sweep scenarios/sweeps/recovery.yaml --out "$out/recovery" > /dev/null
bump=../shared/recordings/second-engine/case-06
[ ! -d "$bump" ] || "$umbsim" gap diagnose "$bump" --out "$out/case-06" > /dev/null
node docs/make-pictures.mjs build/release/tests/web/tools "$out" docs/images
ls -l docs/images/*.png
