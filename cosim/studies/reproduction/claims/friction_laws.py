"""C16 to C18: dry or lubricated, falling with the sliding speed, strengthening at rest."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from cosim.studies.belt_length import Protocol

from .. import cases
from ..cases import DATASET_1, GUIDED, SPEEDS, STIFFNESSES, WEAKENING, Case
from ..claim import Claim
from ..motion import Motion
from ..sheet import Sheet
from .belt_length import belt_case

#: Ice that is warmed to melting where it touches, and a film that is sheared: dry at rest alone.
#: Assumed, as in the packaged scenario `melting_friction`.
DRY = 0.50
MELTING = {
    "rig": GUIDED,
    "friction": {"mu_s": 0.55, "mu_k": DRY},
    "asperity_melting": {"length": 1e-2, "hardness": 2e7},
    "melt_film": {"wetted_share": 7e-4, "length": 1e-2},
}
MELTED = 0.5  # part of the dry value below which friction is that of melting


def _face_degC(case: Case) -> float:
    """Of the ice after a run of 30 s, all friction heat at the contact; finite elements."""
    protocol = Protocol(ramp=0.0, run=cases.SETTLING + cases.WINDOW)
    belt = replace(belt_case(1.0, speed=case.speed), mass=case.mass, friction=case.mu_k)
    belt = replace(belt, protocol=protocol)
    return belt.ambient_degC + belt.follow(belt.sliding())[1].ice_face


def judge_dry_friction() -> Claim:
    """C16: no melting of the face by finite elements; sticking of a block whose asperities melt."""
    sheet, melting = Sheet("C16"), cases.exact_figures(DATASET_1, **MELTING)
    share, part = melting.slip_share, melting.mean_friction / (DRY * DATASET_1.weight)
    sheet.rows("dry", cases.tabulated("slip_share", [DATASET_1], cases.SEEDS))
    sheet.row("melting", [None, None, share])
    sheet.row("friction", [None, None, part])
    faces = [_face_degC(case) for case in DATASET_1.over("speed", (SPEEDS[0], SPEEDS[-1]))]
    for speed, face in zip((SPEEDS[0], SPEEDS[-1]), faces, strict=True):
        sheet.row("face", [None, None, face], v=speed)
    sheet.check("face", [None, None, max(faces)])
    sheet.check("contact", answers=[None, None, not (share < 1.0 and part < MELTED)], margin=share)
    for case in DATASET_1.over("speed", SPEEDS[1:3]):
        faster = cases.exact_figures(case, **MELTING).slip_share
        sheet.turn("speed", faster, sound=faster == 1.0, v=case.speed)
    return sheet.claim(sticks=100.0 * (1.0 - share), part=100.0 * part)


def judge_falling_friction() -> Claim:
    """C17: mean slip times of the two approaches to friction, in three models."""
    sheet, both = Sheet("C17"), DATASET_1.over("weakening", (0.0, WEAKENING))
    before, after = cases.tabulated("slip_time", both, cases.SEEDS).T
    sheet.row("steady", before)
    sheet.row("falling", after)
    sheet.check("longer", after / before)
    for name, numbers in sheet.turns("case").items():
        falling = DATASET_1.changed(**numbers)
        both = falling.over("weakening", (0.0, falling.weakening))
        pair = cases.exact_table("slip_time", both, rig=GUIDED)
        sheet.turn(name, pair[1] / pair[0], times=pair)
    return sheet.claim()


#: Hold by speed above which strengthening is told to be considerable, m.
THRESHOLD = 1e-4
#: Growth of mu_s in a decade of the hold time, and its uncertainty (§2.4).
GROWTH, UNCERTAIN = 0.30, 0.03
#: A coefficient contains what differs by no more than this part of it from run to run.
CONTAINED = 0.1
#: Of the series: softest and stiffest, slowest and fastest that a block sticks on in every model.
SERIES = [
    DATASET_1.changed(stiffness=k, speed=v)
    for k in (STIFFNESSES[0], STIFFNESSES[-1])
    for v in (SPEEDS[0], SPEEDS[3])
]


def hold(motion: Motion) -> float:
    """Median duration of a stick, s."""
    sticks = motion.phases[motion.phases[:, 2] == 0]
    lengths = sticks[:, 1] - sticks[:, 0]
    return float(np.median(lengths[lengths > 0.0]))  # the scheme has sticks that end as they begin


def _holds(case: Case) -> list[float]:
    """As printed, mended, exact, s."""
    printed, mended, exact = cases.three_motions(case, rig=GUIDED)
    steady = printed.last(cases.STEADY), mended.last(cases.STEADY), exact.between(cases.SETTLING)
    return [hold(motion) for motion in steady]


def judge_strengthening() -> Claim:
    """C18: hold times of the series against the threshold, and what they would make of mu_s."""
    sheet, needed = Sheet("C18"), THRESHOLD / SPEEDS[0]
    times = np.array([_holds(case) for case in SERIES])
    factors = times.max(axis=0) / times.min(axis=0)
    spreads = GROWTH * np.log10(factors)
    sheet.row("needed", derived=1e4 * needed)
    sheet.rows("hold", times.T, of=SERIES)
    sheet.row("spread", spreads)
    sheet.check("holds", times[0], limit=needed)
    sheet.turn("measured", sound=times[0, 2] > 0.3, hold=times[0, 2])
    sheet.check("contains", spreads, limit=CONTAINED * DATASET_1.mu_s)
    sheet.turn("weaker", (GROWTH - UNCERTAIN) * np.log10(factors[2]))
    return sheet.claim(factor=factors[2], spread=spreads[2])
