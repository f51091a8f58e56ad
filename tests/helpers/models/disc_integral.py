"""Friction of a sliding and spinning disc whose coefficient depends on the local speed: adaptive.

Unit radius, uniform pressure, per unit of normal force. Disc of sliding speed U and rim speed s.
"""

from collections.abc import Callable

import numpy as np
from scipy.integrate import dblquad


def law_over_disc(
    law: Callable[[float], float], sliding: float, spinning: float, accuracy: float = 1e-10
) -> tuple[float, float]:
    """Mean force along the sliding and mean moment of mu(|u|) u/|u| over the disc.

    Where the centre of rotation lies inside, polar coordinates about it (distance |u|/s, angle):
    the direction of u is then smooth up to where u vanishes. Else about the disc's centre.
    """
    if sliding < spinning:
        return _about_rotation(law, spinning, sliding / spinning, accuracy)
    return _about_disc(law, sliding, spinning, accuracy)


def _about_rotation(law, spinning, k, accuracy):
    """Centre of rotation (0, k) in the disc's frame; the point at (q, t) slides along cos t."""

    def reach(t):
        return k * np.cos(t) + np.sqrt(1.0 - (k * np.sin(t)) ** 2)

    def part(weight):
        value, _ = dblquad(
            lambda q, t: law(spinning * q) * weight(q, t) * q, 0.0, np.pi, 0.0, reach,
            epsabs=accuracy, epsrel=accuracy,
        )  # fmt: skip
        return 2.0 / np.pi * value  # both halves, over the area

    return part(lambda q, t: np.cos(t)), part(lambda q, t: q - k * np.cos(t))


def _about_disc(law, sliding, spinning, accuracy):
    def part(weight):
        def integrand(r, t):
            ux, uy = sliding - spinning * r * np.sin(t), spinning * r * np.cos(t)
            speed = np.hypot(ux, uy)
            return law(speed) * weight(r, t, ux, uy) / speed * r

        value, _ = dblquad(
            integrand, -np.pi / 2, np.pi / 2, 0.0, 1.0, epsabs=accuracy, epsrel=accuracy
        )
        return 2.0 / np.pi * value

    return (
        part(lambda r, t, ux, uy: ux),
        part(lambda r, t, ux, uy: r * (np.cos(t) * uy - np.sin(t) * ux)),
    )
