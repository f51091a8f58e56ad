"""Co-simulation master: couples participants through named ports with units.

It knows of a participant nothing but its ports; which models there are is none of its business.
What couples the models of this product is in `cosim.coupling.case`.
"""

from cosim.coupling.fmu_participant import FmuParticipant
from cosim.coupling.fmu_unit import FmuError
from cosim.coupling.participant import (
    Causality,
    CouplingError,
    Participant,
    ParticipantError,
    Port,
    Restorable,
    inputs,
    outputs,
    port_table,
)
from cosim.coupling.result import CoupledResult, EnergyFlow, Ledger
from cosim.coupling.run import run
from cosim.coupling.scheme import GaussSeidel, Scheme
from cosim.coupling.system import Connection, CoupledSystem

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
    "Scheme",
    "inputs",
    "outputs",
    "port_table",
    "run",
]
