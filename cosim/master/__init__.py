"""Co-simulation master: couples participants through named ports with units.

It knows of a participant nothing but its ports; which models there are is none of its business.
"""

from cosim.master.connections import Connection
from cosim.master.errors import CouplingError, FmuError, ParticipantError
from cosim.master.fmu_participant import FmuParticipant
from cosim.master.gauss_seidel import GaussSeidel
from cosim.master.ledger import EnergyFlow, Ledger
from cosim.master.participant import Participant, Restorable
from cosim.master.ports import Causality, Port, inputs, outputs, port_table
from cosim.master.result import CoupledResult
from cosim.master.run import run
from cosim.master.system import CoupledSystem

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
