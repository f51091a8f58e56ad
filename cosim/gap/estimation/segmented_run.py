"""One measured run beside the model: from parameters to residuals in units of the noise."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from stickslip.effects import EFFECTS
from stickslip.kernel import layout
from stickslip.packing import GRAVITY, pack
from stickslip.restarted import Force, Restarts, simulate_restarted, track_restarted

from cosim.gap.camera.camera import Camera
from cosim.gap.camera.exposure import Exposure

from .drive import (
    SPEED_OFFSET,
    driven_speed,
    model_parameters,
    rig_parameters,
    with_strengths_scaled,
)
from .segments import FRICTION, Segment

#: Columns of the model's outputs, and of its places, that a tracker can see.
COLUMN = {"x": layout.O_X, "y": layout.O_Y, "phi": layout.O_PHI}
_PLACES = (layout.O_X, layout.O_Y, layout.O_PHI)
_VELOCITIES = (layout.O_VX, layout.O_VY, layout.O_OMEGA)
#: Residual, in units of the noise, where the model gave up or left for ever.
LOST = 1e3
#: Part of the weight that pulls the block aside: the sine of a rig's tilt.
TILT = "offset.tilt"
#: Integrator's tolerance in a fit: a hundredth of the noise, and cheap.
TOLERANCE = 1e-6
#: Friction that is another by a larger factor than e to this is none of the run's.
_ENOUGH = 3.0
#: Rim speed over sliding speed up to which a few points of a disc do for a fit: to some 1e-3 of
#: what friction falls by.
_FEW_POINTS = 0.6
#: So many times the longest step of a co-simulation: a sixth of a period, still good to 1e-7 m.
_LONGER = 2.0
#: In stick, of a surface that is even and steady: the load only grows, and no break-away is missed.
_LONGER_STICK = 20.0
#: What makes a surface uneven or unsteady, where it is not 0.
_UNEVEN = tuple(
    f"{effect.id}.{name}"
    for effect in EFFECTS
    if effect.enters == "surface" or effect.axis == "place"
    for name in effect.switch
)


def _is_uneven(values: Mapping[str, float]) -> bool:
    """Whether the load of a stick may fall again."""
    return any(values.get(key, 0.0) != 0.0 for key in _UNEVEN)


def _friction(states: np.ndarray) -> np.ndarray:
    """(segments, 2) mu_s and mu_k of segments, in parts of the run's."""
    both, static = np.clip(states[:, FRICTION], -_ENOUGH, _ENOUGH).T
    return np.exp([both + static, both]).T


@dataclass(frozen=True)
class SegmentedRun:
    """A run, cut into segments.

    Attributes
    ----------
    name : of the run
    known : every parameter of the model, `block.parameter` -> value
    speed, temperature : inputs, m/s and degC
    time : (n,) s since the first sample
    channels : name -> (n,) measured values, NaN where missing
    noise : name -> standard deviation of the channel
    segments : the pieces
    setup : number of the mass and springs that it was made with
    """

    name: str
    known: Mapping[str, float]
    speed: float
    temperature: float
    time: np.ndarray
    channels: Mapping[str, np.ndarray]
    noise: Mapping[str, float]
    segments: tuple[Segment, ...]
    setup: int = 0
    seen: Mapping[str, np.ndarray] = field(init=False)

    def __post_init__(self) -> None:
        seen = {name: np.isfinite(values) for name, values in self.channels.items()}
        object.__setattr__(self, "seen", seen)

    @property
    def quantities(self) -> dict[str, float]:
        """What an effect's strength may go with, as it was set: kg, m/s, N/m."""
        mass, stiffness = self.known["rig.mass"], self.known["springs.stiffness"]
        return {"mass": mass, "speed": abs(self.speed), "stiffness": stiffness}

    @cached_property
    def firsts(self) -> np.ndarray:
        """(segments,) rows at which they begin."""
        return np.array([segment.first for segment in self.segments])

    @cached_property
    def holds_since(self) -> np.ndarray:
        """(segments,) when the stick began that each begins in, s; NaN where it begins in slip."""
        return np.array([segment.hold_since for segment in self.segments])

    @property
    def starts(self) -> np.ndarray:
        """(segments, 8) first guesses of the segments' states."""
        return np.array([segment.state for segment in self.segments])

    def simulate(self, values: Mapping[str, float], states: np.ndarray) -> np.ndarray:
        """The block's own outputs (n, O_SIZE) with parameters and segments' states (segments, 8).

        Of the moments at which the camera took its samples; states are as the camera writes them.
        """
        values, camera = Camera.split(values)
        if camera.is_perfect:
            return self._simulated(simulate_restarted, values, states)
        exposure = self._exposure(camera)
        return self._exposed(simulate_restarted, values, states, exposure)[exposure.rows]

    def places(self, values: Mapping[str, float], states: np.ndarray) -> np.ndarray:
        """x, y and phi alone (n, 3), as the camera writes them."""
        values, camera = Camera.split(values)
        if camera.is_perfect:
            return self._simulated(track_restarted, values, states)
        exposure = self._exposure(camera)
        if not camera.needs_velocity:
            return exposure.written(self._exposed(track_restarted, values, states, exposure))
        outputs = self._exposed(simulate_restarted, values, states, exposure)
        return exposure.written(outputs[:, _PLACES], outputs[:, _VELOCITIES])

    def force(self, values: Mapping[str, float]) -> Force | None:
        """What else acts on the block along x."""
        return None

    def _exposure(self, camera: Camera) -> Exposure:
        return Exposure.of(camera, self.time, self.channels.get("x"))

    def _exposed(
        self, simulate, values: Mapping[str, float], states: np.ndarray, exposure: Exposure
    ) -> np.ndarray:
        """The block's own motion at the moments of an exposure; states are as written."""
        first, since = self.firsts, self.holds_since
        rows, clock = exposure.rows[first], exposure.camera.clock
        speed = driven_speed(self.speed, values)
        true = exposure.true_states(states[:, :6], first, speed)
        holds = exposure.moments[rows] - (self.time[first] - since) / clock
        restarts = Restarts(rows, true[:, :6], holds, _friction(states))
        return self._run(simulate, values, exposure.moments, restarts)

    def _simulated(self, simulate, values: Mapping[str, float], states: np.ndarray) -> np.ndarray:
        restarts = Restarts(self.firsts, states[:, :6], self.holds_since, _friction(states))
        return self._run(simulate, values, self.time, restarts)

    def _run(
        self,
        simulate,
        values: Mapping[str, float],
        times: np.ndarray,
        restarts: Restarts,
    ) -> np.ndarray:
        """Rows of ``simulate`` at times (m,), s, with these parameters."""
        values = with_strengths_scaled(values, self.quantities)
        fitted = model_parameters(self.speed, values)
        flat = rig_parameters(self.setup, self.known, fitted, self.speed)
        speed = driven_speed(self.speed, flat)
        flat.pop(SPEED_OFFSET, None)
        aside = flat.pop(TILT, 0.0) * flat["rig.mass"] * GRAVITY
        p = np.array(pack(flat))
        p[layout.P_FEW_POINTS] = _FEW_POINTS
        p[layout.P_LONGEST_STEP] *= _LONGER
        p[layout.P_LONGEST_STICK] *= _LONGER if _is_uneven(flat) else _LONGER_STICK
        return simulate(p, speed, self.temperature, times, restarts, self.force(values), aside)

    def residuals(self, places: np.ndarray, offsets: Mapping[str, float]) -> np.ndarray:
        """(rows,) model less measurement over noise, channel by channel, without missing ones."""
        parts = []
        for name, values in self.channels.items():
            model = places[:, COLUMN[name]] + offsets.get(f"offset.{name}", 0.0)
            parts.append(((model - values) / self.noise[name])[self.seen[name]])
        rows = np.concatenate(parts)
        return np.clip(np.nan_to_num(rows, nan=LOST), -LOST, LOST)

    def rows_of(self, channel: str) -> slice:
        """Where a channel's residuals stand."""
        first = 0
        for name, seen in self.seen.items():
            count = int(seen.sum())
            if name == channel:
                return slice(first, first + count)
            first += count
        raise KeyError(channel)

    def segment_of_rows(self) -> np.ndarray:
        """(rows,) number of the segment that each residual belongs to."""
        number = np.zeros(len(self.time), dtype=int)
        for i, segment in enumerate(self.segments):
            number[segment.first : segment.last] = i
        return np.concatenate([number[self.seen[name]] for name in self.channels])
