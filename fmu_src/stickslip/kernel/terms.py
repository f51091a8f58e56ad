"""The functions through which the kernel calls the effects' terms, made from their declarations.

What they are is in `stickslip.generation.terms`; ``print(stickslip.kernel.terms.TEXT)`` shows them,
``terms.pyi`` tells them to who checks types.
"""

from ..effects import EFFECTS
from ..generation.functions import define
from ..generation.terms import terms_source
from .tables import constants

TEXT = terms_source(EFFECTS)

globals().update(constants())
define(TEXT, "<terms of the effects>", globals())
