"""From evidence to a verdict: what an effect must show, alone and beside others; what is left.

The models are stand-ins that say how probable they make the runs: what a verdict goes by.
"""

from dataclasses import dataclass, field, replace
from types import SimpleNamespace

import numpy as np
import pytest
from settled_campaigns import strength
from stickslip.effects.candidate import Candidate, FreeParameter

from cosim.gap.evidence.products import Spreads
from cosim.gap.selection.decision import (
    LEVEL,
    implausible,
    is_at_large,
    members_of,
    needed,
    resolved,
)
from cosim.gap.selection.tried import Tried
from cosim.gap.selection.verdict import Rung, bends, concluded

ROWS = 10_000
LINEAR = Candidate("velocity_weakening", "linear", (strength("velocity_weakening.linear", 1, 1),))
BENT = Candidate(
    "velocity_weakening", "hyperbolic", (strength("velocity_weakening.hyperbolic", 1, 1),)
)
DRAG = Candidate("film_drag", "linear", (strength("film_drag.coefficient", 1, 1),))
STIFF = "offset.stiffness_0"


@dataclass
class StandIn:
    """As much of a settled model as a verdict looks at; values in steps of 1, errors of 0.1."""

    evidence: float
    values: dict = field(default_factory=dict)
    spreads: Spreads = field(default_factory=lambda: Spreads(0.01, 0.0, 0.0, 0.1, 0.0))
    squares: float = ROWS
    rows: int = ROWS
    free: tuple = ()
    settings: dict = field(default_factory=dict)
    by_run: tuple = (0.25, 0.25, 0.25, 0.25)

    @property
    def errors(self):
        return dict.fromkeys(self.values, 0.1)

    @property
    def left_out(self):
        return self.evidence * np.array(self.by_run)

    @property
    def model(self):
        return SimpleNamespace(free_parameters=self.free, settings=self.settings)

    @property
    def problem(self):
        return SimpleNamespace(shared=self.free)


def tried(law, evidence, base, value=1.0):
    model = StandIn(evidence, {free.key: value for free in law.free_parameters})
    return Tried(law, base.evidence - evidence, model)


def ladder_of(*evidences, members=()):
    names = ("velocity_weakening", "film_drag", "run_in")
    rungs = [Rung((), StandIn(evidences[0]), 0.0)]
    for count, evidence in enumerate(evidences[1:], start=1):
        gain = evidences[count - 1] - evidence
        rungs.append(Rung(names[:count], StandIn(evidence), gain, tuple(members)))
    return rungs


def test_the_best_of_more_effects_needs_more():
    """A factor of n / alpha in favour comes up by chance, of n, with a probability of alpha."""
    assert needed(1) == pytest.approx(2.0 * np.log(1.0 / LEVEL))
    assert needed(20) - needed(1) == pytest.approx(2.0 * np.log(20.0))


def test_as_good_as_the_best_is_one_of_its_class():
    base = StandIn(2.0 * ROWS)
    best, close = tried(LINEAR, ROWS, base), tried(DRAG, ROWS + 0.9 * needed(1), base)
    assert members_of([close, best]) == [best, close]
    far = tried(DRAG, ROWS + 1.1 * needed(1), base)
    assert members_of([best, far]) == [best]


@pytest.mark.parametrize(("time", "named"), [(0.03, False), (0.0333, False), (0.05, True)])
def test_a_law_that_is_a_plain_number_by_another_name_is_none(time, named):
    """Ageing within 30 ms is another mu_s; the time's error is a tenth of its step, 5 %."""
    keys = "static_strengthening.saturating", "static_strengthening.saturation_time"
    shape = FreeParameter(keys[1], 0.5, 0.5, 0.03, 30.0, log=True, plain_below=True)
    law = Candidate("static_strengthening", "saturating", (strength(keys[0], 0.1, 0.1), shape))
    tried = Tried(law, 100.0, StandIn(ROWS, {keys[0]: 0.2, keys[1]: time}))
    assert bool(members_of([tried])) is named
    # what it does better than, then has no name either
    less = Tried(LINEAR, 50.0, StandIn(ROWS, {"velocity_weakening.linear": 1.0}))
    assert [t.candidate for t in members_of([tried, less])] == ([law] if named else [])
    more = replace(less, gain=150.0)
    assert members_of([tried, more])[0] is more


def test_a_strength_within_its_error_of_nothing_is_none():
    base = StandIn(2.0 * ROWS)
    assert not members_of([tried(LINEAR, ROWS, base, value=0.2)])  # two standard deviations


def test_what_may_be_the_shape_of_a_contact_does_not_count():
    """A tenth of the noise in the residuals; what makes runs alike counts whole."""
    base, shape = StandIn(1.02 * ROWS, squares=1.02 * ROWS), 0.008 * ROWS
    better = StandIn(base.evidence - shape, squares=base.squares - shape)
    assert resolved(better, base) == pytest.approx(0.0)
    alike = StandIn(base.evidence - shape, squares=base.squares)
    assert resolved(alike, base) == pytest.approx(shape)


@pytest.mark.parametrize(
    "ladder, verdict",
    [
        (ladder_of(ROWS), "none"),
        (ladder_of(3.0 * ROWS), "unknown"),
        (ladder_of(9.0 * ROWS, ROWS), "named"),
        (ladder_of(9.0 * ROWS, 3.0 * ROWS), "partial"),
    ],
)
def test_the_last_rung_is_judged_as_it_stands(ladder, verdict):
    found = concluded(ladder, ())
    assert found.verdict == verdict
    named = ladder[-1].effects if verdict in ("named", "partial") else ()
    assert found.effects == named and found.model is ladder[found.chosen].settled


def test_what_is_left_out_is_worth_a_name_only_where_every_run_gains():
    ladder = ladder_of(9.0 * ROWS, 3.0 * ROWS)
    ladder[1].settled.by_run = (-0.25, 0.25, 0.25, 2.75)
    assert concluded(ladder, ()).verdict == "unknown"


def test_several_that_do_as_well_are_a_class():
    base = StandIn(9.0 * ROWS)
    members = (tried(LINEAR, ROWS, base), tried(DRAG, ROWS + 1.0, base))
    found = concluded(ladder_of(9.0 * ROWS, ROWS, members=members), ())
    assert (found.verdict, found.effects) == ("class", ("velocity_weakening", "film_drag"))


def test_a_rig_is_not_far_from_what_is_said_of_it():
    stated = strength(STIFF, 0.0, 0.01, -1.0, 1.0)
    stated = type(stated)(STIFF, 0.0, 0.01, -1.0, 1.0, prior=0.01)
    near, far = (StandIn(ROWS, {STIFF: value}, free=(stated,)) for value in (0.01, 0.1))
    assert not implausible(near)
    assert implausible(far) == ["springs of a set-up +11 % off what is stated"]
    scattered = StandIn(ROWS, spreads=Spreads(0.3, 0.0, 0.0, 0.1, 0.0))
    assert implausible(scattered) == ["friction that scatters by 30 % from run to run"]


def test_another_form_of_the_same_effect_may_stand_beside_the_first():
    """Nature's law may lie between two of the catalogue's: then no second effect is called for."""
    rung = Rung((LINEAR.effect,), StandIn(ROWS, {"velocity_weakening.linear": 1.0}), 100.0)
    assert bends(BENT, rung) == (BENT,)
    assert not bends(LINEAR, rung) and not bends(DRAG, rung)
    assert not bends(BENT, Rung((), StandIn(ROWS), 0.0))


def test_the_second_harmonic_of_a_wave_may_stand_beside_the_first():
    """In phase with it, and a quarter of a period ahead: either may be all there is."""
    keys = ("surface_pattern.amplitude", "surface_pattern.wavelength")
    second = tuple(
        strength(f"surface_pattern.{part}", 0.0, 0.1, -0.7, 0.7)
        for part in ("second_in_phase", "second_ahead")
    )
    first = tuple(strength(key, 0.1, 0.05) for key in keys)
    wave = Candidate("surface_pattern", "sine", first + second, periodic=keys[1])
    rung = Rung((wave.effect,), StandIn(ROWS, dict.fromkeys(keys, 0.1)), 100.0)
    bent = bends(wave, rung)
    assert [law.free_parameters[0].key for law in bent] == [free.key for free in second]
    assert all(not law.periodic and law.free_parameters[0].start > 0.0 for law in bent)
    assert not bends(Candidate("surface_pattern", "sine", first, periodic=keys[1]), rung)


def test_what_one_run_gains_and_others_lose_is_no_effect_of_all():
    """The sum of the runs' gains must be beyond the error of a sum."""
    base, gains = StandIn(2.0 * ROWS), np.array([17.0, 27.0, -19.0, 9.0, -4.0, -4.0])
    base.by_run = np.full(6, 1.0 / 6.0)
    better = StandIn(2.0 * ROWS, by_run=base.by_run - gains / (2.0 * ROWS))
    assert gains.sum() > needed(1) and not is_at_large(better, base)
    better.by_run = base.by_run - np.abs(gains) / (2.0 * ROWS)
    assert is_at_large(better, base)
    alone = np.array([400.0, -5.0, -5.0, -5.0, -5.0, -5.0])  # one run's own
    better.by_run = base.by_run - alone / (2.0 * ROWS)
    assert not is_at_large(better, base)
