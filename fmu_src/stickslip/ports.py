"""Inputs and outputs of the mechanical model: where the kernel keeps each, what is known of it.

They are declared in ``ports.toml``.
"""

import tomllib
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Port:
    """An input or an output.

    slot: name of its place in the kernel's layout; unit: SI, None for an integer; start: of an
    input.
    """

    name: str
    slot: str
    unit: str | None
    nominal: float | None
    description: str
    min: float | int | None = None
    max: float | int | None = None
    start: float | None = None


_DECLARED = tomllib.loads(Path(__file__).with_name("ports.toml").read_text("utf-8"))
INPUTS, OUTPUTS = (
    tuple(Port(name, **{"unit": None, "nominal": None, **told}) for name, told in ports.items())
    for ports in (_DECLARED["inputs"], _DECLARED["outputs"])
)
