"""C16: whether a block that sticks shows that its friction is dry."""

from __future__ import annotations

from functools import cache
from typing import Any

from stickslip import Parameters
from stickslip.reference.scheme_errors import MENDED, PRINTED

from thermal import BeltIceModel, ThermalParameters

from ..cases import (
    DATASET_1,
    GUIDED,
    SETTLING,
    SPEEDS,
    WINDOW,
    Case,
    exact_motion,
    exact_parameters,
    scheme_figures,
)
from ..claim import FAR, Check, Claim, Margin, Row, Turn
from ..motion import figures

MACRO_STEP = 0.1  # s: a face that stays 7 K below melting needs no finer one
#: Ice that is warmed to melting where it touches, and a film that is sheared: dry at rest alone.
#: Assumed, as in the packaged scenario `melting_friction`.
MELTING = {
    "friction": {"mu_s": 0.55, "mu_k": 0.50},
    "asperity_melting": {"length": 1e-2, "hardness": 2e7},
    "melt_film": {"wetted_share": 7e-4, "length": 1e-2},
}
#: Part of the dry value below which friction is that of melting, 1
MELTED = 0.5


@cache
def face_temperature(case: Case) -> float:
    """Of the ice after a run of 30 s, degC, all friction heat at the contact; finite elements."""
    model = BeltIceModel(ThermalParameters())
    force = case.mu_k * case.weight
    for _ in range(round((SETTLING + WINDOW) / MACRO_STEP)):
        travel = case.speed * MACRO_STEP
        model.step(MACRO_STEP, force * travel, travel)
    return float(model.outputs()["ice_face_temperature"])


def _melting(case: Case) -> Parameters:
    """The exact model whose friction is that of melting."""
    tables: dict[str, Any] = {"rig": GUIDED, **MELTING}
    return exact_parameters(case, **tables)


@cache
def lubricated() -> tuple[float, float]:
    """Share of the time in slip of a block on melting asperities, and its friction by the dry."""
    parameters = _melting(DATASET_1)
    ours = figures(exact_motion(parameters).since(SETTLING))
    return ours.slip_share, ours.mean_friction / (MELTING["friction"]["mu_k"] * DATASET_1.weight)


def judge() -> Claim:
    """No melting of the face by finite elements; sticking of a block whose asperities melt."""
    fastest = DATASET_1.changed(speed=SPEEDS[-1])
    face = {case: face_temperature(case) for case in (DATASET_1, fastest)}
    share, part = lubricated()
    guided = exact_motion(exact_parameters(DATASET_1, rig=GUIDED)).since(SETTLING)
    printed, mended = (scheme_figures(DATASET_1, faults) for faults in (PRINTED, MENDED))
    return Claim(
        "C16",
        "sticks occur, so the friction is dry",
        (
            Row(
                "share of time in slip, dry friction",
                "1",
                None,
                printed.slip_share,
                mended.slip_share,
                figures(guided).slip_share,
            ),
            Row("share of time in slip, melting asperities and a film", "1", exact=share),
            Row("its friction in slip, by the dry coefficient", "1", exact=part),
            *(
                Row(
                    f"face of the ice after 30 s at {case.speed:g} m/s, from −8 °C",
                    "degC",
                    exact=warm,
                )
                for case, warm in face.items()
            ),
        ),
        (
            Check(
                "the face of the ice does not melt in a run",
                None,
                None,
                all(warm < 0.0 for warm in face.values()),
                margin=Margin("warmest face", max(face.values()), 0.0, "degC"),
            ),
            Check(
                "a contact whose friction is that of melting does not stick",
                None,
                None,
                not (share < 1.0 and part < MELTED),
                margin=Margin("share of time in slip", share, 1.0),
                turns=tuple(_other_speeds()),
            ),
        ),
        remarks=(
            "Water does not hold a block at rest, but ice does not melt at rest either: where "
            "asperities melt in passing, friction falls with the speed, and a block on springs "
            f"sticks and slips the more for it. Ours sticks for {100.0 * (1.0 - share):.0f} % of "
            f"the time, with {100.0 * part:.0f} % of the dry friction in slip.",
            "That the face does not melt as a whole says nothing of asperities: their real contact "
            "is some thousandth of it.",
        ),
        place="§4.6.1",
        rests="whether a lubricated contact can stick; the laws of melting are assumed",
        assumed=("melting friction as in the packaged scenario melting_friction; −8 °C",),
    )


def _other_speeds() -> list[Turn]:
    """The same law on a faster surface."""
    turns = []
    for speed in (SPEEDS[1], SPEEDS[2]):
        parameters = _melting(DATASET_1.changed(speed=speed))
        share = figures(exact_motion(parameters).since(SETTLING)).slip_share
        turns.append(
            Turn(
                f"at {speed} instead of {SPEEDS[0]} m/s",
                f"slip share {share:.3f}",
                share == 1.0,
                FAR,
            )
        )
    return turns
