"""Trials whose residuals are made up, and a search that answers with them."""

from dataclasses import dataclass, field, replace

import numpy as np
from stickslip.effects.candidate import Candidate

from cosim.gap.estimation.fitted import Fitted, Point
from cosim.gap.estimation.segmented_run import TILT
from cosim.gap.estimation.trial import Model, Trial
from cosim.gap.selection.criteria import PART_OF_OTHERS
from cosim.gap.selection.tried import Tried
from cosim.gap.selection.verdict import judge

ROWS = 1000
FAR = 10.0
#: A little beyond, or within, a level.
MORE, LESS = 1.01, 0.99
ACROSS = {f"{PART_OF_OTHERS}.ratio": 1.0}


def trial(gap, settings=None):
    """Of a model that leaves so many units of the noise, in one fitted and one held-out run."""
    fitted = Fitted((), Point(np.zeros(0), (), ()), (np.full(ROWS, gap),))
    squares = np.full(2, ROWS * gap**2)
    return Trial(Model((), settings or {}), fitted, fitted, squares, np.full(2, ROWS))


#: The plain model in short segments.
FAR_OFF = trial(FAR).fitted


def after(part, before=FAR):
    """A trial that has taken away a part of what a gap of `before` has over the noise."""
    return trial(np.sqrt(1.0 + (1.0 - part) * (before**2 - 1.0)))


def tried(effect, at, settings=None):
    """An effect with a trial, or a gap; None: ruled out by its coarse fit."""
    at = trial(at, settings) if isinstance(at, float | int) else at
    model = Model((), settings or {})
    coarse = FAR_OFF if at is None else at.fitted
    return Tried(Candidate(effect, "law", (), settings or {}), model, coarse, at)


@dataclass
class MadeUp:
    """Answers as `Search` does: what was made up for the plain model, or on top of an effect.

    second : effect -> trials on top of it; without : effect -> gap of a pair without it;
    across : gap of a pair of which only the friction across is left of one effect; hidden : two
    effects that mask one another, the second tried on top of the first; confounder : gap of what
    is not in the catalogue; aliases : trials of what may take a second one's place; once_more :
    effect -> what is found for it when its period is searched for anew beside the other
    """

    first: list
    second: dict = field(default_factory=dict)
    polish: list = field(default_factory=list)
    without: dict = field(default_factory=dict)
    across: float = FAR
    asked: list = field(default_factory=list)
    hidden: tuple | None = None
    confounder: float = FAR
    aliases: list = field(default_factory=list)
    once_more: dict = field(default_factory=dict)

    def masking_pair(self, base, fitted, candidates):
        return self.hidden

    def on(self, base, fitted, candidates):
        if any(TILT in {free.key for free in c.free_parameters} for c in candidates):
            return [replace(tried("", self.confounder), candidate=candidates[0])]
        done = [t for t in self.first if t.judged is not None]
        rest = [t for t in self.first if t.judged is None]
        return sorted(done, key=lambda t: t.trial.rms_residual) + rest

    def beside(self, base, fitted, candidates):
        on_top = {
            id(t.model): self.second.get(t.candidate.effect, [])
            for t in [*self.first, *self.polish]
        }
        offered = {c.effect for c in candidates}
        self.asked.append(offered)
        found = [t for t in on_top.get(id(base), []) if t.candidate.effect in offered]
        return sorted(found, key=lambda t: t.trial.rms_residual)

    def together(self, pairs):
        return list(pairs)

    def instead(self, second, law, candidates, keep):
        offered = {c.effect for c in candidates}
        return [t for t in self.aliases if t.candidate.effect in offered]

    def anew(self, second, law, candidates):
        self.asked.append(law.effect)
        return self.once_more.get(law.effect)

    def less(self, whole, dropped, keep):
        across = any(key in dropped.settings for key in keep)
        return tried("", self.across if across else self.without.get(dropped.effect, FAR))

    def polished(self, chosen, candidates):
        better = {t.candidate.effect: t for t in self.polish}
        return sorted(
            (better.get(t.candidate.effect, t) for t in chosen), key=lambda t: t.trial.rms_residual
        )


def finding(first, plain=FAR, coarse=FAR_OFF, **more):
    search = MadeUp(first, **more)
    candidates = [t.candidate for t in first]
    return judge(search, trial(plain), coarse, candidates), search
