"""Two effects on a campaign that has both: screening, and what is left of a pair without one."""

import pytest
from gap_campaigns import NOISE, motion, noisy, write_campaign
from stickslip.effects.candidate import Candidate, FreeParameter, Scales

from cosim.gap import read_campaign
from cosim.gap.candidates.catalogue import candidates
from cosim.gap.candidates.extend import extended
from cosim.gap.estimation.linearisation import linearised, screening_fit
from cosim.gap.estimation.preparation import prepared
from cosim.gap.estimation.trial import Model, coarse_fit, try_model
from cosim.gap.selection.search import Search
from cosim.gap.selection.tried import Tried

SPEEDS = (0.06, 0.15, 0.10)
PLAIN = Model(
    (
        FreeParameter("friction.mu_s", 0.29, 0.015, 0.0, 2.0),
        FreeParameter("friction.mu_k", 0.21, 0.01, 0.0, 2.0),
    ),
    {},
)
RATE = Candidate(
    "static_strengthening",
    "logarithmic",
    (FreeParameter("static_strengthening.rate", 0.003, 0.02, 0.0, 2.0),),
    {"static_strengthening.hold_time": 0.01},
)
DRAG = Candidate(
    "film_drag", "linear", (FreeParameter("film_drag.coefficient", 0.01, 0.1, 0.0, 50.0),)
)
CUBIC = Candidate(
    "spring_hardening", "cubic", (FreeParameter("spring_hardening.cubic", 10.0, 1e3, 0.0),)
)


def measured(folder, hidden):
    """Runs with two effects in them, ready to be fitted."""
    runs = [
        {
            "surface_speed": v,
            "hold_out": v == SPEEDS[2],
            "columns": {"t": run.time, "x": noisy(run["x"], number)},
        }
        for number, v in enumerate(SPEEDS)
        for run in [motion(speed=v, duration=6.0, **hidden)]
    ]
    campaign = read_campaign(write_campaign(folder, runs, noise={"x": NOISE}))
    return prepared(campaign, campaign.fit_runs, campaign.held_out_runs, False)


@pytest.fixture(scope="module")
def data(tmp_path_factory):
    hidden = {
        "static_strengthening": {"rate": 0.05, "hold_time": 0.01},
        "film_drag": {"coefficient": 0.8},
    }
    return measured(tmp_path_factory.mktemp("campaign"), hidden)


@pytest.fixture(scope="module")
def plain(data):
    return coarse_fit(data, PLAIN, 25)


def on(data):
    return Search(data, lambda function, arguments: (function(*each) for each in arguments))


@pytest.fixture(scope="module")
def search(data):
    return on(data)


def pair_of(data, plain, first, second):
    """Two effects, fitted, the second on top of the first."""
    below = extended(PLAIN, first, plain.values)
    model = extended(below, second, coarse_fit(data, below, 8).values)
    coarse = coarse_fit(data, model, 8)
    return Tried(second, model, coarse, try_model(data, model, coarse))


@pytest.fixture(scope="module")
def both(data, plain):
    """The right pair."""
    return pair_of(data, plain, RATE, DRAG)


def test_the_linearisation_point_is_the_fit_itself(data, plain):
    under = linearised(data, PLAIN, plain)
    assert under.rms_residual() == plain.rms_residual() and under.point is plain.point
    assert [columns.shared.shape[1] for columns in under.columns] == [2, 2]


def test_a_screening_fit_goes_most_of_a_coarse_fit_s_way(data, plain):
    """By the plain model's derivatives an effect that is there is known from one that is not."""
    under = linearised(data, PLAIN, plain)
    left = {}
    for law in (RATE, DRAG, CUBIC):
        model = extended(PLAIN, law, plain.values)
        seen = screening_fit(data, model, under, 3).cost
        assert seen < plain.cost
        left[law.effect] = (seen, coarse_fit(data, model, 12).cost)
    gained = {effect: plain.cost - seen for effect, (seen, _) in left.items()}
    possible = {effect: plain.cost - end for effect, (_, end) in left.items()}
    best = max(possible, key=possible.get)
    assert best == max(gained, key=gained.get)
    assert gained[best] > 0.5 * possible[best]


def test_a_pair_repairs_what_neither_does_alone(both, search):
    assert both.trial.rms_residual < 1.1
    for dropped, kept in ((RATE, DRAG), (DRAG, RATE)):
        less = search.less(both, dropped, tuple(kept.settings))
        keys = {free.key for free in less.model.free_parameters}
        assert not keys & {free.key for free in dropped.free_parameters}
        assert keys >= {free.key for free in kept.free_parameters}
        assert less.trial.rms_residual > 1.5 * both.trial.rms_residual
    assert RATE.settings.items() <= search.less(both, DRAG, ()).model.settings.items()


def test_settings_that_others_need_are_kept(both, search):
    key = "static_strengthening.hold_time"
    assert search.less(both, RATE, (key,)).model.settings == RATE.settings
    assert search.less(both, RATE, ()).model.settings == {}


def test_the_second_effect_is_among_those_beside_the_first(data, plain, search):
    first = extended(PLAIN, RATE, plain.values)
    coarse = coarse_fit(data, first, 8)
    beside = search.beside(first, coarse, [CUBIC, DRAG])
    assert beside[0].candidate.effect == "film_drag"
    assert beside[0].coarse.rms_residual() < 1.1
    ((_, pair),) = search.together([(Tried(RATE, first, coarse), beside[0])])
    assert pair.trial.rms_residual < 1.1


@pytest.mark.parametrize(
    "first, second, wrong, right", [(RATE, CUBIC, CUBIC, DRAG), (CUBIC, DRAG, CUBIC, RATE)]
)
def test_another_effect_may_take_the_place_of_either_of_a_pair(
    data, plain, search, first, second, wrong, right
):
    pair = pair_of(data, plain, first, second)
    kept = second if wrong is first else first
    found, *others = search.instead(pair, wrong, [right], tuple(kept.settings))
    keys = {free.key for free in found.model.free_parameters}
    assert not others and found.candidate.effect == right.effect
    assert keys == {
        free.key
        for free in (
            *PLAIN.free_parameters,
            *kept.free_parameters,
            *right.free_parameters,
        )
    }
    assert found.trial.rms_residual < 1.1 < pair.trial.rms_residual


def test_a_wrong_period_beside_another_effect_is_put_right(tmp_path):
    hidden = {
        "speed_ripple": {"amplitude": 0.3, "frequency": 2.3},
        "film_drag": {"coefficient": 0.8},
    }
    rippled = measured(tmp_path, hidden)
    extent = Scales(
        speed=0.1,
        distance=0.6,
        heat=1.0,
        duration=6.0,
        stiffness=38.5,
        travel=0.05,
        mass=0.87,
        force=8.5,
        extension=0.03,
    )
    laws = [c for c in candidates(extent) if c.effect == "speed_ripple"]
    wrong = laws[0].at(3.7, 0.2, 0.01)
    pair = pair_of(rippled, coarse_fit(rippled, PLAIN, 8), DRAG, wrong)
    found = on(rippled).anew(pair, wrong, [*laws, CUBIC])
    values = found.coarse.values
    assert values["speed_ripple.frequency"] == pytest.approx(2.3, abs=0.02)
    assert values["speed_ripple.amplitude"] == pytest.approx(0.3, abs=0.02)
    assert values["film_drag.coefficient"] == pytest.approx(0.8, abs=0.05)
    assert found.coarse.rms_residual() < 1.1 < pair.coarse.rms_residual()
