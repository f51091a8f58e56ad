"""The keys of a table [coupling] that say by which method: scheme, iteration, step control."""

from typing import Literal

from stickslip.quantity import Table, quantity


class Method(Table):
    """How participants make a step together, and how long it is.

    What it comes to is made by `cosim.coupling.methods`.

    scheme : in turn, all at once, or repeated until both sides agree
    extrapolation : of gauss_seidel and jacobi: inputs over a step, before they are known
    waveform : of the iterated scheme: inputs over a step, by their end values
    sweep : of the iterated scheme: in turn, or all at once
    acceleration : of the iterated scheme
    relaxation : of the iterated scheme: constant, or of the first iteration
    relative_tolerance : change of a port at which an iteration has come to its end
    absolute_tolerances : participant.port -> absolute part of both tolerances, in its unit; of
        others it is the relative one of the port's nominal value
    max_iterations : of a step
    on_divergence : where an iteration does not come to its end
    smallest_step : of a step control, or of halving; 0: a thousandth of macro_step
    largest_step : of a step control; 0: a hundred times macro_step
    step_tolerance : error of a step, as a part of a port's value
    safety : of a step control: the next step, part of what the error would allow
    step_control : steps of one length, or as long as their error allows
    """

    scheme: Literal["gauss_seidel", "jacobi", "iterated"] = quantity("gauss_seidel", None)
    extrapolation: Literal["held", "linear", "quadratic"] = quantity("held", None)
    waveform: Literal["held", "linear", "quadratic"] = quantity("linear", None)
    sweep: Literal["gauss_seidel", "jacobi"] = quantity("gauss_seidel", None)
    acceleration: Literal["none", "constant", "aitken", "iqn_ils"] = quantity("iqn_ils", None)
    relaxation: float = quantity(1.0, "1", gt=0, lt=2)
    relative_tolerance: float = quantity(1e-6, "1", gt=0, lt=1)
    absolute_tolerances: dict[str, float] = quantity({}, None)
    max_iterations: int = quantity(20, "1", ge=1, le=10_000)
    on_divergence: Literal["stop", "halve", "accept"] = quantity("stop", None)
    smallest_step: float = quantity(0.0, "s", ge=0)
    largest_step: float = quantity(0.0, "s", ge=0)
    step_tolerance: float = quantity(1e-4, "1", gt=0, lt=1)
    safety: float = quantity(0.9, "1", gt=0, lt=1)
    step_control: Literal["fixed", "doubling", "defect", "energy"] = quantity("fixed", None)
