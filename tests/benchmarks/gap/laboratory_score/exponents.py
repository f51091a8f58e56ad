"""Powers of mass and speed with which an effect's strength goes, stated against true.

The true ones are beside the law as it is written: a share of mu, a force in N, heat in J; gap.json
has the whole power and that of the catalogue's law, and what it has more is compared. Where every
run has the same gravity, a power of the load is one of the mass.
"""

from __future__ import annotations

from .answers import Row

SAME = {
    "load": "mass", "normal_force": "mass", "surface_speed": "speed", "sliding speed": "speed",
}  # fmt: skip
NEAR = 0.2  # as near as the exponent has to be


def exponents_stated(row: Row) -> dict[str, dict[str, float]]:
    """effect -> quantity -> power over the catalogue's, under the laboratory's names."""
    powers: dict[str, dict[str, float]] = {}
    for each in (row.found or {}).get("exponents") or []:
        quantity = SAME.get(each["quantity"], each["quantity"])
        more = float(each["value"]) - float(each["catalogue"])
        powers.setdefault(each["effect"], {})[quantity] = more
    return powers


def exponents_are_near(row: Row) -> bool:
    """Whether every power that is not nought is stated as it is, and no other one."""
    stated = exponents_stated(row)
    for effect in row.truth.effects:
        true, said = row.truth.exponents.get(effect, {}), stated.get(effect, {})
        for quantity in {*true, *said}:
            if abs(true.get(quantity, 0.0) - said.get(quantity, 0.0)) > NEAR:
                return False
    return True
