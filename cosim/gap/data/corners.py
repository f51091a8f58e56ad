"""Break-away and re-stick between the samples.

Next to a stick the block vibrates freely, and it does so with the velocity that it has on the
surface: the position is smooth at a corner, its curvature jumps. With tau the time from the corner,

    x = line(t) + (v / omega) (sin(omega tau) - omega tau) + d (1 - cos(omega tau)),

d the distance of the vibration's centre from the corner, holds before a stick as well as after it.
Corner times, the line's level and d are fitted to the samples around; the fit's covariance says how
well the corner is known.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import product

import numpy as np
from scipy.optimize import least_squares

#: Parts of the natural period that are looked at on the slip's side and on the stick's side.
SLIP_SIDE, STICK_SIDE = 0.25, 0.5
#: The fit starts from the best of these shifts away from the stick, parts of a period: a guess from
#: noisy samples rather takes the ends of a stick for slip.
SHIFTS = (0.0, -0.05, 0.05, 0.1, 0.15)


@dataclass(frozen=True)
class Corner:
    """Time of a corner and its standard deviation, s."""

    time: float
    sd: float


def fit_corners(
    time: np.ndarray,
    x: np.ndarray,
    corners: list[tuple[float, int]],
    speed: float,
    omega: float,
    noise: float,
) -> list[Corner] | None:
    """Corners of one stick, one or two; None where the samples do not determine them.

    Parameters
    ----------
    time, x : (n,) arrays around the corners, no sample missing
    corners : for each, about when (s), and on which side the slip is: -1 before, 1 after
    """
    side = np.array([side for _, side in corners])
    guess = np.array([at for at, _ in corners])
    if len(time) < 2 * len(corners) + 3:
        return None
    origin = float(np.mean(guess))
    period = 2.0 * math.pi / omega

    def misfit(offsets: np.ndarray) -> np.ndarray:
        shapes, known = _shapes(time, guess + offsets * period, side, origin, speed, omega)
        left = x - known
        return (left - shapes @ np.linalg.lstsq(shapes, left, rcond=None)[0]) / noise

    starts = [side * np.array(shift) for shift in product(SHIFTS, repeat=len(guess))]
    start = min(starts, key=lambda offsets: float(np.sum(misfit(offsets) ** 2)))
    fit = least_squares(misfit, start, diff_step=1e-4, x_scale=0.05)
    information = fit.jac.T @ fit.jac
    if np.linalg.cond(information) > 1e10 or np.max(np.abs(fit.x)) > SLIP_SIDE:
        return None
    scatter = max(2.0 * fit.cost / (len(time) - 2 * len(guess) - 1), 1.0)
    sd = np.sqrt(np.diag(np.linalg.inv(information)) * scatter) * period
    times = guess + fit.x * period
    if len(times) == 2 and times[1] <= times[0]:
        return None
    return [Corner(float(at), float(error)) for at, error in zip(times, sd, strict=True)]


def _shapes(
    time: np.ndarray,
    corners: np.ndarray,
    sides: np.ndarray,
    origin: float,
    speed: float,
    omega: float,
) -> tuple[np.ndarray, np.ndarray]:
    """What level and distances are multiplied with (n, 1 + corners), and what is known (n,)."""
    known = speed * (time - origin)
    shapes = [np.ones(len(time))]
    for corner, side in zip(corners, sides, strict=True):
        angle = omega * (time - corner)
        angle = np.where(side * angle > 0.0, angle, 0.0)
        known = known + speed / omega * (np.sin(angle) - angle)
        shapes.append(1.0 - np.cos(angle))
    return np.stack(shapes, axis=1), known
