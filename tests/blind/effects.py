"""The fourteen effects of the catalogue, in formulas of an experimenter who has not read it."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from .ingredients import Ingredient, between, either
from .simulator.hidden import Hidden, State

Draw = Callable[[np.random.Generator], Ingredient]


def lateral_friction(rng) -> Ingredient:
    """Friction along the relative velocity, seen by a push aside and a twist at the start."""
    share = 1.0 if rng.random() < 0.75 else rng.uniform(0.5, 1.0)
    aside, twist = either(rng) * 0.015, either(rng) * rng.uniform(0.0, 0.1)

    def push(s: State, strength: float) -> State:
        return s._replace(y=s.y + strength * aside, phi=s.phi + strength * twist)

    return Ingredient(
        "lateral_friction",
        f"share {share:.2f}",
        lambda p, s: p._replace(lateral=share),
        plane=True,
        start=push,
    )


def turning_surface(rng) -> Ingredient:
    """A turning slab, which also drags the block aside."""
    curve = 6.0 * either(rng)
    return Ingredient(
        "turning_surface",
        "slab",
        lambda p, s: p._replace(lateral=1.0, curvature=s * curve),
        plane=True,
    )


def static_strengthening(rng) -> Ingredient:
    form = int(rng.choice((1, 1, 2)))
    seconds = between(rng, 0.005, 0.1) if form == 1 else between(rng, 0.1, 1.0)
    top = 0.35 if form == 1 else 0.5
    return Ingredient(
        "static_strengthening",
        ("logarithm", "saturating")[form - 1],
        lambda p, s: p._replace(ageing_form=form, ageing=s * top, ageing_time=seconds),
    )


def velocity_weakening(rng) -> Ingredient:
    form = int(rng.integers(1, 5))
    top = (3.0, 10.0, 0.8, 40.0)[form - 1]
    speed = between(rng, 0.03, 0.3)
    return Ingredient(
        "velocity_weakening",
        ("linear", "hyperbola", "stribeck", "inverse root")[form - 1],
        lambda p, s: p._replace(weakening_form=form, weakening=s * top, weakening_speed=speed),
    )


def film_drag(rng) -> Ingredient:
    if rng.random() < 0.6:
        return Ingredient("film_drag", "linear", lambda p, s: p._replace(drag=8.0 * s))
    return Ingredient("film_drag", "root", lambda p, s: p._replace(root_drag=4.0 * s))


def thermal_weakening(rng) -> Ingredient:
    form, seconds = int(rng.integers(1, 4)), between(rng, 0.5, 20.0)
    return Ingredient(
        "thermal_weakening",
        ("linear", "exponential", "hyperbola")[form - 1],
        lambda p, s: p._replace(thermal_form=form, thermal=3.0 * s, thermal_time=seconds),
    )


def run_in(rng) -> Ingredient:
    form, way, sign = int(rng.integers(1, 4)), between(rng, 0.4, 3.0), either(rng)
    return Ingredient(
        "run_in",
        ("exponential", "ramp", "hyperbola")[form - 1],
        lambda p, s: p._replace(run_in_form=form, run_in=0.6 * sign * s, run_in_way=way),
    )


def spring_hardening(rng) -> Ingredient:
    form = int(rng.choice((1, 1, 2)))
    top = (2e4, 2e5)[form - 1]
    return Ingredient(
        "spring_hardening",
        ("of the elongation", "of the change")[form - 1],
        lambda p, s: p._replace(cubic_form=form, cubic=s * top),
    )


def structural_damping(rng) -> Ingredient:
    yaw = between(rng, 1e-4, 1e-2)
    return Ingredient(
        "structural_damping",
        "viscous",
        lambda p, s: p._replace(damping=8.0 * s, damping_yaw=yaw * s),
    )


def speed_ripple(rng) -> Ingredient:
    form, phase, hertz = int(rng.choice((1, 1, 2))), rng.uniform(0, 2 * math.pi), 0.0
    roller = between(rng, 0.05, 0.4) if rng.random() < 0.25 else 0.0
    hertz = between(rng, 0.3, 8.0)

    def change(p: Hidden, s: float) -> Hidden:
        f = abs(p.speed) / roller if roller else hertz
        return p._replace(ripple_form=form, ripple=0.6 * s, ripple_hz=f, ripple_phase=phase)

    shape = ("sine", "with a second harmonic")[form - 1]
    place = f"roller of {roller:.3f} m" if roller else f"{hertz:.2f} Hz"
    return Ingredient("speed_ripple", f"{shape}, {place}", change)


def surface_pattern(rng) -> Ingredient:
    form, phase = int(rng.choice((1, 1, 2))), rng.uniform(0, 2 * math.pi)
    wave = between(rng, 0.03, 0.5)

    def change(p: Hidden, s: float) -> Hidden:
        return p._replace(
            pattern_form=form, pattern=0.5 * s, pattern_length=wave, pattern_phase=phase
        )

    shape = ("sine", "with a second harmonic")[form - 1]
    return Ingredient("surface_pattern", f"{shape}, {wave:.3f} m", change)


def load_dependence(rng) -> Ingredient:
    power, sign, reference = rng.random() < 0.6, either(rng), 9.81 * 0.87

    def change(p: Hidden, s: float) -> Hidden:
        n = 9.81 * p.mass / reference
        part = n ** (-sign * s) if power else max(1.0 - 0.5 * sign * s * (n - 1.0), 0.2)
        return p._replace(mu_s=p.mu_s * part, mu_k=p.mu_k * part)

    return Ingredient("load_dependence", "power" if power else "straight line", change)


def spring_misalignment(rng) -> Ingredient:
    sign = either(rng)
    if rng.random() < 0.5:
        return Ingredient(
            "spring_misalignment",
            "shifted anchors",
            lambda p, s: p._replace(spring_shift=0.04 * sign * s),
            plane=True,
        )
    return Ingredient(
        "spring_misalignment",
        "turned springs",
        lambda p, s: p._replace(spring_turn=math.radians(15.0) * sign * s),
        plane=True,
    )


def stick_stiffness(rng) -> Ingredient:
    share = rng.uniform(0.25, 0.75)
    return Ingredient(
        "stick_stiffness",
        f"share {share:.2f}",
        lambda p, s: p._replace(stick_share=share),
        sized=False,
        known=True,
    )


EFFECTS: dict[str, Draw] = {
    draw.__name__: draw
    for draw in (
        lateral_friction,
        turning_surface,
        static_strengthening,
        velocity_weakening,
        film_drag,
        thermal_weakening,
        run_in,
        spring_hardening,
        structural_damping,
        speed_ripple,
        surface_pattern,
        load_dependence,
        spring_misalignment,
        stick_stiffness,
    )
}
