"""Parameters that cannot stand side by side, in words. Pure Python: it travels inside the FMU."""

import re
from collections.abc import Mapping

from .kernel.packing import contradictions as codes
from .names import NAMES
from .packing import in_order
from .words import SAID

#: What a single value must be, whatever its own bounds are.
COMPUTABLE = f"must be 0, or of a size from {codes.SMALLEST:g} to {codes.LARGEST:g}"
_VALUE = re.compile(r"\{([^:{}]+):g\}")


def contradiction(values: Mapping[str, float]) -> str:
    """What two of the parameters (names as of `Parameters.flat`) contradict in; "" if nothing.

    Or why one of them, within its bounds, cannot be computed with.
    """
    v = in_order(values)
    place = codes.beyond_numbers(v)
    if place >= 0:
        return f"{NAMES[place]} = {v[place]:g}: {COMPUTABLE}"
    said = SAID[codes.contradiction(v)]
    return _VALUE.sub(lambda found: f"{values[found[1]]:g}", said)
