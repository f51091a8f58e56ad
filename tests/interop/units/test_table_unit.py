"""A table of friction over speed and temperature in the units: the motion of the model."""

import numpy as np
from fmpy import simulate_fmu
from stickslip import Parameters, simulate

SPEED, DEGREES = (0.0, 0.1, 0.3), (-12.0, -6.0, -2.0)
MU = (0.30, 0.22, 0.18, 0.24, 0.15, 0.12, 0.10, 0.05, 0.04)


def test_the_unit_has_friction_of_its_interface(unit):
    """Between two temperatures of the table; colder, the block goes elsewhere."""
    parameters = Parameters(
        rig={"spring_natural_length": 0.17},
        initial={"vx": 0.15},
        friction={"table_speed": SPEED, "table_temperature_degC": DEGREES, "table_mu": MU},
    )
    found = {}
    for warmth in (-4.5, -9.0):
        model = simulate(parameters, 1.0, 0.05, interface_temperature=warmth)
        given = {"surface_speed": 0.15, "interface_temperature": warmth}
        rows = simulate_fmu(
            str(unit), stop_time=1.0, step_size=0.05, output_interval=0.05,
            start_values=parameters.flat() | given, output=["x", "heat"],
        )  # fmt: skip
        for name in ("x", "heat"):
            # the same text, at the same steps of a host: rounding alone
            np.testing.assert_allclose(rows[name], model[name], rtol=0, atol=1e-9)
        found[warmth] = rows["x"]
    assert np.abs(found[-4.5] - found[-9.0]).max() > 1e-3
