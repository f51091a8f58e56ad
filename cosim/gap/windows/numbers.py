"""Numbers to fit: their starting values, bounds, prior knowledge, and to which runs they belong."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple

from cosim.gap.data import Campaign, MeasuredRun

#: Scale of a number without a prior: this part of its start (of e-folds if logarithmic). Finite
#: differences take a hundredth of it, far above the integrator's error and still linear.
PART = 0.05


@dataclass(frozen=True)
class Number:
    """A number to fit.

    Attributes
    ----------
    key : ``block.parameter`` of the model, SI units; or ``springs.stiffness``, a factor on the
        stated stiffness; or ``offset.x``, ``offset.y`` (m, the tracker reads more by this),
        ``offset.speed`` (the surface is faster than its set-point by this fraction),
        ``offset.friction`` (logarithm of the factor on mu_s and mu_k), ``offset.stiffness``
        (logarithm of the factor on the stiffness)
    start : initial guess
    prior : standard deviation about ``start`` known beforehand; None: nothing is known
    low, high : bounds
    scope : one value for the campaign, one for each run, or one for each set-up (a pair of mass
        and springs)
    log : fitted on a logarithmic scale; start and bounds are then positive
    """

    key: str
    start: float
    prior: float | None = None
    low: float = -math.inf
    high: float = math.inf
    scope: Literal["campaign", "run", "setup"] = "campaign"
    log: bool = False

    @property
    def scale(self) -> float:
        """Change that is felt but small; relative if logarithmic."""
        if self.prior is not None:
            return self.prior / self.start if self.log else self.prior
        if self.log:
            return PART
        ends = [abs(end) for end in (self.low, self.high) if math.isfinite(end)]
        return PART * (abs(self.start) or max(ends, default=0.0) or 1.0)

    @property
    def may_vanish(self) -> bool:
        """Whether it may be 0, as what says how large an effect is."""
        return self.low <= 0.0 <= self.high

    def value(self, scaled: float) -> float:
        """The number from ``scaled``, in scales from the start."""
        if self.log:
            return self.start * math.exp(self.scale * scaled)
        return self.start + self.scale * scaled

    def scaled(self, value: float) -> float:
        """Inverse of `value`."""
        if not self.log:
            return (value - self.start) / self.scale
        if value <= 0.0:
            return -math.inf
        return math.log(value / self.start) / self.scale if value < math.inf else math.inf

    def slope(self, scaled: float) -> float:
        """d value / d scaled."""
        return self.scale * (self.value(scaled) if self.log else 1.0)


class Unknown(NamedTuple):
    """A number of one owner: a run's name, a set-up, or "" for the campaign."""

    number: Number
    owner: str

    @property
    def label(self) -> str:
        """``key``, ``key@run`` or ``key@setup n``: how it is called among fitted values."""
        return f"{self.number.key}@{self.owner}" if self.owner else self.number.key


def owners_of(campaign: Campaign, run: MeasuredRun) -> dict[str, str]:
    """Scope -> owner of a run's numbers."""
    return {"campaign": "", "run": run.name, "setup": f"setup {campaign.setup_of(run)}"}


def unknowns_of(
    campaign: Campaign, runs: Sequence[MeasuredRun], numbers: Iterable[Number]
) -> list[Unknown]:
    """Every number of every owner among the runs."""
    found: dict[str, Unknown] = {}
    for number in numbers:
        for run in runs:
            unknown = Unknown(number, owners_of(campaign, run)[number.scope])
            found.setdefault(unknown.label, unknown)
    return list(found.values())


def values_of_run(
    campaign: Campaign, run: MeasuredRun, values: Mapping[str, float]
) -> dict[str, float]:
    """key -> value, of those among labelled values that belong to a run."""
    own = set(owners_of(campaign, run).values())
    parts = ((label.partition("@"), value) for label, value in values.items())
    return {key: value for (key, _, owner), value in parts if owner in own}
