"""Where each number stands in the kernel's flat arrays, with the house's effects.

Counted from `tables`; ``layout.pyi`` tells the names to who checks types, see
`tests/helpers/models/kernel_stubs.py`.
"""

from . import Floats as Floats
from .tables import constants

globals().update(constants())
