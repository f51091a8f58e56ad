"""Periodic laws, ready to be fitted: where their periods lie, from a periodogram of the misfit."""

from __future__ import annotations

from collections.abc import Sequence

from stickslip.effects.candidate import Candidate

from cosim.gap.estimation.fitted import Fitted
from cosim.gap.estimation.segmented_run import SegmentedRun
from cosim.gap.estimation.trial import Model
from cosim.processes import Map

from .frequency_response import frequency_response
from .periodogram import NOISE, scan

#: So many periods of an effect are tried, and so many with a second harmonic.
PERIODS, SECONDS = 3, 1


def waves(
    model: Model,
    fitted: Fitted,
    segmented: Sequence[SegmentedRun],
    laws: Sequence[Candidate],
    mapped: Map,
) -> list[Candidate]:
    """The periodic ones of some laws at the periods that stand out of noise.

    fitted : the model laid along the data, with derivatives
    """
    placed = []
    for effect in dict.fromkeys(law.effect for law in laws if law.periodic):
        own = [law for law in laws if law.effect == effect]
        calls = [(own[0], model, fitted.of_run(i), run) for i, run in enumerate(segmented)]
        responses = list(mapped(frequency_response, calls))
        periods = {law.periodic: law for law in own}
        found = dict(
            zip(
                periods,
                mapped(scan, [(law, responses) for law in periods.values()]),
                strict=True,
            )
        )
        strongest = sorted({p.power for peaks in found.values() for p in peaks}, reverse=True)
        for law in own:
            most = SECONDS if law.has_second else PERIODS
            placed += [
                law.at(peak.period, peak.amplitude, peak.step)
                for peak in found[law.periodic]
                if peak.power >= NOISE and peak.power in strongest[:most]
            ]
    return placed
