"""The whole catalogue tried on a campaign, on top of what is already in the model."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from cosim.gap.candidates.candidate import Candidate
from cosim.gap.candidates.extend import extended, moved
from cosim.gap.shooting.data import Data
from cosim.gap.shooting.fit import fit
from cosim.gap.shooting.fitted import Fitted, Point
from cosim.gap.shooting.glance import glance, ground
from cosim.gap.shooting.problem import Problem
from cosim.gap.shooting.trial import Model, Trial, finished, sketch, try_model
from cosim.processes import Map

from .breadth import ALONE, ANEW, BESIDE, Breadth
from .other_starts import other_starts
from .scan import NOISE, scan
from .screen import screened
from .wave_answer import wave_answer

#: Rounds of the glance at every law, of a look at those that do well in it, of a sketch of those
#: that do so again, ...
GLANCE, LOOK, SKETCH = 3, 2, 6
#: ... so many are fitted in long windows, at most so many of one effect.
FINALISTS, FORMS = 5, 2
#: Rounds in long windows before the best few, so many, are fitted to the end.
FIRST, FINISHED = 6, 2
#: Where a law leaves less than this part of the misfit, others are out that leave more than that.
NEARLY_ALL, HOPELESS = 0.1, 0.5
#: So many laws set out as next to nothing as well; on top of a first effect no others are tried.
PROMISING = 10
#: Laws of one effect that set out again, by other values or other laws, and go to long windows.
AGAIN = 3

#: The setting by which friction acts across the motion.
ACROSS = "lateral_friction.ratio"

Progress = Callable[[int], object]


@dataclass(frozen=True)
class Tried:
    """A candidate on top of a base model; `trial` is None where a shorter look ruled it out."""

    candidate: Candidate
    model: Model
    sketched: Fitted
    trial: Trial | None = None


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
        done = self._tried(_best_forms(sketches, FORMS)[:FINALISTS])
        effects = {t.candidate.effect for t in done}
        rest = [t for t in _best_forms([*sketches, *seen], 1) if t.candidate.effect not in effects]
        return done + rest

    def beside(
        self, base: Model, fitted: Fitted, candidates: Sequence[Candidate]
    ) -> list[Tried]:
        """The best laws beside an effect that is in the base, in short windows, best first."""
        sketches, _ = self._sketches(base, fitted, candidates, BESIDE)
        return _best_forms(sketches, FORMS)

    def concealed(
        self, base: Model, fitted: Fitted, candidates: Sequence[Candidate]
    ) -> tuple[Candidate, Tried] | None:
        """Two laws that do much together and little alone: one, and the other on top of it."""
        laws = [c for c in candidates if c.knobs and not c.periodic]
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
        return [(first, replace(second, trial=trial))
                for (first, second), trial in zip(pairs, trials, strict=True)]

    def instead(
        self, second: Tried, law: Candidate, candidates: Sequence[Candidate], keep: Sequence[str]
    ) -> list[Tried]:
        """The best law of each effect in place of one of a pair, in long windows, best first.

        second : the pair's second effect on top of the first, with a trial; law : that of either;
        keep : settings of that law that the other needs
        """
        values = second.trial.fitted.values
        rest = _without(second.model, law, values, keep)
        tried = [Tried(c, extended(rest, c, values), second.sketched) for c in candidates]
        return self._tried(_best_forms(self._run(_sketched, [(self.data, t) for t in tried]), 1))

    def less(self, tried: Tried, dropped: Candidate, keep: Sequence[str]) -> Tried:
        """A trial's model without an effect, fitted to the end from where the trial ended.

        keep : settings of the dropped effect that others need
        """
        model = _without(tried.model, dropped, tried.trial.fitted.values, keep)
        (again,) = self._run(_sketched, [(self.data, replace(tried, model=model))])
        (trial,) = self._run(try_model, [(self.data, model, again.sketched)])
        return replace(again, trial=trial)

    def anew(
        self, second: Tried, law: Candidate, candidates: Sequence[Candidate]
    ) -> Tried | None:
        """The best law of a periodic effect of a pair, its period looked for beside the other.

        second : the pair's second effect on top of the first; law : that of either that is dropped
        """
        fitted = second.sketched
        model = _without(second.model, law, fitted.values, ())
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
        again = [replace(t, model=model) for i, t in enumerate(tried)
                 if all(t.model is not other.model for other in tried[:i])
                 for model in other_starts(t.model, t.trial.fitted.values)]
        again += [law for t in tried for law in _other_laws(t, candidates)]
        again = _best_forms(self._run(_sketched, [(self.data, t) for t in again]), AGAIN)
        return _best_forms([*tried, *self._tried(again)], 1, lambda t: t.trial.gap)

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
        chosen = sorted(_best_forms(seen, FORMS), key=lambda t: _rank(t, seen))
        looks = [(self.data, t, LOOK) for t in chosen[: breadth.looked_at]]
        looks = self._run(_continued, looks)
        chosen = _in_the_running(_best_forms(looks, FORMS)[: breadth.sketched], fitted)
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
        tasks = [(self.data, m, grounds[_across(base, c)], rounds)
                 for (c, rounds), m in zip(laws, models, strict=True)]
        glances = self._run(glance, tasks)
        tried = [Tried(c, m, g) for (c, _), m, g in zip(laws, models, glances, strict=True)]
        return tried[: len(placed)], tried[len(placed) :]

    def _tried(self, sketched: Sequence[Tried]) -> list[Tried]:
        """The best law of each effect in long windows, best first; the best few to the end."""
        trials = self._run(try_model, [(self.data, t.model, t.sketched, FIRST) for t in sketched])
        done = [replace(t, trial=trial) for t, trial in zip(sketched, trials, strict=True)]
        done = _best_forms(done, 1, lambda t: t.trial.gap)
        trials = self._run(finished, [(self.data, t.trial) for t in done[:FINISHED]])
        ended = [replace(t, trial=trial) for t, trial in zip(done, trials, strict=False)]
        return sorted([*ended, *done[FINISHED:]], key=lambda t: t.trial.gap)

    def _grounds(
        self, base: Model, fitted: Fitted, candidates: Sequence[Candidate]
    ) -> dict[tuple, Fitted]:
        """The base with its derivatives, as it is and with the friction across that laws bring."""
        kinds = list(dict.fromkeys([(), *(_across(base, c) for c in candidates)]))
        models = [replace(base, settings={**base.settings, **dict(kind)}) for kind in kinds]
        grounds = self._run(ground, [(self.data, model, fitted) for model in models])
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


def _in_the_running(tried: Sequence[Tried], fitted: Fitted) -> list[Tried]:
    """Best first, without those that do little where the best does nearly all.

    fitted : the base
    """
    before = fitted.gap() ** 2 - 1.0
    left = [max(t.sketched.gap() ** 2 - 1.0, 0.0) for t in tried]
    if not tried or min(left) > NEARLY_ALL * before:
        return list(tried)
    return [t for t, rest in zip(tried, left, strict=True) if rest <= HOPELESS * before]


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
    """A model where one with more knobs was fitted; the windows' states alone make up for them."""
    kept = {knob.key for knob in model.knobs}
    shared = [knob.key in kept for knob in fitted.knobs if not knob.per_run]
    own = [knob.key in kept for knob in fitted.knobs if knob.per_run]
    point = Point(fitted.point.shared[shared], tuple(o[own] for o in fitted.point.own),
                  fitted.point.states)
    return fit(Problem(data.short, model.knobs, model.settings), point, LOOK, fixed=True)


def _without(
    model: Model, dropped: Candidate, values: dict[str, float], keep: Sequence[str]
) -> Model:
    """A model without an effect, setting out from where it was fitted.

    keep : settings of the dropped effect that others need
    """
    gone = {knob.key for knob in dropped.knobs}
    knobs = tuple(moved(knob, values) for knob in model.knobs if knob.key not in gone)
    settings = {key: value for key, value in model.settings.items()
                if key not in dropped.settings or key in keep}
    return Model(knobs, settings, model.added - 1)


def _other_laws(tried: Tried, candidates: Sequence[Candidate]) -> list[Tried]:
    """The effect's other laws, as far as they can be said with the numbers fitted."""
    values = {**tried.model.settings, **tried.trial.fitted.values}
    own = {knob.key for knob in tried.candidate.knobs}
    settings = {k: v for k, v in tried.model.settings.items() if k not in tried.candidate.settings}
    knobs = tuple(k for k in tried.model.knobs if k.key not in own)
    base = Model(knobs, settings, tried.model.added - 1)
    laws: dict[tuple, Tried] = {}
    for law in candidates:
        if law.effect == tried.candidate.effect and law.form != tried.candidate.form:
            if law.periodic and law.periodic not in own:
                continue
            told = any(knob.key in values for knob in law.knobs[:1])
            law = replace(law, knobs=tuple(moved(knob, values) for knob in law.knobs),
                          grows=0.0 if told else law.grows)
            model = extended(base, law, values)
            key = (law.knobs, *law.settings.items())
            laws.setdefault(key, replace(tried, candidate=law, model=model))
    return list(laws.values())


def _rank(tried: Tried, seen: Sequence[Tried]) -> int:
    """How many laws of its effect did better."""
    cost = penalised(tried.sketched)
    return sum(t.candidate.effect == tried.candidate.effect and penalised(t.sketched) < cost
               for t in seen)


def _best_forms(tried: Sequence[Tried], most: int, key=None) -> list[Tried]:
    """The best laws of each effect, best first."""
    counts: dict[str, int] = {}
    best = []
    for t in sorted(tried, key=key or (lambda t: penalised(t.sketched))):
        counts[t.candidate.effect] = counts.get(t.candidate.effect, 0) + 1
        if counts[t.candidate.effect] <= most:
            best.append(t)
    return best


def penalised(fitted: Fitted) -> float:
    """Sum of squares and the BIC's penalty for the campaign's knobs."""
    rows = sum(r.size for r in fitted.residuals)
    count = sum(not knob.per_run for knob in fitted.knobs)
    return fitted.cost + count * float(np.log(max(rows, 2)))
