"""Effects that stand for one another: confounders, aliases, masking, friction across."""

from dataclasses import replace

import numpy as np
import pytest
from gap_trials import ACROSS, FAR, LESS, MORE, ROWS, after, finding, trial, tried
from stickslip.effects.candidate import FreeParameter

from cosim.gap.estimation.fitted import Fitted, Point
from cosim.gap.estimation.trial import Model
from cosim.gap.selection.criteria import PART_OF_OTHERS, excess_chi_square, repaired

#: Where the decisions lie.
PLAIN_FITS = 1.3  # a plain model fits up to this root mean square residual
FITS = 1.5  # a repaired one up to this
EXPLAINED_BY_ONE = 0.93  # part of the excess chi-square that one effect takes
INDISTINGUISHABLE = 0.08  # difference of chi-squares per sample
INDISTINGUISHABLE_PART = 0.1  # and part of the excess of the better
HARDLY = 1.1  # residual that is hardly more than noise


@pytest.mark.parametrize(
    "effect, without, effects",
    [
        ("spring_misalignment", 5.0, ("spring_misalignment", PART_OF_OTHERS)),
        ("spring_misalignment", 1.02, ("spring_misalignment",)),  # it does without
        ("turning_surface", 5.0, ("turning_surface",)),  # it drags aside by that friction
    ],
)
def test_friction_across_that_another_effect_needs_is_named_with_it(effect, without, effects):
    first = [tried(effect, 1.01, ACROSS), tried(PART_OF_OTHERS, 6.0, ACROSS)]
    found, _ = finding(first, without={PART_OF_OTHERS: without})
    assert (found.verdict, found.effects) == ("named", effects)
    assert found.chosen.rms_residual == pytest.approx(1.01)


def test_friction_across_stands_for_one_effect_that_adds_nothing_to_it():
    """Tried alone it may have ended elsewhere; from where the best one ended it does as well."""
    first = [
        tried("turning_surface", 1.01, ACROSS),
        tried("spring_misalignment", 1.02, ACROSS),
        tried(PART_OF_OTHERS, 2.0, ACROSS),
    ]
    found, _ = finding(first, across=1.02)
    assert (found.verdict, found.effects) == ("named", (PART_OF_OTHERS,))
    assert found.chosen.rms_residual == pytest.approx(1.02)
    names = [t.candidate.effect for t in found.ranking]
    assert names == [PART_OF_OTHERS, "turning_surface", "spring_misalignment"]


@pytest.mark.parametrize(
    "effect, gap, verdict",
    [
        ("spring_misalignment", 1.02, "unknown"),
        ("spring_misalignment", 1.2, "named"),
        ("film_drag", 1.02, "named"),
    ],
)  # nothing else is confounded with that
def test_a_confounder_that_does_better_is_said(effect, gap, verdict):
    found, _ = finding([tried(effect, 1.21)], confounder=gap)
    assert (found.verdict, found.nearest.rms_residual) == (verdict, pytest.approx(1.21))
    assert found.confounder == ("a rig tilted sideways" if verdict == "unknown" else "")


def test_two_effects_that_mask_one_another_are_named():
    """Neither does anything alone; where both do all in short segments, no others are tried."""
    first = [tried("speed_ripple", after(0.1)), tried("run_in", after(0.05))]
    both = tried("thermal_weakening", 1.02)
    hidden = (tried("film_drag", FAR).candidate, both)
    found, search = finding(first, hidden=hidden, second={"speed_ripple": [tried("run_in", 3.0)]})
    assert (found.verdict, found.effects) == ("named", ("film_drag", "thermal_weakening"))
    assert found.chosen.rms_residual == pytest.approx(1.02) and not search.asked


@pytest.mark.parametrize(
    "left, verdict",
    [(LESS * HARDLY, ("film_drag", "run_in")), (MORE * HARDLY, ("speed_ripple", "run_in"))],
)
def test_a_pair_that_leaves_more_than_noise_may_have_an_alias_for_its_first(left, verdict):
    """Its second does as well on top of another first, and leaves less there."""
    first = [
        tried("film_drag", after(0.6, 100.0)),
        tried("speed_ripple", after(0.5, 100.0)),
        tried("run_in", after(0.0, 100.0)),
    ]
    far = trial(100.0).fitted
    second = {"film_drag": [tried("run_in", left)], "speed_ripple": [tried("run_in", 1.0)]}
    found, _ = finding(first, plain=100.0, coarse=far, second=second)
    assert (found.verdict, found.effects) == ("named", verdict)


@pytest.mark.parametrize("lateral, second", [(True, "turning_surface"), (False, "run_in")])
def test_what_moves_a_block_off_its_line_is_tried_in_place_of_what_does_so_too(lateral, second):
    first = [
        tried("film_drag", after(0.6, 100.0)),
        tried("turning_surface", after(0.0, 100.0)),
        tried("run_in", after(0.0, 100.0)),
    ]
    first[1] = replace(first[1], candidate=replace(first[1].candidate, lateral=True))
    pair = tried("run_in", MORE * PLAIN_FITS)
    pair = replace(pair, candidate=replace(pair.candidate, lateral=lateral))
    search = {"second": {"film_drag": [pair]}, "aliases": [tried("turning_surface", 1.0)]}
    found, _ = finding(first, plain=100.0, **search)
    assert (found.verdict, found.effects) == ("named", ("film_drag", second))


def test_an_effect_beside_one_that_moves_the_block_off_its_line_is_kept_for_its_aliases():
    first = [
        tried("lateral_friction", after(0.6, 100.0)),
        tried("run_in", after(0.5, 100.0)),
        tried("turning_surface", after(0.0, 100.0)),
    ]
    for i in (0, 2):
        first[i] = replace(first[i], candidate=replace(first[i].candidate, lateral=True))
    search = {
        "second": {"lateral_friction": [tried("run_in", MORE * PLAIN_FITS)]},
        "aliases": [tried("turning_surface", 1.0)],
    }
    found, _ = finding(first, plain=100.0, **search)
    assert (found.verdict, found.effects) == ("named", ("run_in", "turning_surface"))


def ended(at, time):
    """A trial whose law has a time that ended here; at 0.03 s it is a plain number."""
    free = FreeParameter(
        "static_strengthening.saturation_time", 0.1, 0.5, 0.03, 30.0, log=True, plain_below=True
    )
    fitted = Fitted(
        (free,),
        Point(np.array([free.scaled(time)]), (), ()),
        (np.full(ROWS, at),),
    )
    return replace(trial(at), model=Model((free,), {}), fitted=fitted)


@pytest.mark.parametrize("time, verdict", [(0.03, "unknown"), (0.1, "named")])
def test_a_law_that_has_become_a_plain_number_is_no_effect(time, verdict):
    found, _ = finding([tried("static_strengthening", ended(1.02, time)), tried("run_in", 9.0)])
    assert found.verdict == verdict
    # one that does as well and is an effect is named; with the other one where that is one too
    as_well = [tried("static_strengthening", ended(1.02, time)), tried("stick_stiffness", 1.03)]
    found, _ = finding(as_well)
    assert ("static_strengthening" in found.effects) == (verdict == "named")
    assert "stick_stiffness" in found.effects
    # nor does one that explains most stand alone where such a law does the rest
    most = after(0.5 * (1.0 + EXPLAINED_BY_ONE))
    assert most.rms_residual > FITS and repaired(trial(FAR), most, EXPLAINED_BY_ONE)
    first = [tried("run_in", most), tried("static_strengthening", after(0.1))]
    second = {"run_in": [tried("static_strengthening", ended(1.02, time))]}
    found, _ = finding(first, second=second)
    assert found.verdict == verdict
    assert found.nearest.rms_residual == pytest.approx(1.02)


@pytest.mark.parametrize("part, second", [(LESS, PART_OF_OTHERS), (MORE, "turning_surface")])
def test_friction_across_stands_for_what_brings_it_along_if_it_does_as_well(part, second):
    pair = trial(1.02)
    gap = np.sqrt(
        1.02**2 + part * (INDISTINGUISHABLE + INDISTINGUISHABLE_PART * excess_chi_square(pair))
    )
    first = [
        tried("film_drag", after(0.6)),
        tried("turning_surface", after(0.5), ACROSS),
        tried(PART_OF_OTHERS, after(0.1), ACROSS),
    ]
    both = [tried("turning_surface", pair, ACROSS)]
    found, _ = finding(first, second={"film_drag": both}, across=gap)
    assert (found.verdict, found.effects) == ("named", ("film_drag", second))
