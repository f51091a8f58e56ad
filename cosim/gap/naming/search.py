"""The whole catalogue tried on a campaign, on top of what is already in the model."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from cosim.gap.candidates.candidate import Candidate
from cosim.gap.candidates.extend import extended, moved
from cosim.gap.shooting.fit import Fitted
from cosim.gap.shooting.knob import Knob
from cosim.gap.shooting.trial import Data, Model, Trial, finished, sketch, try_model
from cosim.processes import Map

from .other_starts import other_starts
from .scan import scan
from .screen import gains

#: Rounds of the first look at every law, and of the sketch of those that do well in it.
GLANCE, SKETCH = 2, 8
#: So many laws are sketched and so many fitted in long windows, ...
SKETCHED, FINALISTS = 7, 5
#: ... at most so many of one effect.
FORMS = 2
#: Rounds in long windows before the best few, so many, are fitted to the end.
FIRST, FINISHED = 6, 2
#: On top of a first effect, so many laws are looked at.
PROMISING = 10

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
        placed = self._placed(base, fitted, candidates)
        if base.added:
            placed = self._promising(base, fitted, placed)
        placed += [c.faint() for c in placed if c.can_be_faint]
        models = [extended(base, c, fitted.values) for c in placed]
        glances = self._run(sketch, [(self.data, m, GLANCE, None, fitted) for m in models])
        tried = [Tried(c, m, g) for c, m, g in zip(placed, models, glances, strict=True)]
        chosen = _best_forms(tried, FORMS)[:SKETCHED]
        sketches = self._run(_continued, [(self.data, t) for t in chosen])
        chosen = _best_forms(sketches, FORMS)[:FINALISTS]
        done = self._tried(chosen)
        seen = {t.candidate.effect for t in done}
        rest = [t for t in _best_forms([*sketches, *tried], 1) if t.candidate.effect not in seen]
        return done + rest

    def polished(self, tried: Sequence[Tried], candidates: Sequence[Candidate]) -> list[Tried]:
        """Trials once more, from several values of mu_s and by the effect's other laws, best first.

        Where nothing sticks in most windows, a fit may have left mu_s in a place that the motion
        does not feel, and an effect unrecognised for it. A law with one number more finds its way
        from where the simpler one ended.
        """
        again = [replace(t, model=model) for t in tried
                 for model in other_starts(t.model, t.trial.fitted.values)]
        again += [law for t in tried for law in _other_laws(t, candidates)]
        again = self._run(_sketched, [(self.data, t) for t in again])
        return _best_forms([*tried, *self._tried(again)], 1, lambda t: t.trial.gap)

    def judged(self, tried: Sequence[Tried]) -> tuple[Tried, ...]:
        """Those that were ruled out early judged as well, by what little fit they had."""
        early = [t for t in tried if t.trial is None]
        trials = self._run(try_model, [(self.data, t.model, t.sketched, 0) for t in early])
        late = [replace(t, trial=trial) for t, trial in zip(early, trials, strict=True)]
        late.sort(key=lambda t: t.trial.gap)
        return (*(t for t in tried if t.trial is not None), *late)

    def _tried(self, sketched: Sequence[Tried]) -> list[Tried]:
        """The best law of each effect in long windows, best first; the best few to the end."""
        trials = self._run(try_model, [(self.data, t.model, t.sketched, FIRST) for t in sketched])
        done = [replace(t, trial=trial) for t, trial in zip(sketched, trials, strict=True)]
        done = _best_forms(done, 1, lambda t: t.trial.gap)
        trials = self._run(finished, [(self.data, t.trial) for t in done[:FINISHED]])
        ended = [replace(t, trial=trial) for t, trial in zip(done, trials, strict=False)]
        return sorted([*ended, *done[FINISHED:]], key=lambda t: t.trial.gap)

    def _promising(
        self, base: Model, fitted: Fitted, candidates: Sequence[Candidate]
    ) -> list[Candidate]:
        """Those whose answer goes best with what is left; periodic ones, which have phases, all."""
        kept = [c for c in candidates if c.periodic]
        laws = [c for c in candidates if not c.periodic]
        explained = gains(self.data.short, base, fitted, laws, self.mapped)
        best = np.argsort(-explained, kind="stable")[:PROMISING]
        return kept + [laws[i] for i in sorted(best)]

    def _run(self, function, arguments) -> list:
        """Every call's result in order, counted as they come."""
        results = []
        for result in self.mapped(function, arguments):
            results.append(result)
            self.progress(1)
        return results

    def _placed(self, base: Model, fitted: Fitted, candidates) -> list[Candidate]:
        """Candidates ready to be fitted: periodic ones where their periods lie."""
        periods = {c.periodic: c for c in candidates if c.periodic}
        peaks = self._run(scan, [(c, base, fitted, self.data.short) for c in periods.values()])
        found = dict(zip(periods, peaks, strict=True))
        placed = [c for c in candidates if not c.periodic]
        for c in candidates:
            placed += [c.at(period) for period in found.get(c.periodic, ())]
        return placed


def _continued(data: Data, tried: Tried) -> Tried:
    return replace(tried, sketched=sketch(data, tried.model, SKETCH, tried.sketched))


def _sketched(data: Data, tried: Tried) -> Tried:
    return replace(tried, sketched=sketch(data, tried.model, SKETCH))


def _other_laws(tried: Tried, candidates: Sequence[Candidate]) -> list[Tried]:
    """The effect's other laws, as far as they can be said with the numbers fitted."""
    values = {**tried.model.settings, **tried.trial.fitted.values}
    own = {knob.key for knob in tried.candidate.knobs}
    settings = {k: v for k, v in tried.model.settings.items() if k not in tried.candidate.settings}
    knobs = tuple(k for k in tried.model.knobs if k.key not in own)
    base = Model(knobs, settings, tried.model.added - 1)
    laws: dict[tuple[Knob, ...], Tried] = {}
    for law in candidates:
        if law.effect == tried.candidate.effect and law.form != tried.candidate.form:
            law = replace(law, knobs=tuple(moved(knob, values) for knob in law.knobs))
            model = extended(base, law, values)
            laws.setdefault(law.knobs, replace(tried, candidate=law, model=model))
    return list(laws.values())


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
