"""Rise of the belt where it enters the contact, against independently computed figures.

The figures come from a separate finite-element prototype of this rig (4.03 N, k 0.5 W/mK), which
took the contact as 8 cm by 7.5 cm = 0.0060 m2 on belt and ice, and cooled neither face of the belt
below the block: here a rectangular contact and a railing that only covers. They are printed with
two or three digits. The disc that the sample really has touches 0.0049 m2, and nothing covers the
belt's back.
"""

import numpy as np
import pytest

from thermal import Belt, Contact, Ice, SteadySliding, ThermalParameters

FORCE, DURATION = 4.03, 30.0
LENGTH, WIDTH = 0.08, 0.075
REPRODUCED = 0.02
FILMS = (5, 15, 25)  # W/m2K

#: length m, speed m/s -> rise K for each film, as printed.
SHARED = {
    (1, 0.15): ("0.129", "0.090", "0.065"), (1, 0.50): ("0.484", "0.364", "0.284"),
    (1, 0.82): ("0.816", "0.620", "0.489"), (2, 0.82): ("0.515", "0.363", "0.269"),
    (4, 0.82): ("0.286", "0.188", "0.130"),
}  # fmt: skip
ALL_TO_BELT = {
    (1, 0.15): ("0.284", "0.178", "0.117"), (1, 0.82): ("1.75", "1.16", "0.82"),
    (2, 0.82): ("0.86", "0.55", "0.38"), (4, 0.82): ("0.42", "0.26", "0.17"),
}  # fmt: skip
STEADY_ALL_TO_BELT = {
    (1, 0.15): ("0.83", "0.25", "0.13"), (1, 0.82): ("4.75", "1.55", "0.91"),
    (2, 0.82): ("2.25", "0.72", "0.42"), (4, 0.82): ("1.08", "0.33", "0.18"),
}  # fmt: skip

#: An ice that takes next to nothing: all friction heat goes to the belt.
NO_ICE = Ice(conductivity=1e-6)
PROTOTYPE = {"contact": Contact(radius=np.sqrt(LENGTH * WIDTH / np.pi), length=LENGTH)}


def sliding(length, speed, h, **blocks):
    belt = Belt(length=length, air_heat_transfer=h, cell_length=2e-3, railing_length=LENGTH)
    return SteadySliding(ThermalParameters(belt=belt, **PROTOTYPE, **blocks), speed, FORCE)


def close(printed):
    """Within 2 %, and half a unit of the last digit that is printed."""
    digits = len(printed.split(".")[1])
    return pytest.approx(
        float(printed), rel=0.0, abs=REPRODUCED * float(printed) + 0.5 * 10.0**-digits
    )


#: What the ice takes, and whether it is at the end of the run or long after.
TABLES = {
    "shared with the ice": (SHARED, {}, False),
    "all to the belt": (ALL_TO_BELT, {"ice": NO_ICE}, False),
    "all to the belt, steady": (STEADY_ALL_TO_BELT, {"ice": NO_ICE}, True),
}


@pytest.mark.parametrize(
    ("table", "case"), [(name, case) for name, (table, *_) in TABLES.items() for case in table]
)
def test_rise_of_the_belt_is_as_printed(table, case):
    printed, blocks, settles = TABLES[table]
    for h, rise in zip(FILMS, printed[case], strict=True):
        state = sliding(*case, h, **blocks)
        found = state.settle() if settles else state.run(DURATION)
        assert found.entry == close(rise), h
