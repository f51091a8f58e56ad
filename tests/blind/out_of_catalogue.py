"""Effects that the catalogue does not hold: the honest verdict on them is `unknown`."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from .hidden import Hidden
from .ingredients import Ingredient, between, either

Draw = Callable[[np.random.Generator], Ingredient]


def resonator(rng) -> Ingredient:
    """A second mass on a spring inside the block."""
    hertz, loss = between(rng, 1.2, 6.0), rng.uniform(0.005, 0.05)

    def change(p: Hidden, s: float) -> Hidden:
        mass, omega = 0.5 * s * p.mass, 2 * math.pi * hertz
        return p._replace(
            resonator_mass=mass,
            resonator_stiffness=mass * omega**2,
            resonator_damping=2 * loss * mass * omega,
        )

    return Ingredient("resonator", f"{hertz:.2f} Hz", change)


def play(rng) -> Ingredient:
    """Backlash between springs and block."""
    return Ingredient("play", "dead band", lambda p, s: p._replace(play=0.012 * s))


def tilted_rig(rng) -> Ingredient:
    """The rig leans aside, and a little along the belt."""
    aside, along = 0.08 * either(rng), 0.02 * rng.uniform(-1, 1)
    return Ingredient(
        "tilted_rig",
        "sideways",
        lambda p, s: p._replace(tilt_y=aside * s, tilt_x=along * s),
        plane=True,
    )


def asymmetric_friction(rng) -> Ingredient:
    """Friction differs between the two directions of sliding; seen on a belt that runs both."""
    return Ingredient(
        "asymmetric_friction", "two directions", lambda p, s: p._replace(asymmetry=0.8 * s)
    )


def creeping_spring(rng) -> Ingredient:
    """Springs lose stiffness during the run."""
    seconds = between(rng, 3.0, 20.0)
    return Ingredient(
        "creeping_spring",
        f"{seconds:.1f} s",
        lambda p, s: p._replace(leak=0.6 * s, leak_time=seconds),
    )


def bent_tracker(rng) -> Ingredient:
    """The tracker's image is compressed away from its centre."""
    centre = rng.uniform(-0.01, 0.01)

    def seen(x: np.ndarray, s: float) -> np.ndarray:
        width = 0.01 / max(s, 1e-6)
        return centre + width * np.tanh((x - centre) / width)

    return Ingredient("bent_tracker", "compressed", lambda p, s: p, pixel=seen)


def coarse_tracker(rng) -> Ingredient:
    """The tracker reports whole pixels."""

    def seen(x: np.ndarray, s: float) -> np.ndarray:
        pixel = 0.012 * max(s, 1e-6)
        return pixel * np.round(x / pixel)

    return Ingredient("coarse_tracker", "whole pixels", lambda p, s: p, pixel=seen)


def belt_seam(rng) -> Ingredient:
    """A blow once a loop of the belt."""
    loop, width, sign = rng.uniform(0.5, 1.6), rng.uniform(0.004, 0.012), either(rng)
    return Ingredient(
        "belt_seam",
        f"loop {loop:.2f} m",
        lambda p, s: p._replace(seam=12.0 * sign * s, seam_loop=loop, seam_width=width),
    )


def magnet(rng) -> Ingredient:
    """A force that draws the block to a place or away from it."""
    sign, place, width = either(rng), rng.uniform(0.0, 0.015), rng.uniform(0.002, 0.006)
    return Ingredient(
        "magnet",
        "draws" if sign > 0 else "pushes",
        lambda p, s: p._replace(magnet=2.0 * sign * s, magnet_place=place, magnet_width=width),
    )


def shaking_frame(rng) -> Ingredient:
    """The frame that holds the springs is shaken."""
    hertz = between(rng, 0.5, 7.0)
    return Ingredient(
        "shaking_frame",
        f"{hertz:.2f} Hz",
        lambda p, s: p._replace(shake=0.01 * s, shake_hz=hertz),
    )


def melting_block(rng) -> Ingredient:
    """The block loses mass during the run."""
    return Ingredient("melting_block", "steady", lambda p, s: p._replace(melting=0.04 * s))


def lifting_springs(rng) -> Ingredient:
    """The springs lift or press the block as it moves."""
    sign = either(rng)
    return Ingredient(
        "lifting_springs", "with x", lambda p, s: p._replace(lifting=400.0 * sign * s)
    )


OUT_OF_CATALOGUE: dict[str, Draw] = {
    draw.__name__: draw
    for draw in (
        resonator,
        play,
        tilted_rig,
        asymmetric_friction,
        creeping_spring,
        bent_tracker,
        coarse_tracker,
        belt_seam,
        magnet,
        shaking_frame,
        melting_block,
        lifting_springs,
    )
}
