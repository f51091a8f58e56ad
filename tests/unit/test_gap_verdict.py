"""From trials to a verdict: none, one effect, a class, or unknown."""

from dataclasses import replace

import numpy as np
import pytest
from gap_trials import FAR, LESS, MORE, ROWS, after, finding, trial, tried

from cosim.gap.selection.criteria import explained

#: Where the decisions lie.
PLAIN_FITS = 1.3  # a plain model fits up to this root mean square residual
FITS = 1.5  # a repaired one up to this
EXPLAINED_BY_ONE = 0.93  # part of the excess chi-square that one effect takes
EXPLAINED_AT_LEAST = 0.9  # that is the least for a name
HOLDS = 2.5  # held-out residual over that of the fit
DRIFT = 2.0  # residual of long segments that may be drift
INDISTINGUISHABLE = 0.08  # difference of chi-squares per sample
DOES_MOST = 0.9  # part with which one effect stands alone
RIVAL = 0.5  # part of that which no other reaches
WAVE = 0.8  # part that is a wave
SEEN = 0.1  # of an excess of so much


@pytest.mark.parametrize("times, verdict", [(LESS * HOLDS, "named"), (MORE * HOLDS, "unknown")])
def test_what_is_true_of_the_fitted_runs_alone_is_no_name(times, verdict):
    far = 100.0
    fit, kept_back = 1.1, 1.1 * times
    squares = ROWS * np.array([fit**2, kept_back**2])
    half = replace(trial(fit), held_out=trial(kept_back).fitted, squares=squares)
    assert explained(trial(far), half) > max(EXPLAINED_BY_ONE, DOES_MOST)
    found, _ = finding([tried("film_drag", half), tried("run_in", after(0.0, far))], plain=far)
    assert found.verdict == verdict


def test_a_plain_model_that_fits_lacks_nothing_whatever_fits_better():
    found, _ = finding([tried("film_drag", 1.0)], plain=LESS * PLAIN_FITS)
    assert (found.verdict, found.effects, found.chosen) == ("none", (), None)
    assert found.nearest.rms_residual == pytest.approx(LESS * PLAIN_FITS)
    assert [t.candidate.effect for t in found.ranking] == ["film_drag"]


@pytest.mark.parametrize(
    "period, part, rival, verdict",
    [
        ("speed_ripple.frequency", MORE * WAVE, LESS * RIVAL, "named"),
        ("speed_ripple.frequency", LESS * WAVE, LESS * RIVAL, "none"),
        ("speed_ripple.frequency", MORE * WAVE, MORE * RIVAL * MORE, "none"),
        ("", MORE * WAVE, LESS * RIVAL, "none"),
    ],
)
def test_a_wave_is_named_though_the_plain_model_fits(period, part, rival, verdict):
    plain = np.sqrt(1.0 + MORE * SEEN)
    assert plain < PLAIN_FITS
    first = [tried("speed_ripple", after(part, plain)), tried("run_in", after(rival * part, plain))]
    first[0] = replace(first[0], candidate=replace(first[0].candidate, periodic=period))
    assert finding(first, plain=plain)[0].verdict == verdict
    # of an excess that is hardly there nothing is said
    hardly = np.sqrt(1.0 + LESS * SEEN)
    first[0] = replace(first[0], judged=after(part, hardly))
    assert finding(first[:1], plain=hardly)[0].verdict == "none"


def test_one_effect_is_named():
    found, _ = finding([tried("run_in", 5.0), tried("film_drag", 1.02), tried("speed_ripple", 7.0)])
    assert (found.verdict, found.effects) == ("named", ("film_drag",))
    assert found.chosen.rms_residual == found.nearest.rms_residual == pytest.approx(1.02)
    order = [t.candidate.effect for t in found.ranking]
    assert order == ["film_drag", "run_in", "speed_ripple"]


def test_effects_that_do_as_well_are_a_class():
    most = np.sqrt(1.02**2 + LESS * INDISTINGUISHABLE)
    first = [tried("structural_damping", most), tried("film_drag", 1.02), tried("run_in", 5.0)]
    found, _ = finding(first)
    assert (found.verdict, found.effects) == ("class", ("film_drag", "structural_damping"))
    assert found.chosen.rms_residual == pytest.approx(1.02)  # the member that fits best


def test_an_effect_tried_once_more_counts_as_it_then_fits():
    first = [tried("film_drag", 3.0), tried("run_in", 5.0)]
    found, _ = finding(first, polish=[tried("run_in", 1.02)])
    assert (found.verdict, found.effects) == ("named", ("run_in",))
    assert [t.candidate.effect for t in found.ranking] == ["run_in", "film_drag"]
    assert len(found.ranking) == 2


def test_effects_that_were_ruled_out_early_are_ranked_last():
    found, _ = finding([tried("film_drag", 5.0), tried("run_in", None), tried("speed_ripple", 2.0)])
    assert [t.candidate.effect for t in found.ranking] == ["speed_ripple", "film_drag", "run_in"]


def test_one_effect_that_dominates_is_named_though_something_is_left():
    strong = 0.5 * (DOES_MOST + EXPLAINED_BY_ONE)
    plain = 30.0
    first = [
        tried("film_drag", after(strong, plain)),
        tried("run_in", after(LESS * RIVAL * strong, plain)),
    ]
    found, _ = finding(first, plain=plain)
    assert (found.verdict, found.effects) == ("named", ("film_drag",))
    assert found.chosen.rms_residual == pytest.approx(after(strong, plain).rms_residual)


@pytest.mark.parametrize(
    "strong, rival", [(LESS * DOES_MOST, 0.0), (0.5 * (DOES_MOST + EXPLAINED_BY_ONE), MORE * RIVAL)]
)
def test_no_name_without_a_repair_or_with_a_rival(strong, rival):
    plain = 30.0
    first = [
        tried("film_drag", after(strong, plain)),
        tried("run_in", after(rival * strong, plain)),
    ]
    found, _ = finding(first, plain=plain)
    assert (found.verdict, found.effects, found.chosen) == ("unknown", (), None)
    assert found.nearest.rms_residual == pytest.approx(after(strong, plain).rms_residual)


def test_nothing_helps():
    found, _ = finding([tried("film_drag", FAR), tried("run_in", 1.1 * FAR)])
    assert (found.verdict, found.effects, found.chosen) == ("unknown", (), None)


def test_a_little_that_nothing_explains_is_nothing():
    """Between what fits and what is repaired, an effect has a name for nearly all of it."""
    between = 0.5 * (PLAIN_FITS + FITS)
    weak = after(LESS * EXPLAINED_AT_LEAST, between)
    assert weak.rms_residual < FITS
    found, _ = finding([tried("film_drag", weak)], plain=between)
    assert (found.verdict, found.effects) == ("none", ())
    found, _ = finding(
        [tried("film_drag", after(MORE * EXPLAINED_AT_LEAST, between))], plain=between
    )
    assert (found.verdict, found.effects) == ("named", ("film_drag",))


def test_what_only_long_runs_show_may_be_drift():
    short, plain = trial(LESS * PLAIN_FITS).fitted, LESS * DRIFT
    weak = [tried("film_drag", after(LESS * EXPLAINED_AT_LEAST, plain))]
    assert finding(weak, plain=plain, coarse=short)[0].verdict == "none"
    assert finding(weak, plain=plain)[0].verdict == "unknown"  # short ones show it as well
    assert finding(weak, plain=MORE * DRIFT, coarse=short)[0].verdict == "unknown"
    strong = [tried("film_drag", after(MORE * EXPLAINED_AT_LEAST, plain))]
    assert finding(strong, plain=plain, coarse=short)[0].effects == ("film_drag",)
