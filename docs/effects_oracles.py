"""Return errors of the shipped effect scenarios by closed form: exact kinematics of the square that the odometry
believes, with what statics and the mechanism give for each wheel. Nothing of the simulator is used."""
import cmath
import math

R, B, SIDE, G = 0.075, 0.340, 4.0, 9.81   # the LabMate, robots/labmate.urdf
CASTER, COM, BASE, WHEELS = 0.250, 0.060, 40.0, 2.0
PIECES = 2000


def square(cw, left=lambda w: R * w, right=lambda w: R * w, base=B, step=lambda leg, s: 0.0, carry=lambda m, a, turning: 0.0,
           leg_turn=0.0, turn_gain=1.0):
    """left, right: true travel of a wheel that has turned by w. step: heading step at a place of a leg. carry: extra
    displacement for m metres rolled at heading a. leg_turn: heading per metre on legs. turn_gain: turned over believed."""
    p, heading, wl, wr = 0j, 0.0, 0.0, 0.0
    sense = -1 if cw else 1
    for leg in range(4):
        for turning in (False, True):
            dl = dr = SIDE / R
            if turning:
                dl, dr = -sense * math.pi / 2 * B / 2 / R, sense * math.pi / 2 * B / 2 / R
            for i in range(PIECES):
                l, r = left(wl + dl / PIECES) - left(wl), right(wr + dr / PIECES) - right(wr)
                wl, wr = wl + dl / PIECES, wr + dr / PIECES
                turn = (r - l) / base * (turn_gain if turning else 1)
                if callable(leg_turn):
                    turn += leg_turn(heading, sense if turning else 0) * (abs(l) + abs(r)) / 2
                elif not turning:
                    turn += leg_turn * (l + r) / 2
                if not turning:
                    turn += step(leg, i * SIDE / PIECES) - step(leg, (i - 1) * SIDE / PIECES)
                p += (l + r) / 2 * cmath.exp(1j * (heading + turn / 2))
                p += carry((abs(l) + abs(r)) / 2, heading, turning)
                heading += turn
    return p.real, p.imag, heading + (2 * math.pi if cw else -2 * math.pi)


def radii(left, right, base=B):
    return lambda cw: square(cw, lambda w: left * w, lambda w: right * w, base)


def loads(c, payload=0.0, ahead=0.0, left=0.0, height=0.1):
    """Left and right, by moments; on tyres of compliance c the robot leans to its loaded side."""
    caster = G * (BASE * COM + payload * ahead) / CASTER
    high = BASE * 0.125 + WHEELS * R + payload * (R + height)
    both = G * (BASE + WHEELS + payload) - caster
    difference = 2 * G * payload * left / B / (1 - 2 * G * c * high / B ** 2)
    return (both + difference) / 2, (both - difference) / 2


def compliance(c, **payload):
    n = loads(c, **payload)
    return radii(R - c * n[0], R - c * n[1])


def mean_of_runs(runs):
    def mean(cw):
        errors = [run(cw) for number, run in runs if number % 2 == (0 if cw else 1)]
        return tuple(sum(e[i] for e in errors) / len(errors) for i in range(3))
    return mean


def eccentric(e):
    return lambda cw: square(cw, right=lambda w: R * w - e * (math.cos(w) - 1))


def cable(h):
    """A rigid wheel over a round cable: the centre's way is longer than the floor; right wheel, on the first leg."""
    psi = math.acos((R - h / 2) / (R + h / 2))
    longer = 2 * (R + h / 2) * psi - 4 * math.sqrt(R * h / 2)
    return lambda cw: square(cw, step=lambda leg, s: -longer / B if leg == 0 and s >= 2 else 0.0)


def toe(tau):
    """Right wheel alone, equal creep along and across; legs turn by -tau^2 / (2 b), turns are short by tau^2 / 4."""
    return lambda cw: square(cw, leg_turn=-tau ** 2 / (2 * B), turn_gain=1 - tau ** 2 / 4)


def carpet(share, direction):
    return lambda cw: square(cw, carry=lambda m, a, turning: share * m * cmath.exp(1j * direction))


def play(zone):
    """Where stops take the play to its far end; the driver's path is whole again on every leg."""
    return lambda cw: (0.0, 0.0, (-1 if cw else 1) * zone * R / B)


CREEP, MU = 0.02, 0.9   # of the scenarios that creep; both wheels' load of the empty robot:
ON_CASTER = G * BASE * COM / CASTER
ON_WHEELS = G * (BASE + WHEELS) - ON_CASTER


def patch(width):
    """Lines that slide as they turn: moment mu N w / 4 (1 - q^2) against forces q mu N at B / 2, slip q omega w / 2."""
    q = 0.0
    for _ in range(100):
        q = (q + width / (2 * B) * (1 - q * q)) / 2
    return lambda cw: square(cw, turn_gain=1 / (1 + q * width / B))


def drag(coefficient):
    """The ball pulls backwards on legs, and against its circle of radius CASTER in turns; sideways slip of a turn is small."""
    pull = coefficient * ON_CASTER
    short = CREEP * pull / ON_WHEELS
    return lambda cw: square(cw, lambda w: R * w, lambda w: R * w, turn_gain=1 - CREEP * pull * CASTER * 2 / (ON_WHEELS * B),
                             carry=lambda m, a, turning: 0 if turning else -short * m * cmath.exp(1j * a))


def slope(angle, downhill):
    """Weight along the floor: every metre rolled creeps downhill by C F / N, and turns by its moment about the axle, F acting
    COM ahead of it, shared by two wheels at B / 2 (their loads are taken as equal)."""
    share = CREEP * math.sin(angle) * G * (BASE + WHEELS) / (ON_WHEELS * math.cos(angle))
    turn = lambda a, sense: (CREEP * G * BASE * math.sin(angle) * math.sin(downhill - a) * COM * 4 /
                             (ON_WHEELS * math.cos(angle) * B * B))
    return lambda cw: square(cw, carry=lambda m, a, turning: share * m * cmath.exp(1j * downhill), leg_turn=turn)


NOTHING = lambda cw: (0.0, 0.0, 0.0)
ORACLES = {
    "wheel_radius_scale": radii(R * 1.01, R * 1.01),
    "wheel_radius_difference": radii(2 * R / 2.002, 2 * R * 1.002 / 2.002),
    "wheelbase": radii(R, R, B * 1.01),
    "wheel_misalignment": toe(0.006),
    "wheel_eccentricity": eccentric(0.001),
    "load_shift": compliance(1.5e-6, payload=15, left=0.1),
    "wear": mean_of_runs([(n, radii(R, R * (1 - 0.0005 * n))) for n in range(10)]),
    "backlash": play(0.02),
    "motor_response": NOTHING,
    "encoder_sampling": NOTHING,
    "encoder_missed_counts": radii(R, R / (1 - 0.002)),
    "encoder_latency": NOTHING,
    "tyre_compliance": compliance(1.5e-6),
    "contact_patch": patch(0.02),
    "tyre_creep": NOTHING,
    "caster_drag": drag(0.03),
    "bump": cable(0.006),
    "floor_slope": slope(0.02, 1),
    "carpet_drift": carpet(0.004, 0.8),
}
