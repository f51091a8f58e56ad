"""Whether `none` holds in longer segments too: what is slow, or rare, hides in short ones.

A segment sets out from a state of its own, and friction of its stretch is its own: in little more
than a cycle that may make up for what is missing.
"""

from __future__ import annotations

import math

from cosim.gap.estimation.preparation import CYCLES
from cosim.gap.estimation.trial import Trial
from cosim.gap.evidence.settled import settled
from cosim.gap.selection.decision import TAIL
from cosim.gap.selection.verdict import Finding
from cosim.processes import Map

from .models import Bench


def left_in_longer(bench: Bench, finding: Finding, plain: Trial, mapped: Map) -> float:
    """What the plain model leaves in long segments, in units of the noise; 0 where that is noise.

    plain : fitted in them from where it stands in short ones; where that leaves more than noise it
    sets out anew from the balance of forces
    """
    if finding.verdict != "none" or plain.fit_rms <= TAIL:
        return 0.0
    runs = [bench.runs[i] for i in bench.fitted]
    anew = settled(bench.data.fit, runs, finding.ladder[0].settled.model, mapped=mapped)
    left = math.sqrt(max(anew.evidence, 0.0) / anew.rows)
    return left if left > TAIL else 0.0


def hidden_line(left: float) -> str:
    """What is said of it."""
    return (
        f"the plain model leaves noise in stretches of a cycle, and {left:.2g} times that over "
        f"{CYCLES} cycles on end: what is missing shows in long stretches alone"
    )
