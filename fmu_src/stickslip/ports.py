"""Inputs and outputs of the mechanical model: where the kernel keeps each, what is known of it.

They are declared in ``ports.toml``.
"""

from dataclasses import dataclass

from .packaged import packaged_tables


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


_DECLARED = packaged_tables(__package__, "ports.toml")
INPUTS, OUTPUTS = (
    tuple(Port(name, **{"unit": None, "nominal": None, **told}) for name, told in ports.items())
    for ports in (_DECLARED["inputs"], _DECLARED["outputs"])
)
