"""The empirical formula: regression on the measured slips, the force in the model's own loop."""

from dataclasses import replace

import numpy as np
import pytest
from blind.motion import walk
from blind.simulator.hidden import Hidden, State
from gap_campaigns import NOISE, motion, noisy, write_campaign
from stickslip.kernel import layout
from stickslip.kernel.layout import INSTANT, MODE, SLIP, STICK

from cosim.gap.candidates.plain import plain_free_parameters
from cosim.gap.data import read_campaign
from cosim.gap.diagnostics import Term, empirical_term, library
from cosim.gap.diagnostics.features import FRICTION, Moment
from cosim.gap.diagnostics.force_term import forced, formula, key, moment_of
from cosim.gap.diagnostics.slips import holding, rows_of, slips_of
from cosim.gap.diagnostics.sparse_regression import formulas
from cosim.gap.estimation.preparation import prepare, prepared
from cosim.gap.estimation.trial import Model, coarse_fit, try_model
from cosim.gap.evidence.products import LEAST
from cosim.gap.evidence.tight import tightened

SPEEDS = (0.05, 0.12, 0.08)
BY_NAME = {feature.name: feature for feature in library(True, (-0.02, 0.04))}


def campaign_of(folder, tracks, hold_out=2):
    """A campaign of motions (time, x) at SPEEDS; one is held out."""
    runs = [
        {"surface_speed": speed, "hold_out": i == hold_out,
         "columns": {"t": time, "x": noisy(x, i)}}
        for i, (speed, (time, x)) in enumerate(zip(SPEEDS, tracks, strict=True))
    ]  # fmt: skip
    return read_campaign(write_campaign(folder, runs, noise={"x": NOISE}))


def simulated(**effect):
    seen = [motion(speed=speed, duration=8.0, **effect) for speed in SPEEDS]
    return [(one.time, one["x"]) for one in seen]


@pytest.fixture(scope="module")
def plain(tmp_path_factory):
    return campaign_of(tmp_path_factory.mktemp("plain"), simulated())


@pytest.fixture(scope="module")
def damped(tmp_path_factory):
    tracks = simulated(structural_damping={"coefficient": 3.0})
    return campaign_of(tmp_path_factory.mktemp("damped"), tracks)


def first_segment(campaign):
    """The first segment of the first run alone."""
    (segmented,) = prepare(campaign, campaign.runs[:1], False)
    segment, *_ = segmented.segments
    channels = {name: values[: segment.last] for name, values in segmented.channels.items()}
    return replace(
        segmented, time=segmented.time[: segment.last], channels=channels, segments=(segment,)
    )


def fitted(campaign, alike=False):
    """alike : nothing differs from run to run, as a search would find."""
    data = prepared(campaign, campaign.fit_runs, campaign.held_out_runs, False)
    base = Model(plain_free_parameters(campaign, False), {})
    base = tightened(base, LEAST) if alike else base
    return data, try_model(data, base, coarse_fit(data, base, 8))


def test_without_an_effect_friction_leaves_noise(plain):
    columns, seen = rows_of(slips_of(plain.runs), [FRICTION])
    (mu_k,) = np.linalg.lstsq(columns, seen, rcond=None)[0]
    assert mu_k == pytest.approx(0.2, rel=0.01)
    assert np.std(seen - columns[:, 0] * mu_k) == pytest.approx(1.0, abs=0.06)


def test_static_friction_from_the_break_aways(plain):
    assert np.median(holding(plain.runs, lambda m: 0.0 * m.x)) == pytest.approx(0.3, rel=0.01)


def test_regression_finds_a_damper(damped):
    slips, held = slips_of(damped.fit_runs), slips_of(damped.held_out_runs)
    none, one, *_ = formulas(slips, held, library(False, (-0.01, 0.04)))
    assert not none.features and none.left_held_out > 1.5
    # on a belt at few speeds v - x' is another word for -x'
    assert one.features[0].name in ("vx", "sliding")
    assert abs(one.coefficients[0]) == pytest.approx(3.0, rel=0.1)
    assert one.left_held_out == pytest.approx(1.0, abs=0.1)


def test_features_that_only_both_directions_tell_are_left_out():
    names = [feature.name for feature in library(False, (-0.01, 0.04))]
    assert "N" in BY_NAME and "N" not in names
    assert "direction·x" in BY_NAME and "direction·x" not in names
    assert len(library(False, (-0.01, 0.04), 1.5, 4.0)) == len(names) + 4


def test_every_feature_is_the_same_at_a_moment_and_at_many():
    random = np.random.default_rng(3)
    many = Moment(*random.uniform(0.1, 2.0, (8, 5)))
    for feature in library(True, (-0.02, 0.04), 1.3, 7.0):
        single = [feature.of(Moment(*row)) for row in np.array(many).T.tolist()]
        assert feature.of(many) == pytest.approx(single, rel=1e-12)


def test_formula_in_words():
    terms = [Term(BY_NAME["x"], -12.345), Term(BY_NAME[""], 0.25), Term(FRICTION, -0.01)]
    assert formula(terms) == "F_x = -12.35 N/m · x + 0.25 N - 0.01 · direction·N"


@pytest.mark.parametrize(
    ("name", "effect"),
    [("vx", {"structural_damping.coefficient": 1.5}), ("x", {"springs.stiffness": 40.0})],
)
def test_force_in_the_loop_is_second_order(plain, name, effect):
    """Against the kernel's own effect: a damper, stiffer springs (four of them, 1.5 N/m more)."""
    errors = []
    coefficient = -1.5 if name == "vx" else -4.0 * (40.0 - 38.5)
    for every in (4, 2, 1):
        segmented = first_segment(plain)
        rows = np.arange(0, len(segmented.time), every)
        segment = segmented.segments[0].__class__(
            0, len(rows), segmented.segments[0].state, (), np.nan
        )
        thin = forced(segmented, [BY_NAME[name]]).__class__(
            segmented.name, segmented.known, segmented.speed, segmented.temperature,
            segmented.time[rows], {}, {}, (segment,), features=(BY_NAME[name],))  # fmt: skip
        values = {"friction.mu_s": 0.3, "friction.mu_k": 0.2}
        state = np.array([[0.03, *[0.0] * 7]])
        reference = thin.simulate(values | effect, state)[:, 0]
        x = thin.simulate(values | {key(0): coefficient}, state)[:, 0]
        half = rows < 40  # before the first corner
        errors.append(np.abs(x - reference)[half].max())
    assert errors[-1] < 0.2 * NOISE
    for coarse, fine in zip(errors, errors[1:], strict=False):
        assert 2.5 < coarse / fine < 6.0


def one_by_one(function, arguments):
    return (function(*each) for each in arguments)


def test_a_force_acts_beside_a_creep(plain):
    """None is none, and in the first stick a force like half the springs is half the springs."""
    segmented = first_segment(plain)
    values = {"friction.mu_s": 0.3, "friction.mu_k": 0.2, "friction.stick_creep": 4e-3}
    acting = forced(segmented, [BY_NAME["x"]])
    free = segmented.simulate(values, segmented.starts)
    unforced = acting.simulate(values | {key(0): 0.0}, segmented.starts)
    assert np.abs(unforced - free)[:, layout.O_X].max() < 1e-8
    sticks = int(np.flatnonzero(free[:, layout.O_MODE] == 1.0)[0])
    soft = {"springs.stiffness": 0.5 * 38.5, key(0): -2.0 * 38.5}
    rigid = segmented.simulate(values | {"friction.stick_creep": 0.0}, segmented.starts)
    pulled = acting.simulate(values | soft, segmented.starts)
    x = [run[:sticks, layout.O_X] for run in (free, pulled, rigid)]
    assert np.abs(x[1] - x[0]).max() < 5e-3 * NOISE < NOISE < np.abs(x[2] - x[0]).max()


def test_hidden_resonator_is_described_and_the_gap_shrinks(tmp_path):
    tracks = []
    for speed in SPEEDS:
        rig = Hidden(
            speed=speed,
            mu_s=0.27,
            mu_k=0.2,
            resonator_mass=0.2,
            resonator_stiffness=90.0,
            resonator_damping=0.05,
        )
        path = walk(rig, State(vx=speed), False, 1e-5, 8000)[::10]
        tracks.append((0.01 * np.arange(len(path)), path[:, 0]))
    campaign = campaign_of(tmp_path, tracks)
    data, base = fitted(campaign)
    found = empirical_term(campaign, data, base, one_by_one)
    assert found["kind"] == "empirical"
    assert found["held_out_gap_before"] == base.held_out_rms > 3.0
    # of what is over noise more than half is gone; the contact of the plain model has its part
    assert found["held_out_gap_after"] ** 2 - 1.0 < 0.5 * (base.held_out_rms**2 - 1.0)
    assert {term["feature"] for term in found["terms"]} & {"x", "x³"}
    assert found["formula"].startswith("F_x =")
    assert "empirical" in found["text"]


def test_friction_that_differs_by_direction(tmp_path):
    """Half the difference acts one way at all times: in slip, and another part of it in stick."""
    runs = []
    for i, speed in enumerate((0.05, -0.08, 0.06, -0.05, 0.1)):
        mass = 1.4 if i == 2 else 0.87
        rig = Hidden(speed=speed, mass=mass, mu_s=0.27, mu_k=0.2, asymmetry=0.3)
        path = walk(rig, State(vx=speed), False, 1e-5, 8000)[::10, 0]
        columns = {"t": 0.01 * np.arange(len(path)), "x": noisy(path, i)}
        entry = {"surface_speed": speed, "mass": mass, "hold_out": i > 2}
        runs.append(entry | {"columns": columns})
    campaign = read_campaign(write_campaign(tmp_path, runs, noise={"x": NOISE}))
    data, base = fitted(campaign, alike=True)
    found = empirical_term(campaign, data, base, one_by_one)
    size = {term["feature"]: term["coefficient"] for term in found["terms"]}
    assert set(size) == {"N", "N while held"}
    assert abs(size["N"]) == pytest.approx(0.5 * 0.3 * 0.2, rel=0.1)
    assert found["held_out_gap_after"] < 2.0 < found["held_out_gap_before"]


def test_nothing_is_proposed_where_nothing_is_missing(plain):
    data, base = fitted(plain)
    assert empirical_term(plain, data, base, one_by_one) is None


def test_a_fitted_speed_has_a_direction():
    """A speed that comes out of a fit is numpy's, whose truths have no difference."""
    block = [0.0] * INSTANT
    block[MODE] = SLIP
    assert moment_of(block, np.float64(0.1), 6.0).direction == 1.0
    assert moment_of(block, np.float64(-0.1), 6.0).direction == -1.0
    block[MODE] = STICK
    assert moment_of(block, np.float64(0.1), 6.0).direction == 0.0
