"""Rise of the belt where it enters the contact, against independently computed figures.

The figures come from a separate finite-element prototype of this rig (4.03 N, k 0.5 W/mK, 30 s),
which took the contact as 8 cm by 7.5 cm = 0.0060 m2 on belt and ice, and cooled neither face
of the belt below the block. Here the disc on the belt has 0.0049 m2; with 0.0060 m2 the
figures agree to what the belt's underside loses to the air below the block.
"""

import numpy as np
import pytest

from thermal import Belt, BeltIceModel, Contact, Ice, ThermalParameters

FORCE, DURATION = 4.03, 30.0
AREA = 0.08 * 0.075

#: length m, speed m/s, h W/m2K: rise K with the heat shared, and with all heat in the belt.
SHARED = {
    (1, 0.15, 5): 0.129,
    (1, 0.15, 25): 0.065,
    (1, 0.50, 15): 0.364,
    (1, 0.82, 5): 0.816,
    (1, 0.82, 15): 0.620,
    (1, 0.82, 25): 0.489,
    (2, 0.82, 15): 0.363,
    (4, 0.82, 15): 0.188,
}
ALL_TO_BELT = {(1, 0.15, 15): 0.178, (1, 0.82, 5): 1.75, (1, 0.82, 25): 0.82, (4, 0.82, 15): 0.26}


def run(parameters, speed, macro_step=0.02):
    model = BeltIceModel(parameters)
    for _ in range(round(DURATION / macro_step)):
        model.step(macro_step, FORCE * speed * macro_step, speed * macro_step)
    return model.outputs()


@pytest.mark.parametrize(("case", "rise"), SHARED.items())
def test_heat_shared_with_the_ice(case, rise):
    length, speed, h = case
    radius = np.sqrt(AREA / np.pi)
    wider = 2.0 * radius / 0.075  # same heat and same cooling per length of belt
    outputs = run(
        ThermalParameters(
            belt=Belt(
                length=length,
                width=0.075 * wider,
                density=700.0 / wider,
                air_heat_transfer=h / wider,
                cell_length=2e-3,
            ),
            contact=Contact(radius=radius),
        ),
        speed,
    )
    assert outputs["belt_entry_temperature"] + 8.0 == pytest.approx(rise, rel=0.04)


@pytest.mark.parametrize(("case", "rise"), ALL_TO_BELT.items())
def test_all_heat_to_the_belt(case, rise):
    length, speed, h = case
    outputs = run(
        ThermalParameters(
            belt=Belt(length=length, air_heat_transfer=h, cell_length=2e-3),
            ice=Ice(conductivity=1e-9, heat_capacity=1e-3, air_heat_transfer=0.0),
        ),
        speed,
    )
    assert outputs["belt_entry_temperature"] + 8.0 == pytest.approx(rise, rel=0.05)


def test_lumped_loop_explains_the_rest():
    """Every loop: F/(c m') gained, then cooling by the faces that are open to the air."""
    length, speed, h = 1.0, 0.82, 15.0
    parameters = ThermalParameters(
        belt=Belt(length=length, air_heat_transfer=h),
        ice=Ice(conductivity=1e-9, heat_capacity=1e-3, air_heat_transfer=0.0),
    )
    covered = BeltIceModel(parameters).footprint.length
    rate = h * 0.075 / (0.0525 * 840.0)  # one face
    kept = np.exp(-rate * (2.0 * length - covered) / speed)
    loops = DURATION * speed // length
    expected = FORCE / (840.0 * 0.0525) * kept * (1.0 - kept**loops) / (1.0 - kept)
    outputs = run(parameters, speed)
    assert outputs["belt_entry_temperature"] + 8.0 == pytest.approx(expected, rel=3e-3)
