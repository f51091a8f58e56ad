"""`stickslip belt-length`: its arguments, what it runs, what it leaves behind."""

from __future__ import annotations

import json
import math
import os
import sys
import time
from argparse import ArgumentParser, ArgumentTypeError, Namespace
from dataclasses import replace
from functools import partial
from pathlib import Path

from tqdm import tqdm

from cosim.cli import DONE, FAILED
from cosim.cli.arguments import add_force, add_json, add_output
from cosim.files import OutputRefused, writable, write_atomically, write_bytes, write_text
from cosim.manifest import made_by, require_own, results_in
from cosim.report.page import Picture
from cosim.scenario import read_scenario
from cosim.scenario.faults import ScenarioError
from cosim.studies.belt_length import (
    AIR,
    CAMERA,
    Case,
    DriftMap,
    Options,
    Study,
    StudyError,
    cases,
    empty_map,
    fill_map,
    scenario_case,
    verdict,
    work_off,
)
from cosim.studies.belt_length.study import check_case, check_options
from thermal import MeshError, ParameterError
from thermal.belt.air import NotLaminar
from thermal.steady_state import NoSteadyState

EXAMPLE = "stickslip belt-length --length 1 2 4 --speed 0.15 0.82 -o results/belt"
RESULT, TABLE = "belt_length.json", "belt_length.csv"
CHANGES, DOUBT = "changes.csv", "doubt.csv"
#: The study's rig: speeds and lengths are varied, the rest is a case's default.
STUDY = Case(1.0, 0.82)

#: The printed columns in words.
LEGEND = (
    "study: its single pass; drift: rise of the belt over the air where it enters the contact, at"
    " the end of the runs; low, high: 5 and 95 % of the doubt; steady: for ever; interface drift:"
    " what the interface warms by at constant speed; endless belt: on one that never comes round;"
    " ice: rise of its face; belt share: of the friction heat; wait: until belt and ice are within"
    " the limit again; mu change: of the kinetic friction by the interface's rise, relative."
)

#: Choice -> field of a case, the study's values (None: the default case's), unit, what it is.
CHOICES: dict[str, tuple[str, tuple[float, ...] | None, str, str]] = {
    "length": ("length", (1.0, 2.0, 3.0, 4.0), "M", "lengths of the belt, m"),
    "speed": ("speed", (0.15, 0.5, 0.82), "V", "speeds of the belt, m/s"),
    "mass": ("mass", None, "M", "masses on the belt, kg"),
    "h": (
        "h",
        None,
        "H",
        f"heat transfer to the air on each face of the belt, W/m2K; or {AIR}:"
        " boundary layer, convection and radiation of a belt moving through still air",
    ),
    "conductivity": ("conductivity", None, "K", "conductivities of the belt, W/mK"),
    "friction": ("friction", None, "MU", "kinetic friction coefficients"),
    "ambient": (
        "ambient_degC",
        None,
        "T",
        "temperatures of the air, degC; the rises hardly depend on it",
    ),
    "conductance": ("conductance", None, "HC", "contact conductances, W/m2K"),
    "thickness": ("thickness", None, "D", "thicknesses of the belt, m"),
}
#: What a case takes from the thermal model where it says nothing itself.
_FROM_RIG = {"conductivity": "belt", "thickness": "belt", "conductance": "contact"}


def add_arguments(parser: ArgumentParser) -> None:
    """The arguments of the command."""
    parser.add_argument(
        "scenario",
        nargs="?",
        help="TOML file or packaged scenario that says belt, block, air, ramp and run, in front of"
        " the options; without one, the study's rig and protocol",
    )
    for name, (field, values, metavar, text) in CHOICES.items():
        shown = " ".join(_shown(value) for value in values or (_own(STUDY, field),))
        parser.add_argument(
            f"--{name}",
            metavar=metavar,
            nargs="+",
            type=number_or_air if name == "h" else float,
            help=f"{text} (default: the scenario's, or {shown})",
        )
    _add_protocol(parser)
    parser.add_argument(
        "--limit",
        metavar="K",
        type=float,
        default=CAMERA,
        help=f"rise that is allowed, K (default: {CAMERA:g}, by the camera's data sheet; a choice)",
    )
    parser.add_argument(
        "--sensitivity",
        metavar="S",
        type=float,
        help="part of the friction lost per kelvin, 0 to 1 1/K (default: linear to melting)",
    )
    parser.add_argument(
        "--samples",
        metavar="N",
        type=int,
        default=128,
        help="runs of the model for the uncertainty, a power of two, 0 for none (default: 128)",
    )
    parser.add_argument(
        "--map",
        metavar="N",
        type=int,
        default=30,
        help="points a side of the map length x speed, 0 for none (default: 30)",
    )
    parser.add_argument(
        "--jobs",
        metavar="N",
        type=int,
        default=os.cpu_count() or 1,
        help="processes (default: all cores)",
    )
    add_json(parser)
    add_output(
        parser,
        "folder of table, numbers and figures (default: results/belt-length)",
        default="results/belt-length",
    )
    add_force(parser)


def _add_protocol(parser: ArgumentParser) -> None:
    """How the experiment is run."""
    protocol = STUDY.protocol
    for name, text, from_where in (
        ("ramp", "from standstill to the speed", "the scenario's, or "),
        ("run", "at constant speed", "the scenario's, or "),
        ("pause", "between two runs, the belt at a standstill", ""),
    ):
        parser.add_argument(
            f"--{name}",
            metavar="S",
            type=float,
            help=f"{text}, s (default: {from_where}{getattr(protocol, name):g})",
        )
    parser.add_argument(
        "--runs",
        metavar="N",
        type=int,
        default=protocol.runs,
        help=f"runs in a row (default: {protocol.runs})",
    )
    parser.add_argument(
        "--lifted",
        action="store_true",
        help="the ice is lifted off the belt in a pause, not left resting on it",
    )


def number_or_air(text: str) -> float | str:
    """A number, or AIR."""
    try:
        return AIR if text == AIR else float(text)
    except ValueError:
        raise ArgumentTypeError(f"{text}: allowed is a number in W/m2K, or {AIR}") from None


def _own(case: Case, field: str) -> float | str:
    """What a case has where it is not told otherwise."""
    value = getattr(case, field)
    if value is None and field in _FROM_RIG:
        return getattr(getattr(case.rig, _FROM_RIG[field]), field)
    return AIR if value is None else value


def _shown(value: float | str) -> str:
    return value if isinstance(value, str) else f"{value:g}"


def refused() -> tuple[type[Exception], ...]:
    """What is bad input."""
    return (
        StudyError,
        ScenarioError,
        ParameterError,
        MeshError,
        NoSteadyState,
        NotLaminar,
        OutputRefused,
    )


def execute(arguments: Namespace) -> int:
    """Compute, write, print; 0, or 1 when stopped: what there was by then is written."""
    began = time.perf_counter()
    wanted, options = _asked(arguments)
    folder = Path(arguments.output)
    writable(folder)
    require_own(folder, (RESULT, TABLE, CHANGES, DOUBT), arguments.force)
    study, status = Study(options), DONE
    grid = empty_map(arguments.map) if arguments.map else None
    try:
        with tqdm(
            total=len(wanted) + arguments.map**2, disable=None, unit="case", leave=False
        ) as bar:

            def show(count: int) -> None:
                bar.update(count)

            work_off(study, wanted, arguments.jobs, show)
            if grid is not None:
                fill_map(grid, wanted[0], arguments.jobs, show)
    except KeyboardInterrupt:
        print(
            f"error: interrupted; {len(study.rows)} of {len(wanted)} cases are kept in {folder}",
            file=sys.stderr,
        )
        status = FAILED
    source = arguments.scenario and read_scenario(arguments.scenario).to_toml()
    with results_in(folder, made_by(scenario=source), force=arguments.force) as results:
        _write(study, grid, folder)
        if status == DONE:
            _draw(study, grid, wanted[0], folder)
            results.complete = True
    _print(study, arguments.json, folder, time.perf_counter() - began)
    return status


def _asked(arguments: Namespace) -> tuple[list[Case], Options]:
    """Cases and options, all of them checked before anything is computed."""
    check_options(arguments)
    given = arguments.scenario is not None
    base = _from_file(arguments.scenario) if given else STUDY
    base = replace(base, protocol=_protocol(base, arguments))
    choices = {}
    for name, (field, values, _, _) in CHOICES.items():
        asked = getattr(arguments, name)
        own = (getattr(base, field),) if given or values is None else values
        choices[field] = own if asked is None else asked
    wanted = cases(base, **choices)
    for case in wanted:
        check_case(case, arguments)
    return wanted, Options(arguments.limit, arguments.sensitivity, arguments.samples)


def _from_file(source: str) -> Case:
    """The case of a scenario; faults begin with the file."""
    scenario = read_scenario(source)
    try:
        return scenario_case(scenario)
    except StudyError as error:
        raise StudyError(f"{source}: {error}") from None


def _protocol(base: Case, arguments: Namespace):
    """The base's, with what the options say."""
    said = {
        name: getattr(arguments, name)
        for name in ("ramp", "run", "pause")
        if getattr(arguments, name) is not None
    }
    return replace(base.protocol, runs=arguments.runs, lifted=arguments.lifted, **said)


def _write(study: Study, grid: DriftMap | None, folder: Path) -> None:
    numbers = study.as_dict() | {"verdict": verdict(study)}
    if grid is not None:
        numbers["map"] = {
            "lengths": grid.lengths.tolist(),
            "speeds": grid.speeds.tolist(),
            # JSON has no NaN; where a stopped map did not come is null
            "drift": [
                [value if math.isfinite(value) else None for value in row]
                for row in grid.drift.tolist()
            ],
        }
    write_text(json.dumps(numbers, indent=1), folder / RESULT)
    for name, table in ((TABLE, study.table()), (CHANGES, study.changes()), (DOUBT, study.doubt())):
        if name == TABLE or not table.empty:
            write_atomically(folder / name, partial(table.to_csv, index=False))


def _draw(study: Study, grid: DriftMap | None, case: Case, folder: Path) -> None:
    from cosim.studies.belt_length.figures import draw_doubt, draw_drift, draw_map

    pictures: list[Picture] = [draw_drift(study)]
    doubted = [row for row in study.rows if row.uncertainty is not None]
    if doubted:
        pictures.append(draw_doubt(max(doubted, key=lambda row: row.drift.run)))
    if grid is not None:
        pictures.append(draw_map(grid, case, study.options.limit))
    for one in pictures:
        write_bytes(one.png, folder / f"{one.name}.png")


def _print(study: Study, as_json: bool, folder: Path, wall_time: float) -> None:
    if as_json:
        print(json.dumps(study.as_dict() | {"verdict": verdict(study)}, indent=1))
        return
    if study.rows:
        shown = study.table()[
            [
                "length [m]",
                "speed [m/s]",
                "h [W/m2K]",
                "study [K]",
                "drift [K]",
                "drift low [K]",
                "drift high [K]",
                "drift steady [K]",
                "interface drift [K]",
                "interface drift low [K]",
                "interface drift high [K]",
                "interface drift, endless belt [K]",
                "ice [K]",
                "belt share",
                "wait [s]",
                "mu change",
            ]
        ]
        print(shown.to_string(index=False, float_format=lambda value: f"{value:.3g}"))
        print(LEGEND)
        _print_shortest(study)
    for sentence in verdict(study):
        print(sentence)
    if study.rows:
        _print_changes(study)
    print(f"{len(study.rows)} cases in {wall_time:.1f} s; {folder / TABLE}, {folder / RESULT}")


def _print_shortest(study: Study) -> None:
    """The shortest belts as the rig is said, and at the levels of its doubt."""
    doubted = study.shortest_in_doubt()
    print(
        "Shortest belt [m]: as the rig is said; in half and in 95 % of the rigs of the doubt;"
        " for ever"
    )
    print(
        f"{'speed [m/s]':>12} {'question':<20} {'as said':>8} {'median':>8} {'95 %':>8}"
        f" {'for ever':>8}"
    )
    rows = {row.case.with_length(1.0): row for row in study.rows}
    for case, row in rows.items():
        for name, rise, said, steady in (
            ("comes round cold", "run", row.shortest_run, row.shortest_steady),
            ("interface steady", "interface", row.shortest_interface, None),
        ):
            levels = [doubted[case][rise][level].says or "-" for level in ("median", "high")]
            ever = "-" if rise == "interface" else _length(steady)
            print(
                f"{case.speed:12g} {name:<20} {_length(said):>8} {levels[0]:>8} {levels[1]:>8}"
                f" {ever:>8}"
            )


def _length(value: float | None) -> str:
    return "none" if value is None else f"{value:.2g}"


def _print_changes(study: Study) -> None:
    """What would help, in the case that drifts most."""
    row = study.worst
    print(
        f"One change alone, {row.case.length:g} m at {row.case.speed:g} m/s: belt at entry,"
        " interface at constant speed, K"
    )
    for one in row.changes:
        print(f"  {one.what:60} {one.run:9.3f} {one.interface_drift:9.3f}")
