"""Belt and ice under steady friction: long steps, and the steady state directly.

Seen from the ice a flux that stands still loads a belt that runs below it (`belt.rig_frame`). A
step of any length is exact for fluxes and a speed that are constant in it; a step of endless length
is the steady state: its fixed point, the same for every step. What has to be resolved in time is
only how the fluxes themselves change, quickly at the start, then from loop to loop, and how the
speed does in a ramp: its steps have the mean speed, so the belt's travel is exact at the end of
each.

The strips of the contact, the supports and the heat exchange with the ice are those of
`BeltIceModel`; here the loads are exact Fourier coefficients, there they are hat functions that
travel with the belt.

Where it ends: how warm the interface gets for ever, and when it is nearly there.
"""

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .arrays import Array
from .belt.rig_frame import BeltSeries
from .contact import BeltFace, Fluxes, Footprint, IceFace, exchange
from .ice.block import standing_block
from .ice.body import IceBody
from .parameters import ThermalParameters

#: First steps of a transient: parts of the usual one, since fluxes start like the root of time.
_START = (1 / 32, 1 / 32, 1 / 16, 1 / 8, 1 / 4, 1 / 2)

#: Usual steps in a loop, and the most in a transient: 0.03 % of the rise; half as many 0.2 %.
_STEPS_IN_A_LOOP, _MOST_STEPS = 8, 240

#: Fewest steps in a run, and in a ramp: a slow belt makes but a few loops.
_FEWEST_STEPS, _FEWEST_RAMP_STEPS = 48, 40

#: Last step of a ramp, in parts: the speed at its end is that of the run, not the mean of a step.
_END_OF_RAMP = (1 / 2, 1 / 4, 1 / 8, 1 / 8)

#: Steps in a pause: each longer than the one before by the same factor.
_PAUSE_STEPS, _FIRST_OF_PAUSE = 24, 1e-3


#: A step after which nothing changes any more, s: its mean differs from its end by the part of it
#: that the slowest change (hours) takes.
FOREVER = 1e13

#: Rates below this are those of a belt that keeps its heat, 1/s: a year is 3e7 s.
_KEEPS_HEAT = 1e-9


class NoSteadyState(ValueError):
    """The belt gives no heat away, so it warms for ever; or the ice melts for ever."""


def check_gives_heat(slowest_rate: float, to_supports: bool) -> None:
    """NoSteadyState when a belt gives its heat neither to the air nor to supports."""
    if slowest_rate < _KEEPS_HEAT and not to_supports:
        raise NoSteadyState(
            "belt.air_heat_transfer = 0: a belt that gives its heat to nothing warms for ever and"
            " has no steady state; allowed is above 0, or a railing or rollers that take heat"
        )


class SlidingState(NamedTuple):
    """Temperatures as rises above the air, K; belt_share of the friction heat of the last step.

    mean_interface: mean of the two faces over the contact; hottest_interface: over the hottest
    strip of it. melting: W/m2 of contact, above 0 where the ice face melts.
    """

    time: float
    entry: float
    exit: float
    mean_interface: float
    hottest_interface: float
    ice_face: float
    belt_mean: float
    belt_share: float
    belt_share_so_far: float
    melting: float


class Snapshot(NamedTuple):
    """What a continuation needs of `SteadySliding`."""

    numbers: tuple[float, ...]
    film: float
    belt: NDArray[np.complex128]
    ice: Array


class SteadySliding:
    """Belt at a constant speed (m/s, > 0) under friction (force when cold, N), from a cold start.

    waves: of the Fourier series along the loop; left out, two cells of the belt make the shortest.
    block: contact and ice of these parameters, when they are there from another belt, for the modes
    of the ice take time. sensitivity: part of the friction lost for each kelvin of the interface's
    rise, 1/K. ice_rise: of the ice above the air at the start, K. `air_warming`: of the air while
    the belt runs, K/s, 0 unless it is set. `ramp`, `run` and `pause` make an experiment, `state`
    tells the present temperatures. ValueError for a speed or force that cannot be.
    """

    def __init__(
        self,
        parameters: ThermalParameters,
        speed: float,
        force: float,
        waves: int | None = None,
        block: tuple[Footprint, IceBody] | None = None,
        sensitivity: float = 0.0,
        ice_rise: float = 0.0,
    ) -> None:
        if not (math.isfinite(speed) and speed > 0.0):
            raise ValueError(f"speed = {speed:g} m/s must be above 0: the belt slides steadily")
        if not (math.isfinite(force) and force >= 0.0):
            raise ValueError(f"force = {force:g} N must not be negative: friction produces heat")
        self.parameters: ThermalParameters = parameters
        self.speed: float = speed
        self.force: float = force
        self.footprint, self.ice = standing_block(parameters) if block is None else block
        self.belt: BeltSeries = BeltSeries(parameters.belt, self.footprint, waves)
        self.sensitivity = sensitivity
        self.air_warming: float = 0.0
        self.reset(ice_rise)

    def reset(self, ice_rise: float = 0.0) -> None:
        """Back to a cold belt and an ice of one temperature, K above the air."""
        self.belt.amplitudes[:] = 0.0
        self.ice.fill(ice_rise)
        self._left = 1.0
        self._time = self._into_belt = self._produced = 0.0
        self._sliding = False
        self._fluxes: Fluxes | None = None

    def _ice_face(self, duration: float) -> IceFace:
        area, free = self.footprint.area, self.ice.free_face(duration)
        mean_response, end_response = self.ice.face_response(duration)
        melting = self.parameters.melting_rise
        return IceFace(*free, mean_response * area, end_response * area, melting)

    def step(self, duration: float, speed: float | None = None, lifted: bool = False) -> None:
        """Advance by duration (s, > 0) with constant fluxes.

        speed: of the belt in it, m/s, >= 0; left out, the constant one. lifted: the ice does not
        touch the belt, its base gives heat to the air as its side does.
        """
        if not duration > 0.0:
            raise ValueError(f"duration = {duration:g} s must be positive")
        speed = self.speed if speed is None else speed
        self._warm_air(duration, speed)
        contact = self.belt.step_response(duration, speed)
        friction = 0.0 if lifted else self._friction(speed)
        self._fluxes = fluxes = (
            self._apart(duration) if lifted else self._together(contact.face, duration, friction)
        )
        self.belt.advance(duration, speed, contact.fluxes(fluxes.belt))
        self.ice.advance(duration, fluxes.ice * self.footprint.area)
        self._warm_air(duration, speed)
        self._into_belt += float(fluxes.from_contact.mean()) * duration
        self._produced += friction * duration
        self._time += duration
        if self.sensitivity > 0.0:
            self._left = max(0.0, 1.0 - self.sensitivity * self._interface())

    def _warm_air(self, duration: float, speed: float) -> None:
        """Half of what the air warms in a step: the bodies are that much colder than it."""
        if self.air_warming and speed > 0.0:
            for body in (self.belt, self.ice):
                body.warm(-0.5 * self.air_warming * duration)

    def _together(self, belt: BeltFace, duration: float, friction: float) -> Fluxes:
        ice, contact = self._ice_face(duration), self.parameters.contact
        return exchange(belt, ice, contact, self.belt.film, friction)

    def _apart(self, duration: float) -> Fluxes:
        """Nothing into the belt; the ice's base cools with the mean temperature of the step."""
        ice, h = self._ice_face(duration), self.parameters.ice.air_heat_transfer
        nothing = np.zeros(self.footprint.strips)
        return Fluxes(nothing, nothing, -h * ice.free_mean / (1.0 + h * ice.response_mean), 0.0)

    def _friction(self, speed: float) -> float:
        """Friction heat, W/m2 of contact."""
        return self._left * self.force * speed / self.footprint.area

    def _interface(self) -> float:
        """Mean rise of the two faces over the contact, K."""
        return 0.5 * (float(self.belt.strip_means().mean()) + self.ice.face())

    def run(self, duration: float, coarseness: float = 1.0) -> SlidingState:
        """Advance by a time (s) at the constant speed; the state there.

        The steps follow the loops. coarseness: factor of the steps; 2 changes the temperatures by
        0.4 % of their rise. Of belts on warm rollers the places that lay beside one as the belt
        started are less than a step's way long, and pass the contact under one flux: when they
        enter it again `entry` is 4 % off, with a coarseness of 2 it is 8 %, with 1/2 1 %, with 1/4
        0.3 %.
        """
        if duration > 0.0:
            usual = coarseness * max(
                min(self._of_a_loop(), duration / _FEWEST_STEPS), duration / _MOST_STEPS
            )
            usual = duration / math.ceil(duration / usual)
            start = (1.0,) if self._sliding else _START
            parts = [*start, *[1.0] * (round(duration / usual) - 1)]
            for part in parts:
                self.step(part * usual)
            self._sliding = True
        return self.state()

    def _of_a_loop(self) -> float:
        return self.parameters.belt.length / (self.speed * _STEPS_IN_A_LOOP)

    def ramp(self, duration: float, coarseness: float = 1.0) -> SlidingState:
        """From standstill to the constant speed, evenly in a time (s); the state there."""
        if duration > 0.0:
            usual = max(self._of_a_loop(), duration / _MOST_STEPS)
            count = math.ceil(max(duration / usual, _FEWEST_RAMP_STEPS) / coarseness)
            ends = np.cumsum([0.0, *[1.0] * (count - 1), *_END_OF_RAMP]) / count
            for begin, end in zip(ends[:-1], ends[1:], strict=True):
                self.step(duration * (end - begin), self.speed * 0.5 * (begin + end))
            self._sliding = True
        return self.state()

    def pause(
        self, duration: float, film: float | None = None, lifted: bool = False
    ) -> SlidingState:
        """The belt stands still for a time (s); the state at its end.

        film: heat transfer to the air meanwhile, W/m2K, for a belt that stands drags no air along;
        left out, as when it runs. lifted: the ice is, too.
        """
        if duration > 0.0:
            running = self.belt.film
            self.belt.set_film(running if film is None else film)
            ends = duration * np.geomspace(_FIRST_OF_PAUSE, 1.0, _PAUSE_STEPS)
            for step in np.diff(ends, prepend=0.0):
                self.step(float(step), 0.0, lifted)
            self.belt.set_film(running)
            self._sliding = False
        return self.state()

    def settle(self) -> SlidingState:
        """Go to the steady state; NoSteadyState when the belt gives no heat to anything."""
        check_gives_heat(self.belt.slowest_rate, self.belt.places.take_heat)
        self._left = 1.0
        self.step(FOREVER)
        if self.sensitivity > 0.0:
            # The rises are proportional to the friction, so what it must be follows from one.
            self._left = 1.0 / (1.0 + self.sensitivity * self._interface())
            self.step(FOREVER)
        return self.state()

    def state(self) -> SlidingState:
        """The present temperatures."""
        probe = 0.5 * min(1.25 * self.footprint.length, self.parameters.belt.length)
        entry, exit_ = self.belt.face(np.array([-probe, probe]))
        strips = self.belt.strip_means()
        ice = self.ice.face()
        share = so_far = melting = 0.0
        if self._fluxes is not None and self._produced > 0.0:
            produced = self._fluxes.ice + self._fluxes.melting + self._fluxes.from_contact.mean()
            share = float(self._fluxes.from_contact.mean() / produced) if produced > 0.0 else 0.0
            so_far = self._into_belt / self._produced
            melting = self._fluxes.melting
        return SlidingState(
            time=self._time,
            entry=float(entry),
            exit=float(exit_),
            mean_interface=self._interface(),
            hottest_interface=0.5 * (float(strips.max()) + ice),
            ice_face=ice,
            belt_mean=self.belt.mean_rise(),
            belt_share=share,
            belt_share_so_far=so_far,
            melting=melting,
        )

    def snapshot(self) -> Snapshot:
        """The present temperatures, as a copy."""
        return Snapshot(
            (self._time, self._into_belt, self._produced, self._left),
            self.belt.film,
            self.belt.amplitudes.copy(),
            self.ice.state(),
        )

    def restore(self, snapshot: Snapshot) -> None:
        """Back to a snapshot of standing still, for the friction starts anew."""
        self._time, self._into_belt, self._produced, self._left = snapshot.numbers
        self.belt.set_film(snapshot.film)
        self.belt.amplitudes = snapshot.belt.copy()
        self.ice.restore(snapshot.ice)
        self._fluxes, self._sliding = None, False

    def face(self, x: Array) -> Array:
        """Contact face at places (n,) m behind the contact's middle, K above the air."""
        return self.belt.face(x)


#: Waves of the belt's series in a metre, and at most: the mean interface needs no more, 0.5 %.
_WAVES_PER_METRE, _MOST_WAVES = 150, 1500
#: Steps are so much longer than usual, which changes a rise by less than 1 %.
_COARSENESS = 4.0
#: First look after the ramp, s, and from one to the next a factor; the last, s (some 30 years).
_FIRST, _FACTOR, _LAST = 1.0, 1.5, 1e9


class End(NamedTuple):
    """Of steady sliding that goes on for ever.

    rise: of the interface, mean of the two faces, K above the air; None where the block melts for
    ever. reached: time from standstill, s, from which on the interface is within a part `within` of
    that rise.
    """

    rise: float | None
    reached: float | None
    within: float


@lru_cache(maxsize=16)
def in_the_end(
    parameters: ThermalParameters, speed: float, force: float, ramp: float, within: float = 0.05
) -> End:
    """The end of a belt's sliding at a speed (m/s, > 0) under friction (N, > 0) after a ramp (s).

    NoSteadyState where the belt gives its heat to nothing.

    >>> found = in_the_end(ThermalParameters(), 0.15, 1.4, 10.0)
    >>> round(found.rise, 2), round(found.reached, -2)
    (0.12, 1000.0)
    """
    waves = min(math.ceil(_WAVES_PER_METRE * max(1.0, parameters.belt.length)), _MOST_WAVES)
    sliding = SteadySliding(parameters, speed, force, waves)
    ended = sliding.settle()
    if ended.melting > 0.0:
        return End(None, None, within)
    sliding.reset()
    least = (1.0 - within) * ended.mean_interface
    before = sliding.ramp(ramp, _COARSENESS)
    span = _FIRST
    while before.time < _LAST:
        now = sliding.run(span, _COARSENESS)
        if now.mean_interface >= least:
            gained = now.mean_interface - before.mean_interface
            part = (least - before.mean_interface) / gained if gained > 0.0 else 1.0
            reached = before.time + max(part, 0.0) * (now.time - before.time)
            return End(ended.mean_interface, float(reached), within)
        before, span = now, _FACTOR * span
    return End(ended.mean_interface, None, within)
