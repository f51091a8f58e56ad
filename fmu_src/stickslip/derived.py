"""The effects' numbers in ``p`` from their parameters: made from the effects' declarations.

What it is made of is in `stickslip.generation.derived`; ``print(stickslip.derived.TEXT)`` shows it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .effects import EFFECTS
from .generation.derived import derived_source
from .generation.functions import define
from .kernel.layout import constants

TEXT = derived_source(EFFECTS)

globals().update(constants())
define(TEXT, "<numbers of the effects>", globals())

if TYPE_CHECKING:

    def __getattr__(name: str) -> Any: ...
