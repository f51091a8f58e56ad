"""Block on a spring and a belt, Coulomb friction F_s > F_k: the limit cycle in closed form.

With a = (F_s - F_k)/k and omega = sqrt(k/m) a slip begins at x = F_s/k with the belt's speed v and
is a free oscillation about F_k/k of amplitude sqrt(a^2 + v^2/omega^2); it ends where the block has
that speed again, at F_k/k - a, and the belt carries the block back.

Does it stick, or slide for ever? In closed form, from three starts.

With Coulomb friction F_s >= F_k, damping c against the frame, omega = sqrt(K/m) and
zeta = c/(2 m omega), a slip is a free vibration about F_k/K,

    x = F_k/K + exp(-zeta omega t) (A cos omega_d t + B sin omega_d t),

and it ends where the block again has the belt's speed. From rest on a belt of the speed v, the
fastest that the block comes to is its first velocity peak, so that it sticks at all where

    v <= (F_k/(m omega)) exp(-zeta arccos(zeta)/sqrt(1 - zeta^2));

without damping, where v <= F_k/(m omega). Riding on the belt it breaks away at (F_s - c v)/K with
the speed v; without damping and with F_s > F_k it then always comes back to that speed. On a belt
that runs up as v t/t_r stick and slip follow one another as long as a slip catches up with the
belt, which grows faster by v/t_r all the while: the sequence is worked off piece by piece.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import brentq, minimize_scalar


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


#: Places in a period at which a slip's velocity is looked at before its roots are refined.
PLACES = 400
#: Touching the belt's speed to this part of it is reaching it.
TOUCH = 1e-12


@dataclass(frozen=True)
class BeltStart:
    """An oscillator (F_s > F_k), damping N s/m, and a belt that is at its speed after run_up s."""

    oscillator: CoulombOscillator
    damping: float = 0.0
    run_up: float = 0.0

    def __post_init__(self) -> None:
        if not 0.0 <= self.ratio < 1.0:
            raise ValueError(
                f"damping = {self.damping:g} N s/m: a vibration has 0 to less than "
                f"{2.0 * self.oscillator.mass * self.oscillator.omega:g}"
            )
        if not self.run_up >= 0.0:
            raise ValueError(f"run_up = {self.run_up:g} s: must not be negative")

    @property
    def ratio(self) -> float:
        """Damping ratio zeta."""
        return self.damping / (2.0 * self.oscillator.mass * self.oscillator.omega)

    @property
    def fastest_from_rest(self) -> float:
        """Speed of the belt above which a block that starts from rest never sticks, m/s."""
        zeta, o = self.ratio, self.oscillator
        decay = math.exp(-zeta * math.acos(zeta) / math.sqrt(1.0 - zeta * zeta))
        return o.kinetic_force / (o.mass * o.omega) * decay

    def sticks_riding(self) -> bool:
        """Is a block that has ridden on the belt at full speed caught again after it slips?"""
        o = self.oscillator
        place = (o.static_force - self.damping * o.belt_speed) / o.stiffness
        return self._caught(place, o.belt_speed, math.inf) is not None

    def sticks_from_rest(self) -> bool:
        """Does a block at rest at x = 0 on a belt at full speed come to stick, and go on so?"""
        return self.oscillator.belt_speed <= self.fastest_from_rest and self.sticks_riding()

    def sticks_after_run_up(self) -> bool:
        """Does a block that rests on the belt as that starts still stick when it is at speed?"""
        time, place = 0.0, 0.0
        while time < self.run_up:
            slip = self._breaks_away(time, place)
            if slip is None:
                break
            caught = self._caught(slip[1], self._speed(slip[0]), slip[0])
            if caught is None:
                return False
            time, place = caught
        return self.sticks_riding()

    def _speed(self, time: float) -> float:
        """Of the belt, m/s."""
        v = self.oscillator.belt_speed
        return v if time >= self.run_up else v * time / self.run_up

    def _breaks_away(self, time: float, place: float) -> tuple[float, float] | None:
        """Time and place, s and m, of a stick's end within the speed ramp; None if later.

        K x + c V + m a = F_s with the belt's acceleration a: a quadratic in time.
        """
        o, a = self.oscillator, self.oscillator.belt_speed / self.run_up
        speed = self._speed(time)
        rest = o.stiffness * place + self.damping * speed + o.mass * a - o.static_force
        if rest >= 0.0:
            return time, place
        slope, curve = o.stiffness * speed + self.damping * a, 0.5 * o.stiffness * a
        held = (-slope + math.sqrt(slope * slope - 4.0 * curve * rest)) / (2.0 * curve)
        if time + held >= self.run_up:
            return None
        return time + held, place + speed * held + 0.5 * a * held * held

    def _caught(self, place: float, speed: float, begin: float) -> tuple[float, float] | None:
        """Time and place at which a slip that begins at ``begin`` (inf: after the speed ramp) ends.

        None where it never does: its velocity does not reach the belt's in the speed ramp, nor in
        the first period after it, and later ones are no faster.
        """
        o = self.oscillator
        decay, rate = self.ratio * o.omega, o.omega * math.sqrt(1.0 - self.ratio**2)
        first = place - o.centre
        second = (speed + decay * first) / rate
        if math.isinf(begin):
            begin = self.run_up

        def x(t: Any) -> Any:
            return o.centre + np.exp(-decay * t) * (
                first * np.cos(rate * t) + second * np.sin(rate * t)
            )

        def behind(t: Any) -> Any:
            velocity = np.exp(-decay * t) * (
                (second * rate - decay * first) * np.cos(rate * t)
                - (first * rate + decay * second) * np.sin(rate * t)
            )
            belt = o.belt_speed * (np.minimum(1.0, (begin + t) / self.run_up) if self.run_up else 1)
            return belt - velocity

        period = 2.0 * math.pi / rate
        length = max(0.0, self.run_up - begin) + 1.25 * period
        times = np.linspace(0.0, length, max(2, math.ceil(PLACES * length / period)) + 1)
        end = _first_touch(behind, times, TOUCH * o.belt_speed)
        return None if end is None else (begin + end, float(x(end)))


def _first_touch(behind: Callable[[Any], Any], times: np.ndarray, touch: float) -> float | None:
    """First time after the start at which ``behind`` is 0 or below."""
    values = behind(times)
    for i in range(1, times.size - 1):
        if values[i] <= touch and values[i - 1] > touch and i > 1:
            return float(brentq(behind, times[i - 1], times[i])) if values[i] < 0.0 else times[i]
        if i > 1 and values[i - 1] > values[i] < values[i + 1]:
            least = minimize_scalar(
                behind,
                bounds=(times[i - 1], times[i + 1]),
                method="bounded",
                options={"xatol": 1e-12},
            )
            if least.fun <= touch:
                if least.fun >= 0.0:
                    return float(least.x)
                return float(brentq(behind, times[i - 1], least.x))
    return None
