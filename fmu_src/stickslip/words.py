"""What is said of parameters that contradict each other, and of a motion that cannot go on.

It is in ``words.toml``, by the kernel's names; in the FMU these tables stand by themselves.
"""

import tomllib
from pathlib import Path

from .kernel import layout
from .kernel.packing import contradictions as codes

_WORDS = tomllib.loads(Path(__file__).with_name("words.toml").read_text("utf-8"))
#: What `kernel.packing.contradictions` returns -> sentence.
SAID: dict[int, str] = {getattr(codes, n): text for n, text in _WORDS["contradictions"].items()}
#: What `advance` returns where it gives up -> why.
WHY_NOT: dict[int, str] = {getattr(layout, n): text for n, text in _WORDS["why_not"].items()}
