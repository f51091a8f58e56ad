"""C1: the stiffness matrices of the four spring-angle treatments."""

from __future__ import annotations

import numpy as np
from stickslip.reference.spring_angles import (
    ATTACHMENT_RADIUS,
    attachments,
    fixed_angles,
    stiffness_matrix,
    stiffness_over_k,
)

from ..claim import Check, Claim, Margin, Row, Turn
from ..printed import MATRICES

DIGITS = 5
NAMES = "xyφ"
UNITS = {0: "1", 1: "m", 2: "m²"}


def judge() -> Claim:
    """Every printed entry against K = k sum g gT."""
    rows, checks = [], []
    for treatment, entries in MATRICES.items():
        ours = stiffness_matrix(fixed_angles(treatment))
        expected = np.zeros((3, 3))
        for (i, j), value in entries.items():
            expected[i, j] = expected[j, i] = value.number
            rows.append(
                Row(
                    f"K_{NAMES[i]}{NAMES[j]}/k, {treatment}",
                    UNITS[(i == 2) + (j == 2)],
                    value,
                    float(ours[i, j]),
                    float(ours[i, j]),
                    digits=6,
                )
            )
        same = bool(np.array_equal(np.round(ours, DIGITS), expected))
        says = f"{treatment}: all nine entries to {DIGITS} decimals"
        apart = float(np.abs(ours - expected).max())
        checks.append(
            Check(
                says,
                same,
                same,
                None,
                margin=Margin(f"{treatment}: largest difference", apart, 0.5 * 10.0**-DIGITS),
                turns=(_other_radius(treatment, expected),),
            )
        )
    return Claim(
        "C1",
        "the stiffness matrices of the spring-angle treatments",
        tuple(rows),
        tuple(checks),
        remarks=(
            "The fourth treatment starts from the matrix of the first. The exact model needs no "
            "stiffness matrix; its small vibrations are checked in C4.",
        ),
        place="§4.2.2, eq. 4.16 to 4.18",
        rests="the printed r, β and α alone",
    )


def _other_radius(treatment: str, expected: np.ndarray) -> Turn:
    """The least attachment radius above the study's with which a printed digit changes."""
    matrix, radius = np.empty((3, 3)), ATTACHMENT_RADIUS
    while True:
        radius += 1e-5
        stiffness_over_k(fixed_angles(treatment), attachments(radius), matrix)
        if not np.array_equal(np.round(matrix, DIGITS), expected):
            break
    return Turn(
        f"{treatment}: r of {1e3 * radius:.2f} instead of {1e3 * ATTACHMENT_RADIUS:.0f} mm",
        f"K_φφ/k {matrix[2, 2]:.6f} m²",
        False,
    )
