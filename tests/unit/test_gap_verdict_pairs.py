"""When two effects are named, and when one of them is enough."""

from dataclasses import replace

import numpy as np
import pytest
from gap_trials import FAR, LESS, MORE, after, finding, trial, tried

from cosim.gap.selection.criteria import excess_chi_square, repaired

#: Where the decisions lie.
PLAIN_FITS = 1.3  # a plain model fits up to this root mean square residual
FITS = 1.5  # a repaired one up to this
EXPLAINED_BY_ONE = 0.93  # part of the excess chi-square that one effect takes
EXPLAINED_BY_TWO = 0.92  # that two take
ALL = 0.99  # part beside which nothing is left for another
RIVAL = 0.5  # part of that which no other reaches
DOMINANT = 0.85  # part of one alone beside which
NEEDED = 0.7  # another takes this part of the rest
MOST = 0.6  # part of a pair whose periods are searched for anew
NEARLY = 0.8  # part of a pair that is fitted more closely


def two_effects(pair, one=0.6, other=0.5):
    """film_drag and run_in, each with a part alone, and a trial of both."""
    first = [
        tried("film_drag", after(one)),
        tried("run_in", after(other)),
        tried("speed_ripple", after(0.0)),
    ]
    return finding(
        first, second={"film_drag": [tried("run_in", pair)], "run_in": [tried("film_drag", pair)]}
    )


def test_two_effects_are_named_where_both_repair_it():
    found, search = two_effects(trial(1.02))
    assert (found.verdict, found.effects) == ("named", ("film_drag", "run_in"))
    assert found.chosen.rms_residual == pytest.approx(1.02)
    for offered in search.asked:  # a second one is another one
        assert len(offered) == 2


@pytest.mark.parametrize("part, effects", [(MORE, ("film_drag", "speed_ripple")), (LESS, ())])
def test_a_period_that_was_found_beside_nothing_is_searched_for_beside_the_other(part, effects):
    first = [tried("film_drag", after(0.5)), tried("speed_ripple", after(0.1))]
    waves = [tried("speed_ripple", at) for at in (after(part * MOST), trial(1.02))]
    waves = [
        replace(t, candidate=replace(t.candidate, periodic="speed_ripple.frequency")) for t in waves
    ]
    found, search = finding(
        first, second={"film_drag": waves[:1]}, once_more={"speed_ripple": waves[1]}
    )
    assert found.effects == effects
    assert ("speed_ripple" in search.asked) == bool(effects)
    assert "film_drag" not in search.asked  # it has no period


def test_a_pair_that_fits_in_short_segments_is_fitted_more_closely():
    """Long ones may have led its laws astray."""
    first = [tried("film_drag", after(0.4)), tried("run_in", after(0.3))]
    astray = after(LESS * NEARLY)
    for short, effects in ((PLAIN_FITS, ("film_drag", "run_in")), (MORE * PLAIN_FITS, ())):
        pair = replace(tried("run_in", astray), coarse=trial(short).fitted)
        found, _ = finding(first, second={"film_drag": [pair]}, polish=[tried("run_in", 1.02)])
        assert found.effects == effects


def test_two_effects_must_take_away_so_much():
    parts = [1.0 - factor * (1.0 - EXPLAINED_BY_TWO) for factor in (LESS, MORE)]
    verdicts = []
    for part in parts:
        first = [tried("film_drag", after(0.6, 100.0)), tried("run_in", after(0.5, 100.0))]
        pair = tried("run_in", after(part, 100.0))
        verdicts.append(finding(first, plain=100.0, second={"film_drag": [pair]})[0].verdict)
    assert verdicts == ["named", "unknown"]


def test_a_second_effect_that_the_first_does_without_is_not_named():
    """The first one alone, fitted again from where the pair ended, does nearly as well."""
    first = [tried("film_drag", after(0.6)), tried("run_in", after(0.5))]
    second = {"film_drag": [tried("run_in", 1.2)]}
    found, _ = finding(first, second=second, without={"run_in": 1.25})
    assert (found.verdict, found.effects) == ("named", ("film_drag",))
    found, _ = finding(first, second=second, without={"film_drag": 1.25})
    assert (found.verdict, found.effects) == ("named", ("run_in",))


@pytest.mark.parametrize(
    "factor, effects", [(LESS, ("film_drag", "run_in")), (MORE, ("film_drag",))]
)
def test_beside_an_effect_that_explains_nearly_all_another_must_do_so_with_the_rest(
    factor, effects
):
    """What is left by one whose law is a little wrong is seldom a second one."""
    plain, alone = 100.0, after(0.5 * (EXPLAINED_BY_ONE + 1.0), 100.0)
    pair = trial(np.sqrt(1.0 + factor * (1.0 - NEEDED) * excess_chi_square(alone)))
    first = [tried("film_drag", alone), tried("run_in", after(0.3, plain))]
    found, _ = finding(
        first,
        plain=plain,
        second={"film_drag": [tried("run_in", pair)]},
        without={"run_in": alone.rms_residual, "film_drag": 0.9 * plain},
    )
    assert (found.verdict, found.effects) == ("named", effects)


def test_an_effect_that_leaves_noise_once_it_sets_out_from_the_pair_needs_no_other():
    first = [tried("film_drag", after(0.5)), tried("run_in", after(0.3))]
    found, _ = finding(
        first, second={"film_drag": [tried("run_in", 0.997)]}, without={"run_in": 1.003}
    )
    assert (found.verdict, found.effects) == ("named", ("film_drag",))


def test_beside_an_effect_that_explains_all_no_other_is_searched_for():
    first = [tried("film_drag", after(1.0 - LESS * (1.0 - ALL), 100.0))]
    assert first[0].trial.rms_residual > FITS
    second = {"film_drag": [tried("run_in", 1.0)]}
    found, search = finding(first, plain=100.0, second=second)
    assert (found.verdict, found.effects) == ("named", ("film_drag",))
    assert not search.asked


def test_what_is_nearest_may_be_a_pair():
    pair = after(0.95 * EXPLAINED_BY_TWO)  # twice as much as either alone
    alone = 0.45 * EXPLAINED_BY_TWO
    found, _ = two_effects(pair, one=alone, other=alone)
    assert found.verdict == "unknown" and found.nearest.rms_residual == pytest.approx(
        pair.rms_residual
    )


def test_a_pair_whose_better_half_does_it_alone_is_no_pair():
    """A good effect on top of a poor one does well: the poor one has no part in it."""
    strong = 0.5 * (DOMINANT + EXPLAINED_BY_ONE)
    good, poor = tried("run_in", after(strong)), tried("film_drag", after(MORE * RIVAL * strong))
    pair = after(1.0 - (1.0 - strong) * MORE * (1.0 - NEEDED))
    assert repaired(trial(FAR), pair, EXPLAINED_BY_TWO)
    found, _ = finding([good, poor], second={"film_drag": [tried("run_in", pair)]})
    assert found.verdict == "unknown" and found.nearest.rms_residual == pytest.approx(
        good.trial.rms_residual
    )
