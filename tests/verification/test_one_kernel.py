"""The kernel interpreted and the kernel compiled are one: bit for bit, event for event.

Both take the operations in the order in which they are written, the compiler contracts none, and
`exp`, `sin` and the like are those of the same C library. Where an effect's terms need not be the
same to the last bit, `test_effect_kernels.py` says by how much they differ.
"""

import numpy as np
import pytest
from stickslip import Initial, LateralFriction, Parameters, Rig, Surface, simulate

PLANAR = LateralFriction(ratio=1.0)
SLAB = Rig(surface="slab", spring_natural_length=0.17, slab_radius=-0.4)
OFF_CENTRE = Initial(y=0.01, phi=0.2)

#: Parameters, and the fewest events (break-away, re-stick) that the motion has to compare.
CASES = {
    "along x": (Parameters(), 14),
    "planar, speed ramp": (Parameters(lateral_friction=PLANAR, surface=Surface(run_up_time=2)), 1),
    "slab, sliding": (Parameters(rig=SLAB, lateral_friction=PLANAR, initial=OFF_CENTRE), 0),
    "slab, sticking and slipping": (
        Parameters(
            rig=SLAB, lateral_friction=PLANAR, initial=OFF_CENTRE, surface=Surface(speed=0.05)
        ),
        13,
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_interpreted_and_compiled_agree(case):
    parameters, events = CASES[case]
    compiled = simulate(parameters, 4.0)
    interpreted = simulate(parameters, 4.0, interpreted=True)
    assert len(compiled.events) >= events
    np.testing.assert_array_equal(interpreted.events, compiled.events)
    for name in ("x", "y", "phi", "vx", "vy", "omega", "friction_force_x", "heat"):
        np.testing.assert_array_equal(interpreted[name], compiled[name], err_msg=name)
