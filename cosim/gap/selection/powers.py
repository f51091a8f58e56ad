"""A finding whose strengths go with mass, speed or stiffness where that is needed.

A law may be the catalogue's and its strength another in every set-up. Where an exponent is told
from nothing, and the model with it predicts runs better, it is part of what was found; and what was
left without it is judged anew.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from stickslip.effects.candidate import Candidate

from cosim.gap.camera.faults import is_fault
from cosim.gap.data import MeasuredRun
from cosim.gap.estimation.segmented_run import SegmentedRun
from cosim.gap.evidence.settled import Settled

from .scaling import Exponent, exponents, fitted_exponents, rescaled
from .tried import gain
from .verdict import Finding, concluded

#: Effect -> quantity -> its exponent, and whether it is part of the model.
Powers = Mapping[str, Mapping[str, tuple[Exponent, bool]]]


def with_powers(
    finding: Finding, segmented: Sequence[SegmentedRun], runs: Sequence[MeasuredRun]
) -> tuple[Finding, Powers]:
    """The finding with the exponents that its last step needs, and every one that was tested."""
    settled, found = finding.ladder[-1].settled, {}
    for law in _laws(finding):
        there = fitted_exponents(settled, law, len(runs))
        if there:
            found[law.effect] = {name: (one, True) for name, one in there.items()}
            continue
        tested = exponents(settled, runs, law)
        after, held = _with(settled, segmented, runs, law, tested)
        settled = after
        found[law.effect] = {name: (one, held and one.needed) for name, one in tested.items()}
    if settled is finding.ladder[-1].settled:
        return finding, found
    return _judged_anew(finding, settled), found


def _laws(finding: Finding) -> list[Candidate]:
    """What the last step is made of; a camera's fault has no strength of this kind."""
    laws = [rung.members[0].candidate for rung in finding.ladder if rung.members]
    return [law for law in laws if not is_fault(law.effect)]


def _with(
    settled: Settled,
    segmented: Sequence[SegmentedRun],
    runs: Sequence[MeasuredRun],
    law: Candidate,
    tested: Mapping[str, Exponent],
) -> tuple[Settled, bool]:
    """The model with the exponents that are needed, if it is the better for them."""
    if not any(one.needed for one in tested.values()):
        return settled, False
    after = rescaled(segmented, runs, settled, law, tested)
    return (after.settled, True) if after.repairs else (settled, False)


def _judged_anew(finding: Finding, settled: Settled) -> Finding:
    """By the same rule, with another model on its last step."""
    last = finding.ladder[-1]
    more = gain(settled, last.settled)
    ladder = (*finding.ladder[:-1], replace(last, settled=settled, gain=last.gain + more))
    return concluded(ladder, finding.ranking)
