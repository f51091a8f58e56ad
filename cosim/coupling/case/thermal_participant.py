"""Belt and ice as a participant of a coupled run; made ready by another process, if need be."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from stickslip.packaged import packaged_tables

from cosim.coupling import Waveform, inputs, outputs, port_table
from cosim.processes import apart
from thermal import BeltIceModel, ThermalParameters
from thermal.ice.block import StandingBlock, standing_block
from thermal.work import seconds_to_prepare

#: What takes longer (s) is worth a process of its own, which takes two or three to start; so is a
#: mesh whose file is larger (bytes): it holds some ten thousand elements.
WORTH_A_PROCESS, LARGE_FILE = 10.0, 1_000_000
#: Change of a total that is rounding, as a part of the total: it was added up from 1e4 steps.
ROUNDING = 1e-12
#: Heat (J) that may have been handed over in advance: an iteration ends where a step's total is as
#: good as that of the mechanical side. The next steps make up for it.
ADVANCE = 1e-6

_DECLARED = packaged_tables(__package__, "ports.toml")
PORTS = inputs(**_DECLARED["inputs"]) + outputs(**_DECLARED["outputs"])
#: Sizes that are typical, where 1 in the unit is not: a film of a metre would hide one of microns.
NOMINAL = {"film_thickness": 1e-6}

Observer = Callable[[float], None]


class UnfeltMelting(RuntimeError):
    """The ice melts beside friction that stays dry; the message is one line."""


class Handed(NamedTuple):
    """What the mechanical side has handed over since the start: heat in J, travel in m."""

    heat: float = 0.0
    surface_travel: float = 0.0
    x: float = 0.0


#: All that a continuation depends on: what has crossed the ports, and the model's own state.
State = NDArray[np.float64]
#: Numbers of a state in front of those of the model: taken, now, railed and time.
_SIZES = (len(Handed._fields), len(Handed._fields), 2)


class ThermalParticipant:
    """`BeltIceModel` with the ports of a coupled run.

    Heat and travel arrive as totals since the start, and a step takes what was added: exactly the
    joules and the metres of the step, whatever its size. The belt's travel under the contact is
    what the surface has travelled more than the block; its travel over the railing is all of it,
    for it goes on where the block sticks.

    observer: called with the time (s) by `observe`, which is for states that stand: a
    coupling scheme may take a step back.
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
        self.ports = port_table(
            replace(port, nominal=NOMINAL.get(port.name, port.nominal)) for port in PORTS
        )
        self._observer = observer
        self._fresh = model.state()
        self._begin(0.0)

    def _begin(self, time: float) -> None:
        self._time, self._railed = time, 0.0
        self._now = self._taken = Handed()

    def enter_initialisation(self, start: float, stop: float) -> None:
        """Back to the state that the participant was made with."""
        self.model.restore(self._fresh)
        self._begin(start)

    def exit_initialisation(self) -> None:
        """What was handed over before the start is no heat of this run."""
        self._taken = self._now
        self._railed = self._now.surface_travel

    def write(self, values: Mapping[str, float]) -> None:
        """New totals: heat in J, surface_travel and x in m."""
        self._now = self._now._replace(**values)

    def write_waveforms(self, waveforms: Mapping[str, Waveform]) -> None:
        """New totals by their courses over a step, which takes what is added until its end."""
        self.write({name: wave.end for name, wave in waveforms.items()})

    def read(self) -> dict[str, float]:
        """All outputs of the model."""
        return self.model.outputs()

    def step(self, time: float, size: float) -> None:
        """Advance from time by size (s) with the heat and the travel added since the last step."""
        now, taken = self._now, self._taken
        travelled = now.surface_travel
        heat = now.heat - taken.heat
        if -ROUNDING * abs(now.heat) - ADVANCE <= heat < 0.0:
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
        """Let the observer look at the present state."""
        if self._observer is not None:
            self._observer(self._time)

    def get_state(self) -> State:
        """Temperatures, ledger and what was taken so far."""
        own = (self._railed, self._time)
        return np.concatenate((self._taken, self._now, own, self.model.state()))

    def set_state(self, state: State) -> None:
        """Go back to a state that `get_state` gave; ValueError when it is of another mesh."""
        taken, now, own, model = np.split(state, np.cumsum(_SIZES))
        self._taken, self._now = Handed(*taken.tolist()), Handed(*now.tolist())
        self._railed, self._time = own.tolist()
        self.model.restore(model)

    def free_state(self, state: State) -> None:
        """States are plain arrays; nothing to free."""

    def save_state(self) -> bytes:
        """The same as doubles, least significant byte first."""
        return self.get_state().astype("<f8").tobytes()

    def load_state(self, saved: bytes) -> None:
        """Go on from what `save_state` gave."""
        self.set_state(np.frombuffer(saved, "<f8").astype(np.float64))

    def close(self) -> None:
        """Nothing is held open."""


def prepared_block(parameters: ThermalParameters) -> StandingBlock:
    """Contact and ice, as `standing_block`; a fine mesh, or one from a file, by another process.

    Of such a mesh a single call of LAPACK takes minutes, and Ctrl-C would wait for its end.
    """
    mesh = Path(parameters.ice.mesh) if parameters.ice.mesh else None
    if mesh is None:
        long = seconds_to_prepare(parameters) > WORTH_A_PROCESS
    else:
        long = mesh.is_file() and mesh.stat().st_size > LARGE_FILE
    return apart(standing_block, parameters) if long else standing_block(parameters)
