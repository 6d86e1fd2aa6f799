"""A robot on four squares, by exact kinematics: what its encoders count and what a tracker sees.

Knows nothing of the program. Its wheels differ from what its makers believe: see TRUE.
"""
import math
import random

BELIEVED = {"wheel_radius_m": 0.033, "wheelbase_m": 0.160, "ticks_per_revolution": 4096}
TRUE = {"left_radius_m": 0.03291, "right_radius_m": 0.03309, "wheelbase_m": 0.1616}
START_NS = 1_700_000_000_123_456_789  # of the log
ENCODER_HZ = 20
TRACKER_HZ = 20
CLOCK_LATE_S = 0.04  # the tracker's stamps against the encoders'
SIDE_M, SPEED_MPS, TURN_RADPS = 0.5, 0.25, 1.0
REST_S = 3.0


def ramped(way, speed, acceleration, dt):
    """Speeds over time of a move with ramps, symmetric; sums up to `way`."""
    ramp = speed / acceleration
    cruise = way / speed - ramp
    steps = round((2 * ramp + cruise) / dt)
    profile = []
    for i in range(steps):
        t = (i + 0.5) * dt
        profile.append(acceleration * min(t, ramp, 2 * ramp + cruise - t))
    scale = way / (sum(profile) * dt)
    return [v * scale for v in profile]


def wheel_speeds(dt):
    """What the robot's makers' kinematics command: angular speeds of both wheels, and what is driven when."""
    radius, base = BELIEVED["wheel_radius_m"], BELIEVED["wheelbase_m"]
    speeds, runs = [], []

    def rest(seconds):
        speeds.extend([(0.0, 0.0)] * round(seconds / dt))

    rest(REST_S)
    for number, sense in enumerate((-1, 1, -1, 1)):
        begin = len(speeds) * dt
        for _ in range(4):
            speeds.extend((v / radius, v / radius) for v in ramped(SIDE_M, SPEED_MPS, 0.5, dt))
            rest(0.4)
            for w in ramped(math.pi / 2, TURN_RADPS, 2.0, dt):
                speeds.append((-sense * w * base / 2 / radius, sense * w * base / 2 / radius))
            rest(0.4)
        runs.append(("cw" if sense < 0 else "ccw", begin, len(speeds) * dt))
        rest(REST_S)
    return speeds, runs


def drive(seconds=None):
    """Rows (ns, left ticks, right ticks, left rad/s, right rad/s) and poses (ns, x, y, theta); where runs begin and end.

    `seconds`: the same once more and again, until the log is as long as that.
    """
    dt = 0.002
    speeds, runs = wheel_speeds(dt)
    if seconds:
        speeds = (speeds * (int(seconds / (len(speeds) * dt)) + 1))[: int(seconds / dt)]
    noise = random.Random(28)
    angle = [0.0, 0.0]
    x = y = theta = 0.0
    rows, poses = [], []
    every_row, every_pose = round(1 / ENCODER_HZ / dt), round(1 / TRACKER_HZ / dt)
    for i, (left, right) in enumerate(speeds):
        if i % every_row == 0:
            ticks = [round(a / (2 * math.pi) * BELIEVED["ticks_per_revolution"]) for a in angle]
            rows.append((START_NS + round(i * dt * 1e9), *ticks, left, right))
        if i % every_pose == 0:
            at = START_NS + round((i * dt + CLOCK_LATE_S) * 1e9)
            poses.append((at, x + noise.gauss(0, 3e-4), y + noise.gauss(0, 3e-4), theta + noise.gauss(0, 1e-3)))
        left_m, right_m = left * dt * TRUE["left_radius_m"], right * dt * TRUE["right_radius_m"]
        turn = (right_m - left_m) / TRUE["wheelbase_m"]
        x += (left_m + right_m) / 2 * math.cos(theta + turn / 2)
        y += (left_m + right_m) / 2 * math.sin(theta + turn / 2)
        theta += turn
        angle[0] += left * dt
        angle[1] += right * dt
    return rows, poses, runs
