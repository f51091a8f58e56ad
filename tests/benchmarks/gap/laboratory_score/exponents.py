"""Powers of mass and speed with which an effect's strength goes, stated against true.

Both are beside the law as it is written: a share of mu, a force in N, heat in J. Where every run
has the same gravity, a power of the load is one of the mass.
"""

from __future__ import annotations

from .answers import Row

SAME = {"load": "mass", "normal_force": "mass", "surface_speed": "speed"}
NEAR = 0.2  # as near as the exponent has to be


def exponents_stated(row: Row) -> dict[str, dict[str, float]]:
    """effect -> quantity -> power, under the laboratory's names of quantities.

    Of those in gap.json that are stated: one that was tried and left out is no answer.
    """
    powers: dict[str, dict[str, float]] = {}
    for each in (row.found or {}).get("exponents") or []:
        if each["stated"]:
            quantity = SAME.get(each["quantity"], each["quantity"])
            powers.setdefault(each["effect"], {})[quantity] = float(each["value"])
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
