"""Block on a spring and a belt, Coulomb friction F_s > F_k: the limit cycle in closed form.

With a = (F_s - F_k)/k and omega = sqrt(k/m) a slip begins at x = F_s/k with the belt's speed v and
is a free oscillation about F_k/k of amplitude sqrt(a^2 + v^2/omega^2); it ends where the block has
that speed again, at F_k/k - a, and the belt carries the block back.
"""

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class CoulombOscillator:
    """mass kg; stiffness N/m (of all springs together); belt_speed m/s > 0; forces N."""

    mass: float
    stiffness: float
    belt_speed: float
    static_force: float
    kinetic_force: float

    def __post_init__(self) -> None:
        for name in ("mass", "stiffness", "belt_speed"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"{name} = {getattr(self, name):g}: must be above 0")
        if not self.static_force >= self.kinetic_force >= 0.0:
            raise ValueError(
                f"kinetic_force = {self.kinetic_force:g} N: must lie between 0 and static_force = "
                f"{self.static_force:g} N"
            )

    @property
    def omega(self) -> float:
        """sqrt(k/m), rad/s."""
        return math.sqrt(self.stiffness / self.mass)

    @property
    def excess(self) -> float:
        """a = (F_s - F_k)/k, m: where slip begins, measured from the slip's own centre."""
        return (self.static_force - self.kinetic_force) / self.stiffness

    @property
    def centre(self) -> float:
        """F_k/k, m."""
        return self.kinetic_force / self.stiffness

    @property
    def slip_time(self) -> float:
        """(2/omega) (pi - arctan(a omega / v)), s."""
        angle = math.atan2(self.excess * self.omega, self.belt_speed)
        return 2.0 / self.omega * (math.pi - angle)

    @property
    def stick_time(self) -> float:
        """2 a / v, s."""
        return 2.0 * self.excess / self.belt_speed

    @property
    def period(self) -> float:
        """s"""
        return self.slip_time + self.stick_time

    @property
    def slip_share(self) -> float:
        """Fraction of the period in slip."""
        return self.slip_time / self.period

    @property
    def amplitude(self) -> float:
        """sqrt(a^2 + v^2/omega^2), m: the extremes of x are `centre` -+ this."""
        return math.hypot(self.excess, self.belt_speed / self.omega)

    @property
    def mean_x(self) -> float:
        """Mean of x over a period, m: F_k/k, whatever the belt's speed.

        Slip begins and ends with the same velocity, so its mean acceleration is zero and the
        springs balance the friction in the mean; stick runs from F_k/k - a to F_k/k + a.
        """
        return self.centre
