"""Co-simulation master: couples participants through named ports with units.

It knows of a participant nothing but its ports; which models there are is none of its business.
What couples the models of this product is in `cosim.coupling.case`.
"""

from cosim.coupling.conversion import Affine
from cosim.coupling.driven import Curve, Driven
from cosim.coupling.fmu.errors import FmuError
from cosim.coupling.fmu.participant import FmuParticipant
from cosim.coupling.isolated import IsolatedError, IsolatedParticipant
from cosim.coupling.messages import Message, Messages
from cosim.coupling.participant import (
    Capabilities,
    Causality,
    CouplingError,
    Participant,
    ParticipantError,
    Port,
    Restorable,
    Saved,
    TakesWaveforms,
    UnitDefinition,
    capabilities,
    inputs,
    outputs,
    port_table,
)
from cosim.coupling.result import CoupledResult, EnergyFlow, Ledger
from cosim.coupling.run import run
from cosim.coupling.schemes.acceleration import Aitken, QuasiNewton, Relaxation
from cosim.coupling.schemes.explicit import GaussSeidel, Jacobi
from cosim.coupling.schemes.iterated import Iterated
from cosim.coupling.schemes.scheme import Scheme
from cosim.coupling.step_control.adaptive import AdaptiveStep
from cosim.coupling.step_control.control import ConvergenceError, StepControl
from cosim.coupling.step_control.estimates import Defect, Doubling, EnergyResidual
from cosim.coupling.step_control.fixed import FixedStep
from cosim.coupling.step_control.power_bond import PowerBond
from cosim.coupling.step_control.precheck import restores_exactly
from cosim.coupling.subcycled import Subcycled
from cosim.coupling.system import Connection, CoupledSystem
from cosim.coupling.tolerance import Tolerance
from cosim.coupling.waveform import Waveform

__all__ = [
    "AdaptiveStep",
    "Affine",
    "Aitken",
    "Capabilities",
    "Causality",
    "Connection",
    "ConvergenceError",
    "CoupledResult",
    "CoupledSystem",
    "CouplingError",
    "Curve",
    "Defect",
    "Doubling",
    "Driven",
    "EnergyFlow",
    "EnergyResidual",
    "FixedStep",
    "FmuError",
    "FmuParticipant",
    "GaussSeidel",
    "Iterated",
    "Jacobi",
    "IsolatedError",
    "IsolatedParticipant",
    "Ledger",
    "Message",
    "Messages",
    "Participant",
    "ParticipantError",
    "Port",
    "PowerBond",
    "QuasiNewton",
    "Relaxation",
    "Restorable",
    "Saved",
    "Scheme",
    "StepControl",
    "Subcycled",
    "TakesWaveforms",
    "Tolerance",
    "UnitDefinition",
    "Waveform",
    "capabilities",
    "inputs",
    "outputs",
    "port_table",
    "restores_exactly",
    "run",
]
