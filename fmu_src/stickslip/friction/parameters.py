"""What is said of dry friction: two coefficients, or a table of the kinetic one over the speed."""

from __future__ import annotations

import csv
import math
from collections.abc import Mapping
from itertools import pairwise
from pathlib import Path
from typing import Any, Self

from pydantic import Field, model_validator

from ..kernel.layout import CURVE_LIMIT
from ..quantity import Table, quantity

#: Columns of a file: sliding speed, m/s, and coefficient.
COLUMNS = ("v", "mu")


class Friction(Table):
    """Coulomb friction between block and surface."""

    mu_s: float = quantity(0.2815, "1", "static friction coefficient", ge=0)
    mu_k: float = quantity(0.2086, "1", "kinetic friction coefficient", ge=0)
    stick_creep: float = quantity(
        0.0,
        "m/s",
        "sliding speed in stick at the load mu_s N, smaller in proportion to the load: a contact "
        "is sheared before it slides; 0 is off",
        ge=0,
    )
    transition_speed: float = quantity(
        0.0,
        "m/s",
        "v_s, sliding speed over which friction falls from mu_s to mu_k: "
        "mu_k + (mu_s - mu_k) exp(-(v / v_s)^transition_exponent); 0: at once",
        ge=0,
    )
    transition_exponent: float = quantity(
        1.0, "1", "of the transition: 1 exponential, 2 Gaussian", ge=0.5, le=3
    )
    presliding_distance: float = quantity(
        0.0,
        "m",
        "z_0, shear of the contact under the load mu_s N: its bristles are deflected before they "
        "slide (LuGre); needs transition_speed; 0: a rigid contact",
        ge=0,
        le=0.01,
    )
    bristle_damping: float = quantity(
        0.4,
        "1",
        "of the bristles, as part of the critical damping 2 sqrt(sigma_0 m)",
        ge=0,
        le=2,
    )
    table: str = Field(
        "",
        description="CSV file with the columns v (m/s) and mu, from which table_speed and table_mu "
        "are read",
    )
    table_speed: tuple[float, ...] = Field(
        (),
        description="sliding speeds of a measured table, growing, at most 16; the table takes the "
        "place of mu_k: PCHIP at the local sliding speed, constant beyond its ends",
        json_schema_extra={"unit": "m/s"},
        strict=False,
        max_length=CURVE_LIMIT,
    )
    table_mu: tuple[float, ...] = Field(
        (),
        description="kinetic friction coefficients of the table",
        json_schema_extra={"unit": "1"},
        strict=False,
        max_length=CURVE_LIMIT,
    )

    @property
    def has_table(self) -> bool:
        """Whether a table takes the place of mu_k."""
        return bool(self.table_speed)

    @property
    def at_rest(self) -> tuple[str, float]:
        """Key and value of the kinetic coefficient of a slip that has next to no speed."""
        return ("table_mu", self.table_mu[0]) if self.has_table else ("mu_k", self.mu_k)

    @model_validator(mode="before")
    @classmethod
    def _read(cls, values: Any) -> Any:
        """The table's numbers in place of the file's name."""
        if not isinstance(values, Mapping):
            return values
        file = values.get("table", "")
        if not isinstance(file, str) or not file:
            return values
        if values.get("table_speed") or values.get("table_mu"):
            raise ValueError(f'table = "{file}" beside table_speed and table_mu; give one of them')
        speed, mu = read_table(Path(file))
        return {**values, "table": "", "table_speed": speed, "table_mu": mu}

    @model_validator(mode="after")
    def _check(self) -> Self:
        speed, mu = self.table_speed, self.table_mu
        if len(speed) != len(mu):
            raise ValueError(
                f"table_speed has {len(speed)} values and table_mu has {len(mu)}: allowed is the "
                "same number"
            )
        if len(speed) == 1:
            raise ValueError("table_speed has 1 value: allowed are none or 2 to 16")
        if any(b <= a for a, b in pairwise(speed)):
            raise ValueError("table_speed must grow from value to value")
        if any(value < 0.0 for value in mu):
            raise ValueError(f"table_mu has the value {min(mu):g}: allowed is at least 0")
        return self


def table_of(values: Mapping[str, float]) -> dict[str, tuple[float, ...]]:
    """`table_speed` and `table_mu` from the FMU's names, `friction.table_speed[1]` and so on.

    The table ends before the first place that is not there or whose speed does not grow.

    >>> table_of({f"friction.table_{of}[{i}]": 0.1 * i for of in ("speed", "mu") for i in (1, 2)})
    {'table_speed': (0.1, 0.2), 'table_mu': (0.1, 0.2)}
    """
    speed: list[float] = []
    mu: list[float] = []
    for i in range(1, CURVE_LIMIT + 1):
        at = values.get(f"friction.table_speed[{i}]")
        if at is None or (speed and at <= speed[-1]):
            break
        speed.append(at)
        mu.append(values[f"friction.table_mu[{i}]"])
    if len(speed) < 2:  # the places of a table that there is not
        return {"table_speed": (), "table_mu": ()}
    return {"table_speed": tuple(speed), "table_mu": tuple(mu)}


def read_table(file: Path) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Sliding speeds (m/s) and coefficients of a CSV file with a header row.

    ValueError in one line for a file that is none, a column that is missing, what is no number, and
    more points than a table takes.
    """
    try:
        with file.open(encoding="utf-8-sig", newline="") as lines:
            rows = list(csv.DictReader(lines, skipinitialspace=True))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        why = getattr(error, "strerror", None) or "no CSV in UTF-8"
        raise ValueError(f'table = "{file}": cannot be read: {why}') from None
    if not 2 <= len(rows) <= CURVE_LIMIT:
        raise ValueError(f'table = "{file}": {len(rows)} points, allowed are 2 to {CURVE_LIMIT}')
    for column in COLUMNS:
        if column not in rows[0]:
            there = ", ".join(map(str, rows[0]))
            raise ValueError(f'table = "{file}": no column {column} (there are {there})')
    speed, mu = (
        tuple(_number(file, number, column, row[column]) for number, row in enumerate(rows, 2))
        for column in COLUMNS
    )
    return speed, mu


def _number(file: Path, line: int, column: str, text: str | None) -> float:
    try:
        value = float(text or "")
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise ValueError(f'table = "{file}": line {line}, {column} = "{text}": not a finite number')
    return value
