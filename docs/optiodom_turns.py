"""optiodom_turns.py RECORDING...: an independent look at recorded geometry, without the simulator. Least squares (soft l1) of radii
and wheelbase on the relative poses over windows of 2, 5, 15 and 40 s, with the tracker's frame and marker free, without and with a
clock of its own for each run. Prints by how many per cent distances and turns are off. Then the same of headings only, over windows of
15 s, with what a constant moment against turning takes from them on tyres that creep: a share s of the way of both wheels over the
wheelbase, whatever the turn's radius, which is s of a turn in place and s (2 R / b) of an arc; for each recording and for all together.
Its windows overlap thirtyfold: the uncertainties are up to five times too small. Needs numpy, scipy and yaml."""
import sys
from pathlib import Path

import numpy as np
import yaml
from scipy.optimize import least_squares

WINDOWS_S = (2, 5, 15, 40)
EVERY = 10  # samples between two windows
SD = (0.005, 0.01, 0.02)  # along m, across m, heading rad


def read(folder):
    about = yaml.safe_load((folder / "recording.yaml").read_text())
    table = lambda name: np.genfromtxt(folder / name, delimiter=",", names=True)
    return about["robot"], [(table(r["encoders"]), table(r["truth"])) for r in about["runs"]]


def reckoned(robot, encoders, scale, difference, wheelbase):
    """Dead reckoning, arcs taken as chords: x, y, heading at the encoder samples."""
    k = 2 * np.pi / robot["ticks_per_revolution"] * robot["wheel_radius_m"] * (1 + scale)
    left, right = (k * (1 + s * difference / 2) * encoders[c] for s, c in ((-1, "left_ticks"), (1, "right_ticks")))
    heading = (right - left) / (robot["wheelbase_m"] * (1 + wheelbase))
    heading = heading - heading[0]
    turned, way = np.diff(heading), np.diff((left + right) / 2)
    chord, middle = way * np.sinc(turned / 2 / np.pi), heading[:-1] + turned / 2
    return (np.r_[0, np.cumsum(chord * np.cos(middle))], np.r_[0, np.cumsum(chord * np.sin(middle))], heading)


def relative(x, y, heading, a, b):
    dx, dy, c, s = x[b] - x[a], y[b] - y[a], np.cos(heading[a]), np.sin(heading[a])
    return c * dx + s * dy, -s * dx + c * dy, heading[b] - heading[a]


def fit(robot, runs, window_s, own_clock):
    def errors(p):
        scale, difference, wheelbase, frame, ahead, aside = p[:6]
        all_errors = [p[3:6] / (0.02, 0.005, 0.005), p[6:] * (0.01 if own_clock else 1)]
        for i, (encoders, truth) in enumerate(runs):
            offset, rate = p[6 + 2 * i:8 + 2 * i] * own_clock
            at = truth["time_s"] * (1 + 0.01 * rate) + 0.1 * offset
            x, y, h = (np.interp(at, encoders["time_s"], v) for v in reckoned(robot, encoders, scale, difference, wheelbase))
            step_s = np.median(np.diff(truth["time_s"]))
            a = np.arange(0, len(at) - int(window_s / step_s), EVERY)
            b = a + int(window_s / step_s)
            marker = (x + np.cos(h) * ahead - np.sin(h) * aside, y + np.sin(h) * ahead + np.cos(h) * aside, h + frame)
            seen = (truth["x_m"], truth["y_m"], np.unwrap(truth["theta_rad"]))
            all_errors += [(u - v) / sd for u, v, sd in zip(relative(*marker, a, b), relative(*seen, a, b), SD)]
        return np.concatenate(all_errors)

    return least_squares(errors, np.zeros(6 + 2 * len(runs)), loss="soft_l1").x


for name in sys.argv[1:]:
    robot, runs = read(Path(name))
    for window_s in WINDOWS_S:
        for own_clock in (0, 1):
            scale, difference, wheelbase, frame = fit(robot, runs, window_s, own_clock)[:4]
            print(f"{Path(name).name} {window_s:2} s {'own clock' if own_clock else 'one clock'}: distances {100 * scale:+.2f} %, "
                  f"turns {100 * (scale - wheelbase):+.2f} %, right over left {100 * difference:+.3f} %, frame {1000 * frame:+.1f} mrad")


STRAIGHT_PM = 0.3  # radians per metre, below which a way counts as straight
HEADING_SD = 0.01


def heading_errors(robot, encoders, truth, scale, resistance, difference, offset_s):
    """Of windows of 15 s: dead reckoning minus the tracker."""
    k = 2 * np.pi / robot["ticks_per_revolution"] * robot["wheel_radius_m"]
    left, right = (k * np.diff(encoders[c]) for c in ("left_ticks", "right_ticks"))
    way = (np.abs(left) + np.abs(right)) / robot["wheelbase_m"]
    smooth = lambda v: np.convolve(v, np.ones(11) / 11, "same")
    sense = np.tanh(smooth(right - left) / robot["wheelbase_m"] / (smooth(way) * robot["wheelbase_m"] / 2 + 1e-9) / STRAIGHT_PM)
    turned = (right * (1 + difference / 2) - left * (1 - difference / 2)) / robot["wheelbase_m"] * (1 + scale)
    heading = np.r_[0, np.cumsum(turned - resistance * sense * way)]
    at = truth["time_s"] + offset_s
    inside = (at > encoders["time_s"][0] + 1) & (at < encoders["time_s"][-1] - 1)
    error = np.interp(at[inside], encoders["time_s"], heading) - np.unwrap(truth["theta_rad"])[inside]
    b = np.arange(int(15 / np.median(np.diff(truth["time_s"]))), len(error), EVERY)
    return error[b] - error[b - b[0]]


def fit_headings(recordings, resists):
    runs = [(robot, *run) for robot, all_runs in recordings for run in all_runs]

    def errors(p):
        each = [heading_errors(*run, 0.01 * p[0], 0.01 * p[1] * resists, 0.01 * p[2], 0.1 * offset) / HEADING_SD
                for run, offset in zip(runs, p[3:])]
        return np.concatenate(each + [0.3 * p[3:], [p[1] * (1 - resists)]])

    found = least_squares(errors, np.zeros(3 + len(runs)), loss="soft_l1", diff_step=1e-4)
    return found.x[:3], np.sqrt(np.diag(np.linalg.pinv(found.jac.T @ found.jac)))[:3], found.cost


recordings = {Path(name).name: read(Path(name)) for name in sys.argv[1:]}
for title, some in [*((n, [r]) for n, r in recordings.items()), ("all", list(recordings.values()))]:
    for resists in (0, 1):
        x, sd, cost = fit_headings(some, resists)
        against = f", against turning {x[1]:.3f} +- {sd[1]:.3f} %" if resists else ""
        print(f"{title}: turns {x[0]:+.2f} +- {sd[0]:.2f} %, right over left {x[2]:+.3f} %{against}, cost {cost:.0f}")
