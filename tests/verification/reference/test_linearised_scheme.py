"""The study's scheme: its matrices, its exact step, its limit cycle once mended, its faults."""

from ctypes import c_double

import numpy as np
import pytest
from stickslip.reference.coulomb_oscillator import CoulombOscillator
from stickslip.reference.interpreted_scheme import interpreted_run
from stickslip.reference.linearised import Scheme
from stickslip.reference.scheme import CUT, functions
from stickslip.reference.scheme_options import DESCRIPTIONS, MENDED, PRINTED, Faults
from stickslip.reference.study_rig import fixed_angles, stiffness_matrix, strips

#: K/k as printed, five decimals
PRINTED_MATRICES = {
    "zero": [[4, 0, 0], [0, 0, 0], [0, 0, 0.00117]],
    "constant": [[3.99878, 0.06980, 0], [0.06980, 0.00122, 0], [0, 0, 0.00117]],
    "opposed": [[3.99878, 0, 0], [0, 0.00122, -0.00119], [0, -0.00119, 0.00117]],
}
MASS, STIFFNESS, SPEED, MU_S, MU_K = 0.67, 20.17, 0.15, 0.2815, 0.2086


@pytest.mark.parametrize("treatment", PRINTED_MATRICES)
def test_stiffness_matrix(treatment):
    matrix = stiffness_matrix(fixed_angles(treatment))
    np.testing.assert_array_equal(np.round(matrix, 5), PRINTED_MATRICES[treatment])


def plain_oscillator() -> CoulombOscillator:
    """What the mended scheme without scatter is: one mass on four springs."""
    weight = MASS * 9.81
    share = strips(0.05)[0].sum()  # the trapezium strips cover a little less than the disc
    return CoulombOscillator(MASS, 4 * STIFFNESS, SPEED, MU_S * weight, share * MU_K * weight)


def test_mended_scheme_is_the_closed_form():
    run = Scheme(scatter=0.0, faults=MENDED).run(cycles=12)
    expected = plain_oscillator()
    slips = run.slip_phases
    np.testing.assert_allclose(slips[:, 1] - slips[:, 0], expected.slip_time, atol=1e-10)
    np.testing.assert_allclose(np.diff(slips[:, 0]), expected.period, atol=1e-10)
    np.testing.assert_allclose(slips[:, 4], 0.0, atol=1e-12)
    np.testing.assert_allclose(run.q[:, 1:], 0.0, atol=1e-14)  # the strips' moments cancel


def test_events_on_the_grid():
    """F6: slips last whole blocks and overshoot the surface's speed; sticks stop a sample short."""
    run = Scheme(scatter=0.0, faults=MENDED.only("F6")).run(cycles=8)
    slips = run.slip_phases
    blocks = (slips[:, 1] - slips[:, 0]) / 0.01
    np.testing.assert_allclose(blocks, np.round(blocks), atol=1e-9)
    assert np.all(slips[:, 4] < 0.0)
    sticks = run.phases[run.phases[:, 2] == 0]
    samples = (sticks[:, 1] - sticks[:, 0]) / (20.0 / 1999.0)
    np.testing.assert_allclose(samples, np.round(samples), atol=1e-9)


@pytest.mark.parametrize("mended", ["F2", "F13"])
def test_rotation_needs_both_faults_of_the_angle(mended):
    """The printed scheme turns by tens of degrees; without either fault of alpha it does not."""
    turn = {
        name: np.degrees(np.abs(Scheme(faults=faults).run(cycles=25, seed=1).q[:, 2]).max())
        for name, faults in {"printed": PRINTED, "mended": PRINTED.without(mended)}.items()
    }
    assert turn["printed"] > 30.0
    assert turn["mended"] < 1.0


def test_slip_is_cut_after_a_second():
    """F14: whatever is still sliding after 100 blocks jumps to the surface's speed."""
    low = dict(mu_s=0.065, mu_k=0.05)
    printed = [Scheme(**low).run(cycles=25, seed=seed) for seed in range(3)]
    assert sum(np.sum(run.phases[:, 3] == CUT) for run in printed) > 0
    for run in printed:
        assert np.max(run.slip_phases[:, 1] - run.slip_phases[:, 0]) < 1.0 + 1e-9
    whole = Scheme(**low, faults=PRINTED.without("F14")).run(cycles=25)
    assert not np.any(whole.phases[:, 3] == CUT)


def test_two_draws_stand_for_a_hundred_strips():
    rig = Scheme(scatter=0.05)._rig(seed=0)
    rng = np.random.default_rng(5)
    shares, middles = strips(0.05)
    force = shares * (1.0 + 0.05 * rng.standard_normal((40_000, shares.size)))
    loads = np.stack([force.sum(axis=1), -force @ middles], axis=1)
    n = len(loads)
    relative = 4.0 / np.sqrt(2 * n)  # four standard errors of a standard deviation
    weight = MASS * 9.81
    assert loads[:, 0].std() * weight == pytest.approx(rig.force_scatter, rel=relative)
    assert loads[:, 1].std() * weight == pytest.approx(rig.moment_scatter, rel=relative)
    assert abs(np.corrcoef(loads.T)[0, 1]) < 4.0 / np.sqrt(n)


def scatter_at(place):
    """Two normals that belong to a place, m."""
    normals = (c_double * 2)()
    functions().field_scatter(7, place, 1e-3, normals)
    return np.array(normals)


def test_scatter_belongs_to_places():
    """Mended F5: the same place gives the same draw, neighbours are alike, variance is one."""
    normals = np.array([scatter_at(0.00137 * i) for i in range(4000)])
    again = scatter_at(0.00137 * 5)
    np.testing.assert_array_equal(again, normals[5])
    # neighbouring places share a node, so four standard errors of independent draws, doubled
    np.testing.assert_allclose(normals.mean(axis=0), 0.0, atol=8 / np.sqrt(4000))
    np.testing.assert_allclose(normals.std(axis=0), 1.0, atol=8 / np.sqrt(2 * 4000))
    close = scatter_at(0.00137 * 5 + 1e-9)
    np.testing.assert_allclose(close, again, atol=1e-5)


def test_interpreted_scheme_agrees():
    """The script-like peer, strips in Python, walks the same way as the compiled loop."""
    one = interpreted_run(0.8, Scheme(scatter=0.0))
    run = Scheme(scatter=0.0, faults=MENDED.only("F6")).run(duration=0.8)
    # its stick grid is 10 ms, the other's 10.005 ms: break-away differs by up to a sample
    place = np.interp(one[:, 0], run.time, run.q[:, 0])
    np.testing.assert_allclose(one[:, 1], place, atol=SPEED * 0.011)


def test_seed_repeats_a_run():
    first, again, other = (Scheme().run(cycles=4, seed=s) for s in (3, 3, 4))
    np.testing.assert_array_equal(first.q, again.q)
    assert not np.array_equal(first.q[:50], other.q[:50]) or len(first.q) != len(other.q)


def test_faults_by_name():
    assert all(vars(PRINTED).values()) and list(vars(PRINTED)) == list(DESCRIPTIONS)
    assert not any(vars(MENDED).values())
    assert list(vars(Faults().without("F1", "F2")).values()) == [False] * 2 + [True] * (
        len(DESCRIPTIONS) - 2
    )
    with pytest.raises(ValueError, match="allowed are F1, F2"):
        PRINTED.without("F99")
