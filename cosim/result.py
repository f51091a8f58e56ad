"""What every result can do in Python: say its numbers, show itself, and become files and a page."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cosim.files import writable, write_text
from cosim.names import unknown_name

if TYPE_CHECKING:
    import pandas
    import xarray

#: Axis of what a run has at every recorded time.
TIME = "time"


class Result:
    """A result whose numbers, sentence, page and files are its own class's."""

    __slots__ = ()  # a dataset can be one, too

    def summary(self) -> dict[str, Any]:
        """Its numbers, as the JSON file of the command has them."""
        raise NotImplementedError

    def save(self, folder: str | Path) -> Path:
        """Write what the command leaves, into a folder that is made if need be; the folder.

        Raises OutputRefused or OutputError (ValueErrors of one line) where that cannot be.
        """
        folder = writable(Path(folder))
        self._write(folder)
        return folder

    def report(self, file: str | Path = "report.html") -> Path:
        """Write its page, a file that needs no other; its path. OutputError as `save`."""
        return write_text(self._page(), Path(file))

    def _repr_html_(self) -> str:
        """The sentence that answers, and at most four figures: for a notebook."""
        sentence, figures = self._answer()
        rows = "".join(
            f"<tr><th>{escape(name)}</th><td>{escape(value)}</td></tr>" for name, value in figures
        )
        return f"<p><strong>{escape(sentence)}</strong></p><table>{rows}</table>"

    def _answer(self) -> tuple[str, Sequence[tuple[str, str]]]:
        """A sentence, and names and values of the figures beside it."""
        raise NotImplementedError

    def _page(self) -> str:
        raise NotImplementedError

    def _write(self, folder: Path) -> None:
        raise NotImplementedError


class RunResult(Result):
    """A result over time: by name, as `run["x"]` or `run.x`, it has what `to_xarray` has."""

    def to_xarray(self) -> xarray.Dataset:
        """All of it as a dataset, with units and long names."""
        raise NotImplementedError

    def to_dataframe(self) -> pandas.DataFrame:
        """What it has at every recorded time, a column each over the time in s; fields and events,
        which have axes of their own, are in `to_xarray`."""
        data = self._data
        over_time = [name for name, each in data.data_vars.items() if each.dims == (TIME,)]
        return data[over_time].reset_coords(drop=True).to_dataframe()

    @cached_property
    def _data(self) -> xarray.Dataset:
        return self.to_xarray()

    def __getitem__(self, name: str) -> xarray.DataArray:
        """A variable of `to_xarray`, with its axes and unit; KeyError with the nearest name."""
        if name not in self._data.variables:
            raise KeyError(unknown_name("variable of this run", name, self))
        return self._data[name]

    def __getattr__(self, name: str) -> xarray.DataArray:
        # whoever asks whether an object can do something asks for names with a `_`
        if name.startswith("_") or name not in self._data.variables:
            known = () if name.startswith("_") else self
            told = unknown_name("variable of this run", name, known) if known else name
            raise AttributeError(f"{type(self).__name__} has no attribute {name!r}; {told}")
        return self._data[name]

    def __iter__(self) -> Iterator[str]:
        """Names of all variables."""
        return map(str, self._data.variables)

    def __contains__(self, name: object) -> bool:
        return name in self._data.variables

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *filter(str.isidentifier, self)]

    def _ipython_key_completions_(self) -> list[str]:
        return list(self)
