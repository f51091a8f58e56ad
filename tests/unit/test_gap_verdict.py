"""From trials to a verdict, by trials whose gaps are made up."""

from dataclasses import dataclass, field, replace

import numpy as np
import pytest
from stickslip.effects.candidate import Candidate, FreeParameter

from cosim.gap.naming.measures import (
    ALIKE,
    ALIKE_PART,
    DRIFT,
    EXPLAINED_AT_LEAST,
    EXPLAINED_BY_ONE,
    EXPLAINED_BY_TWO,
    FITS,
    HOLDS,
    PART_OF_OTHERS,
    PLAIN_FITS,
    alike,
    excess,
    explained,
    repaired,
)
from cosim.gap.naming.pairs import DOMINANT, HARDLY, NEEDED
from cosim.gap.naming.refined_pair import MOST, NEARLY
from cosim.gap.naming.tried import Tried
from cosim.gap.naming.verdict import ALL, DOES_MOST, RIVAL, SEEN, WAVE, judge
from cosim.gap.shooting.fitted import Fitted, Point
from cosim.gap.shooting.flight import TILT
from cosim.gap.shooting.trial import Model, Trial

ROWS = 1000
FAR = 10.0
#: A little beyond, or within, a threshold.
MORE, LESS = 1.01, 0.99
ACROSS = {f"{PART_OF_OTHERS}.ratio": 1.0}


def trial(gap, settings=None):
    """Of a model that leaves so many units of the noise, in one fitted and one held-out run."""
    fitted = Fitted((), Point(np.zeros(0), (), ()), (np.full(ROWS, gap),))
    squares = np.full(2, ROWS * gap**2)
    return Trial(Model((), settings or {}), fitted, fitted, squares, np.full(2, ROWS))


def after(part, before=FAR):
    """A trial that has taken away a part of what a gap of `before` has over the noise."""
    return trial(np.sqrt(1.0 + (1.0 - part) * (before**2 - 1.0)))


def tried(effect, at, settings=None):
    """An effect with a trial, or a gap; None: ruled out by a shorter look."""
    at = trial(at, settings) if isinstance(at, float | int) else at
    model = Model((), settings or {})
    sketched = SKETCHED if at is None else at.fitted
    return Tried(Candidate(effect, "law", (), settings or {}), model, sketched, at)


SKETCHED = trial(FAR).fitted


@dataclass
class MadeUp:
    """Answers as `Search` does: what was made up for the plain model, or on top of an effect.

    second : effect -> trials on top of it; without : effect -> gap of a pair without it;
    across : gap of a pair of which only the friction across is left of one effect; hidden : two
    effects that conceal one another, the second tried on top of the first; lookalike : gap of what
    is not in the catalogue; doubles : trials of what may take a second one's place; once_more :
    effect -> what is found for it when its period is looked for anew beside the other
    """

    first: list
    second: dict = field(default_factory=dict)
    polish: list = field(default_factory=list)
    without: dict = field(default_factory=dict)
    across: float = FAR
    asked: list = field(default_factory=list)
    hidden: tuple | None = None
    lookalike: float = FAR
    doubles: list = field(default_factory=list)
    once_more: dict = field(default_factory=dict)

    def concealed(self, base, fitted, candidates):
        return self.hidden

    def on(self, base, fitted, candidates):
        if any(
            TILT in {free_parameter.key for free_parameter in c.free_parameters} for c in candidates
        ):
            return [replace(tried("", self.lookalike), candidate=candidates[0])]
        done = [t for t in self.first if t.trial is not None]
        rest = [t for t in self.first if t.trial is None]
        return sorted(done, key=lambda t: t.trial.gap) + rest

    def beside(self, base, fitted, candidates):
        on_top = {
            id(t.model): self.second.get(t.candidate.effect, [])
            for t in [*self.first, *self.polish]
        }
        offered = {c.effect for c in candidates}
        self.asked.append(offered)
        found = [t for t in on_top.get(id(base), []) if t.candidate.effect in offered]
        return sorted(found, key=lambda t: t.trial.gap)

    def together(self, pairs):
        return list(pairs)

    def instead(self, second, law, candidates, keep):
        offered = {c.effect for c in candidates}
        return [t for t in self.doubles if t.candidate.effect in offered]

    def anew(self, second, law, candidates):
        self.asked.append(law.effect)
        return self.once_more.get(law.effect)

    def less(self, whole, dropped, keep):
        across = any(key in dropped.settings for key in keep)
        return tried("", self.across if across else self.without.get(dropped.effect, FAR))

    def polished(self, chosen, candidates):
        better = {t.candidate.effect: t for t in self.polish}
        return sorted(
            (better.get(t.candidate.effect, t) for t in chosen), key=lambda t: t.trial.gap
        )


def finding(first, plain=FAR, sketched=SKETCHED, **more):
    search = MadeUp(first, **more)
    candidates = [t.candidate for t in first]
    return judge(search, trial(plain), sketched, candidates), search


def test_measures():
    assert excess(trial(2.0)) == pytest.approx(3.0) and excess(trial(0.9)) == 0.0
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
    assert found.nearest.gap == pytest.approx(LESS * PLAIN_FITS)
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
    first[0] = replace(first[0], trial=after(part, hardly))
    assert finding(first[:1], plain=hardly)[0].verdict == "none"


def test_one_effect_is_named():
    found, _ = finding([tried("run_in", 5.0), tried("film_drag", 1.02), tried("speed_ripple", 7.0)])
    assert (found.verdict, found.effects) == ("named", ("film_drag",))
    assert found.chosen.gap == found.nearest.gap == pytest.approx(1.02)
    order = [t.candidate.effect for t in found.ranking]
    assert order == ["film_drag", "run_in", "speed_ripple"]


def test_effects_that_do_as_well_are_a_class():
    most = np.sqrt(1.02**2 + LESS * ALIKE)
    first = [tried("structural_damping", most), tried("film_drag", 1.02), tried("run_in", 5.0)]
    found, _ = finding(first)
    assert (found.verdict, found.effects) == ("class", ("film_drag", "structural_damping"))
    assert found.chosen.gap == pytest.approx(1.02)  # the member that fits best


def test_effects_are_told_apart_by_more_than_their_fit_s_own_misfit():
    best = trial(1.4)
    allowed = ALIKE + ALIKE_PART * excess(best)
    for part, members in ((LESS, 2), (MORE, 1)):
        other = trial(np.sqrt(best.gap**2 + part * allowed))
        assert len(alike([tried("film_drag", best), tried("run_in", other)])) == members


def test_friction_across_alone_is_named_when_others_add_nothing_to_it():
    with_it = tried("turning_surface", 1.0, ACROSS)
    without = tried("spring_misalignment", 1.0)
    alone = tried(PART_OF_OTHERS, 1.01, ACROSS)
    assert alike([with_it, alone]) == (PART_OF_OTHERS,)
    assert alike([with_it, without]) == ("turning_surface", "spring_misalignment")
    # one that does as well without any friction across is a member
    assert set(alike([with_it, alone, without])) == {PART_OF_OTHERS, "spring_misalignment"}
    # what friction across alone does not repair is for the others
    far = tried(PART_OF_OTHERS, 5.0, ACROSS)
    assert alike([with_it, far]) == ("turning_surface",)


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
    assert found.chosen.gap == pytest.approx(1.01)


def test_friction_across_stands_for_one_effect_that_adds_nothing_to_it():
    """Tried alone it may have ended elsewhere; from where the best one ended it does as well."""
    first = [
        tried("turning_surface", 1.01, ACROSS),
        tried("spring_misalignment", 1.02, ACROSS),
        tried(PART_OF_OTHERS, 2.0, ACROSS),
    ]
    found, _ = finding(first, across=1.02)
    assert (found.verdict, found.effects) == ("named", (PART_OF_OTHERS,))
    assert found.chosen.gap == pytest.approx(1.02)
    names = [t.candidate.effect for t in found.ranking]
    assert names == [PART_OF_OTHERS, "turning_surface", "spring_misalignment"]


@pytest.mark.parametrize(
    "effect, gap, verdict",
    [
        ("spring_misalignment", 1.02, "unknown"),
        ("spring_misalignment", 1.2, "named"),
        ("film_drag", 1.02, "named"),
    ],
)  # nothing else looks like that
def test_what_looks_like_an_effect_and_does_better_is_said(effect, gap, verdict):
    found, _ = finding([tried(effect, 1.21)], lookalike=gap)
    assert (found.verdict, found.nearest.gap) == (verdict, pytest.approx(1.21))
    assert found.lookalike == ("a rig tilted sideways" if verdict == "unknown" else "")


def test_an_effect_tried_once_more_counts_as_it_then_fits():
    first = [tried("film_drag", 3.0), tried("run_in", 5.0)]
    found, _ = finding(first, polish=[tried("run_in", 1.02)])
    assert (found.verdict, found.effects) == ("named", ("run_in",))
    assert [t.candidate.effect for t in found.ranking] == ["run_in", "film_drag"]
    assert len(found.ranking) == 2


def test_effects_that_were_ruled_out_early_are_ranked_last():
    found, _ = finding([tried("film_drag", 5.0), tried("run_in", None), tried("speed_ripple", 2.0)])
    assert [t.candidate.effect for t in found.ranking] == ["speed_ripple", "film_drag", "run_in"]


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
    assert found.chosen.gap == pytest.approx(1.02)
    for offered in search.asked:  # a second one is another one
        assert len(offered) == 2


def test_two_effects_that_conceal_one_another_are_named():
    """Neither does anything alone; where both do all in short windows, no others are tried."""
    first = [tried("speed_ripple", after(0.1)), tried("run_in", after(0.05))]
    both = tried("thermal_weakening", 1.02)
    hidden = (tried("film_drag", FAR).candidate, both)
    found, search = finding(first, hidden=hidden, second={"speed_ripple": [tried("run_in", 3.0)]})
    assert (found.verdict, found.effects) == ("named", ("film_drag", "thermal_weakening"))
    assert found.chosen.gap == pytest.approx(1.02) and not search.asked


@pytest.mark.parametrize(
    "left, verdict",
    [(LESS * HARDLY, ("film_drag", "run_in")), (MORE * HARDLY, ("speed_ripple", "run_in"))],
)
def test_a_pair_that_leaves_more_than_noise_may_have_a_double_for_its_first(left, verdict):
    """Its second does as well on top of another first, and leaves less there."""
    first = [
        tried("film_drag", after(0.6, 100.0)),
        tried("speed_ripple", after(0.5, 100.0)),
        tried("run_in", after(0.0, 100.0)),
    ]
    far = trial(100.0).fitted
    second = {"film_drag": [tried("run_in", left)], "speed_ripple": [tried("run_in", 1.0)]}
    found, _ = finding(first, plain=100.0, sketched=far, second=second)
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
    search = {"second": {"film_drag": [pair]}, "doubles": [tried("turning_surface", 1.0)]}
    found, _ = finding(first, plain=100.0, **search)
    assert (found.verdict, found.effects) == ("named", ("film_drag", second))


def test_an_effect_beside_one_that_moves_the_block_off_its_line_is_kept_for_its_doubles():
    first = [
        tried("lateral_friction", after(0.6, 100.0)),
        tried("run_in", after(0.5, 100.0)),
        tried("turning_surface", after(0.0, 100.0)),
    ]
    for i in (0, 2):
        first[i] = replace(first[i], candidate=replace(first[i].candidate, lateral=True))
    search = {
        "second": {"lateral_friction": [tried("run_in", MORE * PLAIN_FITS)]},
        "doubles": [tried("turning_surface", 1.0)],
    }
    found, _ = finding(first, plain=100.0, **search)
    assert (found.verdict, found.effects) == ("named", ("run_in", "turning_surface"))


@pytest.mark.parametrize("part, effects", [(MORE, ("film_drag", "speed_ripple")), (LESS, ())])
def test_a_period_that_was_found_beside_nothing_is_looked_for_beside_the_other(part, effects):
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


def test_a_pair_that_fits_in_short_windows_is_fitted_more_closely():
    """Long ones may have led its laws astray."""
    first = [tried("film_drag", after(0.4)), tried("run_in", after(0.3))]
    astray = after(LESS * NEARLY)
    for short, effects in ((PLAIN_FITS, ("film_drag", "run_in")), (MORE * PLAIN_FITS, ())):
        pair = replace(tried("run_in", astray), sketched=trial(short).fitted)
        found, _ = finding(first, second={"film_drag": [pair]}, polish=[tried("run_in", 1.02)])
        assert found.effects == effects


def ended(at, time):
    """A trial whose law has a time that ended here; at 0.03 s it is a plain number."""
    free_parameter = FreeParameter(
        "static_strengthening.saturation_time", 0.1, 0.5, 0.03, 30.0, log=True, plain_below=True
    )
    fitted = Fitted(
        (free_parameter,),
        Point(np.array([free_parameter.scaled(time)]), (), ()),
        (np.full(ROWS, at),),
    )
    return replace(trial(at), model=Model((free_parameter,), {}), fitted=fitted)


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
    assert most.gap > FITS and repaired(trial(FAR), most, EXPLAINED_BY_ONE)
    first = [tried("run_in", most), tried("static_strengthening", after(0.1))]
    second = {"run_in": [tried("static_strengthening", ended(1.02, time))]}
    found, _ = finding(first, second=second)
    assert found.verdict == verdict
    assert found.nearest.gap == pytest.approx(1.02)


def test_two_effects_must_take_away_so_much():
    parts = [1.0 - factor * (1.0 - EXPLAINED_BY_TWO) for factor in (LESS, MORE)]
    verdicts = []
    for part in parts:
        first = [tried("film_drag", after(0.6, 100.0)), tried("run_in", after(0.5, 100.0))]
        pair = tried("run_in", after(part, 100.0))
        verdicts.append(finding(first, plain=100.0, second={"film_drag": [pair]})[0].verdict)
    assert verdicts == ["named", "unknown"]


@pytest.mark.parametrize("part, second", [(LESS, PART_OF_OTHERS), (MORE, "turning_surface")])
def test_friction_across_stands_for_what_brings_it_along_if_it_does_as_well(part, second):
    pair = trial(1.02)
    gap = np.sqrt(1.02**2 + part * (ALIKE + ALIKE_PART * excess(pair)))
    first = [
        tried("film_drag", after(0.6)),
        tried("turning_surface", after(0.5), ACROSS),
        tried(PART_OF_OTHERS, after(0.1), ACROSS),
    ]
    both = [tried("turning_surface", pair, ACROSS)]
    found, _ = finding(first, second={"film_drag": both}, across=gap)
    assert (found.verdict, found.effects) == ("named", ("film_drag", second))


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
    pair = trial(np.sqrt(1.0 + factor * (1.0 - NEEDED) * excess(alone)))
    first = [tried("film_drag", alone), tried("run_in", after(0.3, plain))]
    found, _ = finding(
        first,
        plain=plain,
        second={"film_drag": [tried("run_in", pair)]},
        without={"run_in": alone.gap, "film_drag": 0.9 * plain},
    )
    assert (found.verdict, found.effects) == ("named", effects)


def test_an_effect_that_leaves_noise_once_it_sets_out_from_the_pair_needs_no_other():
    first = [tried("film_drag", after(0.5)), tried("run_in", after(0.3))]
    found, _ = finding(
        first, second={"film_drag": [tried("run_in", 0.997)]}, without={"run_in": 1.003}
    )
    assert (found.verdict, found.effects) == ("named", ("film_drag",))


def test_beside_an_effect_that_explains_all_no_other_is_looked_for():
    first = [tried("film_drag", after(1.0 - LESS * (1.0 - ALL), 100.0))]
    assert first[0].trial.gap > FITS
    second = {"film_drag": [tried("run_in", 1.0)]}
    found, search = finding(first, plain=100.0, second=second)
    assert (found.verdict, found.effects) == ("named", ("film_drag",))
    assert not search.asked


def test_one_effect_that_dominates_is_named_though_something_is_left():
    strong = 0.5 * (DOES_MOST + EXPLAINED_BY_ONE)
    plain = 30.0
    first = [
        tried("film_drag", after(strong, plain)),
        tried("run_in", after(LESS * RIVAL * strong, plain)),
    ]
    found, _ = finding(first, plain=plain)
    assert (found.verdict, found.effects) == ("named", ("film_drag",))
    assert found.chosen.gap == pytest.approx(after(strong, plain).gap)


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
    assert found.nearest.gap == pytest.approx(after(strong, plain).gap)


def test_nothing_helps():
    found, _ = finding([tried("film_drag", FAR), tried("run_in", 1.1 * FAR)])
    assert (found.verdict, found.effects, found.chosen) == ("unknown", (), None)


def test_what_is_nearest_may_be_a_pair():
    pair = after(0.95 * EXPLAINED_BY_TWO)  # twice as much as either alone
    alone = 0.45 * EXPLAINED_BY_TWO
    found, _ = two_effects(pair, one=alone, other=alone)
    assert found.verdict == "unknown" and found.nearest.gap == pytest.approx(pair.gap)


def test_a_pair_whose_better_half_does_it_alone_is_no_pair():
    """A good effect on top of a poor one does well: the poor one has no part in it."""
    strong = 0.5 * (DOMINANT + EXPLAINED_BY_ONE)
    good, poor = tried("run_in", after(strong)), tried("film_drag", after(MORE * RIVAL * strong))
    pair = after(1.0 - (1.0 - strong) * MORE * (1.0 - NEEDED))
    assert repaired(trial(FAR), pair, EXPLAINED_BY_TWO)
    found, _ = finding([good, poor], second={"film_drag": [tried("run_in", pair)]})
    assert found.verdict == "unknown" and found.nearest.gap == pytest.approx(good.trial.gap)


def test_a_little_that_nothing_explains_is_nothing():
    """Between what fits and what is repaired, an effect has a name for nearly all of it."""
    between = 0.5 * (PLAIN_FITS + FITS)
    weak = after(LESS * EXPLAINED_AT_LEAST, between)
    assert weak.gap < FITS
    found, _ = finding([tried("film_drag", weak)], plain=between)
    assert (found.verdict, found.effects) == ("none", ())
    found, _ = finding(
        [tried("film_drag", after(MORE * EXPLAINED_AT_LEAST, between))], plain=between
    )
    assert (found.verdict, found.effects) == ("named", ("film_drag",))


def test_what_remains_may_be_noise_and_yet_most_of_what_was():
    before = MORE * FITS
    most, least = (after(part * EXPLAINED_AT_LEAST, before) for part in (LESS, MORE))
    assert most.gap < FITS
    assert not repaired(trial(before), most, EXPLAINED_BY_ONE)
    assert repaired(trial(before), least, EXPLAINED_BY_ONE)


def test_what_only_long_flights_show_may_be_drift():
    short, plain = trial(LESS * PLAIN_FITS).fitted, LESS * DRIFT
    weak = [tried("film_drag", after(LESS * EXPLAINED_AT_LEAST, plain))]
    assert finding(weak, plain=plain, sketched=short)[0].verdict == "none"
    assert finding(weak, plain=plain)[0].verdict == "unknown"  # short ones show it as well
    assert finding(weak, plain=MORE * DRIFT, sketched=short)[0].verdict == "unknown"
    strong = [tried("film_drag", after(MORE * EXPLAINED_AT_LEAST, plain))]
    assert finding(strong, plain=plain, sketched=short)[0].effects == ("film_drag",)


def test_what_only_held_out_runs_feel_explains_nothing():
    """A number that the fitted runs hardly feel helps a held-out run by chance."""
    plain = trial(FAR)
    fitted = Fitted((), plain.fitted.point, (np.full(ROWS, 0.99 * FAR),))
    lucky = Trial(Model((), {}), fitted, plain.fitted, plain.squares * 0.01, plain.rows)
    assert explained(plain, lucky) < 0.05 < EXPLAINED_BY_ONE
    assert not repaired(plain, lucky, EXPLAINED_BY_ONE)
