"""The claims C1 to C18 of the source study, one function each that fills and judges it."""

from . import belt_length as belt_length
from . import friction_laws as friction_laws
from . import friction_level as friction_level
from . import rotation as rotation
from . import scheme as scheme
from . import trends as trends
