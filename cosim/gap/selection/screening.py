"""From every law of the catalogue to the few that are worth a fit, in short segments.

A score test, a screening fit by known derivatives, then coarse fits in two steps, each of fewer
laws than the one before. Periodic effects set out from where their periods lie.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from stickslip.effects.candidate import Candidate

from cosim.gap.candidates.extend import extended
from cosim.gap.estimation.fitted import Fitted
from cosim.gap.estimation.linearisation import linearised, screening_fit
from cosim.gap.estimation.preparation import Data
from cosim.gap.estimation.trial import Model, coarse_fit
from cosim.processes import Map

from .frequency_response import frequency_response
from .periodogram import NOISE, scan
from .score_test import score_test
from .tried import ACROSS, Tried, best_laws, in_the_running, rank

#: Rounds of the screening fit of every law, of the first part of a coarse fit of those that do well
#: in it, of a whole one of those that do so again.
SCREENING, STARTING, COARSE = 3, 2, 6
#: At most so many laws of one effect.
FORMS = 2
#: So many laws set out as next to nothing as well; on top of a first effect no others are tried.
PROMISING = 10

Progress = Callable[[int], object]


@dataclass(frozen=True)
class Breadth:
    """How many laws a search tries, from many in the screening to a few in coarse fits.

    Attributes
    ----------
    started, coarse : so many laws start a coarse fit after the screening, and so many complete it
    periods, seconds : so many periods of a periodic effect, in time or along the surface, are
        tried, and so many of them with a second harmonic
    everything : whether laws that promise little are tried too, and those that do not from next to
        nothing as well as in full
    """

    started: int
    coarse: int
    periods: int
    seconds: int
    everything: bool


#: Of a first effect; of one beside it; of a periodic one searched for once more beside another.
ALONE = Breadth(started=16, coarse=7, periods=4, seconds=1, everything=True)
BESIDE = Breadth(started=10, coarse=4, periods=3, seconds=0, everything=False)
ANEW = Breadth(started=10, coarse=4, periods=3, seconds=1, everything=False)


class Screening:
    """Screens candidates on top of base models, as ``mapped`` does it."""

    def __init__(self, data: Data, mapped: Map, progress: Progress | None = None):
        self.data, self.mapped = data, mapped
        self.progress = progress or (lambda count: None)

    def run(self, function: Callable[..., Any], arguments: Iterable[tuple]) -> list[Any]:
        """Every call's result in order, counted as they come."""
        results = []
        for result in self.mapped(function, arguments):
            results.append(result)
            self.progress(1)
        return results

    def coarse_fits(
        self, base: Model, fitted: Fitted, candidates: Sequence[Candidate], breadth: Breadth
    ) -> tuple[list[Tried], list[Tried]]:
        """The best laws fitted coarsely, at most so many, and all that were screened for it."""
        seen, unseen = self._screened(base, fitted, candidates, breadth)
        # the best law of every effect: a screening fit may miss how well one does, its derivatives
        # being taken elsewhere
        chosen = sorted(best_laws(seen, FORMS), key=lambda t: rank(t, seen))
        started = self.run(
            _continued, [(self.data, t, STARTING) for t in chosen[: breadth.started]]
        )
        chosen = in_the_running(best_laws(started, FORMS)[: breadth.coarse], fitted)
        coarse_fits = self.run(_continued, [(self.data, t, COARSE - STARTING) for t in chosen])
        return coarse_fits, [*started, *seen, *unseen]

    def _screened(
        self, base: Model, fitted: Fitted, candidates: Sequence[Candidate], breadth: Breadth
    ) -> tuple[list[Tried], list[Tried]]:
        """Every law after its screening fit; those whose period is noise, as they set out."""
        linearised_fits = self.linearised(base, fitted, candidates)
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
        screened = self.run(screening_fit, tasks)
        tried = [Tried(c, m, g) for (c, _), m, g in zip(laws, models, screened, strict=True)]
        return tried[: len(placed)], tried[len(placed) :]

    def linearised(
        self, base: Model, fitted: Fitted, candidates: Sequence[Candidate]
    ) -> dict[tuple, Fitted]:
        """The base with its derivatives, as it is and with the friction across that laws bring."""
        kinds = list(dict.fromkeys([(), *(_across(base, c) for c in candidates)]))
        models = [replace(base, settings={**base.settings, **dict(kind)}) for kind in kinds]
        tasks = [(self.data, m, fitted, bool(kind)) for kind, m in zip(kinds, models, strict=True)]
        linearised_fits = self.run(linearised, tasks)
        return dict(zip(kinds, linearised_fits, strict=True))

    def _promising(
        self, base: Model, fitted: Fitted, candidates: Sequence[Candidate]
    ) -> list[Candidate]:
        """Those whose response goes best with what is left, and all that are periodic."""
        kept = [c for c in candidates if c.periodic]
        laws = [c for c in candidates if not c.periodic]
        explained = score_test(self.data.short, base, fitted, laws, self.mapped).gains()
        best = np.argsort(-explained, kind="stable")[:PROMISING]
        return kept + [laws[i] for i in sorted(best)]

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
            responses = self.run(frequency_response, calls)
            periods = {law.periodic: law for law in laws}
            scanned = self.run(scan, [(law, responses) for law in periods.values()])
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
    """So many rounds on; phases that seem better may lead nowhere."""
    again = coarse_fit(data, tried.model, rounds, tried.coarse)
    return replace(tried, coarse=min(again, tried.coarse, key=lambda fitted: fitted.cost))
