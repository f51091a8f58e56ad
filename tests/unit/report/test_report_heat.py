"""Where a report says the heat came from and went to, with a railing and with warm rollers."""

import numpy as np
import pytest
import xarray as xr

from cosim.report.heat_numbers import heat_ledger, heat_shares


def dataset(**last):
    """Totals that grow evenly to these, J."""
    totals = {
        "heat_received": 2.0,
        "heat_residual": 0.0,
        "belt_heat": 1.0,
        "ice_heat": 0.6,
        "air_heat": 0.4,
        "support_heat": 0.0,
        "railing_heat": 0.0,
    } | last
    return xr.Dataset(
        {name: ("time", np.linspace(0.0, value, 5)) for name, value in totals.items()}
    )


def test_without_railing_and_rollers_the_shares_are_those_of_the_contacts_heat():
    found = dataset()
    assert "from_railing" not in heat_ledger(found)
    assert heat_shares(found) == pytest.approx(
        {"belt": 0.5, "ice": 0.3, "air": 0.2, "supports": 0.0}
    )


@pytest.mark.parametrize("others", [
    {"railing_heat": 1.0, "belt_heat": 2.0},
    {"support_heat": -1.0, "belt_heat": 2.0},
    {"railing_heat": 1.0, "support_heat": 0.5, "belt_heat": 1.5},
])  # fmt: skip
def test_shares_are_of_all_heat_and_add_up(others):
    found = dataset(**others)
    assert sum(heat_shares(found).values()) == pytest.approx(1.0)
    assert min(heat_shares(found).values()) >= 0.0
    assert heat_ledger(found)["supports"] == others.get("support_heat", 0.0)
    assert ("from_railing" in heat_ledger(found)) is ("railing_heat" in others)
