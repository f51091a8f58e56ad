"""Unknowns of a campaign: what each does to a run, and how large it may be beforehand."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline

from cosim.gap.weak_form.rows import Response, RunRows


@dataclass(frozen=True)
class Curve:
    """The axis of an unknown curve: cubic splines through values at its nodes.

    quantity, unit : in words; nodes : (q,) values of the argument; per : what a value of 1 stands
    for, in the unit of the law ("mu_k", "N"); root : it is smooth over the root of the argument
    """

    quantity: str
    unit: str
    nodes: np.ndarray
    per: str
    root: bool = False

    def priors(self) -> tuple[np.ndarray, np.ndarray]:
        """Two (q, q) covariances of a curve that is 0 at its first node: a line, and its bends.

        The line has a standard deviation of 1 at the last node; the bends are an integrated random
        walk (a cubic smoothing spline; Wahba 1990) that has 1 there.
        """
        at = np.sqrt(self.nodes - self.nodes[0]) if self.root else self.nodes - self.nodes[0]
        u = at / at[-1]
        less, more = np.minimum.outer(u, u), np.maximum.outer(u, u)
        line = np.outer(u, u) + 1e-8 * np.eye(u.size)
        return line, 3.0 * less**2 * (more / 2.0 - less / 6.0)

    def at(self, values: np.ndarray) -> np.ndarray:
        """(n, q) what each node's value adds at arguments (n,); straight on beyond the ends."""
        inside = np.clip(values, self.nodes[0], self.nodes[-1])
        there, is_beyond = self._splines(inside), values != inside
        off = (values - inside)[is_beyond, None]
        there[is_beyond] += off * self._splines(inside[is_beyond], 1)
        return np.asarray(there, dtype=float)

    @cached_property
    def _splines(self) -> CubicSpline:
        """1 at a node, 0 at the others; the same for all runs."""
        return CubicSpline(self.nodes, np.eye(self.nodes.size), bc_type="not-a-knot")


@dataclass(frozen=True)
class Unknown:
    """q numbers that enter the rows together.

    Attributes
    ----------
    name : effect id, measurement fault, or what of the rig it is
    variant : which of its settings (a memory, a wave length), in words
    respond : run -> what a unit of each does
    prior : (q, q) covariance at scale 1
    bends : (q, q) covariance beside it, of what is bent in a curve, at scale 1; None: nothing is
    per_run : every run has its own
    curve : axis, where they are values of a curve
    settings : the variant in numbers, for who fits the law
    wave : of what is periodic (`periodic.Wave`)
    weight : how probable it is among the variants of its name, beside one of 1
    """

    name: str
    variant: str
    respond: Callable[[RunRows], Response] = field(repr=False)
    prior: np.ndarray = field(repr=False)
    per_run: bool = False
    curve: Curve | None = None
    settings: dict[str, float] = field(default_factory=dict)
    bends: np.ndarray | None = field(default=None, repr=False)
    wave: Any = field(default=None, repr=False)
    weight: float = 1.0

    @classmethod
    def over(
        cls, name: str, curve: Curve, respond: Callable[[RunRows], Response], variant: str = "",
        settings: dict[str, float] | None = None,
    ) -> Unknown:  # fmt: skip
        """The values of a curve."""
        line, bends = curve.priors()
        return cls(name, variant, respond, line, curve=curve, settings=settings or {}, bends=bends)

    @property
    def size(self) -> int:
        """q"""
        return int(self.prior.shape[0])

    def columns(self, runs: Sequence[RunRows]) -> np.ndarray:
        """(rows of all runs, unknowns)"""
        parts = [run.respond(self.respond(run), self.size) for run in runs]
        if not self.per_run:
            return np.concatenate(parts) if parts else np.zeros((0, self.size))
        rows = sum(len(run) for run in runs)
        columns = np.zeros((rows, self.size * len(runs)))
        first = 0
        for number, part in enumerate(parts):
            last = first + part.shape[0]
            columns[first:last, self.size * number : self.size * (number + 1)] = part
            first = last
        return columns


def column(values: Sequence[float] | np.ndarray) -> np.ndarray:
    """(n, 1)"""
    return np.asarray(values, dtype=float).reshape(-1, 1)
