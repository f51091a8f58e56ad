"""What the study's scheme can be asked for: its faults one by one, and effects of the catalogue.

F1 to F6 keep the numbers under which they are known; F12 to F15 are further ones, found when the
scheme was written anew.

What each effect is stands in `stickslip.effects`; here it is added to the scheme's loads, off by
default, in the form that the scheme's own elements allow: springs linear in x, y and phi, a disc of
strips along y, stick judged along x. With all faults mended and the block guided along x it is the
kernel's (the tests hold it to that).
"""

from dataclasses import dataclass, fields, replace
from typing import NamedTuple, Self

DESCRIPTIONS = {
    "F1": "stick ends where k x, not 4 k x, reaches mu_s N",
    "F2": "the attachment radius is missing from the rise that sets the spring angles",
    "F5": "the scatter of friction is white per sample, so its effect depends on the time step",
    "F6": "re-stick asks for x' alone, every 10 ms: not for its moment, nor whether friction holds",
    "F12": "after a stick, velocities and spring angles of before the last slip block come back",
    "F13": "springs on the +x side get the spring angle of the -x side instead of its mirror image",
    "F14": "a slip of more than 100 blocks (1 s) is cut: the block jumps to the belt's speed",
    "F15": "friction that depends on speed keeps the speeds of the block's beginning for 10 ms",
}


@dataclass(frozen=True)
class Faults:
    """One flag a fault; True is as the study prints it. The default is the printed scheme."""

    F1: bool = True
    F2: bool = True
    F5: bool = True
    F6: bool = True
    F12: bool = True
    F13: bool = True
    F14: bool = True
    F15: bool = True

    @classmethod
    def mended(cls) -> Self:
        """None of them."""
        return cls(**{field.name: False for field in fields(cls)})

    def without(self, *ids: str) -> Self:
        """These faults mended; ValueError for an unknown one."""
        return replace(self, **{known(one): False for one in ids})

    def only(self, *ids: str) -> Self:
        """These faults and no other; ValueError for an unknown one."""
        return replace(self.mended(), **{known(one): True for one in ids})


def known(fault: str) -> str:
    """``fault`` itself, or ValueError with the ids that are allowed."""
    if fault not in DESCRIPTIONS:
        raise ValueError(f"fault {fault!r}: allowed are {', '.join(DESCRIPTIONS)}")
    return fault


PRINTED = Faults()
MENDED = Faults.mended()


class SchemeEffects(NamedTuple):
    """Numbers of the effects; SI units, rad. `on` says whether there are any.

    stick_springs: springs counted in stick, 0 for what fault F1 says.
    """

    on: bool = False
    stick_springs: float = 0.0
    lateral: float = 0.0
    ageing: float = 0.0
    hold_time: float = 0.01
    film: float = 0.0
    weakening_per_joule: float = 0.0
    relaxation: float = 5.0
    run_in: float = 0.0
    run_in_distance: float = 1.0
    cubic: float = 0.0
    damping: float = 0.0
    damping_rotation: float = 0.0
    ripple: float = 0.0
    ripple_rate: float = 1.0
    ripple_phase: float = 0.0
    pattern: float = 0.0
    pattern_wavenumber: float = 1.0
    pattern_phase: float = 0.0
    spring_angle: float = 0.0
    anchor_offset: float = 0.0


NO_EFFECTS = SchemeEffects()
