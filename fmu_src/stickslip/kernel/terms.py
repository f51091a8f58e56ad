"""The functions through which the kernel calls the effects' terms, made from their declarations.

What they are is in `stickslip.generation.terms`; ``print(stickslip.kernel.terms.TEXT)`` shows them.
"""

from __future__ import annotations

import linecache
from typing import TYPE_CHECKING, Any

from ..effects import EFFECTS
from ..generation.terms import terms_source
from .layout import constants

TEXT = terms_source(EFFECTS)
_NAME = "<terms of the effects>"

globals().update(constants())
exec(compile(TEXT, _NAME, "exec"), globals())
linecache.cache[_NAME] = (len(TEXT), None, TEXT.splitlines(keepends=True), _NAME)  # for tracebacks

if TYPE_CHECKING:

    def __getattr__(name: str) -> Any: ...
