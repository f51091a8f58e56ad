"""A campaign's own law of friction over the sliding speed: what its model sets out from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from scipy.interpolate import PchipInterpolator
from stickslip.friction.parameters import Friction

from cosim.gap.data.campaign_file import CampaignTable
from cosim.gap.data.errors import CampaignError
from cosim.scenario.validation import ScenarioError, checked


@dataclass(frozen=True)
class FrictionTable:
    """Kinetic friction over the sliding speed: PCHIP, constant beyond the ends.

    Attributes
    ----------
    file : with the columns v and mu
    speeds, mu : (n,) m/s, growing, and the coefficients there; n is 2 to 16
    typical : the surface's mean speed, m/s, at which the table's value says how large it is
    """

    file: Path
    speeds: tuple[float, ...] = field(repr=False)
    mu: tuple[float, ...] = field(repr=False)
    typical: float = 0.0

    def at(self, speeds: np.ndarray) -> np.ndarray:
        """(m,) coefficients at sliding speeds (m,), m/s."""
        inside = np.clip(speeds, self.speeds[0], self.speeds[-1])
        return np.asarray(PchipInterpolator(self.speeds, self.mu)(inside), dtype=float)

    @property
    def level(self) -> float:
        """mu at the typical speed: the fit's mu_k, by which the whole table goes."""
        return float(self.at(np.array([self.typical]))[0])

    @property
    def parts(self) -> np.ndarray:
        """(n,) coefficients as parts of the level."""
        return np.array(self.mu) / self.level

    @property
    def text(self) -> str:
        """A line on what is taken for what."""
        return (
            f"friction.table: {self.file.name}, {len(self.speeds)} points, {self.speeds[0]:g} to "
            f"{self.speeds[-1]:g} m/s and constant beyond, is the law that the model sets out "
            f"from; mu_k is its value at {self.typical:.3g} m/s, {self.level:.3g}, and the whole "
            "table goes with it"
        )


def read_friction_table(
    path: Path, table: CampaignTable, speeds: Sequence[float]
) -> FrictionTable | None:
    """The campaign's table, if it names one; CampaignError in one line.

    speeds : of the surface in every run, m/s
    """
    if not table.friction.table:
        return None
    file = path.parent / table.friction.table
    try:
        read = checked(Friction, {"table": str(file)})
    except ScenarioError as refused:
        raise CampaignError(f"{path}: friction.{refused}") from None
    typical = float(np.mean(np.abs(speeds)))
    found = FrictionTable(file, read.table_speed, read.table_mu, typical)
    fault = ""
    if read.table_temperature_degC:
        fault = f"{file}: column T_degC: no run measures it; allowed are v and mu"
    elif table.model.scheme != "exact":
        alone = f'model.scheme = "{table.model.scheme}", which knows mu_s and mu_k alone'
        fault = f'beside {alone}; allowed with model.scheme = "exact"'
    elif not found.level > 0.0:
        here = f"{typical:.3g} m/s, the speed of the surface"
        fault = f"{file}: mu is {found.level:g} at {here}; allowed is above 0 there"
    if fault:
        raise CampaignError(f"{path}: friction.table: {fault}")
    return found
