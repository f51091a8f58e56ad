"""The effects' numbers in ``p`` from their parameters: made from the effects' declarations.

What it is made of is in `stickslip.generation.derived`; ``print(stickslip.derived.TEXT)`` shows it.
"""

from __future__ import annotations

import linecache
from typing import TYPE_CHECKING, Any

from .effects import EFFECTS
from .generation.derived import derived_source
from .kernel.layout import constants

TEXT = derived_source(EFFECTS)
_NAME = "<numbers of the effects>"

globals().update(constants())
exec(compile(TEXT, _NAME, "exec"), globals())
linecache.cache[_NAME] = (len(TEXT), None, TEXT.splitlines(keepends=True), _NAME)  # for tracebacks

if TYPE_CHECKING:

    def __getattr__(name: str) -> Any: ...
