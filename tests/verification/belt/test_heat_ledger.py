"""Heat received = stored in belt and ice + given to the air + melted, to 1e-10, for any history."""

import numpy as np
import pytest

from thermal import Ambient, Belt, BeltIceModel, Contact, Ice, Layer, ThermalParameters

CLOSED = 1e-10

SHORT = {"length": 0.3, "cell_length": 4e-3}
CASES = {
    "rig": ThermalParameters(belt=Belt(**SHORT)),
    "loop hardly longer than the contact": ThermalParameters(belt=Belt(length=0.09,
            cell_length=3e-3)),
    "near melting": ThermalParameters(ambient=Ambient(temperature_degC=-0.3), belt=Belt(**SHORT)),
    "strong draught": ThermalParameters(belt=Belt(air_heat_transfer=500.0, **SHORT),
        ice=Ice(air_heat_transfer=200.0)),
    "poor contact": ThermalParameters(belt=Belt(**SHORT), contact=Contact(conductance=5.0)),
    "perfect contact, wide belt": ThermalParameters(belt=Belt(width=0.3, **SHORT),
        contact=Contact(conductance=1e12, strips=3)),
    "layers, railing, rollers": ThermalParameters(belt=Belt(layers=(Layer(thickness=3e-4,
                    density=2600.0, heat_capacity=780.0, conductivity=2.0),
                Layer(thickness=7e-4, density=500.0, heat_capacity=1300.0, conductivity=0.12)),
            railing_length=0.1, railing_conductance=200.0, railing_friction=0.1, railing_load=13.45,
            railing_share=0.5, rollers=2, roller_arc=0.04, roller_rise=0.7, **SHORT)),
    "rectangle": ThermalParameters(belt=Belt(**SHORT), contact=Contact(radius=0.045, length=0.08)),
    "odd cells": ThermalParameters(belt=Belt(length=0.305, cell_length=5e-3)),
}  # fmt: skip
PASSES = dict.fromkeys(CASES, 12) | {"loop hardly longer than the contact": 60, "near melting": 25}


@pytest.mark.parametrize("case", CASES)
def test_ledger_over_many_passes(case):
    """Random steps, pauses and reversals between movements of up to two loops."""
    rng = np.random.default_rng(20)
    model = BeltIceModel(CASES[case])
    length = model.parameters.belt.length
    worst, passes = 0.0, 0.0
    while passes < PASSES[case]:
        movements = [0.0, *rng.normal(0.0, 0.01, 4), rng.uniform(0.0, 2.0 * length)]
        for movement in movements:
            model.step(rng.choice([1e-4, 0.01, 0.1, 0.7]), rng.exponential(0.2), movement)
            passes += abs(movement) / length
        outputs = model.outputs()
        worst = max(worst, abs(outputs["heat_residual"]) / outputs["heat_received"])
    assert worst < CLOSED
    assert outputs["air_heat"] > 0.05 * outputs["heat_received"], "the air's part must matter"
    if "railing" in case:
        assert outputs["railing_heat"] > 0.05 * outputs["heat_received"]
        assert outputs["support_heat"] != 0.0
    if case == "near melting":
        assert outputs["latent_heat"] > 0.05 * outputs["heat_received"]
