"""The kernel interpreted and the kernel compiled are one: bit for bit, event for event."""

import numpy as np
import pytest
from stickslip import Initial, LateralFriction, Parameters, Rig, Surface, simulate

CASES = {
    "along x": Parameters(),
    "planar, run-up": Parameters(
        lateral_friction=LateralFriction(ratio=1.0), surface=Surface(run_up_time=2.0)
    ),
    "slab": Parameters(
        rig=Rig(surface="slab", spring_natural_length=0.17, slab_radius=-0.4),
        lateral_friction=LateralFriction(ratio=1.0),
        initial=Initial(y=0.01, phi=0.2),
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_interpreted_and_compiled_agree(case):
    compiled = simulate(CASES[case], 4.0)
    interpreted = simulate(CASES[case], 4.0, interpreted=True)
    # rounding apart: a compiler may contract a*b + c; 1e-12 a step, some hundred steps
    np.testing.assert_allclose(interpreted.events, compiled.events, atol=1e-10)
    for name in ("x", "y", "phi", "vx", "heat"):
        np.testing.assert_allclose(interpreted[name], compiled[name], atol=1e-10)
