"""The source study's scheme, from its equations: linear springs and blocks of 10 ms.

Stick: x' = v, y' = phi' = 0 until the springs reach mu_s N. Slip: M q'' + K q = (F, 0, M_F) with
q = (x, y, phi), solved exactly in blocks of 10 ms with the friction sampled a hundred times a
block (`scheme.c`), the spring angles alpha by one of four treatments and friction summed over a
hundred strips (`study_rig`). Each known fault can be mended (`scheme_options`).

What the study does not print is a parameter here: the scatter of mu (its standard deviation, per
strip), the slope of mu_k over the sliding speed (its four data points are only drawn) and, for
the mended scatter, the length over which friction is correlated.

>>> from stickslip.reference.linearised import Scheme
>>> run = Scheme(scatter=0.0).run(cycles=3)
>>> run.slips
3
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, fields

import numpy as np

from .scheme import CUT, SLIP, STUCK_AGAIN, Motion, SchemeFaults, SchemeRig
from .scheme_options import NO_EFFECTS, PRINTED, Faults, SchemeEffects
from .study_rig import (
    ATTACHMENT_ANGLES,
    ATTACHMENT_RADIUS,
    attachments,
    fixed_angles,
    strips,
    treatment_number,
)

GRAVITY = 9.81


@dataclass(frozen=True)
class Scheme:
    """The scheme's numbers; SI units.

    stiffness: of one spring. scatter, static_scatter: standard deviation of mu_k (per strip; of all
    strips alike where it is common_scatter) and of mu_s (per cycle). mu_slope: loss of mu_k per m/s
    of sliding speed above mu_k_speed, at which mu_k holds. correlation_length: of the scatter
    on the surface once F5 is mended.
    curvature: 1/R of a turning slab, whose speed falls across the block. effects: of the catalogue,
    none by default.
    """

    mass: float = 0.67
    stiffness: float = 20.17
    speed: float = 0.15
    mu_s: float = 0.2815
    mu_k: float = 0.2086
    treatment: str = "updated"
    scatter: float = 0.02
    common_scatter: bool = False
    static_scatter: float = 0.0
    mu_slope: float = 0.0
    mu_k_speed: float = 0.15
    correlation_length: float = 1e-3
    curvature: float = 0.0
    radius: float = ATTACHMENT_RADIUS
    spring_length: float = 0.20
    faults: Faults = field(default=PRINTED)
    effects: SchemeEffects = field(default=NO_EFFECTS)

    def __post_init__(self) -> None:
        treatment_number(self.treatment)
        positive = ("mass", "speed", "correlation_length", "radius", "spring_length")
        for item in fields(self):
            value = getattr(self, item.name)
            if not isinstance(value, (int, float)):
                continue
            if not math.isfinite(value) or (item.name in positive and value <= 0.0):
                raise ValueError(
                    f"{item.name} = {value:g}: must be finite"
                    f"{' and above 0' if item.name in positive else ''}"
                )
        for name in ("stiffness", "mu_s", "mu_k", "scatter", "static_scatter"):
            if getattr(self, name) < 0.0:
                raise ValueError(f"{name} = {getattr(self, name):g}: must not be negative")

    def run(
        self,
        *,
        cycles: int = 1_000_000,
        duration: float = 300.0,
        seed: int = 0,
        turned: float = 0.0,
    ) -> SchemeRun:
        """Stick-slip from rest at the springs' middle, until ``cycles`` or ``duration`` (s).

        turned: rad, of the block at the start; the mirror images cancel exactly here, so that
        without scatter an unstable straight motion stays straight unless the start is turned.
        """  # fmt: skip
        return self._follow(seed, cycles, float(duration), q=[0.0, 0.0, turned])

    def slide(self, duration: float, *, x0: float = 0.0) -> SchemeRun:
        """Slip alone, whatever the block's speed, as the study's verification runs do."""
        return self._follow(0, float(duration), q=[x0, 0.0, 0.0])

    def _rig(self, seed: int) -> SchemeRig:
        normal_force = self.mass * GRAVITY
        shares, middles = strips(self.radius)
        scatter = self.scatter * normal_force
        force_share, arm = float(np.sqrt(np.sum(shares**2))), shares * middles
        if self.common_scatter:
            force_share, arm = float(shares.sum()), np.zeros_like(arm)
        own = {name: value for name, value in vars(self).items() if hasattr(SchemeRig, name)}
        return SchemeRig(
            **own,
            inertia=self.mass * self.radius**2,
            normal_force=normal_force,
            force_scatter=scatter * force_share,
            moment_scatter=scatter * float(np.sqrt(np.sum(arm**2))),
            covered=float(shares.sum()),
            reach=1.0 if self.faults.F2 else self.radius,
            updated=self.treatment == "updated",
            strip_wise=self.mu_slope != 0.0,
            seed=seed,
        )

    def _faults(self) -> SchemeFaults:
        f = self.faults
        # in the order of its fields
        return SchemeFaults(f.F1, f.F5, f.F6, f.F12, not f.F13, f.F14, f.F15)

    def _follow(self, seed: int, *until: float, **begin: list[float]) -> SchemeRun:
        """From what a run begins with, until so many cycles, where there are any, or a time, s."""
        shares, middles = strips(self.radius)
        # the mean load of all strips where it does not depend on their speeds
        steady = np.array([shares.sum() * self.mu_k * self.mass * GRAVITY, 0.0])
        motion = Motion(
            until[-1],
            seed,
            alpha=fixed_angles(self.treatment),
            attachment=attachments(self.radius),
            beta=ATTACHMENT_ANGLES,
            mean=steady,
            shares=shares,
            middles=middles,
            **{name: np.array(value) for name, value in begin.items()},
        )
        motion.run(self._rig(seed), self._faults(), self.effects, *until)
        t, q, velocity, load, mode = np.split(motion.rows, (1, 4, 7, 9), axis=1)
        return SchemeRun(t[:, 0], q, velocity, load, mode[:, 0], motion.phases)


@dataclass(frozen=True)
class SchemeRun:
    """A run of the scheme.

    time (n,) s; q, velocity (n, 3): x, y, phi; load (n, 2): N, N m; mode (n,): 0 stick, 1 slip.
    phases (k, 5): begin s, end s, mode, how it ended (`scheme`), jump of x' at its end m/s.
    """

    time: np.ndarray
    q: np.ndarray
    velocity: np.ndarray
    load: np.ndarray
    mode: np.ndarray
    phases: np.ndarray

    @property
    def slip_phases(self) -> np.ndarray:
        """Phases of slip that ended in stick, (k, 5)."""
        ended = self.phases[:, 3]
        found: np.ndarray = self.phases[
            (self.phases[:, 2] == SLIP) & ((ended == STUCK_AGAIN) | (ended == CUT))
        ]
        return found

    @property
    def slips(self) -> int:
        """Slips that ended in stick."""
        return len(self.slip_phases)
