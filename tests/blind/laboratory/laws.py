"""What is hidden: for every effect of the interfaces several laws, none of them a plain textbook's.

A law is drawn with its shape's numbers and then given a strength; `apply` writes both into a
record. `stick_stiffness` is missing on purpose: it is an error of a computing scheme, which no rig
can have.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from functools import wraps

import numpy as np
from numpy.typing import NDArray

from .apparatus import MODES, PRESSURES, Record, spread_contact
from .friction_law import FOLLOWS, SCALES, STAYS, half_space


@dataclass(frozen=True)
class Reference:
    """What is typical of a campaign: the scales of its laws. SI units."""

    speed: float  # median of the belt
    fastest: float
    mass: float  # median
    load: float  # N
    friction: float  # kinetic, N
    deflection: float  # m of the springs under the static friction
    travel: float  # m, shortest of the runs
    longest: float  # m, longest
    duration: float
    contact_radius: float


@dataclass(frozen=True)
class Law:
    """A law with its shape drawn, its strength still open.

    exponents : by quantity (mass, speed), the power with which the strength goes from run to run,
    beside what `text` states: none where mu-laws are shares of mu, forces are N, heat is J
    """

    shape: str
    text: str
    write: Callable[[Record, float], None]
    start: float = 0.2  # a strength to begin with
    most: float = 0.6
    sized: bool = True  # has a strength at all
    planar: bool = False  # needs a block that is free in the plane
    exponents: dict[str, float] = field(default_factory=dict)

    def apply(self, p: Record, strength: float, reference: Reference) -> None:
        """Put the law into a run's record, its strength scaled to the run's mass and speed."""
        ratio = {"mass": p["mass"] / reference.mass, "speed": p["belt_speed"] / reference.speed}
        for quantity, power in self.exponents.items():
            strength = strength * float(ratio[quantity]) ** power
        self.write(p, strength)


class Named(dict):
    """Functions by their names, in the order in which they are written."""

    def add(self, function: Callable) -> Callable:
        self[function.__name__] = function
        return function

    def of(self, form: int) -> Callable[[Callable], Callable]:
        """The same of what draws the numbers of a kind that no catalogue holds, the size first."""

        def add(numbers: Callable[[float, np.random.Generator, Reference], Iterable]) -> Callable:
            @wraps(numbers)
            def write(p: Record, size: float, rng: np.random.Generator, r: Reference) -> None:
                p["other_form"] = form
                drawn = [*numbers(size, rng, r)]
                p["other"][: len(drawn)] = drawn

            return self.add(write)

        return add


LAWS = Named()


def ruler(p: Record, r: Reference) -> float:
    """Extension of a spring at the static load, m."""
    return abs(float(p["anchor_x"][0] - p["hook_x"][0])) - float(p["natural"][0]) + r.deflection


def one_of(rng: np.random.Generator, *options):
    return options[int(rng.integers(len(options)))]


def sets(
    name: str, scale: float = 1.0, **numbers: float | NDArray
) -> Callable[[Record, float], None]:
    """A writer of the strength, scaled, into the field named; numbers: of NAME_KEY for each key."""

    def write(p: Record, strength: float) -> None:
        for key, value in numbers.items():
            p[f"{name}_{key}"] = value
        p[name] = scale * strength

    return write


@LAWS.add
def lateral_friction(rng: np.random.Generator, r: Reference) -> Law:
    pressure = str(one_of(rng, *PRESSURES))

    def write(p: Record, strength: float) -> None:
        p["planar"] = 1
        spread_contact(p, r.contact_radius, pressure)

    text = f"friction against the slip of every point of a disc, pressure {pressure}"
    return Law(pressure, text, write, 1.0, 1.0, sized=False, planar=True)


@LAWS.add
def turning_surface(rng: np.random.Generator, r: Reference) -> Law:
    pressure, side = str(one_of(rng, *PRESSURES)), float(one_of(rng, -1, 1))
    ahead = float(one_of(rng, 0.0, np.tan(np.radians(rng.uniform(1, 4)))))

    def write(p: Record, strength: float) -> None:
        p["planar"] = 1
        spread_contact(p, r.contact_radius, pressure)
        p["slab_y"] = side / strength
        p["slab_x"] = ahead / strength

    shape = "abreast" if ahead == 0 else "ahead"
    text = f"slab turning about a point 1/strength m abreast, {ahead:.3f} of it ahead; disc"
    return Law(shape, text, write, 1.0, 3.0, planar=True)


@LAWS.add
def static_strengthening(rng: np.random.Generator, r: Reference) -> Law:
    form = int(one_of(rng, 1, 2, 3))
    time = {1: rng.uniform(0.01, 0.05), 2: 1.0, 3: rng.uniform(0.25, 1.0)}[form]
    power = float(rng.uniform(0.25, 0.5))
    write = sets("ageing", form=form, time=time, power=power)
    shape = {1: "logarithm", 2: "power", 3: "saturating"}[form]
    curve = {
        1: f"log10(1 + t/{time:.3f} s)",
        2: f"(t/1 s)^{power:.2f}",
        3: f"1 - exp(-t/{time:.2f} s)",
    }[form]
    text = f"mu_s grows by strength * mu_k * ({curve}) over hold time t, lost over 0.3 mm of slip"
    return Law(shape, text, write, 0.2, 1.5)


@LAWS.add
def velocity_weakening(rng: np.random.Generator, r: Reference) -> Law:
    form = int(one_of(rng, 1, 2, 3))
    speed = 2 * r.fastest if form != 2 else float(rng.uniform(0.3, 1.0)) * r.speed
    power = float(one_of(rng, 0.5, 0.7, 1.5))
    write = sets("weakening", form=form, speed=speed, power=power)
    shape = {1: f"power {power}", 2: "hyperbola", 3: "logarithm"}[form]
    curve = {1: f"u^{power}", 2: "u/(1 + u)", 3: "ln(1 + 3u)"}[form]
    text = f"mu_k (1 - strength * {curve}), u = sliding speed / {speed:.4g} m/s"
    most = {1: 0.7, 2: 0.7, 3: 0.5}[form]
    return Law(shape, text, write, 0.3, most)


@LAWS.add
def film_drag(rng: np.random.Generator, r: Reference) -> Law:
    form, power = int(one_of(rng, 1, 1, 2)), float(one_of(rng, 0.5, 0.7, 1.5))
    write = sets("film", r.friction, form=form, speed=r.speed, power=power)
    shape = f"power {power}" if form == 1 else "thinning"
    curve = f"u^{power}" if form == 1 else "u/(1 + u)"
    text = f"drag strength * {r.friction:.4g} N * {curve}, u = sliding speed / {r.speed:.4g} m/s"
    return Law(shape, text, write, 0.06, 0.8)


@LAWS.add
def thermal_weakening(rng: np.random.Generator, r: Reference) -> Law:
    memory, form = (
        str(one_of(rng, "half-space", "half-space", "two-stage")),
        int(rng.integers(1, 4)),
    )
    per = str(one_of(rng, "joule", "kilogram"))
    static = int(one_of(rng, STAYS, SCALES, FOLLOWS))
    power = r.friction * r.speed
    weights, rates = half_space()
    typical = 2 * power * np.sqrt(r.duration / np.pi)
    if memory == "two-stage":
        weights, rates = np.zeros(MODES), np.zeros(MODES)
        rates[:2] = 1 / rng.uniform(0.3, 1.0), 1 / rng.uniform(6, 15)
        weights[:2] = 0.4 * rates[0], 0.6 * rates[1]
        typical = power
    write = sets("heat", form=form, reference=typical, static=static, weight=weights, rate=rates)
    curve = {1: "1 - q", 2: "exp(-q)", 3: "1/(1 + q)"}[form]
    way = {STAYS: "mu_s stays", SCALES: "mu_s in proportion", FOLLOWS: "mu_s by as much"}[static]
    text = (
        f"mu_k times {curve}, q = strength * heat of friction, J, through a {memory} memory"
        f" / {typical:.4g}; {way}"
    )
    exponents = {"mass": -1.0} if per == "kilogram" else {}
    shape = f"{memory}, {curve}, per {per}"
    return Law(shape, text, write, 0.3, 1.5, exponents=exponents)


@LAWS.add
def run_in(rng: np.random.Generator, r: Reference) -> Law:
    form, static = int(rng.integers(1, 5)), int(one_of(rng, STAYS, SCALES))
    distance = float(rng.uniform(0.3, 0.8)) * r.longest
    if form != 4:
        distance *= 0.4
    sign = -1.0 if rng.random() < 0.7 else 1.0
    power = float(rng.uniform(0.5, 1.2))
    write = sets("run_in", sign, form=form, distance=distance, power=power, static=static)
    shape = {1: "exponential", 2: "power", 3: "two-stage", 4: "logarithm"}[form]
    curve = {
        1: "1 - exp(-u)",
        2: f"1 - (1 + u)^-{power:.2f}",
        3: "half in u = 1/6, half in u = 1.5",
        4: "ln(1 + 3u)/ln 4",
    }[form]
    kept = "mu_s in proportion" if static == SCALES else "mu_s stays"
    text = f"mu_k (1 {sign:+.0f} strength * ({curve})), u = distance / {distance:.3g} m; {kept}"
    name = f"{shape}, {kept}"
    return Law(name, text, write, 0.2, 0.5)


@LAWS.add
def spring_hardening(rng: np.random.Generator, r: Reference) -> Law:
    form = int(rng.integers(1, 4))

    def write(p: Record, strength: float) -> None:
        p["spring_form"] = form
        power = {1: strength**-0.25, 2: (6 * strength) ** -0.5, 3: strength**-0.5}[form]
        p["spring_b"] = ruler(p, r) * power

    shape = {1: "quintic", 2: "sinh", 3: "cubic in tension only"}[form]
    text = (
        f"each spring {shape} in its full extension, stiffer by about strength at the static load"
    )
    return Law(shape, text, write, 0.2, 3.0)


@LAWS.add
def structural_damping(rng: np.random.Generator, r: Reference) -> Law:
    power = float(one_of(rng, 2.0, 1.5, 0.7))
    write = sets("damping", r.friction, power=power, speed=r.speed)
    text = f"against the frame strength * {r.friction:.4g} N * (speed / {r.speed:.4g} m/s)^{power}"
    return Law(f"power {power}", text, write, 0.03, 1.0)


@LAWS.add
def speed_ripple(rng: np.random.Generator, r: Reference) -> Law:
    form, roller = int(rng.integers(1, 4)), bool(rng.random() < 0.35)
    frequency, own = float(rng.uniform(0.3, 1.6)), bool(rng.random() < 0.6)
    width = float(rng.uniform(0.1, 0.2))

    def write(p: Record, strength: float) -> None:
        p["ripple_form"], p["ripple_width"] = form, width
        p["ripple_start"] = p["phase"] if own else 0.0
        p["ripple_frequency"] = frequency * (p["belt_speed"] / r.speed if roller else 1.0)
        p["ripple"] = strength

    shape = {1: "bump once a turn", 2: "two harmonics", 3: "sawtooth"}[form]
    rate = f"{frequency:.3g} Hz" + (f" at {r.speed:.3g} m/s, in proportion" if roller else "")
    name = shape + (", roller" if roller else "")
    return Law(name, f"speed (1 + strength * {shape}), {rate}", write, 0.1, 0.5)


@LAWS.add
def surface_pattern(rng: np.random.Generator, r: Reference) -> Law:
    form = int(rng.integers(1, 4))
    length = float(max(rng.uniform(0.15, 0.35) * r.travel, 4 * r.deflection))
    length = min(length, 0.5 * r.travel)
    width = length * float(rng.uniform(0.1, 0.2))
    common, first = bool(rng.random() < 0.4), float(rng.uniform(0, length))

    def write(p: Record, strength: float) -> None:
        p["pattern_form"], p["pattern_length"], p["pattern_width"] = form, length, width
        p["pattern"] = strength
        p["pattern_start"] = first if common else p["phase"] * length

    shape = {1: "bumps", 2: "joints", 3: "two materials"}[form]
    phase = "same start in every run" if common else "own start in every run"
    text = f"mu (1 + strength * {shape}) every {length:.3g} m of surface; {phase}"
    return Law(shape, text, write, 0.15, 0.6)


@LAWS.add
def load_dependence(rng: np.random.Generator, r: Reference) -> Law:
    form = int(rng.integers(1, 4))
    sign = -1.0 if form == 1 or rng.random() < 0.6 else 1.0
    sign = 1.0 if form == 2 else sign
    write = sets("load", sign, form=form, reference=r.load)
    shape = {1: "power", 2: "adhesion", 3: "logarithm"}[form]
    curve = {1: "n^-strength", 2: "1 - strength + strength/n", 3: f"1 {sign:+.0f} strength ln n"}
    text = f"mu times {curve[form]}, n = load / {r.load:.4g} N"
    return Law(shape, text, write, 0.25, 0.6)


@LAWS.add
def spring_misalignment(rng: np.random.Generator, r: Reference) -> Law:
    shape = str(one_of(rng, "one anchor", "one side turned", "one spring's two ends"))
    which, sign = int(rng.integers(4)), float(one_of(rng, -1, 1))

    def write(p: Record, strength: float) -> None:
        length = abs(float(p["anchor_x"][0] - p["hook_x"][0]))
        shift = sign * strength * length
        if shape == "one anchor":
            p["anchor_y"][which] += shift
        elif shape == "one side turned":
            side = p["anchor_x"] * p["anchor_x"][which] > 0
            p["anchor_y"][side] += shift
        else:
            p["anchor_y"][which] += shift
            p["hook_y"][which] -= 0.3 * shift

    text = f"{shape} off by strength times the spring's length, sideways"
    return Law(shape, text, write, 0.05, 0.35, planar=True)
