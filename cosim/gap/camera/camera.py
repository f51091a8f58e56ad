"""From the motion of a block to the picture of it, and back: one camera's faults at work.

Light and lens, then the chip, then the stand, the filter and the clock:

    p(s) = (1 + a) R(alpha) r(s) + d(s)                  the picture of the place r at true time s
    q(t) = p(t + c (q_x(t) - q_x(0)))                    read out line by line: implicit in q_x
    w(t) = int K(u) q(t - u) du,     written at (1 + b) t

a `measurement.scale`, b `.clock`, alpha `.rotation`, c `.latency` over 0.1 m, d `.drift` (linear,
settling and logarithmic in time), K `.smoothing`. R turns the axes: x' = x cos + y sin. The angle
phi of the block has a zero of its own wherever the mark was glued on, and is left alone.

A delay that is the same for every sample is not among them: where nothing else runs on the same
clock, a record that begins later is the same record, and no data show it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .faults import ACROSS, is_fault
from .filters import exponential, gaussian


@dataclass(frozen=True)
class Camera:
    """Numbers of the faults, `measurement.*` -> value; what is missing is faultless."""

    numbers: Mapping[str, float]

    @staticmethod
    def split(values: Mapping[str, float]) -> tuple[dict[str, float], Camera]:
        """What belongs to the model, and the camera with the rest."""
        model = {key: value for key, value in values.items() if not is_fault(key)}
        return model, Camera({key: value for key, value in values.items() if is_fault(key)})

    def __getitem__(self, name: str) -> float:
        return self.numbers.get(f"measurement.{name}", 0.0)

    @property
    def is_perfect(self) -> bool:
        """Whether it writes the motion as it is."""
        return not any(value for key, value in self.numbers.items() if not key.endswith("_time"))

    @property
    def per_metre(self) -> float:
        """c: how much later a place one metre further is seen, s/m."""
        return self["latency"] / ACROSS

    @property
    def filters(self) -> bool:
        """Whether neighbouring samples are mixed."""
        return bool(self["smoothing"] or self["smoothing_past"])

    @property
    def kernel(self) -> tuple[np.ndarray, np.ndarray]:
        """Delays, s, and weights of the filter: both where there are two, one after the other."""
        delays, weights = np.zeros(1), np.ones(1)
        for name, kernel in (("smoothing", gaussian), ("smoothing_past", exponential)):
            if self[name]:
                further, more = kernel(self[name])
                delays = np.add.outer(delays, further).ravel()
                weights = np.multiply.outer(weights, more).ravel()
        return delays, weights

    @property
    def reach(self) -> float:
        """How far ahead of a sample its filter looks, s."""
        return max(0.0, -float(self.kernel[0].min()))

    @property
    def needs_velocity(self) -> bool:
        """Whether what is written of an instant depends on more than the place at that instant."""
        return self.filters or bool(self["latency"])

    @property
    def clock(self) -> float:
        """Written time over true time."""
        return 1.0 + self["clock"]

    @cached_property
    def _turn(self) -> tuple[float, float]:
        return math.cos(self["rotation"]), math.sin(self["rotation"])

    def drift(self, time: np.ndarray) -> np.ndarray:
        """(n, 2) m, of the zeros of x and y at so many seconds (n,) after the first sample."""
        courses = (
            ("drift_rate", time),
            ("drift", _settled(time, self["drift_time"])),
            ("drift_log", _crept(time, self["drift_log_time"])),
        )
        axes = [sum(self[f"{name}_{axis}"] * course for name, course in courses) for axis in "xy"]
        return np.stack(axes, axis=-1)

    def drift_rate(self, time: np.ndarray) -> np.ndarray:
        """(n, 2) m/s, of `drift`."""
        step = 1e-6 * max(float(time[-1]) if time.size else 0.0, 1.0)
        return (self.drift(time + step) - self.drift(time)) / step

    def turned(self, vectors: np.ndarray) -> np.ndarray:
        """(n, 2+) with x and y in front, turned and scaled as in the picture."""
        return self._scaled(vectors, 1.0)

    def turned_back(self, vectors: np.ndarray) -> np.ndarray:
        """The inverse of `turned`."""
        return self._scaled(vectors, -1.0)

    def _scaled(self, vectors: np.ndarray, sign: float) -> np.ndarray:
        result = np.array(vectors, dtype=float)
        scale = 1.0 + self["scale"]
        if self["rotation"]:  # a missing y would take x with it
            cos, sin = self._turn[0], sign * self._turn[1]
            x, y = result[..., 0].copy(), result[..., 1].copy()
            result[..., 0], result[..., 1] = cos * x + sin * y, cos * y - sin * x
        result[..., :2] *= scale if sign > 0.0 else 1.0 / scale
        return result

    def pictured(self, places: np.ndarray, time: np.ndarray) -> np.ndarray:
        """(n, 3) places x, y, phi at true times (n,) as they are in the picture."""
        picture = self.turned(places)
        picture[:, :2] += self.drift(time)
        return picture

    def pictured_rates(self, velocities: np.ndarray, time: np.ndarray) -> np.ndarray:
        """(n, 3) velocities likewise."""
        rates = self.turned(velocities)
        rates[:, :2] += self.drift_rate(time)
        return rates


def _settled(time: np.ndarray, constant: float) -> np.ndarray:
    return -np.expm1(-time / constant) if constant > 0.0 else np.zeros_like(time)


def _crept(time: np.ndarray, constant: float) -> np.ndarray:
    return np.log1p(time / constant) if constant > 0.0 else np.zeros_like(time)
