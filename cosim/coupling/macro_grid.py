"""The communication points of a run."""

import math

from cosim.coupling.errors import CouplingError

# A remainder below this part of a macro step is rounding in (stop - start) / H, not a step that
# somebody asked for: 1e6 steps leave some 1e-10.
SLIVER = 1e-9


def macro_grid(start: float, stop: float, macro_step: float) -> list[float]:
    """Times t_n = start + n H with the end hit exactly; the last step may be shorter.

    Computed from n, never by adding up, so that nothing drifts.

    >>> macro_grid(0.0, 0.25, 0.1)
    [0.0, 0.1, 0.2, 0.25]
    """
    for key, value in (("start", start), ("stop", stop), ("macro_step", macro_step)):
        if not math.isfinite(value):
            raise CouplingError(f"{key} = {value}: must be a finite number of seconds")
    if macro_step <= 0:
        raise CouplingError(f"macro_step = {macro_step:g} s: must be greater than 0")
    if stop <= start:
        raise CouplingError(f"stop = {stop:g} s: must be later than start = {start:g} s")
    steps = max(1, math.ceil((stop - start) / macro_step - SLIVER))
    times = [start + n * macro_step for n in range(steps)] + [stop]
    if any(late <= early for early, late in zip(times, times[1:], strict=False)):
        raise CouplingError(f"macro_step = {macro_step:g} s: too small to advance {start:g} s")
    return times
