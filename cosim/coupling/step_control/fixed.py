"""Steps of one size."""

from __future__ import annotations

import math
from typing import Any

from cosim.coupling.participant import CouplingError
from cosim.coupling.schemes.scheme import Scheme
from cosim.coupling.step_control.control import Stepper
from cosim.coupling.system import CoupledSystem

# A remainder below this part of a macro step is rounding in (stop - start) / H, not a step that
# somebody asked for: 1e6 steps leave some 1e-10.
SLIVER = 1e-9


class Grid:
    """Times t_n = start + n H with the end hit exactly; the last step may be shorter.

    Computed from n, never by adding up, so that nothing drifts. Raises CouplingError.

    >>> list(Grid(0.0, 0.25, 0.1))
    [0.0, 0.1, 0.2, 0.25]
    """

    def __init__(self, start: float, stop: float, macro_step: float):
        for key, value in (("start", start), ("stop", stop), ("macro_step", macro_step)):
            if not math.isfinite(value):
                raise CouplingError(f"{key} = {value}: must be a finite number of seconds")
        if macro_step <= 0:
            raise CouplingError(f"macro_step = {macro_step:g} s: must be greater than 0")
        if stop <= start:
            raise CouplingError(f"stop = {stop:g} s: must be later than start = {start:g} s")
        self.start: float = start
        self.stop: float = stop
        self.macro_step: float = macro_step
        self.steps: int = max(1, math.ceil((stop - start) / macro_step - SLIVER))
        # steps are the smaller, the later, in what a number of that size can tell apart
        late = start + (self.steps - 1) * macro_step
        if start + macro_step <= start or late >= stop or late + macro_step <= late:
            raise CouplingError(f"macro_step = {macro_step:g} s: too small to advance {start:g} s")

    def __len__(self) -> int:
        return self.steps + 1

    def __getitem__(self, n: int) -> float:
        if not 0 <= n <= self.steps:
            raise IndexError(n)
        return self.stop if n == self.steps else self.start + n * self.macro_step


class FixedStep:
    """Communication points on a grid, and at known events between them.

    macro_step: s.
    """

    needs_restore = False

    def __init__(self, macro_step: float):
        self.macro_step = macro_step
        self._grid: Grid | None = None
        self._made = 0
        self._on_grid = True

    @property
    def first_size(self) -> float:
        """That of all, s."""
        return self.macro_step

    def check(self, system: CoupledSystem) -> list[str]:
        """Fits all."""
        return []

    def begin(self, start: float, stop: float, scheme: Scheme) -> None:
        """The grid from start to stop (s)."""
        self._grid = Grid(start, stop, self.macro_step)
        self._made, self._on_grid = 0, True

    def step(self, stepper: Stepper, stop: float) -> float:
        """To the next time of the grid, or as far as `stop` or an event lets it."""
        assert self._grid is not None
        goal = self._grid[self._made + 1]
        if abs(goal - stop) <= SLIVER * self.macro_step:
            goal = stop  # an event at 0.6 is that of 6 steps of 0.1, which are 0.6000000000000001
        reached = stepper.make(min(goal, stop))
        self._on_grid = reached >= goal
        self._made += self._on_grid
        return reached

    def is_row(self) -> bool:
        """On the grid it is."""
        return self._on_grid

    def state(self) -> dict[str, Any]:
        """Steps made."""
        return {"made": self._made, "on_grid": self._on_grid}

    def restore(self, state: dict[str, Any]) -> None:
        """Go on from there."""
        self._made, self._on_grid = int(state["made"]), bool(state["on_grid"])
