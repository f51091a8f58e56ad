"""C1: the stiffness matrices of the four spring-angle treatments."""

from __future__ import annotations

import numpy as np
from stickslip.reference.spring_angles import fixed_angles, stiffness_matrix

from ..claim import Check, Claim, Row

DIGITS = 5
#: K/k as printed: (treatment, entry) -> figure; what is not listed is printed as 0
PRINTED_ENTRIES = {
    "zero": {(0, 0): 4.0, (2, 2): 0.00117},
    "constant": {(0, 0): 3.99878, (0, 1): 0.06980, (1, 1): 0.00122, (2, 2): 0.00117},
    "opposed": {(0, 0): 3.99878, (1, 1): 0.00122, (1, 2): -0.00119, (2, 2): 0.00117},
}
NAMES = "xyφ"
UNITS = {0: "1", 1: "m", 2: "m²"}


def judge() -> Claim:
    """Every printed entry against K = k sum g gT."""
    rows, checks = [], []
    for treatment, entries in PRINTED_ENTRIES.items():
        ours = stiffness_matrix(fixed_angles(treatment))
        expected = np.zeros((3, 3))
        for (i, j), value in entries.items():
            expected[i, j] = expected[j, i] = value
            rows.append(Row(
                f"K_{NAMES[i]}{NAMES[j]}/k, {treatment}", UNITS[(i == 2) + (j == 2)], value,
                float(ours[i, j]), float(ours[i, j]), digits=6,
            ))
        same = bool(np.array_equal(np.round(ours, DIGITS), expected))
        says = f"{treatment}: all nine entries to {DIGITS} decimals"
        checks.append(Check(says, same, same, None))
    return Claim(
        "C1", "the stiffness matrices of the spring-angle treatments", tuple(rows), tuple(checks),
        remarks=(
            "The fourth treatment starts from the matrix of the first. The exact model needs no "
            "stiffness matrix; its small vibrations are checked in C4.",
        ),
    )
