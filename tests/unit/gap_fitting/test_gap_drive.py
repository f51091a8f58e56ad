"""How fast the surface is for the block: what sticks tell of it, and what the fit makes of that."""

from dataclasses import replace

import numpy as np
import pytest
from gap_campaigns import KNOWN, NOISE, noisy, write_campaign
from linear_runs import trial_of
from scipy.stats import chi2
from stickslip import Parameters
from stickslip.effects.candidate import FreeParameter
from stickslip.restarted import Restarts, simulate_restarted

from cosim.gap import read_campaign
from cosim.gap.candidates.plain import (
    CREEP,
    EXPONENT,
    TRANSITION,
    first_guess,
    plain_free_parameters,
)
from cosim.gap.estimation.drive import (
    FRICTION_OFFSET,
    LOADING,
    RIPPLE_LENGTH,
    SPEED_OFFSET,
    driven_speed,
    model_parameters,
    stiffness_offset,
)
from cosim.gap.estimation.fit import fit
from cosim.gap.estimation.fitted import start
from cosim.gap.estimation.intervals import intervals
from cosim.gap.estimation.preparation import prepare
from cosim.gap.estimation.problem import Problem


def test_driven_speed_is_the_set_point_and_a_part_of_it():
    assert driven_speed(0.2, {}) == 0.2
    assert driven_speed(0.2, {SPEED_OFFSET: 0.03, CREEP: 1e-3}) == pytest.approx(0.206, rel=1e-15)
    assert driven_speed(-0.2, {SPEED_OFFSET: -0.5}) == pytest.approx(-0.1, rel=1e-15)


@pytest.mark.parametrize("speed", [0.2, -0.2])
def test_a_roller_s_ripple_has_the_frequency_of_its_turns(speed):
    given = {"speed_ripple.amplitude": 0.1, RIPPLE_LENGTH: 0.05}
    assert model_parameters(speed, given) == pytest.approx(
        {"speed_ripple.amplitude": 0.1, "speed_ripple.frequency": 4.0}, rel=1e-15
    )
    assert RIPPLE_LENGTH in given
    assert model_parameters(speed, {"friction.mu_k": 0.2}) == {"friction.mu_k": 0.2}


@pytest.mark.parametrize("effect", ["speed_ripple", "surface_pattern"])
def test_parts_of_a_second_harmonic_are_its_amplitude_and_phase(effect):
    given = {f"{effect}.second_in_phase": -0.3, f"{effect}.second_ahead": 0.4}
    assert model_parameters(0.2, given) == pytest.approx(
        {
            f"{effect}.second_amplitude": 0.5,
            f"{effect}.second_phase_deg": 180.0 - np.degrees(np.arctan(4.0 / 3.0)),
        },
        rel=1e-14,
    )


# The same by the kernel, through files.

CREEPING = 2e-3


def kernel_run(speed, offset=0.0, creep=0.0, duration=8.0):
    """Time and x of a block on a surface that is not as fast as it was set to be, or creeps."""
    parameters = Parameters(
        rig={"mass": KNOWN["mass"], "spring_natural_length": 0.17},
        springs={"stiffness": KNOWN["stiffness"]},
        friction={"mu_s": 0.3, "mu_k": 0.2, "stick_creep": creep},
    )
    time = np.arange(0.0, duration, 0.01)
    first = Restarts.at([0], [np.array([0.0, 0.0, 0.0, speed, 0.0, 0.0])])
    outputs = simulate_restarted(parameters.pack(), speed * (1.0 + offset), -8.0, time, first)
    return time, outputs[:, 0]


def kernel_campaign(folder, offsets=(0.0, 0.0, 0.0), creep=0.0):
    runs = []
    for seed, (speed, offset) in enumerate(zip((0.03, 0.05, 0.08), offsets, strict=True)):
        time, x = kernel_run(speed, offset, creep)
        runs.append(
            {
                "surface_speed": speed,
                "hold_out": seed == 1,
                "columns": {"t": time, "x": noisy(x, seed)},
            }
        )
    return read_campaign(write_campaign(folder, runs, noise={"x": NOISE}))


def test_plain_numbers_are_those_of_friction_contact_springs_and_of_every_run(tmp_path):
    """Whatever the runs look like: that nothing creeps, or is off, is for the fit to find."""
    for creep in (0.0, CREEPING):
        folder = tmp_path / str(creep)
        folder.mkdir()
        campaign = kernel_campaign(folder, creep=creep)
        free = {each.key: each for each in plain_free_parameters(campaign, False)}
        shared = {key for key, each in free.items() if not each.per_run}
        assert shared == {
            *("friction.mu_s", "friction.mu_k", CREEP, TRANSITION, EXPONENT, LOADING),
            stiffness_offset(campaign.setup_of(campaign.runs[0])),
        }
        assert set(free) - shared == {"offset.x", SPEED_OFFSET, FRICTION_OFFSET}
        assert all(each.low <= each.start <= each.high for each in free.values())


def test_speed_of_every_run_is_found(tmp_path):
    offsets = (0.05, 0.0, -0.06)
    campaign = kernel_campaign(tmp_path, offsets=offsets)
    free_parameters = plain_free_parameters(campaign, False)
    problem = Problem(prepare(campaign, campaign.fit_runs, False), free_parameters)
    found = fit(problem, start(problem.segmented_runs, free_parameters))
    assert found.rms_residual() == pytest.approx(
        1.0, abs=0.1
    )  # of 1600 samples: 0.02, and the fit's
    for run, offset in enumerate((offsets[0], offsets[2])):
        # a stick of half a second in 0.2 mm of noise: a part in a hundred of 0.03 m/s
        assert found.own_values(run)[SPEED_OFFSET] == pytest.approx(offset, abs=0.01)
    check_within(problem, found, {"friction.mu_s": 0.3, "friction.mu_k": 0.2})


def check_within(problem, found, values):
    """Not further off than 1.7 times the reach of a 95 % interval: once in a thousand."""
    for key, (low, high) in intervals(trial_of(problem, found)).items():
        if key in values:
            assert abs(found.values[key] - values[key]) < 1.7 * 0.5 * (high - low)


def test_creep_is_found_again_by_the_fit(tmp_path):
    campaign = kernel_campaign(tmp_path, creep=CREEPING)
    free_parameters = plain_free_parameters(campaign, False)
    problem = Problem(prepare(campaign, campaign.fit_runs, False), free_parameters)
    found = fit(problem, start(problem.segmented_runs, free_parameters))
    assert found.rms_residual() == pytest.approx(1.0, abs=0.1)
    assert found.values[CREEP] == pytest.approx(CREEPING, rel=0.15)
    rigid = [free for free in free_parameters if free.key != CREEP]
    without = fit(Problem(problem.segmented_runs, rigid), start(problem.segmented_runs, rigid))
    # speeds of the runs make up for most of it, at a price
    assert without.cost > found.cost + chi2.isf(1e-3, 1)


def test_a_run_with_an_offset_is_one_on_a_faster_surface(tmp_path):
    campaign = kernel_campaign(tmp_path)
    segmented = prepare(campaign, campaign.runs, False)[0]
    faster = replace(segmented, speed=segmented.speed * 1.04)
    states = segmented.starts
    np.testing.assert_array_equal(
        segmented.simulate({SPEED_OFFSET: 0.04}, states), faster.simulate({}, states)
    )
    assert np.abs(segmented.simulate({}, states) - faster.simulate({}, states))[:, 0].max() > NOISE


def test_the_tracker_s_zero_moves_with_the_data(tmp_path):
    campaign = kernel_campaign(tmp_path)
    free_parameters = (FreeParameter("offset.x", 0.0, NOISE),)
    segmented_runs = prepare(campaign, campaign.fit_runs, False)
    moved = [replace(f, channels={"x": f.channels["x"] + 5.0 * NOISE}) for f in segmented_runs]
    found = []
    for simulated in (segmented_runs, moved):
        problem = Problem(simulated, free_parameters, {"friction.mu_s": 0.3, "friction.mu_k": 0.2})
        found.append(fit(problem, start(simulated, free_parameters)))
    before, after = (fitted.values["offset.x"] for fitted in found)
    assert after - before == pytest.approx(5.0 * NOISE, rel=0.01)
    assert found[1].cost == pytest.approx(found[0].cost, abs=0.05)  # each stops within 0.02
    check_within(problem, found[1], {"offset.x": 5.0 * NOISE})


def test_first_guesses_are_near_what_was_put_in(tmp_path):
    mu_s, mu_k = first_guess(kernel_campaign(tmp_path).runs)
    assert mu_s == pytest.approx(0.3, rel=0.05) and mu_k == pytest.approx(0.2, rel=0.05)
