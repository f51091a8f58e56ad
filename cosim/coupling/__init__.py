"""Co-simulation master: couples participants through named ports with units.

It knows of a participant nothing but its ports; which models there are is none of its business.
What couples the models of this product is in `cosim.coupling.case`.
"""

from cosim.coupling.around import Curve as Curve
from cosim.coupling.around import Driven as Driven
from cosim.coupling.around import Subcycled as Subcycled
from cosim.coupling.conversion import Affine as Affine
from cosim.coupling.fmu.errors import FmuError as FmuError
from cosim.coupling.fmu.participant import FmuParticipant as FmuParticipant
from cosim.coupling.initial import restores_exactly as restores_exactly
from cosim.coupling.isolated import IsolatedError as IsolatedError
from cosim.coupling.isolated import IsolatedParticipant as IsolatedParticipant
from cosim.coupling.messages import Message as Message
from cosim.coupling.messages import Messages as Messages
from cosim.coupling.participant import Capabilities as Capabilities
from cosim.coupling.participant import Causality as Causality
from cosim.coupling.participant import CouplingError as CouplingError
from cosim.coupling.participant import Participant as Participant
from cosim.coupling.participant import ParticipantError as ParticipantError
from cosim.coupling.participant import Port as Port
from cosim.coupling.participant import Restorable as Restorable
from cosim.coupling.participant import Saved as Saved
from cosim.coupling.participant import TakesWaveforms as TakesWaveforms
from cosim.coupling.participant import UnitDefinition as UnitDefinition
from cosim.coupling.participant import capabilities as capabilities
from cosim.coupling.participant import inputs as inputs
from cosim.coupling.participant import outputs as outputs
from cosim.coupling.participant import port_table as port_table
from cosim.coupling.result import CoupledResult as CoupledResult
from cosim.coupling.result import EnergyFlow as EnergyFlow
from cosim.coupling.result import Ledger as Ledger
from cosim.coupling.run import run as run
from cosim.coupling.schemes.iterated import Aitken as Aitken
from cosim.coupling.schemes.iterated import Iterated as Iterated
from cosim.coupling.schemes.iterated import QuasiNewton as QuasiNewton
from cosim.coupling.schemes.iterated import Relaxation as Relaxation
from cosim.coupling.schemes.scheme import GaussSeidel as GaussSeidel
from cosim.coupling.schemes.scheme import Jacobi as Jacobi
from cosim.coupling.schemes.scheme import Scheme as Scheme
from cosim.coupling.step_control.adaptive import AdaptiveStep as AdaptiveStep
from cosim.coupling.step_control.adaptive import Defect as Defect
from cosim.coupling.step_control.adaptive import Doubling as Doubling
from cosim.coupling.step_control.adaptive import EnergyResidual as EnergyResidual
from cosim.coupling.step_control.adaptive import PowerBond as PowerBond
from cosim.coupling.step_control.control import ConvergenceError as ConvergenceError
from cosim.coupling.step_control.control import FixedStep as FixedStep
from cosim.coupling.step_control.control import StepControl as StepControl
from cosim.coupling.system import Connection as Connection
from cosim.coupling.system import CoupledSystem as CoupledSystem
from cosim.coupling.tolerance import Tolerance as Tolerance
from cosim.coupling.waveform import Waveform as Waveform
