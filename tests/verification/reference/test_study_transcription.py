"""The study's scheme against a second transcription of its equations and its listing."""

import numpy as np
import pytest
from stickslip.reference.linearised import Scheme
from stickslip.reference.scheme_errors import PRINTED
from stickslip.reference.spring_angles import stiffness_matrix
from stickslip.reference.strip_friction import strips as reference_strips
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


def test_rounding_alone_turns_the_printed_scheme():
    """No scatter at all: dataset #2 slides straight for some seconds, then rotates as ever."""
    rows, _ = transcribed(**DATASET_2, cycles=22)
    turned = np.degrees(np.abs(rows[:, 3]))
    onset = rows[np.argmax(turned > 1.0), 0]
    assert 5.0 < onset < 13.0
    assert turned.max() > 30.0
    straight, _ = transcribed(**DATASET_2, cycles=22, reach=R)
    assert np.degrees(np.abs(straight[:, 3])).max() < 1e-6
    # a start turned by as much does it in the reference, whose mirror images cancel exactly
    still = Scheme(**DATASET_2, scatter=0.0)
    assert np.abs(still.run(cycles=22).q[:, 2]).max() == 0.0
    assert np.degrees(np.abs(still.run(cycles=22, turned=1e-15).q[:, 2]).max()) > 30.0


def test_a_hundred_draws_do_as_the_scheme_does():
    """Each strip its own draw: dataset #2 turns as far, and the mean of x is as negative."""
    rows, phases = transcribed(**DATASET_2, scatter=0.02, cycles=20)
    run = Scheme(**DATASET_2, scatter=0.02).run(cycles=20)
    last = rows[:, 0] > phases[15, 1]
    steady = run.time > run.phases[15, 1]
    for x, phi in ((rows[last, 1], rows[last, 3]), (run.q[steady, 0], run.q[steady, 2])):
        assert 30.0 < np.degrees(np.abs(phi).max()) < 70.0
        assert x.min() < -0.05  # straight, it would not go below -0.018
