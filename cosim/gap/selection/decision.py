"""From evidence to a verdict: none, named, class, partial, unknown, each at a stated error rate.

The evidence for an effect is a Bayes factor: how much more probable the runs are with it than
without, all other numbers integrated over. Under the model without it, a factor of n / alpha or
more comes up in any of n effects with a probability of at most alpha (Markov's inequality;
Kerridge, Ann. Math. Statist. 34, 1963). Of two effects one is named, if the runs are 1 / alpha
times as probable with it; else they are a class.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from scipy import stats

from cosim.gap.estimation.drive import STIFFNESS_OFFSET
from cosim.gap.evidence.settled import Settled

from .tried import Tried, best_of_effects, by_run, gain

#: Stated error rate of every decision.
LEVEL = 0.05
#: Root mean square, in units of the noise, of what no effect is named for: by so much every model
#: of a contact is wrong, and evidence, which grows with the samples, would take it for something
#: (coarsened evidence, Miller & Dunson, J. Am. Stat. Assoc. 114, 2019).
RESOLUTION = 0.1
#: Standard deviations that a strength must be away from nothing.
STRENGTH = 3.0
#: What is left of a misfit whose law is the catalogue's but for this part of its response is no
#: second effect.
LAW = 0.03
#: Friction that differs by more than this part of it from stretch to stretch is no rig's scatter.
SCATTERS = 0.05
#: Largest root of -2 ln evidence a sample that a true model leaves: a contact is not quite a film.
TAIL = 1.35


def needed(count: int, level: float = LEVEL) -> float:
    """Gain in -2 ln evidence that the best of so many effects must reach."""
    return 2.0 * math.log(max(count, 1) / level)


def unresolved(settled: Settled) -> float:
    """Part of -2 ln evidence that is below the resolution."""
    return RESOLUTION**2 * settled.rows


def resolved(settled: Settled, base: Settled) -> float:
    """Gain in -2 ln evidence over a base, without what may be the shape of a contact.

    What of it comes out of the residuals counts above the resolution; what makes runs and stretches
    alike counts whole.
    """
    shape = max(base.squares - settled.squares, 0.0)
    return gain(settled, base) - min(shape, unresolved(base))


def is_at_large(settled: Settled, base: Settled) -> bool:
    """Whether runs are predicted better by more than the standard error of that, run by run.

    What shows in one of several runs alone is no more than its error. A single run has none.
    """
    gains = by_run(settled, base)
    error = float(np.std(gains, ddof=1)) * math.sqrt(gains.size) if gains.size > 1 else 0.0
    return bool(gains.sum() > error)


def is_there(tried: Tried) -> bool:
    """Whether a law's strength is beyond its error: evidence without it is that of a better fit.

    And whether it is a law, see `is_plain`.
    """
    if is_plain(tried):
        return False
    errors = tried.model.errors
    free = [each for each in tried.candidate.free_parameters if each.is_strength]
    if not free:
        return True
    return any(
        abs(each.scaled(tried.model.values[each.key])) > STRENGTH * errors[each.key]
        for each in free
        if each.key in errors
    )


def is_plain(tried: Tried) -> bool:
    """Whether a law is a plain number by another name, like an ageing within milliseconds.

    Its shape is not surely beyond where it would be.
    """
    values, errors = tried.model.values, tried.model.errors
    return any(
        free.scaled(values[free.key]) - free.scaled(free.low)
        <= STRENGTH * errors.get(free.key, 0.0)
        for free in tried.candidate.free_parameters
        if free.plain_below and free.key in values
    )


def members_of(tried: Sequence[Tried], level: float = LEVEL) -> list[Tried]:
    """The best effect, and those that the runs are not 1 / level times less probable with.

    None, where a plain number by another name does better: the contact is then of another shape.
    """
    settled = [t for t in tried if t.settled is not None]
    effects = best_of_effects([t for t in settled if is_there(t)])
    if not effects:
        return []
    best = effects[0].gain
    if any(t.gain > best and is_plain(t) for t in settled):
        return []
    return [t for t in effects if t.gain > best - needed(1, level)]


def implausible(settled: Settled) -> list[str]:
    """What a model needs that a rig as stated does not have, a line each."""
    lines = []
    shared = {f.key: f for f in settled.problem.shared}
    offsets = [k for k in shared if k.startswith(STIFFNESS_OFFSET)]
    for key in offsets:
        prior = next(f.prior for f in settled.model.free_parameters if f.key == key)
        value = settled.values[key]
        if prior and abs(value) > _far(len(offsets)) * prior:
            lines.append(
                f"springs of a set-up {100 * (math.exp(value) - 1):+.0f} % off what is stated"
            )
    if settled.spreads.friction > 0.2:
        lines.append(
            f"friction that scatters by {100 * settled.spreads.friction:.0f} % from run to run"
        )
    if settled.spreads.stretch > SCATTERS:
        lines.append(
            f"friction that scatters by {100 * settled.spreads.stretch:.0f} % within a run"
        )
    return lines


def _far(count: int) -> float:
    """Standard deviations that the largest of so many exceeds with a probability of LEVEL / 5."""
    return float(stats.norm.isf(0.1 * LEVEL / max(count, 1)))


def is_left(settled: Settled) -> bool:
    """Whether so much more than noise is left that the model is not the rig's."""
    return settled.evidence > TAIL**2 * settled.rows


def is_noise(settled: Settled) -> bool:
    """Whether nothing is left for another effect."""
    return not implausible(settled) and settled.evidence <= settled.rows + unresolved(settled)
