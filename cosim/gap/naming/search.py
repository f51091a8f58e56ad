"""The whole catalogue tried on a campaign, on top of what is already in the model."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from stickslip.effects.candidate import Candidate

from cosim.gap.candidates.extend import extended, reduced
from cosim.gap.shooting.data import Data
from cosim.gap.shooting.fit import fit
from cosim.gap.shooting.fitted import Fitted, Point
from cosim.gap.shooting.glance import glance, ground
from cosim.gap.shooting.problem import Problem
from cosim.gap.shooting.trial import Model, finished, sketch, try_model
from cosim.processes import Map

from .breadth import ALONE, ANEW, BESIDE, Breadth
from .other_laws import other_laws
from .other_starts import other_starts
from .scan import NOISE, scan
from .screen import screened
from .tried import ACROSS, Tried, best_laws, in_the_running, penalised, rank
from .wave_answer import wave_answer

#: Rounds of the glance at every law, of a look at those that do well in it, of a sketch of those
#: that do so again, ...
GLANCE, LOOK, SKETCH = 3, 2, 6
#: ... so many are fitted in long windows, at most so many of one effect.
FINALISTS, FORMS = 5, 2
#: Rounds in long windows before the best few, so many, are fitted to the end.
FIRST, FINISHED = 6, 2
#: So many laws set out as next to nothing as well; on top of a first effect no others are tried.
PROMISING = 10
#: Laws of one effect that set out again, by other values or other laws, and go to long windows.
AGAIN = 3

Progress = Callable[[int], object]


class Search:
    """Tries candidates on top of base models, as ``mapped`` does it."""

    def __init__(self, data: Data, mapped: Map, progress: Progress | None = None):
        self.data, self.mapped = data, mapped
        self.progress = progress or (lambda count: None)

    def on(self, base: Model, fitted: Fitted, candidates: Sequence[Candidate]) -> list[Tried]:
        """The best law of each effect, best effect first; finalists have a trial.

        fitted : the base in short windows.
        """
        sketches, seen = self._sketches(base, fitted, candidates, ALONE)
        done = self._tried(best_laws(sketches, FORMS)[:FINALISTS])
        effects = {t.candidate.effect for t in done}
        rest = [t for t in best_laws([*sketches, *seen], 1) if t.candidate.effect not in effects]
        return done + rest

    def beside(self, base: Model, fitted: Fitted, candidates: Sequence[Candidate]) -> list[Tried]:
        """The best laws beside an effect that is in the base, in short windows, best first."""
        sketches, _ = self._sketches(base, fitted, candidates, BESIDE)
        return best_laws(sketches, FORMS)

    def concealed(
        self, base: Model, fitted: Fitted, candidates: Sequence[Candidate]
    ) -> tuple[Candidate, Tried] | None:
        """Two laws that do much together and little alone: one, and the other on top of it."""
        laws = [c for c in candidates if c.free_parameters and not c.periodic]
        with_derivatives = self._grounds(base, fitted, ())[()]
        two = screened(self.data.short, base, with_derivatives, laws, self.mapped).concealed()
        if two is None:
            return None
        model = extended(extended(base, two[0], fitted.values), two[1], {})
        second = Tried(two[1], model, fitted)
        return two[0], self._run(_sketched, [(self.data, second)])[0]

    def together(self, pairs: Sequence[tuple[Tried, Tried]]) -> list[tuple[Tried, Tried]]:
        """Second effects on top of first ones in long windows; the best few to the end."""
        seconds = [second for _, second in pairs]
        trials = self._run(try_model, [(self.data, t.model, t.sketched, FIRST) for t in seconds])
        best = sorted(range(len(pairs)), key=lambda i: trials[i].gap)[:FINISHED]
        ended = self._run(finished, [(self.data, trials[i]) for i in best])
        trials = [ended[best.index(i)] if i in best else trial for i, trial in enumerate(trials)]
        return [
            (first, replace(second, trial=trial))
            for (first, second), trial in zip(pairs, trials, strict=True)
        ]

    def instead(
        self, second: Tried, law: Candidate, candidates: Sequence[Candidate], keep: Sequence[str]
    ) -> list[Tried]:
        """The best law of each effect in place of one of a pair, in long windows, best first.

        second : the pair's second effect on top of the first, with a trial; law : that of either;
        keep : settings of that law that the other needs
        """
        values = second.trial.fitted.values
        rest = reduced(second.model, law, values, keep)
        tried = [Tried(c, extended(rest, c, values), second.sketched) for c in candidates]
        return self._tried(best_laws(self._run(_sketched, [(self.data, t) for t in tried]), 1))

    def less(self, tried: Tried, dropped: Candidate, keep: Sequence[str]) -> Tried:
        """A trial's model without an effect, fitted to the end from where the trial ended.

        keep : settings of the dropped effect that others need
        """
        model = reduced(tried.model, dropped, tried.trial.fitted.values, keep)
        (again,) = self._run(_sketched, [(self.data, replace(tried, model=model))])
        (trial,) = self._run(try_model, [(self.data, model, again.sketched)])
        return replace(again, trial=trial)

    def anew(self, second: Tried, law: Candidate, candidates: Sequence[Candidate]) -> Tried | None:
        """The best law of a periodic effect of a pair, its period looked for beside the other.

        second : the pair's second effect on top of the first; law : that of either that is dropped
        """
        fitted = second.sketched
        model = reduced(second.model, law, fitted.values, ())
        (rest,) = self._run(_left, [(self.data, model, fitted)])
        laws = [c for c in candidates if c.effect == law.effect]
        sketches, _ = self._sketches(model, rest, laws, ANEW)
        return min(sketches, key=lambda t: penalised(t.sketched), default=None)

    def polished(self, tried: Sequence[Tried], candidates: Sequence[Candidate]) -> list[Tried]:
        """Trials once more, from several values of mu_s and by the effect's other laws, best first.

        Where nothing sticks in most windows, a fit may have left mu_s in a place that the motion
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
        again = best_laws(self._run(_sketched, [(self.data, t) for t in again]), AGAIN)
        return best_laws([*tried, *self._tried(again)], 1, lambda t: t.trial.gap)

    def judged(self, tried: Sequence[Tried]) -> tuple[Tried, ...]:
        """Those that were ruled out early judged as well, by what little fit they had."""
        early = [t for t in tried if t.trial is None]
        trials = self._run(try_model, [(self.data, t.model, t.sketched, 0) for t in early])
        late = [replace(t, trial=trial) for t, trial in zip(early, trials, strict=True)]
        late.sort(key=lambda t: t.trial.gap)
        return (*(t for t in tried if t.trial is not None), *late)

    def _sketches(
        self, base: Model, fitted: Fitted, candidates: Sequence[Candidate], breadth: Breadth
    ) -> tuple[list[Tried], list[Tried]]:
        """The best laws sketched, at most so many, and all that were looked at for it."""
        seen, unseen = self._glanced(base, fitted, candidates, breadth)
        # the best law of every effect: by derivatives of afar a glance may miss how well one does
        chosen = sorted(best_laws(seen, FORMS), key=lambda t: rank(t, seen))
        looks = [(self.data, t, LOOK) for t in chosen[: breadth.looked_at]]
        looks = self._run(_continued, looks)
        chosen = in_the_running(best_laws(looks, FORMS)[: breadth.sketched], fitted)
        sketches = self._run(_continued, [(self.data, t, SKETCH - LOOK) for t in chosen])
        return sketches, [*looks, *seen, *unseen]

    def _glanced(
        self, base: Model, fitted: Fitted, candidates: Sequence[Candidate], breadth: Breadth
    ) -> tuple[list[Tried], list[Tried]]:
        """Every law after a glance at it; those whose period is noise, as they set out."""
        grounds = self._grounds(base, fitted, candidates)
        placed, feeble = self._placed(base, grounds[()], candidates, breadth)
        promising = self._promising(base, grounds[()], placed)
        if not breadth.everything:
            placed, feeble = promising, []
        placed = placed + [c.faint() for c in promising if c.can_be_faint]
        laws = [*((c, GLANCE) for c in placed), *((c, 0) for c in feeble)]
        models = [extended(base, c, fitted.values) for c, _ in laws]
        tasks = [
            (self.data, m, grounds[_across(base, c)], rounds)
            for (c, rounds), m in zip(laws, models, strict=True)
        ]
        glances = self._run(glance, tasks)
        tried = [Tried(c, m, g) for (c, _), m, g in zip(laws, models, glances, strict=True)]
        return tried[: len(placed)], tried[len(placed) :]

    def _tried(self, sketched: Sequence[Tried]) -> list[Tried]:
        """The best law of each effect in long windows, best first; the best few to the end."""
        trials = self._run(try_model, [(self.data, t.model, t.sketched, FIRST) for t in sketched])
        done = [replace(t, trial=trial) for t, trial in zip(sketched, trials, strict=True)]
        done = best_laws(done, 1, lambda t: t.trial.gap)
        trials = self._run(finished, [(self.data, t.trial) for t in done[:FINISHED]])
        ended = [replace(t, trial=trial) for t, trial in zip(done, trials, strict=False)]
        return sorted([*ended, *done[FINISHED:]], key=lambda t: t.trial.gap)

    def _grounds(
        self, base: Model, fitted: Fitted, candidates: Sequence[Candidate]
    ) -> dict[tuple, Fitted]:
        """The base with its derivatives, as it is and with the friction across that laws bring."""
        kinds = list(dict.fromkeys([(), *(_across(base, c) for c in candidates)]))
        models = [replace(base, settings={**base.settings, **dict(kind)}) for kind in kinds]
        tasks = [(self.data, m, fitted, bool(kind)) for kind, m in zip(kinds, models, strict=True)]
        grounds = self._run(ground, tasks)
        return dict(zip(kinds, grounds, strict=True))

    def _promising(
        self, base: Model, fitted: Fitted, candidates: Sequence[Candidate]
    ) -> list[Candidate]:
        """Those whose answer goes best with what is left; periodic ones, which have phases, all."""
        kept = [c for c in candidates if c.periodic]
        laws = [c for c in candidates if not c.periodic]
        explained = screened(self.data.short, base, fitted, laws, self.mapped).gains()
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
            flights = enumerate(self.data.short)
            calls = [(laws[0], base, fitted, flight, i) for i, flight in flights]
            answers = self._run(wave_answer, calls)
            periods = {law.periodic: law for law in laws}
            found = self._run(scan, [(law, answers) for law in periods.values()])
            found = dict(zip(periods, found, strict=True))
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
    again = sketch(data, tried.model, rounds, tried.sketched)
    return replace(tried, sketched=min(again, tried.sketched, key=lambda fitted: fitted.cost))


def _sketched(data: Data, tried: Tried) -> Tried:
    return replace(tried, sketched=sketch(data, tried.model, SKETCH))


def _left(data: Data, model: Model, fitted: Fitted) -> Fitted:
    """A model where one with more free parameters was fitted; the windows' states alone make up for them."""
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
    return fit(Problem(data.short, model.free_parameters, model.settings), point, LOOK, fixed=True)
