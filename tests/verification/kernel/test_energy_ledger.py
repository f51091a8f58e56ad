"""What the surface puts in is what block, springs and friction heat took: to 1e-9 of the work."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from stickslip import Initial, Parameters, Surface, simulate


@pytest.mark.parametrize("free", [("x", "y"), ("x", "phi"), ("x",)])
@pytest.mark.parametrize("ramp", [0.0, 0.5])
def test_guided_on_a_turning_surface(free, ramp):
    """A block that cannot follow the surface's turn slides on it as soon as that turns."""
    run = simulate(
        Parameters(rig=dict(surface="slab", slab_radius=0.9, degrees_of_freedom=free),
                   lateral_friction=dict(ratio=1.0), surface=dict(speed=0.3, run_up_time=ramp),
                   initial=dict(x=0.005, y=0.008, phi=0.1)),
        3.0,
    )  # fmt: skip
    assert run.complete
    assert np.max(np.abs(run["energy_residual"])) < 1e-9 * run["heat"][-1]
    turning = run["surface_speed_actual"] / 0.9
    assert np.all(run["mode"][1:] == 1)
    if "phi" not in free:
        np.testing.assert_array_equal(run["omega"], 0.0)
        # friction resists the spin that the guide imposes: M (omega - turning) < 0
        assert np.all(run["friction_moment"][1:] * -turning[1:] < 0.0)
    else:
        np.testing.assert_array_equal(run["vy"], 0.0)


parameters = st.builds(
    lambda mass, stiffness, mu_s, ratio_k, ratio, speed, natural, x, y, phi: Parameters(
        rig=dict(mass=mass, spring_natural_length=natural),
        springs=dict(stiffness=stiffness),
        friction=dict(mu_s=mu_s, mu_k=ratio_k * mu_s),
        lateral_friction=dict(ratio=ratio),
        surface=dict(speed=speed),
        initial=dict(x=x, y=y, phi=phi),
    ),
    st.floats(0.3, 3.0),
    st.floats(5.0, 150.0),
    st.floats(0.02, 0.6),
    st.floats(0.3, 1.0),
    st.sampled_from([0.0, 0.3, 1.0]),
    st.floats(0.01, 0.9),
    st.floats(0.15, 0.2),
    st.floats(-0.02, 0.02),
    st.floats(-0.01, 0.01),
    st.floats(-0.2, 0.2),
)


@settings(max_examples=30)
@given(parameters)
def test_mirror_images(p):
    """Left and right: y, phi change sign. Belt reversed: x, phi change sign, with the start."""
    start = p.initial
    run = simulate(p, 1.5)
    across = p.model_copy(update={"initial": Initial(x=start.x, y=-start.y, phi=-start.phi)})
    back = p.model_copy(
        update={
            "initial": Initial(x=-start.x, y=start.y, phi=-start.phi),
            "surface": Surface(speed=-p.surface.speed),
        }
    )
    for other, signs in ((simulate(across, 1.5), (1, -1, -1)), (simulate(back, 1.5), (-1, 1, -1))):
        for name, sign in zip(("x", "y", "phi"), signs, strict=True):
            np.testing.assert_allclose(other[name], sign * run[name], atol=1e-7)
