"""temperature_dependence: mu_k is linear in the interface temperature, up to the melting point."""

import numpy as np
import pytest
from kernel_steps import memory_of
from stickslip import Parameters, simulate
from stickslip.catalogue import CATALOGUE
from stickslip.kernel.layout import E_FIRST, MODE, O_FRICTION_X, O_SIZE, SHOWN, SLIP, W_SIZE

MU_K, SENSITIVITY, REFERENCE = 0.2086, 0.05, -8.0
WARM = Parameters(
    temperature_dependence={"sensitivity": SENSITIVITY, "reference_degC": REFERENCE},
    rig={"degrees_of_freedom": ("x",)},
)


@pytest.mark.parametrize("temperature", [-20.0, -8.0, -3.0, 0.0, 5.0])
def test_friction_of_a_slip(temperature):
    memory = memory_of(WARM, temperature)
    w, e, o = [0.0] * W_SIZE, [0.0] * E_FIRST, [0.0] * O_SIZE
    CATALOGUE.kernel.advance(memory.p, memory.u, memory.z, w, e, 0.3)
    CATALOGUE.kernel.show(memory.p, memory.u, memory.z, w, o, 0)
    assert memory.z[SHOWN + MODE] == SLIP
    mu = MU_K * (1.0 - SENSITIVITY * (min(temperature, 0.0) - REFERENCE))
    assert abs(o[O_FRICTION_X]) == pytest.approx(mu * 0.67 * 9.81, rel=1e-13)


def test_at_the_reference_temperature_it_is_the_plain_model():
    plain = simulate(Parameters(rig={"degrees_of_freedom": ("x",)}), 3.0)
    np.testing.assert_array_equal(simulate(WARM, 3.0)["x"], plain["x"])
