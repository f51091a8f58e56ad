"""What a trial has taken away of the plain model's misfit, and which trials do as well."""

from __future__ import annotations

from collections.abc import Sequence

from cosim.gap.estimation.fitted import Fitted
from cosim.gap.estimation.trial import Trial

from .tried import ACROSS, Tried

#: The plain model fits when its root mean square residual, in units of the noise, is at most this:
#: what a real contact has beside any model (creep before sliding, a tracker's own errors) is worth
#: about three quarters of the noise.
PLAIN_FITS = 1.3
#: A repaired model fits when its root mean square residual is at most this, ...
FITS = 1.5
#: ... or when it has taken away this part of the excess chi-square: the law of a real effect is
#: never quite the catalogue's.
EXPLAINED_BY_ONE, EXPLAINED_BY_TWO = 0.93, 0.92
#: What takes away less than this part has no name, however little remains: what is not in the
#: catalogue may be aliased that far.
EXPLAINED_AT_LEAST = 0.9
#: A law that leaves more than so many times as much of the runs held out as of those fitted is
#: another law than theirs.
HOLDS = 2.5
#: A number that is less than so many times its least has run to the end of its range.
AT_AN_END = 1.02
#: What has taken away less than this part is not fitted more closely, nor is what leaves more than
#: so many times the best one's excess chi-square.
WORTH_A_POLISH, IN_REACH = 0.5, 4.0
#: Where the plain model fits in short segments, what long ones leave up to this may be the drift of
#: a motion that is unstable by itself.
DRIFT = 2.0
#: So many times the part that is gone from the fitted runs may be gone from all.
FELT_BY_FITTED = 2.0
#: Models are indistinguishable when their chi-squares per sample differ by less than this ...
INDISTINGUISHABLE = 0.08
#: ... and this part of what the better one leaves over the noise.
INDISTINGUISHABLE_PART = 0.1
#: Friction across the motion comes with every effect that moves a block off its line.
PART_OF_OTHERS = "lateral_friction"
#: The effect that acts by it.
DRAGS_ASIDE = "turning_surface"


def is_little(plain: Trial, coarse: Fitted) -> bool:
    """Whether what the plain model leaves is next to nothing, or nothing but drift."""
    return plain.rms_residual <= FITS or (
        plain.rms_residual <= DRIFT and coarse.rms_residual() <= PLAIN_FITS
    )


def repaired(plain: Trial, trial: Trial, part: float) -> bool:
    """Whether next to nothing of what there was is left: this part is gone, or noise remains.

    Also of what was held out, and by what is more than plain numbers by another name.
    """
    if not stands(trial):
        return False
    share = explained(plain, trial)
    return share >= part or (
        share >= EXPLAINED_AT_LEAST and excess_chi_square(trial) <= FITS**2 - 1.0
    )


def stands(trial: Trial) -> bool:
    """Whether an effect is one at all: true of the runs held out too, and no plain number."""
    return trial.held_out_rms <= HOLDS * max(trial.fitted.rms_residual(), 1.0) and not is_plain(
        trial
    )


def is_plain(trial: Trial) -> bool:
    """Whether a number of the effect has run to where it is a plain one by another name."""
    values = trial.fitted.values
    return any(
        values[free.key] <= AT_AN_END * free.low
        for free in trial.model.free_parameters
        if free.plain_below
    )


def in_reach(done: Sequence[Tried]) -> list[Tried]:
    """Those that might do as well as the best one if they were fitted more closely."""
    return [
        t for t in done if excess_chi_square(t.trial) <= IN_REACH * excess_chi_square(done[0].trial)
    ]


def explained(plain: Trial, trial: Trial) -> float:
    """Part of the plain model's excess chi-square that is gone from all runs.

    It counts no more than so many times what is gone from those fitted: a number that they hardly
    feel may happen to help a run that was held out.
    """
    of_all = gone(plain.rms_residual, trial.rms_residual)
    if plain.fitted.rms_residual() <= PLAIN_FITS:
        return of_all
    return min(
        of_all, FELT_BY_FITTED * gone(plain.fitted.rms_residual(), trial.fitted.rms_residual())
    )


def gone(before: float, after: float) -> float:
    """Part of the excess chi-square that is gone, from root mean square residuals."""
    return 1.0 - max(after**2 - 1.0, 0.0) / (before**2 - 1.0) if before > 1.0 else 0.0


def excess_chi_square(trial: Trial) -> float:
    """Chi-square per sample less 1, that of the noise; 0 where it is less."""
    return max(trial.rms_residual**2 - 1.0, 0.0)


def indistinguishable(done: Sequence[Tried]) -> tuple[str, ...]:
    """The effects that repair the model as well as the best one does."""
    best = done[0].trial
    members = tuple(t.candidate.effect for t in done if t.trial.rms_residual**2 <= as_good(best))
    if PART_OF_OTHERS in members:  # then what the others add to it is of no use
        has_it = {t.candidate.effect for t in done if ACROSS in t.model.settings}
        members = tuple(m for m in members if m == PART_OF_OTHERS or m not in has_it)
    return members


def as_good(best: Trial) -> float:
    """Chi-square per sample that is as good as the best one's."""
    return (
        best.rms_residual**2 + INDISTINGUISHABLE + INDISTINGUISHABLE_PART * excess_chi_square(best)
    )


def telling(done: Sequence[Tried]) -> list[Tried]:
    """Those that add something to the friction across that they bring along, in short segments."""
    across = next((t for t in done if t.candidate.effect == PART_OF_OTHERS), None)
    return [t for t in done if across is None or t is across or not _adds_nothing(t, across)]


def _adds_nothing(tried: Tried, across: Tried) -> bool:
    left = tried.coarse.rms_residual() ** 2
    as_well = left + INDISTINGUISHABLE + INDISTINGUISHABLE_PART * max(left - 1.0, 0.0)
    return ACROSS in tried.candidate.settings and across.coarse.rms_residual() ** 2 <= as_well
