"""Names of the parameters in the order of the kernel's array ``v``; in the FMU they are a list."""

from .kernel.tables import value_names

NAMES = value_names()
