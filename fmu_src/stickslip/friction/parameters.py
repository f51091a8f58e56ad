"""What is said of dry friction: two coefficients, or a table in place of the kinetic one.

The table is over the sliding speed, or over that and the temperature of the interface.
"""

from collections.abc import Mapping
from itertools import pairwise
from pathlib import Path
from typing import Annotated, Any, Self

from pydantic import Field, model_validator

from ..kernel.layout import CURVE_LIMIT, TABLE_LIMIT, TEMPERATURE_LIMIT
from ..quantity import Table, quantity
from .table_file import ABSOLUTE_ZERO, read_table


class Friction(Table):
    """Coulomb friction between block and surface.

    mu_s : static friction coefficient
    mu_k : kinetic friction coefficient
    stick_creep : sliding speed in stick at the load mu_s N, smaller in proportion to the load: a
        contact is sheared before it slides; 0 is off
    transition_speed : v_s, sliding speed over which friction falls from mu_s to mu_k: mu_k + (mu_s
        - mu_k) exp(-(v / v_s)^transition_exponent); 0: at once
    transition_exponent : of the transition: 1 exponential, 2 Gaussian
    presliding_distance : z_0, shear of the contact under the load mu_s N: its bristles are
        deflected before they slide (LuGre); needs transition_speed; 0: a rigid contact
    bristle_damping : of the bristles, as part of the critical damping 2 sqrt(sigma_0 m)
    table : CSV file with the columns v (m/s), mu and, where mu is of both, T_degC, from which
        table_speed, table_temperature_degC and table_mu are read
    table_speed : sliding speeds of a measured table, growing, at most 16; the table takes the place
        of mu_k: PCHIP at the local sliding speed, constant beyond its ends
    table_mu : kinetic friction coefficients of the table, at all speeds; of a table over
        temperatures too, at all speeds of the first, then of the second, and so on
    table_temperature_degC : temperatures of the interface at which the table has its coefficients,
        growing, 2 to 6; PCHIP between them, constant beyond; none: at any temperature
    """

    mu_s: float = quantity(0.2815, "1", ge=0)
    mu_k: float = quantity(0.2086, "1", ge=0)
    stick_creep: float = quantity(0.0, "m/s", ge=0)
    transition_speed: float = quantity(0.0, "m/s", ge=0)
    transition_exponent: float = quantity(1.0, "1", ge=0.5, le=3)
    presliding_distance: float = quantity(0.0, "m", ge=0, le=0.01)
    bristle_damping: float = quantity(0.4, "1", ge=0, le=2)
    table: str = quantity("", None)
    table_speed: tuple[float, ...] = quantity((), "m/s", strict=False, max_length=CURVE_LIMIT)
    table_mu: tuple[float, ...] = quantity((), "1", strict=False, max_length=TABLE_LIMIT)
    table_temperature_degC: tuple[Annotated[float, Field(ge=ABSOLUTE_ZERO, le=1000)], ...] = (
        quantity((), "degC", strict=False, max_length=TEMPERATURE_LIMIT)
    )

    @property
    def has_table(self) -> bool:
        """Whether a table takes the place of mu_k."""
        return bool(self.table_speed)

    @property
    def at_rest(self) -> tuple[str, float]:
        """Key and value of the kinetic coefficient of a slip that has next to no speed."""
        if not self.has_table:
            return "mu_k", self.mu_k
        return "table_mu", max(self.table_mu[:: len(self.table_speed)])

    @model_validator(mode="before")
    @classmethod
    def _read(cls, values: Any) -> Any:
        """The table's numbers in place of the file's name."""
        if not isinstance(values, Mapping):
            return values
        file = values.get("table", "")
        if not isinstance(file, str) or not file:
            return values
        if any(values.get(key) for key in ("table_speed", "table_mu", "table_temperature_degC")):
            raise ValueError(f'table = "{file}" beside table_speed and table_mu; give one of them')
        speed, temperature, mu = read_table(Path(file))
        read = {"table_speed": speed, "table_temperature_degC": temperature, "table_mu": mu}
        return {**values, "table": "", **read}

    @model_validator(mode="after")
    def _check(self) -> Self:
        speed, mu, temperature = self.table_speed, self.table_mu, self.table_temperature_degC
        places = len(speed) * max(1, len(temperature))
        if temperature and len(mu) != places:
            raise ValueError(
                f"table_mu has {len(mu)} values: allowed are {places}, one at each of "
                f"{len(speed)} speeds for each of {len(temperature)} temperatures"
            )
        if len(temperature) == 1:
            raise ValueError("table_temperature_degC has 1 value: allowed are none or 2 to 6")
        if any(b <= a for a, b in pairwise(temperature)):
            raise ValueError("table_temperature_degC must grow from value to value")
        if len(mu) != places:
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
