"""The study's scheme against a second transcription of its equations and its listing."""

import numpy as np
import pytest
from stickslip.reference.linearised import Scheme
from stickslip.reference.scheme_options import PRINTED
from stickslip.reference.study_rig import stiffness_matrix
from stickslip.reference.study_rig import strips as reference_strips
from study_transcription import R, stiffness, strips, transcribed

DATASET_2 = {"mu_s": 0.065, "mu_k": 0.05}
ONE_DEGREE = np.radians(np.ones(4))
#: arguments of the transcription, and of the scheme; both rigs turn far in the last two
CASES = {
    "dataset #1": ({}, {}),
    "dataset #2": (DATASET_2, DATASET_2),
    "constant angles": (
        {"alpha0": ONE_DEGREE, "updated": False}, {"treatment": "constant"},
    ),
    "four springs in stick": (
        DATASET_2 | {"stick_springs": 4}, DATASET_2 | {"faults": PRINTED.without("F1")},
    ),
    "#1 on a slab, friction falling with speed": (
        {"slope": 0.1, "curvature": 2.0}, {"mu_slope": 0.1, "curvature": 2.0},
    ),
    "#2 on a slab, friction falling with speed": (
        DATASET_2 | {"slope": 0.03, "curvature": 2.0},
        DATASET_2 | {"mu_slope": 0.03, "curvature": 2.0},
    ),
    "r in the rise, on a slab": (
        DATASET_2 | {"slope": 0.03, "curvature": 2.0, "reach": R},
        DATASET_2 | {"mu_slope": 0.03, "curvature": 2.0, "faults": PRINTED.without("F2")},
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", CASES)
def test_the_same_motion_to_rounding(name):
    """Both walk the same blocks; what differs is rounding, which an unstable motion magnifies.

    It grows about tenfold a cycle: ten cycles after 1e-16 m it is below 1e-6 m.
    """
    ours, theirs = CASES[name]
    rows, phases = transcribed(**ours, cycles=10)
    run = Scheme(**theirs, scatter=0.0).run(cycles=10)
    np.testing.assert_allclose(phases[:, :2], run.phases[:, :2], atol=1e-9)
    slip = rows[rows[:, 7] == 1]
    place = np.searchsorted(run.time, slip[:, 0] - 1e-6)
    np.testing.assert_allclose(run.time[place], slip[:, 0], atol=1e-9)
    np.testing.assert_allclose(run.q[place, :2], slip[:, 1:3], atol=1e-6)
    np.testing.assert_allclose(run.q[place, 2], slip[:, 3], atol=1e-5)
    first = slip[:, 0] < phases[5, 1]  # before anything is magnified much
    np.testing.assert_allclose(run.q[place][first], slip[first, 1:4], atol=1e-12)
    if name.startswith("#"):
        assert np.degrees(np.abs(slip[:, 3]).max()) > 30.0


def test_springs_and_strips():
    rng = np.random.default_rng(2)
    for alpha in rng.uniform(-1.5, 1.5, (5, 4)):
        np.testing.assert_allclose(stiffness(alpha), stiffness_matrix(alpha), atol=1e-14)
    area, arm = strips()
    shares, middles = reference_strips(R)
    order = np.argsort(arm)
    np.testing.assert_allclose(area[order] / (np.pi * R**2), shares, atol=1e-16)
    np.testing.assert_allclose(arm[order], middles, atol=1e-16)
