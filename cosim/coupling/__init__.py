"""Co-simulation master: couples participants through named ports with units.

It knows of a participant nothing but its ports; which models there are is none of its business.
"""

from cosim.coupling.connections import Connection
from cosim.coupling.errors import CouplingError, FmuError, ParticipantError
from cosim.coupling.fmu_participant import FmuParticipant
from cosim.coupling.gauss_seidel import GaussSeidel
from cosim.coupling.ledger import EnergyFlow, Ledger
from cosim.coupling.participant import Participant, Restorable
from cosim.coupling.ports import Causality, Port, inputs, outputs, port_table
from cosim.coupling.result import CoupledResult
from cosim.coupling.run import run
from cosim.coupling.system import CoupledSystem

__all__ = [
    "Causality",
    "Connection",
    "CoupledResult",
    "CoupledSystem",
    "CouplingError",
    "EnergyFlow",
    "FmuError",
    "FmuParticipant",
    "GaussSeidel",
    "Ledger",
    "Participant",
    "ParticipantError",
    "Port",
    "Restorable",
    "inputs",
    "outputs",
    "port_table",
    "run",
]
