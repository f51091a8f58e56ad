"""The whole catalogue tried on top of a model: screened by algebra, the best settled."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from stickslip.effects.candidate import ACROSS, Candidate, FreeParameter

from cosim.gap.camera.faults import is_fault
from cosim.gap.candidates.extend import extended
from cosim.gap.data import MeasuredRun
from cosim.gap.estimation.segmented_run import SegmentedRun
from cosim.gap.estimation.trial import Model
from cosim.gap.evidence.alignment import FAR, NEAR
from cosim.gap.evidence.settled import REACH, TURNS, Settled, ended, settled
from cosim.processes import Map, map_here

from .decision import implausible, is_noise, needed
from .scaling import better_rescaled
from .screening import faint, screened
from .tried import Tried, gain
from .waves import waves

#: Laws of one effect that are settled, and of all, on top of the plain model and of an effect.
FORMS, ALONE, BESIDE = 2, 10, 7
#: Part of the best law's gain that another must promise.
FAINTLY = 0.1
#: Turns after which the best few, so many, are carried on: those that gain this part of the best.
FIRST, FINISHED, NEARLY = 2, 4, 0.5
#: Part of its gain that others must promise where one leaves nothing but noise.
ALIKE = 0.8
#: A law that takes more of the misfit is not looked for from the balance of forces again.
MOST_OF_IT = 0.9
#: Root mean square residual, in units of the noise, of a model that lies along the data, and of
#: one that leaves hardly anything.
ALONG, ALMOST = 1.5, 1.05
#: So many laws set out anew where nothing repairs a model, and so many effects' strengths may then
#: go with mass, speed or stiffness.
ANEW = 2


#: Of a law, as pairs.
Settings = tuple[tuple[str, float], ...]


class Search:
    """Tries candidates on models of some runs in short segments, as ``mapped`` does it."""

    def __init__(
        self,
        segmented: Sequence[SegmentedRun],
        runs: Sequence[MeasuredRun],
        mapped: Map,
        progress: Callable[[int], object] | None = None,
    ):
        self.segmented, self.runs, self.mapped = tuple(segmented), tuple(runs), mapped
        self.held_out = [run.hold_out for run in runs]
        self.progress = progress or (lambda count: None)
        self.ruled_out: set[Settings] = set()  # what laws set that no motion was found to go with

    def plain(self, model: Model) -> Settled:
        """The plain model at its best."""
        (best,) = self._settled([(model, None)])
        return best

    def on(
        self, base: Settled, laws: Sequence[Candidate], most: int, beyond: float
    ) -> tuple[Settled, list[Tried]]:
        """Every law on top of a base, the best of them settled, best first; and the base.

        The base without the best law may be better than it was: then it was not at its best.
        beyond : -2 ln evidence; what cannot be expected to come below is not carried to its end
        """
        ranked, starts = self._screened(base, laws)
        chosen = self._chosen(base, ranked, most, beyond)
        tasks = [(extended(starts[id(t)].model, _start(t), {}), starts[id(t)]) for t in chosen]
        started = self._settled(tasks, FIRST)
        best = [
            replace(t, settled=s, gain=gain(s, base)) for t, s in zip(chosen, started, strict=True)
        ]
        best = self._finished(sorted(best, key=lambda t: t.model.promise), base, beyond)
        rest = [t for t in ranked if t not in chosen]
        ruled_out = [t for t in rest if t.settled is None]
        found = [*best, *(t for t in rest if t.settled)]
        base = self._without(base, found)
        found = [replace(t, gain=gain(t.model, base)) for t in found]
        return base, sorted(found, key=lambda t: -t.gain) + ruled_out

    def _screened(self, base: Settled, laws: Sequence[Candidate]):
        """All laws with the gain that the screening promises, best first; where each sets out."""
        ranked: list[Tried] = []
        starts: dict[int, Settled] = {}
        laws = _distinct(base, laws)
        waving = [law for law in laws if law.periodic]
        for kind, (start, more) in self._bases(base, laws).items():
            own = [law for law in laws if not law.periodic and _brings(base, law) == kind]
            if kind == ():
                own += self._waves(base, waving)
            bare = [law for law in own if not law.free_parameters]
            found = [Tried(law, more, start) for law in bare]
            own = [law for law in own if law.free_parameters]
            for law, promised, point in self._promised(start, own):
                each = Tried(law, more + promised)
                found.append(each)
                starts[id(each)] = point
            ranked += found
            starts.update((id(t), start) for t in found if id(t) not in starts)
        return sorted(ranked, key=lambda t: -t.gain), starts

    def _promised(
        self, start: Settled, laws: Sequence[Candidate]
    ) -> list[tuple[Candidate, float, Settled]]:
        """Of every law the gain that it promises on a start, and the point that promises it.

        Where a model is wrong, a law may be felt where it lies loosely along the data and not where
        it is likeliest, or the other way round.
        """
        points = [start]
        if start.loose and not is_noise(start):
            points.append(start.loose)
        found = []
        gains = [
            screened(point, laws, self.held_out, self.mapped) + start.promised - point.promised
            for point in points
        ]
        for law, each in zip(laws, zip(*gains, strict=True), strict=True):
            best = int(np.argmax(each))
            found.append((law, float(each[best]), points[best]))
        return found

    def without(self, plain: Settled, laws: Sequence[Candidate], found: Settled) -> Settled:
        """The plain model with some laws of a model that was found, from where that stands."""
        model = plain.model
        for law in laws:
            model = extended(model, law, {})
        (alone,) = self._settled([(model, found)])
        return alone

    def _without(self, base: Settled, found: Sequence[Tried]) -> Settled:
        """The base, or what it is when it sets out from the best law's model."""
        best = max(found, key=lambda t: t.gain, default=None)
        if best is None or best.gain <= 0.0:
            return base
        (again,) = self._settled([(base.model, best.model)], FIRST)
        if again.promise >= base.evidence:
            return base
        if again.promise < best.model.evidence + FAINTLY * best.gain:  # it may be all there is
            (again,) = self._ended([again])
        return min(base, again, key=lambda each: each.evidence)

    def _finished(self, tried: Sequence[Tried], base: Settled, beyond: float) -> list[Tried]:
        """The best few carried on to their end, or from the balance of forces if that is better."""
        promised = [base.evidence - t.model.promise for t in tried]
        least = NEARLY * max(promised, default=0.0)
        few = [
            t for t, p in zip(tried, promised, strict=True) if p >= least and t.model.reach < beyond
        ][:FINISHED]
        done = self._ended([t.model for t in few[:1]])
        if any(is_noise(each) for each in done):
            least = ALIKE * gain(done[0], base)
            few = [
                t for i, t in enumerate(few) if i < ANEW or base.evidence - t.model.promise >= least
            ]
        beyond = min([beyond, *(each.evidence + needed(1) for each in done)])
        done += self._ended([t.model for t in few[1:]], beyond)
        if few and not any(is_noise(each) for each in (base, *done)):
            done = self._repaired(base, few, done)
        best = [replace(t, settled=s, gain=gain(s, base)) for t, s in zip(few, done, strict=True)]
        return [*best, *(t for t in tried if all(t is not other for other in few))]

    def _repaired(self, base: Settled, few: Sequence[Tried], done: list[Settled]) -> list[Settled]:
        """The best of each effect with a strength that goes with mass or speed, or fitted anew."""
        order = sorted(range(len(few)), key=lambda i: done[i].evidence)
        firsts: dict[str, int] = {}
        for number in order:
            firsts.setdefault(few[number].candidate.effect, number)
        best = [i for e, i in firsts.items() if not is_fault(e)][:ANEW]
        calls = [(self.segmented, self.runs, done[i], few[i].candidate) for i in best]
        scaled = list(self.mapped(better_rescaled, calls))
        first = order[:ANEW] if _may_be_lost(done[order[0]], base) else []
        fresh = self._settled([(self._anew(base, few[i].candidate, done[i]), None) for i in first])
        for number, other in [*zip(best, scaled, strict=True), *zip(first, fresh, strict=True)]:
            done[number] = min(done[number], other, key=lambda each: each.evidence)
        return done

    def _anew(self, base: Settled, candidate: Candidate, found: Settled) -> Model:
        """A law on top of a base, its own numbers as found; plain ones from the balance of forces.

        What the law was settled from, a simpler model's alignment, may have made up for what was
        missing there.
        """
        values = found.values
        own = tuple(
            replace(free, start=_not_faint(values.get(free.key, free.start), free))
            for free in candidate.free_parameters
        )
        plain = replace(base.model, settings=found.model.settings)
        return extended(plain, replace(candidate, free_parameters=own), {})

    def _bases(self, base: Settled, laws: Sequence[Candidate]):
        """By what laws set that changes the motion even without them: a base, and its gain.

        What is not near a base that is poor may still be found from the balance of forces; where
        the base lies along the data, it is ruled out, for what is built on that as well.
        """
        brought = dict.fromkeys(_brings(base, law) for law in laws if not law.periodic)
        kinds = [kind for kind in brought if kind and kind not in self.ruled_out]
        models = [
            replace(base.model, settings={**base.model.settings, **dict(kind)}) for kind in kinds
        ]
        near = self._settled([(model, base) for model in models], FIRST)
        lost = [i for i, each in enumerate(near) if each.rms_residual > ALONG]
        if base.rms_residual > ALONG:
            said = (base.loose or base).springs
            springs = said if said in (NEAR, FAR) else None  # whichever fits
            fresh = self._settled([(models[i], None) for i in lost], springs=springs)
            for i, each in zip(lost, fresh, strict=True):
                near[i] = min(near[i], each, key=lambda one: one.promise)
        else:
            self.ruled_out.update(kinds[i] for i in lost)
        found = {(): base, **dict(zip(kinds, near, strict=True))}
        return {kind: (each, gain(each, base)) for kind, each in found.items()}

    def _waves(self, base: Settled, laws: Sequence[Candidate]) -> list[Candidate]:
        if not laws:
            return []
        near = base if is_noise(base) else base.loose or base
        problem = near.problem  # what is a run's own has given way to a wave, as far as it could
        model = Model(problem.free_parameters, problem.settings, local=problem.local)
        return waves(model, near.fitted, self.segmented, laws, self.mapped)

    def _chosen(
        self, base: Settled, ranked: Sequence[Tried], most: int, beyond: float
    ) -> list[Tried]:
        """Those that promise the most, and enough; of waves all periods.

        How a wave's phases lie is not known before it is settled: on top of a poor base its
        evidence is not, either.
        """
        least = max(0.0, FAINTLY * max((t.gain for t in ranked), default=0.0))
        if base.rms_residual < ALMOST:  # what algebra promises is then nearly what comes
            least = max(least, (base.evidence - beyond) / REACH)
        poor, counts = base.rms_residual > ALONG, Counter[str]()
        chosen: list[Tried] = []
        for each in ranked:
            wave, effect = bool(each.candidate.periodic), each.candidate.effect
            if each.settled is not None or (each.gain <= least and not (wave and poor)):
                continue
            if any(_are_twins(each.candidate, other.candidate) for other in chosen):
                continue
            counts[effect] += 1
            if wave or (counts[effect] <= FORMS and len(chosen) < most):
                chosen.append(each)
        return chosen

    def _ended(self, models: Sequence[Settled], beyond: float = math.inf) -> list[Settled]:
        """Some models carried on to their end, unless they stay ``beyond``."""
        over_models, over_runs = self._maps(len(models))
        return list(over_models(ended, [(each, over_runs, beyond) for each in models]))

    def _settled(
        self,
        tasks: Sequence[tuple[Model, Settled | None]],
        turns: int = TURNS,
        springs: float | None = None,
    ) -> list[Settled]:
        over_tasks, over_runs = self._maps(len(tasks))
        calls = [(self.segmented, self.runs, *task, turns, over_runs, springs) for task in tasks]
        results = []
        for result in over_tasks(settled, calls):
            results.append(result)
            self.progress(1)
        return results

    def _maps(self, count: int) -> tuple[Map, Map]:
        """Over so many tasks, and over the runs of each: one alone has its runs divided."""
        return (map_here, self.mapped) if count == 1 else (self.mapped, map_here)


def _distinct(base: Settled, laws: Sequence[Candidate]) -> list[Candidate]:
    """Laws that are not one another once the base sets what it does."""
    set_already = base.model.settings.items()
    found: dict[tuple, Candidate] = {}
    for law in laws:
        new = tuple(sorted(law.settings.items() - set_already))
        found.setdefault((law.effect, law.form, new, _starts(law)), law)
    return list(found.values())


def _starts(law: Candidate) -> tuple[tuple[str, float], ...]:
    return tuple((free.key, free.start) for free in law.free_parameters)


def _are_twins(one: Candidate, other: Candidate) -> bool:
    """Whether two laws are one, set out with on either side of nothing: one finds where to go."""
    if (one.effect, one.form, one.settings) != (other.effect, other.form, other.settings):
        return False
    mine, its = _starts(one), _starts(other)
    same = [(key, abs(start)) for key, start in mine] == [(key, abs(start)) for key, start in its]
    return same and mine != its


def _start(tried: Tried) -> Candidate:
    """The law as a fit sets out with it."""
    return tried.candidate if tried.candidate.periodic else faint(tried.candidate)


def _may_be_lost(best: Settled, base: Settled) -> bool:
    """Whether a law that was settled from a simpler model may have more to it than was found.

    About a model that lies along the data everything answers linearly, and nothing is lost.
    """
    misfit = base.evidence - base.rows
    some = base.rms_residual > ALONG and gain(best, base) < MOST_OF_IT * misfit
    return bool(implausible(best)) or some


def _not_faint(found: float, free: FreeParameter) -> float:
    """Where a fit sets out anew: what is next to nothing of an effect would stay so."""
    usual = 0.5 * abs(free.start)
    if not free.is_strength or abs(found) > 0.4 * usual:
        return found
    return math.copysign(usual, found or free.start)


def _brings(base: Settled, law: Candidate) -> Settings:
    """What a law sets that changes the motion even where there is next to nothing else of it."""
    new = law.settings.items() - base.model.settings.items()
    return tuple((key, value) for key, value in new if key in ACROSS)


__all__ = ["ALONE", "BESIDE", "Search"]
