"""Every effect in the study's scheme, once its faults are mended, is the kernel's.

The kernel is guided along x, where its exact geometry is linear; the scheme does not scatter. What
the scheme keeps of its own is its step of 0.1 ms, over which the thermal state, distance and
predicted loads are of first order: over 6 s the motions agree to a few 1e-6 m, where the effects
move them by 3 mm and more.
"""

import numpy as np
import pytest
from stickslip import Parameters, simulate
from stickslip.reference.linearised import Scheme
from stickslip.reference.scheme_options import MENDED, PRINTED, SchemeEffects
from stickslip.reference.study_rig import strips

MU_S, MU_K, SPEED = 0.2815, 0.2086, 0.15
COVERED = strips(0.05)[0].sum()
DURATION = 6.0


# kernel's block -> the scheme's numbers
CASES = {
    "static_strengthening": ({"rate": 0.05, "hold_time": 0.01},
        {"ageing": 0.05, "hold_time": 0.01}),
    "film_drag": ({"coefficient": 0.4}, {"film": 0.4}),
    "thermal_weakening": ({"per_joule": 1.0, "relaxation_time": 2.0},
        {"weakening_per_joule": 1.0, "relaxation": 2.0}),
    "run_in": ({"change": 0.3, "distance": 0.5}, {"run_in": 0.3, "run_in_distance": 0.5}),
    "spring_hardening": ({"cubic": 2e4}, {"cubic": 2e4}),
    "structural_damping": ({"coefficient": 0.2}, {"damping": 0.2}),
    "speed_ripple": ({"amplitude": 0.2, "frequency": 0.7},
        {"ripple": 0.2, "ripple_rate": 1.4 * np.pi}),
    "surface_pattern": ({"amplitude": 0.15, "wavelength": 0.2, "phase_deg": 30.0},
        {"pattern": 0.15, "pattern_wavenumber": 10.0 * np.pi, "pattern_phase": np.radians(30.0)}),
    "stick_stiffness": ({"ratio": 0.6}, {"stick_springs": 2.4}),
}  # fmt: skip


def scheme(faults=MENDED, **effects) -> Scheme:
    return Scheme(scatter=0.0, faults=faults, effects=SchemeEffects(on=True, **effects))


@pytest.mark.parametrize("effect", CASES)
def test_mended_scheme_with_an_effect_is_the_kernel(effect):
    block, numbers = CASES[effect]
    run = scheme(**numbers).run(duration=DURATION)
    exact = simulate(
        Parameters(rig={"degrees_of_freedom": ("x",), "contact_radius": 0.05},
                   friction={"mu_s": MU_S, "mu_k": MU_K * COVERED}, surface={"speed": SPEED},
                   initial={"vx": SPEED}, **{effect: block}),
        DURATION, 1e-3,
    )  # fmt: skip
    x = np.interp(run.time, exact.time, exact["x"])
    plain = Scheme(scatter=0.0, faults=MENDED).run(duration=DURATION)
    away = np.abs(np.interp(plain.time, exact.time, exact["x"]) - plain.q[:, 0]).max()
    assert away > 2e-3  # the effect is to be seen
    assert np.abs(x - run.q[:, 0]).max() < 5e-6


@pytest.mark.parametrize("faults", [MENDED, PRINTED])
def test_effects_of_no_size_change_nothing(faults):
    """To rounding; the printed scheme turns rounding into motion, so it is held to 2 s."""
    bare = Scheme(scatter=0.0, faults=faults).run(duration=2.0)
    none = scheme(faults).run(duration=2.0)
    np.testing.assert_allclose(none.q, bare.q, atol=1e-10)
