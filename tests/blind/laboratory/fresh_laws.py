"""What the Iwan contact's suites hide: laws of shapes that the other laboratories do not have.

LAWS are drawn and used as those of `laws`. ALIKE are textbook laws: where all runs have one belt
speed and one mass, two effects of the catalogue then say exactly the same of the motion.
"""

from __future__ import annotations

import numpy as np

from . import curves
from .apparatus import MODES, Record, spread_contact
from .curves import CURVES, SPRINGS, WAVES
from .friction_law import FOLLOWS, SCALES, STAYS
from .laws import Law, Named, Reference, one_of, ruler, sets

LAWS = Named()
KEPT = {STAYS: "mu_s stays", SCALES: "mu_s in proportion", FOLLOWS: "mu_s by as much"}


def hollow_disc(p: Record, radius: float, ahead: float) -> None:
    """Contact points on a disc that presses most at its rim, and `ahead` more at the front."""
    p["planar"] = 1
    spread_contact(p, radius, "hollow")
    p["point_weight"] *= 1 + ahead * p["point_x"] / radius


@LAWS.add
def lateral_friction(rng: np.random.Generator, r: Reference) -> Law:
    ahead = float(one_of(rng, 0.0, 0.2))
    shape = "hollow" if ahead == 0 else "hollow and nose-heavy"
    text = f"friction against the slip of every point of a disc, pressure r^2 (1 + {ahead} x/a)"

    def write(p: Record, strength: float) -> None:
        hollow_disc(p, r.contact_radius, ahead)

    return Law(shape, text, write, 1.0, 1.0, sized=False, planar=True)


@LAWS.add
def turning_surface(rng: np.random.Generator, r: Reference) -> Law:
    side, behind = float(one_of(rng, -1, 1)), float(one_of(rng, 0.0, np.tan(rng.uniform(0.1, 0.2))))

    def write(p: Record, strength: float) -> None:
        hollow_disc(p, r.contact_radius, 0.0)
        p["slab_x"], p["slab_y"] = -behind / strength, side / strength

    text = f"slab about a point 1/strength m abreast, {behind:.3f} of it behind; hollow disc"
    shape = "hollow, behind" if behind else "hollow disc"
    return Law(shape, text, write, 1.0, 3.0, planar=True)


@LAWS.add
def static_strengthening(rng: np.random.Generator, r: Reference) -> Law:
    form = int(one_of(rng, curves.STRETCHED, curves.HYPERBOLA, curves.ARCTAN))
    time, q = float(rng.uniform(0.2, 1.0)), 0.5
    slip = float(rng.uniform(2e-4, 1e-3))
    write = sets("ageing", form=form, time=time, power=q, slip=slip)
    text = (
        f"mu_s grows by strength * mu_k * ({CURVES[form]}), u = hold time / {time:.3f} s, q = {q}"
    )
    text += f"; lost over {slip * 1e3:.2f} mm of slip"
    shape = CURVES[form]
    return Law(shape, text, write, 0.3, 1.5)


@LAWS.add
def velocity_weakening(rng: np.random.Generator, r: Reference) -> Law:
    form = int(one_of(rng, curves.SLOW_HYPERBOLA, curves.ARCTAN, curves.STRETCHED))
    speed = float(rng.uniform(0.4, 1.2)) * r.speed
    q = 0.6 if form == curves.SLOW_HYPERBOLA else 1.0
    write = sets("weakening", form=form, speed=speed, power=q)
    text = f"mu_k (1 - strength * ({CURVES[form]})), u = sliding speed / {speed:.4g} m/s, q = {q}"
    shape = CURVES[form]
    return Law(shape, text, write, 0.3, 0.7)


@LAWS.add
def film_drag(rng: np.random.Generator, r: Reference) -> Law:
    form, q = int(one_of(rng, curves.POWER, curves.TANH, curves.ASINH)), 1.3
    speed = r.speed * (float(rng.uniform(0.6, 1.5)) if form == curves.TANH else 1.0)
    write = sets("film", r.friction, form=form, speed=speed, power=q)
    text = f"drag strength * {r.friction:.4g} N * ({CURVES[form]}), u = sliding speed / "
    text += f"{speed:.4g} m/s, q = {q}"
    shape = CURVES[form]
    return Law(shape, text, write, 0.06, 0.8)


@LAWS.add
def thermal_weakening(rng: np.random.Generator, r: Reference) -> Law:
    form, static = int(one_of(rng, curves.TANH, curves.DELAYED)), int(one_of(rng, *KEPT))
    per = str(one_of(rng, "joule", "kilogram"))
    times = np.array([rng.uniform(0.15, 0.4), rng.uniform(1.5, 4.0), rng.uniform(15, 40)])
    weights, rates = np.zeros(MODES), np.zeros(MODES)
    rates[:3] = 1 / times
    weights[:3] = np.array([0.2, 0.4, 0.4]) * rates[:3]
    power = r.friction * r.speed
    write = sets("heat", form=form, reference=power, static=static, weight=weights, rate=rates)
    text = f"mu_k (1 - 0.9 ({CURVES[form]})), u = strength * (0.2, 0.4, 0.4 of the friction power, "
    text += f"means of the last {times[0]:.2f}, {times[1]:.1f}, {times[2]:.0f} s) / {power:.4g} W; "
    return Law(
        f"three-stage, {CURVES[form]}, per {per}",
        text + KEPT[static],
        write,
        0.3,
        1.5,
        exponents={"mass": -1.0} if per == "kilogram" else {},
    )


@LAWS.add
def run_in(rng: np.random.Generator, r: Reference) -> Law:
    form = int(one_of(rng, curves.STRETCHED, curves.DELAYED, curves.RETURNING))
    static, sign = int(one_of(rng, STAYS, SCALES)), float(rng.choice((-1, 1), p=(0.7, 0.3)))
    q, distance = float(rng.uniform(0.45, 0.7)), float(rng.uniform(0.15, 0.35)) * r.longest
    write = sets("run_in", sign, form=form, distance=distance, power=q, static=static)
    text = f"mu_k (1 {sign:+.0f} strength * ({CURVES[form]})), u = distance / {distance:.3g} m, "
    text += f"q = {q:.2f}; {KEPT[static]}"
    name = f"{CURVES[form]}, {KEPT[static]}"
    return Law(name, text, write, 0.2, 0.5)


@LAWS.add
def spring_hardening(rng: np.random.Generator, r: Reference) -> Law:
    form = int(one_of(rng, *SPRINGS))

    def write(p: Record, strength: float) -> None:
        p["spring_form"] = form
        reach = {
            curves.LESS_THAN_CUBIC: (strength / 1.7) ** (1 / 0.7),
            curves.ENDING: (strength / 3) ** 0.5,
            curves.TENSION_POWER: (strength / 2.4) ** (1 / 1.4),
        }
        p["spring_b"] = ruler(p, r) / reach[form]

    text = f"each spring {SPRINGS[form]} in its extension e, stiffer by strength at the static load"
    return Law(SPRINGS[form], text, write, 0.2, 2.0)


@LAWS.add
def structural_damping(rng: np.random.Generator, r: Reference) -> Law:
    form, q = one_of(rng, (curves.POWER, 3.0), (curves.POWER, 1.25), (curves.TANH, 1.0))
    write = sets("damping", r.friction, form=form, power=q, speed=r.speed)
    text = f"against the frame strength * {r.friction:.4g} N * ({CURVES[form]}), u = speed / "
    text += f"{r.speed:.4g} m/s, q = {q}"
    shape = f"{CURVES[form]} {q}"
    return Law(shape, text, write, 0.03)


@LAWS.add
def speed_ripple(rng: np.random.Generator, r: Reference) -> Law:
    form, frequency = int(one_of(rng, *list(WAVES)[:3])), float(rng.uniform(0.25, 1.3))
    roller, own = bool(rng.random() < 0.5), bool(rng.random() < 0.6)

    def write(p: Record, strength: float) -> None:
        p["ripple_form"], p["ripple"] = form, strength
        p["ripple_start"] = p["phase"] if own else 0.0
        p["ripple_frequency"] = frequency * (p["belt_speed"] / r.speed if roller else 1.0)

    rate = f"{frequency:.3g} Hz" + (f" at {r.speed:.3g} m/s, in proportion" if roller else "")
    shape = WAVES[form] + (", roller" if roller else "")
    return Law(shape, f"speed (1 + strength * {shape}), {rate}", write, 0.1, 0.5)


@LAWS.add
def surface_pattern(rng: np.random.Generator, r: Reference) -> Law:
    form = int(one_of(rng, curves.TRIANGLE, curves.HALF_WAVE, curves.RAMP))
    length = float(max(rng.uniform(0.12, 0.3) * r.travel, 4 * r.deflection))
    length, common = min(length, 0.5 * r.travel), bool(rng.random() < 0.4)
    first = float(rng.uniform(0, length))

    def write(p: Record, strength: float) -> None:
        p["pattern_form"], p["pattern"] = form, strength
        p["pattern_length"] = p["pattern_width"] = length
        p["pattern_start"] = first if common else p["phase"] * length

    start = "same start in every run" if common else "own start in every run"
    text = f"mu (1 + strength * {WAVES[form]}) every {length:.3g} m of surface; {start}"
    return Law(WAVES[form], text, write, 0.15, 0.6)


@LAWS.add
def load_dependence(rng: np.random.Generator, r: Reference) -> Law:
    hertz, sign = bool(rng.random() < 0.5), float(rng.choice((-1, 1), p=(0.7, 0.3)))
    write = sets("load", sign, form=curves.FRESH + hertz, reference=r.load)
    curve = (
        f"1 {sign:+.0f} strength (1 - n^(-1/3))" if hertz else f"exp({sign:+.0f} strength (n-1))"
    )
    text = f"mu times {curve}, n = load / {r.load:.4g} N"
    shape, most = ("Hertzian part", 1.2) if hertz else ("exponential", 0.5)
    return Law(shape, text, write, 0.3, most)


@LAWS.add
def spring_misalignment(rng: np.random.Generator, r: Reference) -> Law:
    shape, first = str(one_of(rng, "frame turned", "diagonal pair")), int(rng.integers(2))
    sign = float(one_of(rng, -1, 1))

    def write(p: Record, strength: float) -> None:
        x, y = p["anchor_x"].copy(), p["anchor_y"].copy()
        if shape == "frame turned":
            c, s = np.cos(sign * strength), np.sin(sign * strength)
            p["anchor_x"], p["anchor_y"] = c * x - s * y, s * x + c * y
        else:
            pair = [first, 3 - first]
            p["anchor_y"][pair] = y[pair] + sign * strength * abs(x[pair] - p["hook_x"][pair])

    text = f"{shape}: by strength, rad, or by strength times the spring's length sideways"
    return Law(shape, text, write, 0.05, 0.35, planar=True)


def straight_film(rng: np.random.Generator, r: Reference) -> Law:
    write = sets("film", r.friction, form=curves.POWER, speed=r.speed, power=1.0)
    text = f"drag strength * {r.friction:.4g} N * sliding speed / {r.speed:.4g} m/s"
    return Law("linear", text, write, 0.05)


def straight_damping(rng: np.random.Generator, r: Reference) -> Law:
    write = sets("damping", r.friction, form=curves.POWER, speed=r.speed, power=1.0)
    text = f"against the frame strength * {r.friction:.4g} N * speed / {r.speed:.4g} m/s"
    return Law("linear", text, write, 0.05)


def plain_run_in(rng: np.random.Generator, r: Reference) -> Law:
    distance = float(rng.uniform(6, 12)) * r.speed
    write = sets("run_in", -1.0, form=curves.STRETCHED, distance=distance, power=1.0)
    text = f"mu_k (1 - strength * (1 - exp(-distance / {distance:.3g} m))); mu_s stays"
    return Law("exponential", text, write, 0.2, 0.5)


def plain_heat(rng: np.random.Generator, r: Reference) -> Law:
    weights, rates = np.zeros(MODES), np.zeros(MODES)
    weights[0] = rates[0] = 1 / rng.uniform(7, 14)
    power = r.friction * r.speed
    write = sets("heat", form=1, reference=power, weight=weights, rate=rates)
    text = f"mu_k (1 - strength * mean friction power of the last {1 / rates[0]:.1f} s / "
    text += f"{power:.4g} W); mu_s stays"
    return Law("linear", text, write, 0.2, 0.5)


ALIKE = LAWS | {
    "film_drag": straight_film,
    "structural_damping": straight_damping,
    "run_in": plain_run_in,
    "thermal_weakening": plain_heat,
}
