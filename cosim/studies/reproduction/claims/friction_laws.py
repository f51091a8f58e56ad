"""C16 to C18: dry or lubricated, falling with the sliding speed, strengthening at rest."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from stickslip.reference.scheme_errors import MENDED, PRINTED

from cosim.studies.belt_length import Protocol

from ..cases import (
    DATASET_1,
    DATASET_2,
    GUIDED,
    SEEDS,
    SETTLING,
    SPEEDS,
    STEADY,
    STIFFNESSES,
    WEAKENING,
    WINDOW,
    Case,
    exact_figures,
    exact_motion,
    exact_table,
    scheme_motion,
    tabulated,
)
from ..claim import Claim
from ..motion import Motion
from ..sheet import Sheet
from .belt_length import belt_case

#: Ice that is warmed to melting where it touches, and a film that is sheared: dry at rest alone.
#: Assumed, as in the packaged scenario `melting_friction`.
MELTING = {
    "rig": GUIDED,
    "friction": {"mu_s": 0.55, "mu_k": 0.50},
    "asperity_melting": {"length": 1e-2, "hardness": 2e7},
    "melt_film": {"wetted_share": 7e-4, "length": 1e-2},
}
MELTED = 0.5  # part of the dry value below which friction is that of melting


def _face_degC(case: Case) -> float:
    """Of the ice after a run of 30 s, all friction heat at the contact; finite elements."""
    belt = replace(belt_case(1.0, speed=case.speed), mass=case.mass, friction=case.mu_k)
    belt = replace(belt, protocol=Protocol(ramp=0.0, run=SETTLING + WINDOW))
    return belt.ambient_degC + belt.follow(belt.sliding())[1].ice_face


def judge_dry_friction() -> Claim:
    """C16: no melting of the face by finite elements; sticking of a block whose asperities melt."""
    sheet, slowest, fastest = Sheet("C16"), DATASET_1, DATASET_1.changed(speed=SPEEDS[-1])
    melting = exact_figures(slowest, **MELTING)
    share, part = melting.slip_share, melting.mean_friction / (0.50 * slowest.weight)
    sheet.row("dry", tabulated("slip_share", [slowest], SEEDS)[:, 0])
    sheet.row("melting", [None, None, share])
    sheet.row("friction", [None, None, part])
    faces = [_face_degC(case) for case in (slowest, fastest)]
    for case, face in zip((slowest, fastest), faces, strict=True):
        sheet.row("face", [None, None, face], v=case.speed)
    sheet.check("face", [None, None, max(faces)])
    sheet.check("contact", answers=[None, None, not (share < 1.0 and part < MELTED)], margin=share)
    for speed in SPEEDS[1:3]:
        faster = exact_figures(slowest.changed(speed=speed), **MELTING).slip_share
        sheet.turn("speed", faster, sound=faster == 1.0, v=speed)
    return sheet.claim(sticks=100.0 * (1.0 - share), part=100.0 * part)


def judge_falling_friction() -> Claim:
    """C17: mean slip times of the two approaches to friction, in three models."""
    sheet, falling = Sheet("C17"), DATASET_1.changed(weakening=WEAKENING)
    before, after = tabulated("slip_time", [DATASET_1, falling], SEEDS).T
    sheet.row("steady", before)
    sheet.row("falling", after)
    sheet.check("longer", after / before)
    # the figure's case is not printed
    for speed in (SPEEDS[2], SPEEDS[-1]):
        _turn_falling(sheet, "speed", DATASET_1.changed(speed=speed))
    _turn_falling(sheet, "dataset", DATASET_2)
    for fall in (0.2, 0.6):
        _turn_falling(sheet, "fall", DATASET_1, fall)
    return sheet.claim()


def _turn_falling(sheet: Sheet, name: str, case: Case, fall: float = WEAKENING) -> None:
    """Slip times of the exact model without and with a fall of friction."""
    before, after = exact_table("slip_time", case.over("weakening", (0.0, fall)), rig=GUIDED)
    sheet.turn(name, after / before, v=case.speed, fall=100.0 * fall, before=before, after=after)


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


def judge_strengthening() -> Claim:
    """C18: hold times of the series against the threshold, and what they would make of mu_s."""
    sheet, needed = Sheet("C18"), THRESHOLD / SPEEDS[0]
    times = np.array(
        [
            [
                hold(scheme_motion(case, PRINTED).last(STEADY)),
                hold(scheme_motion(case, MENDED).last(STEADY)),
                hold(exact_motion(case, rig=GUIDED).between(SETTLING)),
            ]
            for case in SERIES
        ]
    )
    factors = times.max(axis=0) / times.min(axis=0)
    spreads = GROWTH * np.log10(factors)
    sheet.row("needed", derived=1e4 * needed)
    for case, row in zip(SERIES, times, strict=True):
        sheet.row("hold", row, k=case.stiffness, v=case.speed)
    sheet.row("spread", spreads)
    sheet.check("holds", times[0], limit=needed)
    sheet.turn("measured", sound=times[0, 2] > 0.3, hold=times[0, 2])
    sheet.check("contains", spreads, limit=CONTAINED * DATASET_1.mu_s)
    sheet.turn("weaker", (GROWTH - UNCERTAIN) * np.log10(factors[2]))
    return sheet.claim(factor=factors[2], spread=spreads[2])
