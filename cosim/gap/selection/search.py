"""The whole catalogue tried on a campaign, on top of what is already in the model."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from cosim.gap.candidates.candidate import Candidate
from cosim.gap.candidates.extend import extended, reduced
from cosim.gap.estimation.fit import fit
from cosim.gap.estimation.fitted import Fitted, Point
from cosim.gap.estimation.preparation import Data
from cosim.gap.estimation.problem import Problem
from cosim.gap.estimation.screening import linearised, screening_fit
from cosim.gap.estimation.trial import Model, coarse_fit, finished, try_model
from cosim.processes import Map

from .alternatives import other_laws, other_starts
from .breadth import ALONE, ANEW, BESIDE, Breadth
from .frequency_response import frequency_response
from .periodogram import NOISE, scan
from .score_test import score_test
from .tried import ACROSS, Tried, best_laws, in_the_running, penalised, rank

#: Rounds of the screening fit at every law, of a look at those that do well in it, of a coarse fit of those
#: that do so again, ...
SCREENING, STARTING, COARSE = 3, 2, 6
#: ... so many are fitted in long segments, at most so many of one effect.
FINALISTS, FORMS = 5, 2
#: Rounds in long segments before the best few, so many, are fitted to the end.
FIRST, FINISHED = 6, 2
#: So many laws set out as next to nothing as well; on top of a first effect no others are tried.
PROMISING = 10
#: Laws of one effect that set out again, by other values or other laws, and go to long segments.
AGAIN = 3

Progress = Callable[[int], object]


class Search:
    """Tries candidates on top of base models, as ``mapped`` does it."""

    def __init__(self, data: Data, mapped: Map, progress: Progress | None = None):
        self.data, self.mapped = data, mapped
        self.progress = progress or (lambda count: None)

    def on(self, base: Model, fitted: Fitted, candidates: Sequence[Candidate]) -> list[Tried]:
        """The best law of each effect, best effect first; finalists have a trial.

        fitted : the base in short segments.
        """
        coarse_fits, seen = self._coarse_fits(base, fitted, candidates, ALONE)
        done = self._tried(best_laws(coarse_fits, FORMS)[:FINALISTS])
        effects = {t.candidate.effect for t in done}
        rest = [t for t in best_laws([*coarse_fits, *seen], 1) if t.candidate.effect not in effects]
        return done + rest

    def beside(self, base: Model, fitted: Fitted, candidates: Sequence[Candidate]) -> list[Tried]:
        """The best laws beside an effect that is in the base, in short segments, best first."""
        coarse_fits, _ = self._coarse_fits(base, fitted, candidates, BESIDE)
        return best_laws(coarse_fits, FORMS)

    def masking_pair(
        self, base: Model, fitted: Fitted, candidates: Sequence[Candidate]
    ) -> tuple[Candidate, Tried] | None:
        """Two laws that do much together and little alone: one, and the other on top of it."""
        laws = [c for c in candidates if c.free_parameters and not c.periodic]
        with_derivatives = self._linearised(base, fitted, ())[()]
        two = score_test(self.data.short, base, with_derivatives, laws, self.mapped).masking_pair()
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
        coarse_fits, _ = self._coarse_fits(model, rest, laws, ANEW)
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

    def _coarse_fits(
        self, base: Model, fitted: Fitted, candidates: Sequence[Candidate], breadth: Breadth
    ) -> tuple[list[Tried], list[Tried]]:
        """The best laws fitted coarsely, at most so many, and all that were looked at for it."""
        seen, unseen = self._screened(base, fitted, candidates, breadth)
        # the best law of every effect: by derivatives of afar a screening fit may miss how well one does
        chosen = sorted(best_laws(seen, FORMS), key=lambda t: rank(t, seen))
        started = self._run(
            _continued, [(self.data, t, STARTING) for t in chosen[: breadth.started]]
        )
        chosen = in_the_running(best_laws(started, FORMS)[: breadth.coarse], fitted)
        coarse_fits = self._run(_continued, [(self.data, t, COARSE - STARTING) for t in chosen])
        return coarse_fits, [*started, *seen, *unseen]

    def _screened(
        self, base: Model, fitted: Fitted, candidates: Sequence[Candidate], breadth: Breadth
    ) -> tuple[list[Tried], list[Tried]]:
        """Every law after a screening fit at it; those whose period is noise, as they set out."""
        linearised_fits = self._linearised(base, fitted, candidates)
        placed, feeble = self._placed(base, linearised_fits[()], candidates, breadth)
        promising = self._promising(base, linearised_fits[()], placed)
        if not breadth.everything:
            placed, feeble = promising, []
        placed = placed + [c.faint() for c in promising if c.can_be_faint]
        laws = [*((c, SCREENING) for c in placed), *((c, 0) for c in feeble)]
        models = [extended(base, c, fitted.values) for c, _ in laws]
        tasks = [
            (self.data, m, linearised_fits[_across(base, c)], rounds)
            for (c, rounds), m in zip(laws, models, strict=True)
        ]
        screened = self._run(screening_fit, tasks)
        tried = [Tried(c, m, g) for (c, _), m, g in zip(laws, models, screened, strict=True)]
        return tried[: len(placed)], tried[len(placed) :]

    def _tried(self, coarse: Sequence[Tried]) -> list[Tried]:
        """The best law of each effect in long segments, best first; the best few to the end."""
        trials = self._run(try_model, [(self.data, t.model, t.coarse, FIRST) for t in coarse])
        done = [replace(t, judged=trial) for t, trial in zip(coarse, trials, strict=True)]
        done = best_laws(done, 1, lambda t: t.trial.rms_residual)
        trials = self._run(finished, [(self.data, t.trial) for t in done[:FINISHED]])
        ended = [replace(t, judged=trial) for t, trial in zip(done, trials, strict=False)]
        return sorted([*ended, *done[FINISHED:]], key=lambda t: t.trial.rms_residual)

    def _linearised(
        self, base: Model, fitted: Fitted, candidates: Sequence[Candidate]
    ) -> dict[tuple, Fitted]:
        """The base with its derivatives, as it is and with the friction across that laws bring."""
        kinds = list(dict.fromkeys([(), *(_across(base, c) for c in candidates)]))
        models = [replace(base, settings={**base.settings, **dict(kind)}) for kind in kinds]
        tasks = [(self.data, m, fitted, bool(kind)) for kind, m in zip(kinds, models, strict=True)]
        linearised_fits = self._run(linearised, tasks)
        return dict(zip(kinds, linearised_fits, strict=True))

    def _promising(
        self, base: Model, fitted: Fitted, candidates: Sequence[Candidate]
    ) -> list[Candidate]:
        """Those whose answer goes best with what is left; periodic ones, which have phases, all."""
        kept = [c for c in candidates if c.periodic]
        laws = [c for c in candidates if not c.periodic]
        explained = score_test(self.data.short, base, fitted, laws, self.mapped).gains()
        best = np.argsort(-explained, kind="stable")[:PROMISING]
        return kept + [laws[i] for i in sorted(best)]

    def _run(self, function, arguments) -> list:
        """Every call's result in order, counted as they come."""
        results = []
        for result in self.mapped(function, arguments):
            results.append(result)
            self.progress(1)
        return results

    def _placed(
        self, base: Model, fitted: Fitted, candidates: Sequence[Candidate], breadth: Breadth
    ) -> tuple[list[Candidate], list[Candidate]]:
        """Candidates ready to be fitted: periodic ones where their periods lie.

        And those periodic ones, of an effect that has no others, whose period noise alone explains.
        fitted : of the base, with derivatives
        """
        placed, feeble = [c for c in candidates if not c.periodic], []
        for effect in dict.fromkeys(c.effect for c in candidates if c.periodic):
            laws = [c for c in candidates if c.effect == effect]
            calls = [
                (laws[0], base, fitted, segmented, i) for i, segmented in enumerate(self.data.short)
            ]
            responses = self._run(frequency_response, calls)
            periods = {law.periodic: law for law in laws}
            scanned = self._run(scan, [(law, responses) for law in periods.values()])
            found = dict(zip(periods, scanned, strict=True))
            peaks = [(peak, law) for law in laws for peak in found[law.periodic]]
            strongest = sorted({peak.power for peak, _ in peaks}, reverse=True)
            if strongest[:1] and strongest[0] < NOISE:
                peak, law = max(peaks, key=lambda each: each[0].power)
                feeble.append(law.at(peak.period, peak.amplitude, peak.step).faint())
                continue
            for peak, law in peaks:
                most = breadth.seconds if law.has_second else breadth.periods
                if peak.power in strongest[:most]:
                    placed.append(law.at(peak.period, peak.amplitude, peak.step))
        return placed, feeble


def _across(base: Model, candidate: Candidate) -> tuple[tuple[str, float], ...]:
    """What it sets that changes the motion even where there is next to nothing else of it."""
    new = candidate.settings.items() - base.settings.items()
    return tuple((key, value) for key, value in new if key == ACROSS)


def _continued(data: Data, tried: Tried, rounds: int) -> Tried:
    """So many rounds on; phases that look better may lead nowhere."""
    again = coarse_fit(data, tried.model, rounds, tried.coarse)
    return replace(tried, coarse=min(again, tried.coarse, key=lambda fitted: fitted.cost))


def _coarse(data: Data, tried: Tried) -> Tried:
    return replace(tried, coarse=coarse_fit(data, tried.model, COARSE))


def _left(data: Data, model: Model, fitted: Fitted) -> Fitted:
    """A model where one with more was fitted; only the segments' states make up for what is gone."""
    kept = {free_parameter.key for free_parameter in model.free_parameters}
    shared = [
        free_parameter.key in kept
        for free_parameter in fitted.free_parameters
        if not free_parameter.per_run
    ]
    own = [
        free_parameter.key in kept
        for free_parameter in fitted.free_parameters
        if free_parameter.per_run
    ]
    point = Point(
        fitted.point.shared[shared], tuple(o[own] for o in fitted.point.own), fitted.point.states
    )
    return fit(
        Problem(data.short, model.free_parameters, model.settings), point, STARTING, fixed=True
    )
