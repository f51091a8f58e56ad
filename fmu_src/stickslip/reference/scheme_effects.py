"""Effects of the catalogue in the study's scheme: added to its loads, all off by default.

What each effect is stands in `stickslip.effects`; here it takes the form that the scheme's own
elements allow: springs linear in x, y and phi, a disc of strips along y, stick judged along x.
With all faults mended and the block guided along x it is the kernel's (the tests hold it to that).
"""

from typing import NamedTuple


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
