"""A formula with its coefficients, and as a force on the block of a run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from functools import cached_property

from stickslip.kernel import layout
from stickslip.packing import pack
from stickslip.restarted import Force

from cosim.gap.estimation.drive import driven_speed
from cosim.gap.estimation.segmented_run import SegmentedRun

from .features import Feature, Moment

#: What the coefficients are called among the parameters of a fit.
BLOCK = "empirical."


@dataclass(frozen=True)
class Term:
    """A feature and its coefficient, in the feature's unit."""

    feature: Feature
    coefficient: float

    @property
    def text(self) -> str:
        """As in a formula: -1.2 N/m · x"""
        unit = "" if self.feature.unit == "1" else f" {self.feature.unit}"
        name = f" · {self.feature.name}" if self.feature.name else ""
        return f"{abs(self.coefficient):.4g}{unit}{name}"


def formula(terms: Sequence[Term]) -> str:
    """F_x = ... in N."""
    text = "F_x ="
    for number, term in enumerate(terms):
        sign = "-" if term.coefficient < 0.0 else "+" if number else ""
        text += f" {sign} {term.text}" if number else f" {sign}{term.text}"
    return text


def key(number: int) -> str:
    """Parameter of the coefficient of a term."""
    return f"{BLOCK}c{number}"


@dataclass(frozen=True)
class ForcedRun(SegmentedRun):
    """A run on whose block features with coefficients `key(i)` act as a force along x."""

    features: tuple[Feature, ...] = field(default=(), kw_only=True)

    @cached_property
    def load(self) -> float:
        """Normal force, N."""
        return float(pack(dict(self.known))[layout.P_NORMAL_FORCE])

    def force(self, values: Mapping[str, float]) -> Force:
        """The features' sum, with the coefficients among ``values``."""
        coefficients = [values.get(key(i), 0.0) for i in range(len(self.features))]
        of = [feature.of for feature in self.features]
        speed = driven_speed(self.speed, values)

        def along(block: Sequence[float]) -> float:
            moment = moment_of(block, speed, self.load)
            return float(sum(c * one(moment) for c, one in zip(coefficients, of, strict=True)))

        return along


def moment_of(block: Sequence[float], speed: float, load: float) -> Moment[float]:
    """Of the model's state."""
    vx, slips = block[layout.VX], block[layout.MODE] == layout.SLIP
    sliding = speed - vx if slips else 0.0
    direction = float(sliding > 0.0) - float(sliding < 0.0)  # numpy's truths have no difference
    place = abs(block[layout.TRAVEL] - block[layout.X])
    return Moment(
        block[layout.X], vx, sliding, direction, block[layout.TIME], block[layout.DISTANCE], place,
        load,
    )  # fmt: skip


def forced(segmented: SegmentedRun, features: Sequence[Feature]) -> ForcedRun:
    """The same run under a force."""
    known = {one.name: getattr(segmented, one.name) for one in fields(segmented) if one.init}
    return ForcedRun(**known, features=tuple(features))
