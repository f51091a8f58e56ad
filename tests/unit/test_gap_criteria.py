"""What a trial has taken away of the misfit, and which trials do as well."""

import numpy as np
import pytest
from gap_trials import ACROSS, FAR, LESS, MORE, ROWS, after, trial, tried

from cosim.gap.estimation.fitted import Fitted
from cosim.gap.estimation.trial import Model, Trial
from cosim.gap.selection.criteria import (
    PART_OF_OTHERS,
    excess_chi_square,
    explained,
    indistinguishable,
    repaired,
)

#: Where the decisions lie.
FITS = 1.5  # a repaired one up to this
EXPLAINED_BY_ONE = 0.93  # part of the excess chi-square that one effect takes
EXPLAINED_AT_LEAST = 0.9  # that is the least for a name
INDISTINGUISHABLE = 0.08  # difference of chi-squares per sample
INDISTINGUISHABLE_PART = 0.1  # and part of the excess of the better


def test_measures():
    assert (
        excess_chi_square(trial(2.0)) == pytest.approx(3.0) and excess_chi_square(trial(0.9)) == 0.0
    )
    assert explained(trial(FAR), after(0.8)) == pytest.approx(0.8)
    assert explained(trial(1.0), trial(1.0)) == 0.0  # nothing was there to be explained


def test_a_model_is_repaired_when_noise_is_left_or_next_to_nothing_of_what_was():
    assert repaired(trial(FAR), trial(LESS * FITS), EXPLAINED_BY_ONE)
    assert repaired(
        trial(100.0), after(1.0 - LESS * (1.0 - EXPLAINED_BY_ONE), 100.0), EXPLAINED_BY_ONE
    )
    assert not repaired(
        trial(100.0), after(1.0 - MORE * (1.0 - EXPLAINED_BY_ONE), 100.0), EXPLAINED_BY_ONE
    )
    small = MORE * FITS  # a gap that was small before is not repaired by what is left of it
    assert not repaired(trial(1.2 * small), trial(small), EXPLAINED_BY_ONE)


def test_effects_are_told_apart_by_more_than_their_fit_s_own_misfit():
    best = trial(1.4)
    allowed = INDISTINGUISHABLE + INDISTINGUISHABLE_PART * excess_chi_square(best)
    for part, members in ((LESS, 2), (MORE, 1)):
        other = trial(np.sqrt(best.rms_residual**2 + part * allowed))
        assert len(indistinguishable([tried("film_drag", best), tried("run_in", other)])) == members


def test_friction_across_alone_is_named_when_others_add_nothing_to_it():
    with_it = tried("turning_surface", 1.0, ACROSS)
    without = tried("spring_misalignment", 1.0)
    alone = tried(PART_OF_OTHERS, 1.01, ACROSS)
    assert indistinguishable([with_it, alone]) == (PART_OF_OTHERS,)
    assert indistinguishable([with_it, without]) == ("turning_surface", "spring_misalignment")
    # one that does as well without any friction across is a member
    assert set(indistinguishable([with_it, alone, without])) == {
        PART_OF_OTHERS,
        "spring_misalignment",
    }
    # what friction across alone does not repair is for the others
    far = tried(PART_OF_OTHERS, 5.0, ACROSS)
    assert indistinguishable([with_it, far]) == ("turning_surface",)


def test_what_remains_may_be_noise_and_yet_most_of_what_was():
    before = MORE * FITS
    most, least = (after(part * EXPLAINED_AT_LEAST, before) for part in (LESS, MORE))
    assert most.rms_residual < FITS
    assert not repaired(trial(before), most, EXPLAINED_BY_ONE)
    assert repaired(trial(before), least, EXPLAINED_BY_ONE)


def test_what_only_held_out_runs_feel_explains_nothing():
    """A number that the fitted runs hardly feel helps a held-out run by chance."""
    plain = trial(FAR)
    fitted = Fitted((), plain.fitted.point, (np.full(ROWS, 0.99 * FAR),))
    lucky = Trial(Model((), {}), fitted, plain.fitted, plain.squares * 0.01, plain.rows)
    assert explained(plain, lucky) < 0.05 < EXPLAINED_BY_ONE
    assert not repaired(plain, lucky, EXPLAINED_BY_ONE)
