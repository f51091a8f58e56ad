"""What is said of parameters that contradict each other, and of a motion that cannot go on.

It is in ``words.toml``, by the kernel's names; in the FMU these tables stand by themselves.
"""

from .kernel import layout
from .kernel.packing import contradictions as codes
from .packaged import packaged_tables

_WORDS = packaged_tables(__package__, "words.toml")
#: What `kernel.packing.contradictions` returns -> sentence.
SAID: dict[int, str] = {getattr(codes, n): text for n, text in _WORDS["contradictions"].items()}
#: What `advance` returns where it gives up -> why.
WHY_NOT: dict[int, str] = {getattr(layout, n): text for n, text in _WORDS["why_not"].items()}
