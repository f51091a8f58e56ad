"""The model beside one measured run: from numbers and start states to residuals."""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping

import numpy as np
from stickslip import Parameters
from stickslip.catalogue import Catalogue
from stickslip.kernel import layout
from stickslip.packing import GRAVITY
from stickslip.restarted import Restarts, track_restarted

from cosim.gap.data import Campaign, MeasuredRun

from .camera import seen, true_time
from .numbers import values_of_run
from .windows import AXES, Windows

#: Of the integrator in a fit: errors of some 1e-7 m, far below any tracker's noise.
TOLERANCE = 1e-6
#: Rim speed over sliding speed up to which a few points of the contact disc do: friction is then
#: averaged over the disc to some 1e-3 of what it varies by.
FEW_POINTS = 0.6
#: Steps this much longer than a simulation's: a sixth of a period, still good to 1e-7 m; in stick
#: on an even surface that moves steadily much longer, as the load only grows.
LONGER, LONGER_STICK = 2.0, 20.0
FRICTION = ("friction.mu_s", "friction.mu_k")
#: Standard deviations of y and phi at a window's start where the tracker does not have them, m and
#: rad, and of their velocities in these times the frequency of the free vibration: what springs and
#: friction let a block do. Without them what a window hardly feels may take any value.
UNSEEN = {"y": 0.02, "phi": 0.1}
#: Points of a table of friction, in parts of mu_k, and of the springs' force curve, over their
#: stiffness: these then scale the whole.
TABLE_PART, FORCE_PART = "friction.table_part", "springs.force_part"
#: By which factor such a curve is higher than its points, beyond mu_k or a force that is linear.
HEIGHT = "curve.height"
#: Of the tracker and the drive, not of the block.
OUTSIDE = ("offset.", "measurement.", "per_weight.", "with_", "scatter.", "curve.")
#: Standard deviation of the static friction from one stick to the next, relative.
BREAK_AWAY = "scatter.break_away"
#: Of what is outside, all that acts on a track beside the tracker's zeros and the parameters.
NOT_PACKED = ("offset.speed", "measurement.")
#: Time by which a contact lets go sooner, s: mu_s N falls by this times the rate of the load.
LOADING = "offset.loading"
#: ``with_weight.block.parameter``: the weight, N, at which that parameter is what it says; in other
#: runs it goes in proportion to theirs; ``per_weight`` inversely; ``with_stiffness`` as the
#: stiffness of their springs, N/m.
WITH_WEIGHT, PER_WEIGHT, WITH_STIFFNESS = "with_weight", "per_weight", "with_stiffness"


def uneven(catalogue: Catalogue) -> list[str]:
    """Parameters that make a surface uneven or unsteady where they are not 0."""
    return [
        f"{effect.id}.{name}"
        for effect in catalogue.effects
        if effect.enters == "surface" or effect.axis == "place"
        for name in effect.switch
    ]


def parameters_of(run: MeasuredRun, values: Mapping[str, float]) -> dict[str, float]:
    """``block.parameter`` -> value in the kernel, of a run's own values (see `Number.key`)."""
    flat = {key: value for key, value in values.items() if not key.startswith(OUTSIDE)}
    stiffness = values.get("springs.stiffness", 1.0) * run.stiffness
    flat["springs.stiffness"] = stiffness * math.exp(values.get("offset.stiffness", 0.0))
    for key in FRICTION:
        if key in flat:
            flat[key] *= math.exp(values.get("offset.friction", 0.0))
    weight = run.mass * GRAVITY
    if LOADING in values:
        rate = run.total_stiffness * abs(run.surface_speed) / weight
        flat["friction.mu_s"] = max(flat["friction.mu_s"] - values[LOADING] * rate, 0.0)
    for key, typical in values.items():
        scaled_by, _, parameter = key.partition(".")
        if scaled_by == PER_WEIGHT:
            flat[parameter] *= typical / weight
        elif scaled_by == WITH_WEIGHT:
            flat[parameter] *= weight / typical
        elif scaled_by == WITH_STIFFNESS:
            flat[parameter] *= run.stiffness / typical
    height, force = values.get(HEIGHT, 1.0), -math.inf
    for key in [key for key in flat if key.startswith((TABLE_PART, FORCE_PART))]:
        part, number = flat.pop(key), key[key.index("[") :]
        if key.startswith(TABLE_PART):
            part = max(1.0 + height * (part - 1.0), 0.0)
            flat[f"friction.table_mu{number}"] = flat["friction.mu_k"] * part
        else:
            linear = flat[f"springs.force_curve_extension{number}"]
            force = max(force, flat["springs.stiffness"] * (linear + height * (part - linear)))
            flat[f"springs.force_curve_force{number}"] = force
    return flat


class RunModel:
    """A run, its windows and the model with everything that is known of the run.

    A window's state is (x, y, phi, vx, vy, omega), and, one for each of its sticks, the logarithm
    of the factor on mu_s.

    Attributes
    ----------
    size : number of residuals
    starts : the first residual of each window that is compared; those of a window stand together
    owner : (rows,) window of each residual, then of each stick's prior and of each state's
    rounding : (size,) factor by which the noise of each is larger than stated
    simulated : samples of all tracks so far
    """

    def __init__(self, campaign: Campaign, run: MeasuredRun, windows: Windows):
        self.campaign, self.run, self.windows = campaign, run, windows
        with warnings.catch_warnings(action="ignore"):  # friction is not known yet
            kind = Parameters.of(campaign.catalogue)
            parameters = kind.model_validate(campaign.parameters(run), strict=True)
        self.known = dict(parameters.flat()) | {"solver.tolerance": TOLERANCE}
        self.friction = {key: self.known[key] for key in FRICTION}
        self.uneven = uneven(campaign.catalogue)
        if not windows.is_planar:
            self.known |= {"rig.free_y": 0.0, "rig.free_phi": 0.0}
        data = np.column_stack([run.motion[name] for name in windows.channels])
        noise = np.array([run.noise[name] for name in windows.channels])
        compared = np.isfinite(data)
        compared[: windows.begin] = False
        compared[windows.crests] = False
        self.rows, channel = np.nonzero(compared)
        self.axes = np.array([AXES.index(name) for name in windows.channels])[channel]
        self.noise, self.data = noise[channel], data[self.rows, channel]
        factors = [run.rounding.get(name, (0.0, 1.0))[1] for name in windows.channels]
        self.rounding = np.array(factors)[channel]
        # a window that the model loses counts as off by the whole motion, not by more
        self.most = (np.nanmax(data, axis=0) - np.nanmin(data, axis=0))[channel] / self.noise
        self.size = self.data.size
        self.owner = np.searchsorted(windows.first, self.rows, side="right") - 1
        self.starts = np.searchsorted(self.owner, np.arange(windows.led_in, len(windows.first)))
        self.restarts = np.unique(np.concatenate([windows.first, windows.lets_go]))
        of_window = np.searchsorted(windows.first, self.restarts, side="right") - 1
        number = np.arange(self.restarts.size) - np.searchsorted(of_window, of_window)
        self.sticks = (of_window, 6 + number)  # where in the states each one's friction is
        self.is_start = np.isin(self.restarts, windows.first)
        self.unseen, self.unseen_sd = self._unseen()
        self.owner = np.concatenate([self.owner, of_window, self.unseen[0]])
        self.simulated = 0

    def _unseen(self) -> tuple[tuple[np.ndarray, np.ndarray], np.ndarray]:
        """Where in the states what the tracker does not have is free, and its deviations."""
        scales = np.array([0.0, *UNSEEN.values()])
        sd = np.concatenate([scales, scales * self.run.natural_frequency])
        seen = [AXES.index(name) for name in self.windows.channels]
        is_unseen = self.windows.free.copy()
        is_unseen[:, [*seen, *(axis + 3 for axis in seen)]] = False
        windows, axes = np.nonzero(is_unseen)
        return (windows, axes), sd[axes]

    def values(self, values: Mapping[str, float]) -> dict[str, float]:
        """key -> value of this run, of labelled ones."""
        return values_of_run(self.campaign, self.run, values)

    def zero(self, values: Mapping[str, float]) -> np.ndarray:
        """(3,) what the tracker reads where x, y and phi are 0; m, m, rad."""
        return np.array([values.get(f"offset.{axis}", 0.0) for axis in AXES])

    def packed(self, values: Mapping[str, float]) -> np.ndarray:
        """The kernel's parameters, of this run's values."""
        flat = {**self.known, **parameters_of(self.run, {**self.friction, **values})}
        catalogue = self.campaign.catalogue
        p = catalogue.packed(flat)
        p[layout.P_FEW_POINTS] = FEW_POINTS
        p[layout.P_LONGEST_STEP] *= LONGER
        is_uneven = any(flat[key] != 0.0 for key in self.uneven)
        p[layout.P_LONGEST_STICK] *= LONGER if is_uneven else LONGER_STICK
        return p

    def taken_from(self, values: Mapping[str, float], p: np.ndarray) -> np.ndarray:
        """All that of a run's values acts on a track, but for the tracker's zeros. p : `packed`"""
        outside = [value for key, value in values.items() if key.startswith(NOT_PACKED)]
        return np.concatenate([p, outside])

    def track(
        self, values: Mapping[str, float], states: np.ndarray, p: np.ndarray | None = None
    ) -> np.ndarray:
        """(n, 3) x, y, phi as the tracker reads them, at the data's times.

        states : (w, 6 + sticks) of the block itself; p : `packed` of the values
        """
        run = self.run
        p = self.packed(values) if p is None else p
        self.simulated += run.motion.time.size
        speed = run.surface_speed * (1.0 + values.get("offset.speed", 0.0))
        count = self.restarts.size
        own, since, friction = (
            np.full((count, 6), np.nan),
            np.full(count, np.nan),
            np.ones((count, 2)),
        )
        time = true_time(run.motion.time, values)
        own[self.is_start] = states[:, :6]
        since[self.is_start] = true_time(self.windows.hold_since, values)
        friction[:, 0] = np.exp(states[self.sticks])
        restarts = Restarts(self.restarts, own, since, friction)
        temperature = self.known["temperature_dependence.reference_degC"]
        places = track_restarted(
            p, speed, temperature, time, restarts, catalogue=self.campaign.catalogue
        )
        return np.asarray(seen(places, time, values) + self.zero(values))

    def residuals(
        self, values: Mapping[str, float], states: np.ndarray, p: np.ndarray | None = None
    ) -> np.ndarray:
        """(rows,) model less data in units of the noise, no more than the whole motion; then how
        far the sticks' own friction is from 0 in units of its scatter, and start states that the
        tracker does not have from 0 in units of their deviation."""
        model = self.track(values, states, p)[self.rows, self.axes]
        off = np.nan_to_num((model - self.data) / self.noise, nan=np.inf)
        scatter = values.get(BREAK_AWAY, 0.0) or 1.0
        return np.concatenate(
            [
                np.clip(off, -self.most, self.most),
                states[self.sticks] / scatter,
                states[self.unseen] / self.unseen_sd,
            ]
        )

    def per_window(self, rows: np.ndarray) -> np.ndarray:
        """(w, ...) sums over each window's rows of (rows, ...)."""
        sums = np.add.reduceat(rows[: self.size], self.starts, axis=0)
        if self.windows.led_in:
            sums = np.concatenate([np.zeros_like(sums[:1]), sums])
        np.add.at(sums, self.owner[self.size :], rows[self.size :])
        return sums
