"""Error rates of a design: the ladder's own decision, drawn campaigns, when a name is a class."""

from dataclasses import replace
from functools import cache
from itertools import product
from types import SimpleNamespace

import numpy as np
import pytest
from gap_campaigns import campaign_with, motion, seen
from scipy.stats import multivariate_normal

from cosim.gap.rates import (
    NONE,
    Decision,
    Offers,
    added_rows,
    confirmed,
    counted,
    drawn,
    options_of,
    rates_of,
)
from cosim.gap.result import Rates
from cosim.gap.scatter import SCATTER_ASKED, ZERO_PARTS_ASKED, averaged_over
from cosim.gap.weak_form.arguments import Arguments
from cosim.gap.weak_form.ladder import Search
from cosim.gap.weak_form.rows import rows_of
from cosim.gap.weak_form.system import System
from cosim.gap.weak_form.track import smooth
from cosim.gap.windows.fitted import Fitted, Information

PAIR = ("film_drag", "velocity_weakening")
ASKED = (*PAIR, "structural_damping", "run_in")


@cache
def campaign_of(folder, masses):
    """Three speeds with each mass, ten seconds; friction falls linearly with the speed."""
    runs = []
    for number, (mass, speed) in enumerate((m, v) for m in masses for v in (0.05, 0.1, 0.2)):
        run = motion(speed, mass, duration=10.0, velocity_weakening={"linear": 0.4})
        runs.append(seen(run, number, surface_speed=speed, mass=mass))
    folder.mkdir(exist_ok=True)
    campaign = campaign_with(folder, runs)
    system = System(campaign, [rows_of(smooth(run), campaign.rig) for run in campaign.runs])
    unknowns = Arguments(campaign, system.runs, system.level).unknowns()
    return system, {name: unknowns[name] for name in ASKED}


@pytest.fixture(scope="module", params=[(0.87,), (0.5, 1.4)], ids=["one mass", "two masses"])
def searched(request, tmp_path_factory):
    folder = tmp_path_factory.getbasetemp() / f"rates{len(request.param)}"
    system, unknowns = campaign_of(folder, request.param)
    return Search(system, unknowns, ()).climb(), unknowns, len(request.param)


def test_the_decision_is_that_of_the_ladder(searched):
    """Evidence of every argument as the ladder itself asks for it, of the measured rows."""
    ladder, unknowns, _ = searched
    system = ladder.system
    rung = system.rung()
    options = {name: options_of(some, len(system.fitted)) for name, some in unknowns.items()}
    decision = Decision(rung, options)
    offers = decision.decided(decision.projected(system.rows[:, None]))
    for name, evidence, gain in zip(offers.names, offers.evidence, offers.gain, strict=True):
        total, added = rung.offered(unknowns[name])
        assert evidence[0] == pytest.approx(total - rung.evidence, abs=1e-6)
        assert gain[0] == pytest.approx(system.rung([added]).evidence - rung.evidence, abs=1e-6)


def test_one_mass_cannot_tell_force_from_coefficient(searched):
    """Two masses can; where nothing is missing nothing is named."""
    ladder, unknowns, masses = searched
    assert ladder.findings[0].name in PAIR
    known = {name: ladder.first_offers[ladder.findings[0].name] for name in PAIR}
    rates = rates_of(replace(ladder, first_offers={**ladder.first_offers, **known}), unknowns)
    truth = "velocity_weakening"
    assert sum(rates.table[truth].values()) == rates.each == 50
    both = sum(n for said, n in rates.table[truth].items() if all(one in said for one in PAIR))
    alone = rates.table[truth].get(truth, 0)
    assert both >= 45 if masses == 1 else alone >= 45
    assert rates.table[NONE].get(NONE, 0) >= 47


def test_friction_over_the_speed_has_the_name_that_the_ladder_has_for_it(searched):
    """The verdict asks the table by it; by the other name an argument's answers would be lost."""
    ladder, unknowns, _ = searched
    rates = rates_of(ladder, unknowns, each=20)
    assert "film_drag" not in ladder.first_offers  # force and coefficient both fall
    assert not any("film_drag" in said for row in rates.table.values() for said in row)
    answers = rates.table["velocity_weakening"].items()
    assert sum(count for said, count in answers if "velocity_weakening" in said) >= 18


def test_a_wave_that_offered_nothing_at_first_is_no_truth(searched):
    """Beside other findings it may come near; where it would stand nobody has looked for."""
    ladder, unknowns, _ = searched
    (finding, *rest) = ladder.findings
    near = replace(finding, others={"surface_pattern": -0.1, **finding.others})
    rates = rates_of(replace(ladder, findings=(near, *rest)), unknowns, each=2)
    assert finding.name in rates.table and "surface_pattern" not in rates.table


def test_a_seed_draws_the_same_campaigns(searched):
    ladder, unknowns, _ = searched
    first = rates_of(ladder, unknowns, each=5, seed=1)
    assert first == rates_of(ladder, unknowns, each=5, seed=1)


def test_what_is_drawn_is_as_large_as_stated(searched):
    """Mean squares of drawn rows: noise, and the rig's own numbers as wide as their priors."""
    system = searched[0].system
    rung = system.rung(contact=False)
    spread, zeros = 0.03, 0.5
    rows = drawn(rung, 400, np.random.default_rng(0), spread, zeros)
    expected = np.ones(system.rows.size)
    for added in rung.base:
        scale = {"scatter": spread, "zero": zeros, "mu_k": 0.0, "mu_s": 0.0}
        factor = added.factor * scale.get(added.unknown.name, 1.0)
        blocks = np.kron(np.eye(len(system.fitted)), factor) if added.unknown.per_run else factor
        expected += np.sum((system.columns(added.unknown) @ blocks) ** 2, axis=1)
    assert np.mean(rows**2) / np.mean(expected) == pytest.approx(1.0, abs=0.1)


def test_a_truth_is_as_large_as_the_rows_have_it(searched):
    """What it adds is what a rung's posterior mean adds."""
    ladder = searched[0]
    mean = ladder.rung.posterior[0]
    columns = [ladder.system.columns(one.unknown) for one in ladder.rung.added]
    parts = [mean[ladder.rung.part_of(one)] for one in ladder.rung.added]
    expected = sum(c @ p for c, p in zip(columns, parts, strict=True))
    assert added_rows(ladder.rung) == pytest.approx(expected)


def test_a_name_takes_six_nats_and_a_class_three():
    """A third more or less of either threshold would answer otherwise."""
    evidence = np.array([[9.0, 9.0, 9.0, 9.0], [6.5, 5.5, 6.5, 5.5]])
    gain = np.array([[6.5, 6.5, 5.5, 5.5], [6.5, 6.5, 5.5, 5.5]])
    answers = Offers(("a", "b"), evidence, gain).answers()
    assert answers == [("a", "b"), ("a",), (), ()]
    assert counted(answers) == {NONE: 2, "class: a, b": 1, "a": 1}
    assert counted([("b", "a"), ("a", "b")]) == {"class: a, b": 2}


@pytest.mark.parametrize(("times", "members"), [(4, ("a",)), (6, ("a", "b"))])
def test_a_name_that_another_truth_would_be_given_is_a_class(times, members):
    """One in ten."""
    table = {"a": {"a": 50}, "b": {"b": 50 - times, "a": times}, NONE: {NONE: 40, "a": 10}}
    assert confirmed(Rates(50, table), "a") == members


# --- scatter that simulated runs are averaged over, against closed forms ---

#: Friction of six runs in parts, the standard deviation to which each is seen, what a fit has let
#: friction scatter by, what is expected of that, and what a zero within its stated error does.
SEEN, ASSUMED, EXPECTED, ZERO = 2e-3, 0.045, 0.02, 0.01
LOADS = np.array([-1.0, -0.6, -0.2, 0.2, 0.6, 1.0])
OBSERVED = 0.06 * LOADS + SEEN * np.array([0.3, -1.1, 0.6, 0.2, -0.4, 0.9])


def regressed(friction, trend, assumed=ASSUMED, short=0.0):
    """The fit of a level, of a trend over the loads or of none, and of the runs' own numbers.

    short : by which it has ended early
    """
    shared = np.column_stack([np.ones_like(LOADS), LOADS][: 1 + trend])
    sizes = {"offset.friction": assumed, "offset.x": ZERO}
    kinds = [kind for kind, size in sizes.items() if size]
    own = np.hstack([sizes[kind] * np.eye(LOADS.size) for kind in kinds])
    prior = np.hstack([np.zeros((own.shape[1], shared.shape[1])), np.eye(own.shape[1])])
    rows = np.vstack([np.hstack([shared, own]) / SEEN, prior])
    data = np.concatenate([friction / SEEN, np.zeros(own.shape[1])])
    found = np.linalg.lstsq(rows, data, rcond=None)[0]
    names = ["level", "trend"][: 1 + trend]
    labels = (*names, *(f"{kind}@run{n}" for kind in kinds for n in range(LOADS.size)))
    run = SimpleNamespace(residuals=np.ones(3), states=np.zeros((1, 6)))
    found = found + short * np.arange(found.size)
    left = rows @ found - data
    known = Information(labels, found, np.linalg.qr(rows, mode="r"), rows.T @ left)
    return Fitted({}, {}, {}, (run,), float(left @ left), known=(known,))


def exactly(trend, scatter, zeros):
    """ln of how probable the runs are, the level and the trend as they are then."""
    shared = np.column_stack([np.ones_like(LOADS), LOADS][: 1 + trend])
    left = OBSERVED - shared @ np.linalg.lstsq(shared, OBSERVED, rcond=None)[0]
    variance = scatter**2 + (zeros * ZERO) ** 2 + SEEN**2
    return multivariate_normal.logpdf(left, cov=variance * np.eye(LOADS.size))


@pytest.mark.parametrize("trend", [False, True])
@pytest.mark.parametrize("assumed", [0.0, 0.03, 0.09])
def test_shared_numbers_follow_where_less_scatter_is_allowed(trend, assumed):
    asked = list(product(SCATTER_ASKED if assumed else (0.0,), ZERO_PARTS_ASKED))
    weights = np.exp([-0.5 * (scatter / EXPECTED) ** 2 for scatter, _ in asked])
    average = np.average(np.exp([exactly(trend, *one) for one in asked]), weights=weights)
    off = np.log(average) - exactly(trend, assumed, 1.0)
    found = averaged_over(regressed(OBSERVED, trend, assumed), assumed, EXPECTED)
    assert found == pytest.approx(off, abs=1e-6)
    early = averaged_over(regressed(OBSERVED, trend, assumed, 0.1), assumed, EXPECTED)
    assert early == pytest.approx(off, abs=1e-6)


def test_a_trend_that_scatter_has_half_taken_up_is_worth_what_all_of_it_is():
    without, found = (regressed(0.06 * LOADS, trend) for trend in (False, True))
    gain = found.gain_over(without)
    gain += averaged_over(found, ASSUMED, EXPECTED) - averaged_over(without, ASSUMED, EXPECTED)
    assert found.gain_over(without) < 6.0 < 12.0 < gain
