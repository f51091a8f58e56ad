"""A scenario's run as an object: what the results of `run` and `simulate` can do in Python."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cosim.result import RunResult

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

    from cosim.report.columns import Columns


class ScenarioRun(RunResult):
    """A run whose columns are those of the command's ``result.nc``."""

    @property
    def _columns(self) -> Columns:
        raise NotImplementedError

    def to_xarray(self) -> xarray.Dataset:
        """The dataset that the command writes as ``result.nc``: all outputs over ``time`` (n,) with
        units and long names, what has axes of its own (the belt's temperature over time and place,
        or events), the scenario.

        >>> from cosim import read_scenario, simulate_scenario
        >>> run = simulate_scenario(read_scenario("reference").changed(run_duration=1.0))
        >>> run.to_xarray()["x"].attrs["units"], run["x"].shape, run.x.shape
        ('m', (101,), (101,))
        """
        return self._columns.to_xarray()

    def plot(self, figure: str = "motion") -> Figure:
        """One of the figures of the run's page; which there are, the refusal of another name says.

        Raises ValueError for a name that is none.

        >>> from cosim import read_scenario, simulate_scenario
        >>> simulate_scenario(read_scenario("reference").changed(run_duration=1.0)).plot("motion")
        <Figure size ...>
        """
        from cosim.report.figures import figure_of

        return figure_of(self.to_xarray(), figure)

    def summary(self) -> dict[str, Any]:
        """The numbers of ``summary.json``, with their units; other regimes are not looked for.

        >>> from cosim import read_scenario, simulate_scenario
        >>> run = simulate_scenario(read_scenario("reference").changed(run_duration=1.0))
        >>> run.summary()["whole_run"]["break_aways"]
        0
        """
        from cosim.report import summary

        return summary(self._columns)

    def _answer(self) -> tuple[str, Sequence[tuple[str, str]]]:
        from cosim.report.run_text import headline, tiles

        numbers = self.summary()
        return headline(numbers), tiles(numbers)

    def _page(self) -> str:
        from cosim.report.results import run_page

        return run_page(self._columns, self.summary())

    def _write(self, folder: Path) -> None:
        from cosim.report import write_results

        write_results(self._columns, folder)
