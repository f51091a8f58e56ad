"""The keys of a table [coupling] that say by which method: scheme, iteration, step control."""

from typing import Literal

from pydantic import Field
from stickslip.quantity import Table, quantity


class Method(Table):
    """How participants make a step together, and how long it is.

    What it comes to is made by `cosim.coupling.methods`.
    """

    scheme: Literal["gauss_seidel", "jacobi", "iterated"] = Field(
        "gauss_seidel", description="in turn, all at once, or repeated until both sides agree"
    )
    extrapolation: Literal["held", "linear", "quadratic"] = Field(
        "held", description="of gauss_seidel and jacobi: inputs over a step, before they are known"
    )
    waveform: Literal["held", "linear", "quadratic"] = Field(
        "linear", description="of the iterated scheme: inputs over a step, by their end values"
    )
    sweep: Literal["gauss_seidel", "jacobi"] = Field(
        "gauss_seidel", description="of the iterated scheme: in turn, or all at once"
    )
    acceleration: Literal["none", "constant", "aitken", "iqn_ils"] = Field(
        "iqn_ils", description="of the iterated scheme"
    )
    relaxation: float = quantity(
        1.0, "1", "of the iterated scheme: constant, or of the first iteration", gt=0, lt=2
    )
    relative_tolerance: float = quantity(
        1e-6, "1", "change of a port at which an iteration has come to its end", gt=0, lt=1
    )
    absolute_tolerances: dict[str, float] = Field(
        {},
        description="participant.port -> absolute part of both tolerances, in its unit; of others "
        "it is the relative one of the port's nominal value",
    )
    max_iterations: int = quantity(20, "1", "of a step", ge=1, le=10_000)
    on_divergence: Literal["stop", "halve", "accept"] = Field(
        "stop", description="where an iteration does not come to its end"
    )
    smallest_step: float = quantity(
        0.0, "s", "of a step control, or of halving; 0: a thousandth of macro_step", ge=0
    )
    largest_step: float = quantity(
        0.0, "s", "of a step control; 0: a hundred times macro_step", ge=0
    )
    step_tolerance: float = quantity(
        1e-4, "1", "error of a step, as a part of a port's value", gt=0, lt=1
    )
    safety: float = quantity(
        0.9, "1", "of a step control: the next step, part of what the error would allow", gt=0, lt=1
    )
    step_control: Literal["fixed", "doubling", "defect", "energy"] = Field(
        "fixed", description="steps of one length, or as long as their error allows"
    )
