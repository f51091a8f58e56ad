"""The whole catalogue tried on a campaign, on top of what is already in the model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from stickslip.effects.candidate import Candidate

from cosim.gap.candidates.extend import extended, reduced
from cosim.gap.estimation.fit import fit
from cosim.gap.estimation.fitted import Fitted, Point, own_of, shared_of
from cosim.gap.estimation.preparation import Data
from cosim.gap.estimation.problem import Problem
from cosim.gap.estimation.trial import Model, coarse_fit, finished, try_model
from cosim.processes import Map

from .alternatives import other_laws, other_starts
from .score_test import score_test
from .screening import ALONE, ANEW, BESIDE, COARSE, FORMS, STARTING, Progress, Screening
from .tried import Tried, best_laws, penalised

#: So many laws are fitted in long segments.
FINALISTS = 5
#: Rounds in long segments before the best few, so many, are fitted to the end.
FIRST, FINISHED = 6, 2
#: Laws of one effect that set out again, by other values or other laws, and go to long segments.
AGAIN = 3


class Search:
    """Tries candidates on top of base models, as ``mapped`` does it."""

    def __init__(self, data: Data, mapped: Map, progress: Progress | None = None):
        self.data, self.screening = data, Screening(data, mapped, progress)
        self._run = self.screening.run

    def on(self, base: Model, fitted: Fitted, candidates: Sequence[Candidate]) -> list[Tried]:
        """The best law of each effect, best effect first; finalists have a trial.

        fitted : the base in short segments.
        """
        coarse_fits, seen = self.screening.coarse_fits(base, fitted, candidates, ALONE)
        done = self._tried(best_laws(coarse_fits, FORMS)[:FINALISTS])
        effects = {t.candidate.effect for t in done}
        rest = [t for t in best_laws([*coarse_fits, *seen], 1) if t.candidate.effect not in effects]
        return done + rest

    def beside(self, base: Model, fitted: Fitted, candidates: Sequence[Candidate]) -> list[Tried]:
        """The best laws beside an effect that is in the base, in short segments, best first."""
        coarse_fits, _ = self.screening.coarse_fits(base, fitted, candidates, BESIDE)
        return best_laws(coarse_fits, FORMS)

    def masking_pair(
        self, base: Model, fitted: Fitted, candidates: Sequence[Candidate]
    ) -> tuple[Candidate, Tried] | None:
        """Two laws that do much together and little alone: one, and the other on top of it."""
        laws = [c for c in candidates if c.free_parameters and not c.periodic]
        with_derivatives = self.screening.linearised(base, fitted, ())[()]
        two = score_test(
            self.data.short, base, with_derivatives, laws, self.screening.mapped
        ).masking_pair()
        if two is None:
            return None
        model = extended(extended(base, two[0], fitted.values), two[1], {})
        second = Tried(two[1], model, fitted)
        return two[0], self._run(_coarse, [(self.data, second)])[0]

    def together(self, pairs: Sequence[tuple[Tried, Tried]]) -> list[tuple[Tried, Tried]]:
        """Second effects on top of first ones in long segments; the best few to the end."""
        seconds = [second for _, second in pairs]
        trials = self._run(try_model, [(self.data, t.model, t.coarse, FIRST) for t in seconds])
        best = sorted(range(len(pairs)), key=lambda i: trials[i].rms_residual)[:FINISHED]
        ended = self._run(finished, [(self.data, trials[i]) for i in best])
        trials = [ended[best.index(i)] if i in best else trial for i, trial in enumerate(trials)]
        return [
            (first, replace(second, judged=trial))
            for (first, second), trial in zip(pairs, trials, strict=True)
        ]

    def instead(
        self, second: Tried, law: Candidate, candidates: Sequence[Candidate], keep: Sequence[str]
    ) -> list[Tried]:
        """The best law of each effect in place of one of a pair, in long segments, best first.

        second : the pair's second effect on top of the first, with a trial; law : that of either;
        keep : settings of that law that the other needs
        """
        values = second.trial.fitted.values
        rest = reduced(second.model, law, values, keep)
        tried = [Tried(c, extended(rest, c, values), second.coarse) for c in candidates]
        return self._tried(best_laws(self._run(_coarse, [(self.data, t) for t in tried]), 1))

    def less(self, tried: Tried, dropped: Candidate, keep: Sequence[str]) -> Tried:
        """A trial's model without an effect, fitted to the end from where the trial ended.

        keep : settings of the dropped effect that others need
        """
        model = reduced(tried.model, dropped, tried.trial.fitted.values, keep)
        (again,) = self._run(_coarse, [(self.data, replace(tried, model=model))])
        (trial,) = self._run(try_model, [(self.data, model, again.coarse)])
        return replace(again, judged=trial)

    def anew(self, second: Tried, law: Candidate, candidates: Sequence[Candidate]) -> Tried | None:
        """The best law of a periodic effect of a pair, its period looked for beside the other.

        second : the pair's second effect on top of the first; law : that of either that is dropped
        """
        fitted = second.coarse
        model = reduced(second.model, law, fitted.values, ())
        (rest,) = self._run(_left, [(self.data, model, fitted)])
        laws = [c for c in candidates if c.effect == law.effect]
        coarse_fits, _ = self.screening.coarse_fits(model, rest, laws, ANEW)
        return min(coarse_fits, key=lambda t: penalised(t.coarse), default=None)

    def polished(self, tried: Sequence[Tried], candidates: Sequence[Candidate]) -> list[Tried]:
        """Trials once more, from several values of mu_s and by the effect's other laws, best first.

        Where nothing sticks in most segments, a fit may have left mu_s in a place that the motion
        does not feel, and an effect unrecognised for it. A law with one number more finds its way
        from where the simpler one ended.
        """
        again = [
            replace(t, model=model)
            for i, t in enumerate(tried)
            if all(t.model is not other.model for other in tried[:i])
            for model in other_starts(t.model, t.trial.fitted.values)
        ]
        again += [law for t in tried for law in other_laws(t, candidates)]
        again = best_laws(self._run(_coarse, [(self.data, t) for t in again]), AGAIN)
        return best_laws([*tried, *self._tried(again)], 1, lambda t: t.trial.rms_residual)

    def judged(self, tried: Sequence[Tried]) -> tuple[Tried, ...]:
        """Those that were ruled out early judged as well, by what little fit they had."""
        early = [t for t in tried if t.judged is None]
        trials = self._run(try_model, [(self.data, t.model, t.coarse, 0) for t in early])
        late = [replace(t, judged=trial) for t, trial in zip(early, trials, strict=True)]
        late.sort(key=lambda t: t.trial.rms_residual)
        return (*(t for t in tried if t.judged is not None), *late)

    def _tried(self, coarse: Sequence[Tried]) -> list[Tried]:
        """The best law of each effect in long segments, best first; the best few to the end."""
        trials = self._run(try_model, [(self.data, t.model, t.coarse, FIRST) for t in coarse])
        done = [replace(t, judged=trial) for t, trial in zip(coarse, trials, strict=True)]
        done = best_laws(done, 1, lambda t: t.trial.rms_residual)
        trials = self._run(finished, [(self.data, t.trial) for t in done[:FINISHED]])
        ended = [replace(t, judged=trial) for t, trial in zip(done, trials, strict=False)]
        return sorted([*ended, *done[FINISHED:]], key=lambda t: t.trial.rms_residual)


def _coarse(data: Data, tried: Tried) -> Tried:
    return replace(tried, coarse=coarse_fit(data, tried.model, COARSE))


def _left(data: Data, model: Model, fitted: Fitted) -> Fitted:
    """A model where one with more was fitted; the segments' states alone make up for it."""
    kept = {free.key for free in model.free_parameters}
    shared = [free.key in kept for free in shared_of(fitted.free_parameters)]
    own = [free.key in kept for free in own_of(fitted.free_parameters)]
    point = Point(
        fitted.point.shared[shared], tuple(o[own] for o in fitted.point.own), fitted.point.states
    )
    return fit(
        Problem(data.short, model.free_parameters, model.settings), point, STARTING, fixed=True
    )
