"""What two effects share by which mu_k drifts: how much of the drift mu_s takes.

A drift that multiplies mu_k by f makes of mu_s

    mu_s (1 + (f - 1) (r + a mu_k / mu_s)).

r = 1: mu_s moves in proportion, as where the real area of contact changes; a = 1: by as much as
mu_k, as where what a contact at rest holds beyond that is of its own kind; both 0: mu_s stays.
"""

from typing import Any

from ..quantity import quantity


def static_share() -> Any:
    """r, or a."""
    return quantity(0.0, "1", ge=0, le=2, tried=(0.0, 1.0))


#: Form of a candidate beside that in which mu_s stays -> the parameter that is set to 1.
STATIC_FORMS = {"mu_s in proportion": "static_relative", "mu_s by as much": "static_absolute"}


def static_factor(
    kinetic_factor: float, static_relative: float, static_absolute: float, mu_s: float, mu_k: float
) -> float:
    """mu_s over its value at the start, from what the effect makes of mu_k."""
    share = static_relative
    if mu_s > 0.0:
        share += static_absolute * mu_k / mu_s
    return max(0.0, 1.0 + share * (kinetic_factor - 1.0))
