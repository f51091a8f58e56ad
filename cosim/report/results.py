"""A run's dataset to the files of its output folder: data, summary, page, figures on request."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from datetime import datetime
from pathlib import Path
from typing import Any, NamedTuple

from stickslip.steady_motion.starts import STARTS

from cosim.files import write_bytes, write_text
from cosim.report.columns import Columns, Data, write_columns, write_columns_as_csv
from cosim.report.contents import REGIME_UNITS
from cosim.scenario.keys import taken_line

from .bounds import bounds_sentences
from .contents import Views, material_of, stored_tables
from .coupling import doubts, effort_rows, step_rows
from .files import write_json
from .heat_numbers import ambient_degC
from .material import page_of_material
from .motion_text import border_sentence, regime_sentence, stability_sentence
from .page import render
from .quantities import digits, spelled, told, with_unit, worded
from .run_answer import headline, tiles
from .run_summary import summary

Progress = Callable[[str], None]

ANIMATION = "temperature.gif"
OWN_FILES = {
    "result.nc": "everything, with units and descriptions: netCDF 4, for xarray, ParaView, Matlab",
    "result.csv": "all time series as a table with a header, digits in full",
    "summary.json": "the numbers of this page, with their units",
}
TITLES = {
    "mechanics": "Energy of the block",
    "heat": "Heat in belt and ice",
    "coupling": "Heat from mechanics to belt and ice",
}
CASES = {"coupled": "mechanics coupled to belt and ice", "mechanics": "mechanics alone"}


class Table(NamedTuple):
    """A heading and rows of words and numbers."""

    title: str
    rows: list[tuple[str, ...]]


def write_results(
    dataset: Data,
    folder: str | Path,
    *,
    command: str = "",
    files: Mapping[str, str] | None = None,
    views: Views = (),
    progress: Progress | None = None,
    figures: bool = False,
    page: bool = True,
) -> list[Path]:
    """Write data, summary and page into a folder that exists; the data first.

    command: how the run was asked for, shown on the page. files: further files of the run,
    relative to the folder -> what they are, to be listed there. views: times (s) and what is seen
    of belt and ice, for an animation; none without them. progress: called with the name
    of each file once it is written. figures: those of the page as PNG files, too. Raises
    OutputError where the disk refuses.
    """
    folder = Path(folder)
    written: list[Path] = []

    def done(path: Path) -> None:
        written.append(path)
        if progress is not None:
            progress(path.name)

    for path in write_data(dataset, folder):
        done(path)
    numbers = summary(dataset)
    done(write_json(numbers, folder / "summary.json"))
    files = dict(files or {})
    if figures:
        for path in write_figures(dataset, folder):
            done(path)
            files[path.name] = "figure, as above"
    if views:
        from .figures.animation import Moving, animation

        columns = (dataset[name].values for name in ("time", "x", "surface_travel"))
        film = animation(views, ambient_degC(dataset), dataset.attrs["title"], Moving(*columns))
        done(write_bytes(film, folder / ANIMATION))
        files[ANIMATION] = "temperature of belt and ice over time, an animation"
    if page:
        text = run_page(dataset, numbers, command=command, files=OWN_FILES | files)
        done(write_text(text, folder / "report.html"))
    return written


def write_figures(dataset: Data, folder: Path, names: Sequence[str] = ()) -> Iterator[Path]:
    """The figures of a run's page as ``NAME.png``, one after the other; all, if none is named.

    Raises ValueError for a name that is none, before anything is written.
    """
    from .figures import named_plates

    for plate in named_plates(dataset, names):
        yield write_bytes(plate.picture(dataset).png, folder / f"{plate.name}.png")


def write_data(dataset: Data, folder: str | Path) -> list[Path]:
    """`result.nc` and `result.csv`."""
    folder = Path(folder)
    columns = Columns.of(dataset)
    return [
        write_columns(columns, folder / "result.nc"),
        write_columns_as_csv(columns, "time", folder / "result.csv"),
    ]


def run_page(
    dataset: Data,
    numbers: Mapping[str, Any],
    *,
    command: str = "",
    files: Mapping[str, str] | None = None,
) -> str:
    """HTML of a run: numbers of `summary`, its figures, the files beside it."""
    from .figures import plates_of

    html = render(
        "run.html.j2",
        "cosim.report",
        numbers=numbers,
        created=datetime.fromisoformat(numbers["created"]).strftime("%d %B %Y, %H:%M %Z"),
        case=CASES.get(numbers["case"], numbers["case"]),
        headline=headline(numbers),
        tiles=tiles(numbers),
        simulated=_simulated(numbers),
        ledgers=list(ledgers(numbers)),
        tables=list(number_tables(numbers)),
        temperatures=temperature_rows(numbers),
        beyond=beyond(numbers),
        assessed=assessed(numbers),
        regimes=regime_rows(numbers),
        figures=[plate.picture(dataset) for plate in plates_of(dataset)],
        parameters=parameter_tables(dataset),
        defaults=taken_line(numbers["defaults"]),
        files=files or {},
        command=command,
        coupled=numbers["case"] == "coupled",
    )
    return page_of_material(html, material_of(dataset))


def _simulated(numbers: Mapping[str, Any]) -> str:
    """How long the run was, and how long it took: to two digits, for that is the machine's mood."""
    took = numbers.get("wall_time")
    computing = "" if took is None else f", computed in {told(float(f'{took:.2g}'), 's')}"
    return f"{told(numbers['time_reached'], 's')} of motion{computing}"


def ledgers(numbers: Mapping[str, Any]) -> Iterator[Table]:
    """One table for each ledger of the run."""
    for name, entries in numbers.get("ledger", {}).items():
        yield Table(TITLES[name], _rows(numbers, f"ledger.{name}", entries))


def number_tables(numbers: Mapping[str, Any]) -> Iterator[Table]:
    """Motion after the speed ramp and in all, shares of the heat, melting, how it was coupled."""
    titles = {
        "after_run_up": "After the speed ramp",
        "whole_run": "Whole run",
        "heat_shares": "Where the heat is at the end",
        "in_the_end": "How warm in the end, if this went on for ever",
        "melting": "Melting, and the balance of the film in the last second",
    }
    for name, title in titles.items():
        if name not in numbers:
            continue
        if name == "in_the_end":
            yield Table(title, ending_rows(numbers[name]))
        elif name == "after_run_up" and not numbers[name]["duration"]:
            begin = _told(numbers, f"{name}.begin")
            yield Table(title, [("none: the run ends before the ramp does", begin)])
        else:
            yield Table(title, _rows(numbers, name, numbers[name]))
    if "coupling" in numbers:
        coupling = numbers["coupling"]
        yield Table("How it was coupled", step_rows(coupling))
        yield Table("Steps of each side, and time in them", effort_rows(coupling["participants"]))


def ending_rows(ends: Mapping[str, Any]) -> list[tuple[str, ...]]:
    """Where the interface would end, or why there is no such place."""
    if "reason" in ends:
        return [("the contact's temperature for ever", ends["reason"])]
    near = f"from then on within {100.0 * ends['within']:.0f} % of that rise"
    reached = (
        "after 30 years not yet" if ends["reached"] is None else told(ends["reached"], "s", count=2)
    )
    return [
        (
            "the contact's temperature for ever, mean of both faces",
            _degrees(ends["interface_degC"]),
        ),
        ("its rise over the air", told(ends["interface_rise"], "K")),
        (near, reached),
        *_air_rows(ends),
    ]


def _air_rows(ends: Mapping[str, Any]) -> list[tuple[str, ...]]:
    """The heat transfer to the air, and why `stickslip belt-length` takes another."""
    taken, still = ends["air_heat_transfer"], ends["still_air_heat_transfer"]
    rows: list[tuple[str, ...]] = [
        ("heat transfer to the air, each face of the belt", _of_air(taken))
    ]
    if still is None or _of_air(still) == _of_air(taken):
        return rows
    why = (
        "that of still air, which `belt-length` takes unless belt.air_heat_transfer is given;"
        f" belt.still_air_speed = {ends['speed']:g} makes this run take it, too"
    )
    return [*rows, (why, _of_air(still))]


def _of_air(film: float) -> str:
    return told(film, "W/(m2.K)", count=2)


def beyond(numbers: Mapping[str, Any]) -> list[str]:
    """Sentences on what the block does that its rig could not; none where all is well."""
    found = (*bounds_sentences(numbers), *doubts(numbers.get("coupling", {})))
    return [f"{said[0].upper()}{said[1:]}." for said in found]


def assessed(numbers: Mapping[str, Any]) -> list[str]:
    """Sentences on stability and regimes; none for a run that was not assessed."""
    if "stability" not in numbers:
        return []
    return [stability_sentence(numbers), regime_sentence(numbers), border_sentence(numbers)]


def regime_rows(numbers: Mapping[str, Any]) -> list[tuple[str, ...]]:
    """Start, regime, and what the motion is like, of the run's own start and of the others."""
    return [
        (
            STARTS[start],
            regime["name"],
            *(_told(numbers, f"regimes.{start}.{key}") for key in REGIME_UNITS),
        )
        for start, regime in numbers.get("regimes", {}).items()
    ]


def temperature_rows(numbers: Mapping[str, Any]) -> list[tuple[str, ...]]:
    """Place, end, lowest and highest temperature, rise at the end and at most."""
    found = []
    for place, entries in numbers.get("temperatures", {}).items():
        if place == "ambient":
            continue
        degrees = [_degrees(entries[key]) for key in ("end_degC", "min_degC", "max_degC")]
        rises = [told(entries[key], "K") for key in ("end_rise", "max_rise")]
        found.append((worded(place), *degrees, *rises))
    return found


def parameter_tables(dataset: Data) -> list[Table]:
    """Every parameter with value, unit and description, table by table."""
    return [
        Table(
            "block" if name == "ice" else name,
            [
                (key, _valued(entry["value"], entry["unit"]), entry["description"])
                for key, entry in entries.items()
            ],
        )
        for name, entries in stored_tables(dataset).items()
    ]


def _valued(value: Any, unit: str) -> str:
    """A parameter's value; a unit only behind numbers."""
    return digits(value) if isinstance(value, str) else with_unit(digits(value), spelled(unit))


def _rows(
    numbers: Mapping[str, Any], path: str, entries: Mapping[str, Any]
) -> list[tuple[str, ...]]:
    shares = path == "heat_shares"
    return [(worded(key), _told(numbers, f"{path}.{key}", shares)) for key in entries]


def _told(numbers: Mapping[str, Any], path: str, share: bool = False) -> str:
    return told(_at(numbers, path), numbers["units"].get(path, ""), share or path.endswith("share"))


def _at(numbers: Mapping[str, Any], path: str) -> Any:
    node: Any = numbers
    for key in path.split("."):
        if not isinstance(node, Mapping) or key not in node:
            return None
        node = node[key]
    return node


def _degrees(value: float | None) -> str:
    """A temperature to 0.01 K: the rise beside it has the digits that it is worth."""
    return "–" if value is None else f"{value:z.2f} °C".replace("-", "−")
