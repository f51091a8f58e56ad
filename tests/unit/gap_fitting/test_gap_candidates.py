"""What the catalogue offers: every effect, with laws that the model knows, inside their ranges."""

from dataclasses import replace

import numpy as np
import pytest
from effect_cases import IDS, SCALES
from gap_campaigns import KNOWN, NOISE, motion, noisy, write_campaign
from stickslip import EFFECTS, Parameters
from stickslip.effects.candidate import ACROSS as SET_ACROSS
from stickslip.effects.candidate import OFFSETS, Candidate, FreeParameter
from stickslip.effects.effect import no_candidates

from cosim.gap import read_campaign
from cosim.gap.candidates.catalogue import candidates
from cosim.gap.candidates.extend import extended, moved
from cosim.gap.candidates.plain import plain_free_parameters
from cosim.gap.candidates.scales import scales
from cosim.gap.estimation.drive import (
    FRICTION_OFFSET,
    LOADING,
    SPEED_OFFSET,
    model_parameters,
    stiffness_offset,
)
from cosim.gap.estimation.fit import fit
from cosim.gap.estimation.fitted import start
from cosim.gap.estimation.preparation import prepare
from cosim.gap.estimation.problem import Problem
from cosim.gap.estimation.trial import Model

(ACROSS,) = SET_ACROSS
OFFERED = candidates(SCALES)
#: Also those that are only tried where somebody names them.
ALL = candidates(SCALES, also=IDS)
EVERY = [pytest.param(c, id=f"{c.effect} {c.form} {i}") for i, c in enumerate(ALL)]
KEYS = set(Parameters().flat())


def test_every_effect_with_candidates_is_offered_in_the_catalogue_s_order():
    """Those that are not offered by themselves where they are named, and only they."""
    have = [effect for effect in EFFECTS if effect.candidates is not no_candidates]
    assert list(dict.fromkeys(c.effect for c in ALL)) == [effect.id for effect in have]
    by_themselves = [effect.id for effect in have if effect.offered]
    assert list(dict.fromkeys(c.effect for c in OFFERED)) == by_themselves
    for effect in have:
        alone = [c for c in candidates(SCALES, also=(effect.id,)) if c not in OFFERED]
        assert effect.offered == (not alone) and {c.effect for c in alone} <= {effect.id}


def test_effects_across_the_motion_are_known_as_such():
    """Of one effect all candidates are, or none; and whatever sets or fits friction across it."""
    sideways = {c.effect for c in ALL if c.lateral}
    assert sideways and all(c.lateral == (c.effect in sideways) for c in ALL)
    assert all(c.lateral for c in ALL if ACROSS in c.settings)


def test_no_law_is_offered_twice_from_the_same_place():
    seen = [(c.effect, c.form, c.free_parameters, tuple(c.settings.items())) for c in ALL]
    assert len(set(seen)) == len(seen)


@pytest.mark.parametrize("candidate", EVERY)
def test_a_candidate_speaks_the_model_s_language(candidate):
    keys = [free_parameter.key for free_parameter in candidate.free_parameters]
    said = model_parameters(SCALES.speed, {**candidate.settings, **dict.fromkeys(keys, 1.0)})
    assert set(said) <= KEYS | {SPEED_OFFSET}
    # friction across is set for all that need it, and one fits how much of it there is
    assert len(set(keys)) == len(keys) and set(keys) & set(candidate.settings) <= {ACROSS}
    assert any(key.startswith(f"{candidate.effect}.") for key in [*keys, *candidate.settings])
    assert candidate.size == sum(
        not free_parameter.per_run for free_parameter in candidate.free_parameters
    )


def parameters(values):
    """The model with what is fitted and set; ValidationError where it allows none such."""
    tables = {"rig": {"spring_natural_length": 0.17}, "friction": {"mu_s": 0.3, "mu_k": 0.2}}
    for key, value in model_parameters(SCALES.speed, values).items():
        block, name = key.split(".")
        tables.setdefault(block, {})[name] = value
    return Parameters(**tables)


@pytest.mark.parametrize("candidate", EVERY)
def test_starts_lie_inside_ranges_that_the_model_allows(candidate):
    starts = {
        free_parameter.key: free_parameter.start for free_parameter in candidate.free_parameters
    }
    values = {**candidate.settings, **starts}
    given, flat = model_parameters(SCALES.speed, values), parameters(values).flat()
    assert {key: flat[key] for key in given} == pytest.approx(given)
    for free_parameter in candidate.free_parameters:
        assert (
            free_parameter.step > 0.0
            and free_parameter.low < free_parameter.start < free_parameter.high
        )
        assert free_parameter.inside(
            free_parameter.scaled(free_parameter.start)
        ) == free_parameter.scaled(free_parameter.start)
        assert free_parameter.low > 0.0 or not free_parameter.log
        for end in (free_parameter.low, free_parameter.high):
            if np.isfinite(end):
                parameters({**candidate.settings, **starts, free_parameter.key: end})


@pytest.mark.parametrize("candidate", EVERY)
def test_a_candidate_changes_the_model_at_its_start(candidate, segmented):
    """It can be simulated, and is felt: a step of each of its free parameters moves the block."""
    started = {**candidate.settings, **{k.key: k.start for k in candidate.free_parameters}}
    plain = segmented.simulate(FRICTION, segmented.starts)
    with_it = segmented.simulate({**FRICTION, **started}, segmented.starts)
    assert np.isfinite(with_it).all()
    seen = slice(0, 6)
    assert np.abs(with_it[:, seen] - plain[:, seen]).max() > 1e-6
    for free_parameter in candidate.free_parameters:
        near = free_parameter.value(free_parameter.scaled(free_parameter.start) + 0.1)
        stepped = segmented.simulate(
            {**FRICTION, **started, free_parameter.key: near}, segmented.starts
        )
        assert np.abs(stepped[:, seen] - with_it[:, seen]).max() > 1e-9


#: As the plain model has it: friction falls over a speed, without which a contact that starts to
#: slide loses its age at once, and not over a distance.
FRICTION = {"friction.mu_s": 0.3, "friction.mu_k": 0.2, "friction.transition_speed": 2e-3}


@pytest.fixture(scope="module")
def campaign(tmp_path_factory):
    run = motion(duration=4.0)
    columns = {"t": run.time, "x": noisy(run["x"], 1), "y": noisy(run["y"], 2)}
    folder = tmp_path_factory.mktemp("campaign")
    return read_campaign(write_campaign(folder, [{"columns": columns}], noise={"x": NOISE}))


@pytest.fixture(scope="module")
def segmented(campaign):
    return prepare(campaign, campaign.runs, True)[0]


def test_scales_are_those_of_the_runs(campaign):
    (run,) = campaign.runs
    found = scales([run], 0.2, 0.03)
    assert (found.speed, found.mass, found.stiffness) == (0.06, KNOWN["mass"], KNOWN["stiffness"])
    assert found.duration == pytest.approx(4.0)
    assert found.distance == pytest.approx(0.24) and found.force == pytest.approx(8.5347)
    assert found.extension == 0.03 and found.longest == pytest.approx(0.24)
    assert found.heat == pytest.approx(0.2 * 8.5347 * 0.24)
    assert {c.effect for c in candidates(found)} == {c.effect for c in OFFERED}


def test_what_grows_in_a_hold_starts_in_place_of_a_part_of_mu_s():
    base = Model(
        (FreeParameter("friction.mu_s", 0.3, 0.01), FreeParameter("friction.mu_k", 0.2, 0.01)), {}
    )
    fitted = {"friction.mu_s": 0.4, "friction.mu_k": 0.2}
    growing = [c for c in ALL if c.grows]
    assert growing
    for candidate in growing:
        mu_s, mu_k, first, *_ = extended(base, candidate, fitted).free_parameters
        assert mu_k.start == 0.2 < mu_s.start < 0.4
        # after a usual hold break-away is where it was
        assert mu_s.start + candidate.grows * first.start == pytest.approx(0.4)
        faint = extended(base, candidate.faint(), fitted).free_parameters
        assert (faint[0].start, faint[2].start) == (0.4, candidate.faint().free_parameters[0].start)
    stated = replace(
        base,
        free_parameters=(replace(base.free_parameters[0], prior=0.01), base.free_parameters[1]),
    )
    assert extended(stated, growing[0], fitted).free_parameters[2] == growing[0].free_parameters[0]


@pytest.mark.parametrize("candidate", EVERY)
def test_faint_is_the_same_law_with_less_of_it(candidate):
    faint = candidate.faint()
    assert (
        replace(faint, free_parameters=candidate.free_parameters, grows=candidate.grows)
        == candidate
    )
    for free_parameter, fainter in zip(
        candidate.free_parameters, faint.free_parameters, strict=True
    ):
        assert replace(fainter, start=free_parameter.start) == free_parameter
        if (
            free_parameter.log
            or free_parameter.per_run
            or not free_parameter.low <= 0.0 <= free_parameter.high
        ):
            assert fainter.start == free_parameter.start
        else:
            assert (
                abs(fainter.start) < 0.5 * abs(free_parameter.start) or free_parameter.start == 0.0
            )
            assert fainter.start * free_parameter.start >= 0.0
    assert candidate.can_be_faint == (faint != candidate and not candidate.periodic)


def test_every_strength_can_be_faint():
    """Not what has no number, a part of springs, and waves, which start where they were found."""
    for c in ALL:
        strengths = [k for k in c.free_parameters if k.is_strength and k.start != 0.0]
        assert c.can_be_faint == (bool(strengths) and not c.periodic), (c.effect, c.form)


def test_a_periodic_candidate_starts_at_a_period():
    periodic = [c for c in ALL if c.periodic]
    assert periodic
    for c in periodic:
        at = {k.key: k.start for k in c.at(3.5, 0.3, 0.01).free_parameters}
        before = {k.key: k.start for k in c.free_parameters}
        amplitude = f"{c.effect}.amplitude"
        assert at == {**before, c.periodic: 3.5, amplitude: 0.3} and {*at} == {*before}
        assert [k.step for k in c.at(3.5, 0.3, 0.01).free_parameters if k.key == c.periodic] == [
            0.01
        ]
        assert any(k.per_run and k.key.endswith("phase_deg") for k in c.free_parameters)


def test_a_pattern_is_no_longer_than_what_a_run_passes():
    for longest, ends in ((2.0, 2.0), (0.0, SCALES.distance), (0.05, 0.05)):
        for c in candidates(replace(SCALES, longest=longest)):
            for k in c.free_parameters:
                if k.key == "surface_pattern.wavelength":
                    assert k.high == ends and 0.0 < k.low < k.start < k.high


# A model with a candidate added to it.

BASE = Model(
    (
        FreeParameter("friction.mu_s", 0.3, 0.01, 0.1, 20.0),
        FreeParameter("friction.mu_k", 0.2, 0.01, 0.0, 20.0),
        FreeParameter("offset.x", 0.0, 4e-4, prior=4e-4),
        FreeParameter("film_drag.coefficient", 0.5, 0.5, 0.0, 500.0),
    ),
    {"load_dependence.reference_force": 8.0},
)
FITTED = {
    "friction.mu_s": 0.35,
    "friction.mu_k": 0.15,
    "offset.x": 1e-4,
    "film_drag.coefficient": 2.0,
}
RATE = Candidate(
    "static_strengthening",
    "logarithmic",
    (FreeParameter("static_strengthening.rate", 0.03, 0.02, 0.0, 2.0),),
    {"static_strengthening.hold_time": 0.01},
)


def starts(model):
    return {free_parameter.key: free_parameter.start for free_parameter in model.free_parameters}


def test_an_extended_model_starts_where_the_base_was_fitted():
    model = extended(BASE, RATE, FITTED)
    # what is known beforehand stays centred on what is known
    assert starts(model) == {**FITTED, "offset.x": 0.0, "static_strengthening.rate": 0.03}
    assert model.settings == {**BASE.settings, **RATE.settings}
    assert model.free_parameters[-1] is RATE.free_parameters[0]  # after those of the base
    for free_parameter, before in zip(model.free_parameters, BASE.free_parameters, strict=False):
        assert replace(free_parameter, start=before.start) == before


def test_a_candidate_s_own_free_parameters_replace_the_base_s():
    again = Candidate("film_drag", "linear", (replace(BASE.free_parameters[3], start=7.0),))
    model = extended(BASE, again, FITTED)
    assert [k.key for k in model.free_parameters].count("film_drag.coefficient") == 1
    assert starts(model)["film_drag.coefficient"] == 7.0


@pytest.mark.parametrize("value", [0.0, 500.0])
def test_a_fit_that_ran_into_a_bound_starts_anew(value):
    assert (
        moved(BASE.free_parameters[3], {"film_drag.coefficient": value}) == BASE.free_parameters[3]
    )


def test_a_mu_s_that_is_not_felt_starts_where_it_is():
    for mu_s in (0.10, 0.15, 0.151):
        model = extended(BASE, RATE, {**FITTED, "friction.mu_s": mu_s})
        assert starts(model)["friction.mu_s"] > 1.1 * FITTED["friction.mu_k"]
        assert starts(model)["friction.mu_k"] == FITTED["friction.mu_k"]


def test_plain_free_parameters_start_inside_their_ranges_and_fit(campaign):
    """On top of them every candidate stands: the keys do not meet."""
    free_parameters = plain_free_parameters(campaign, True)
    plain = {free_parameter.key for free_parameter in free_parameters}
    setups = {stiffness_offset(number) for number in {campaign.setup_of(r) for r in campaign.runs}}
    drive = {SPEED_OFFSET, FRICTION_OFFSET, LOADING, *setups}
    assert plain <= KEYS | set(OFFSETS) | drive and drive <= plain
    assert not plain & {free_parameter.key for c in ALL for free_parameter in c.free_parameters}
    problem = Problem(
        prepare(campaign, campaign.runs, False),
        [free_parameter for free_parameter in free_parameters if free_parameter.key != "offset.y"],
    )
    assert fit(problem, start(problem.segmented_runs, problem.free_parameters)).rms_residual() < 1.2
