"""Belt and ice as a participant of a coupled run, and pictures of their temperature on the way."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cosim.coupling import inputs, outputs, port_table
from thermal import BeltIceModel, FieldSeries, RigView, rig_view

#: Change of a total that is rounding, as a part of the total: it was added up from 1e4 steps.
ROUNDING = 1e-12
#: Times closer than this part of the interval are the same: 3 macro steps of 0.1 s make 0.3 s.
SAME_TIME = 1e-6

#: Most views that are kept; then every other one is dropped, and from there on not taken.
MOST_VIEWS = 400

PORTS = inputs(heat="J", surface_travel="m", x="m") + outputs(
    interface_temperature="degC",
    belt_entry_temperature="degC",
    belt_exit_temperature="degC",
    ice_face_temperature="degC",
    belt_share="1",
    melt_rate="kg/s",
    melted_mass="kg",
    refrozen_mass="kg",
    wiped_ice_mass="kg",
    film_thickness="m",
    heat_received="J",
    railing_heat="J",
    belt_heat="J",
    ice_heat="J",
    air_heat="J",
    support_heat="J",
    latent_heat="J",
    meltwater_heat="J",
    heat_residual="J",
)

Observer = Callable[[float, BeltIceModel], None]


class UnfeltMelting(RuntimeError):
    """The ice melts beside friction that stays dry; the message is one line."""


class Handed(NamedTuple):
    """What the mechanical side has handed over since the start: heat in J, travel in m."""

    heat: float = 0.0
    surface_travel: float = 0.0
    x: float = 0.0


class State(NamedTuple):
    """All that a continuation depends on: the model's own state, and what has crossed the ports."""

    model: NDArray[np.float64]
    taken: Handed
    now: Handed
    railed: float
    time: float


class ThermalParticipant:
    """`BeltIceModel` with the ports of a coupled run.

    Heat and travel arrive as totals since the start, and a step takes what was added: exactly the
    joules and the metres of the step, whatever its size. The belt's travel under the contact is
    what the surface has travelled more than the block; its travel over the railing is all of it,
    for it goes on where the block sticks.

    observer: called as observer(time, model) with every state that a step starts from, so never
    with one that a coupling scheme takes back; `observe` does the same for the last one.
    melts: whether the ice may; a step in which it does is else refused by UnfeltMelting.
    """

    def __init__(
        self,
        model: BeltIceModel,
        name: str = "thermal",
        observer: Observer | None = None,
        melts: bool = True,
    ):
        self.name = name
        self._melts = melts
        self.model = model
        self.ports = port_table(PORTS)
        self._observer = observer
        self._time = 0.0
        self._now = self._taken = Handed()
        self._railed = 0.0
        self._fresh = model.state()

    def enter_initialisation(self, start: float, stop: float) -> None:
        """Back to the state that the participant was made with."""
        self.model.restore(self._fresh)
        self._time = start
        self._now = self._taken = Handed()
        self._railed = 0.0

    def exit_initialisation(self) -> None:
        """What was handed over before the start is no heat of this run."""
        self._taken = self._now
        self._railed = self._now.surface_travel

    def write(self, values: Mapping[str, float]) -> None:
        """New totals: heat in J, surface_travel and x in m."""
        self._now = self._now._replace(**values)

    def read(self) -> dict[str, float]:
        """All outputs of the model."""
        return self.model.outputs()

    def step(self, time: float, size: float) -> None:
        """Advance from time by size (s) with the heat and the travel added since the last step."""
        self._time = time
        self.observe()
        now, taken = self._now, self._taken
        travelled = now.surface_travel
        heat = now.heat - taken.heat
        if -ROUNDING * abs(now.heat) <= heat < 0.0:
            # not taken yet: the total stays that of the mechanical side
            heat, now = 0.0, now._replace(heat=taken.heat)
        slid = (now.surface_travel - taken.surface_travel) - (now.x - taken.x)
        if abs(slid) <= ROUNDING * (abs(now.surface_travel) + abs(now.x)):
            # stick; taken as it is, its sign would tell the belt to run backwards
            slid, now = 0.0, now._replace(surface_travel=taken.surface_travel, x=taken.x)
        self._advance(size, heat, slid, travelled - self._railed)
        self._taken, self._railed = now, travelled
        self._time = time + size

    def _advance(self, size: float, heat: float, slid: float, railed: float) -> None:
        """Step the model; back again where it may not melt and does."""
        before = None if self._melts else self.model.state()
        self.model.step(size, heat, slid, railed)
        if before is not None and self.model.meltwater.melted > 0.0:
            self.model.restore(before)
            raise UnfeltMelting(
                "the face of the ice has come to 0 degC and melts, which friction does not feel:"
                " switch on mixed_lubrication (the water is sheared), asperity_melting or"
                " temperature_dependence"
            )

    def observe(self) -> None:
        """Show the present state to the observer."""
        if self._observer is not None:
            self._observer(self._time, self.model)

    def get_state(self) -> State:
        """Temperatures, ledger and what was taken so far."""
        return State(self.model.state(), self._taken, self._now, self._railed, self._time)

    def set_state(self, state: State) -> None:
        """Go back to a state that `get_state` gave."""
        model, self._taken, self._now, self._railed, self._time = state
        self.model.restore(model)

    def free_state(self, state: State) -> None:
        """States are plain arrays; nothing to free."""

    def close(self) -> None:
        """Nothing is held open."""


class Snapshots:
    """Keeps the belt's contact face and, when a folder is given, writes the fields there.

    interval: s; a picture is taken of the first state shown at or after each multiple of it.
    folder: must exist; None writes no files. views: also keep the fields of belt and ice, as
    `views` (time in s, what is seen), evenly spread over the run, for an animation.
    `contact_length`: along the belt, m.
    """

    def __init__(self, interval: float, folder: str | Path | None = None, views: bool = False):
        self._interval = interval
        self._folder = folder
        self._number = -1
        self._series: FieldSeries | None = None
        self._taken: list[tuple[float, np.ndarray, float]] = []
        self._view_every = 1 if views else 0
        self.views: list[tuple[float, RigView]] = []
        self.position = np.empty(0)
        self.contact_length = float("nan")

    def __call__(self, time: float, model: BeltIceModel) -> None:
        """Take a picture when one is due."""
        number = math.floor(time / self._interval + SAME_TIME)
        if number > self._number:
            self._number = number
            self.take(time, model)

    def take(self, time: float, model: BeltIceModel) -> None:
        """Take a picture now, unless the last one is of now."""
        if self._taken and time <= self._taken[-1][0]:
            return
        if self._folder is not None:
            self._series = self._series or FieldSeries(self._folder, model)
            self._series.write(time)
        if self._view_every and len(self._taken) % self._view_every == 0:
            self._keep_view(time, model)
        self.position, temperature = model.belt_profile()
        self.contact_length = model.footprint.length
        self._taken.append((time, temperature, model.contact_position))

    def _keep_view(self, time: float, model: BeltIceModel) -> None:
        # half the memory, and more digits than a picture shows
        view = RigView(*(np.float32(part) for part in rig_view(model)))  # type: ignore[arg-type]
        self.views.append((time, view))
        if len(self.views) > MOST_VIEWS:
            del self.views[1::2]
            self._view_every *= 2

    @property
    def file(self) -> Path | None:
        """The collection of the written fields, None when none were written."""
        return self._series.path if self._series else None

    @property
    def time(self) -> np.ndarray:
        """Times of the pictures, s, (k,)."""
        return np.array([time for time, _, _ in self._taken])

    @property
    def temperature(self) -> np.ndarray:
        """Contact face of the belt at the `position`s of its material (n,) m: degC, (k, n)."""
        profiles = [profile for _, profile, _ in self._taken]
        return np.array(profiles).reshape(len(profiles), self.position.size)

    @property
    def contact(self) -> np.ndarray:
        """Material position under the contact's centre, m, (k,)."""
        return np.array([contact for _, _, contact in self._taken])
