"""`stickslip belt-length`: its arguments, what it runs, what it leaves behind.

What `execute` raises of `REFUSED` is bad input, in one line.
"""

from __future__ import annotations

import json
import math
import os
import sys
import time
from argparse import ArgumentParser, Namespace
from pathlib import Path

from tqdm import tqdm

from cosim.atomic import write_atomically
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
    verdict,
    work_off,
)
from cosim.studies.drawing import OutputRefused, Picture, writable
from thermal import ParameterError
from thermal.air import NotLaminar
from thermal.steady import NoSteadyState

DONE, FAILED = 0, 1
REFUSED = (StudyError, ParameterError, NoSteadyState, NotLaminar, OutputRefused)
RESULT, TABLE = "belt_length.json", "belt_length.csv"

#: Choice -> default, unit, what it is.
CHOICES: dict[str, tuple[tuple[float, ...], str, str]] = {
    "length": ((1.0, 2.0, 3.0, 4.0), "M", "lengths of the belt, m"),
    "speed": ((0.15, 0.5, 0.82), "V", "speeds of the belt, m/s"),
    "mass": ((1.371,), "M", "masses on the belt, kg"),
    "h": ((15.0,), "H", f"heat transfer to the air on each face of the belt, W/m2K; or {AIR}: that"
                        " of a belt moving through still air"),
    "conductivity": ((0.5,), "K", "conductivities of the belt, W/mK"),
    "friction": ((0.3,), "MU", "kinetic friction coefficients"),
    "ambient": ((-8.0, -16.0), "T", "temperatures of the air, degC"),
    "conductance": ((1e4,), "HC", "contact conductances, W/m2K"),
    "thickness": ((1e-3,), "D", "thicknesses of the belt, m"),
}


def add_arguments(parser: ArgumentParser) -> None:
    """The arguments of the command."""
    for name, (default, metavar, text) in CHOICES.items():
        shown = " ".join(f"{value:g}" for value in default)
        kind = number_or_air if name == "h" else float
        parser.add_argument(f"--{name}", metavar=metavar, type=kind, nargs="+", default=default,
                            help=f"{text} (default: {shown})")
    parser.add_argument(
        "--limit", metavar="K", type=float, default=CAMERA,
        help=f"drift that is allowed, K (default: {CAMERA:g}, what the camera sees)")
    parser.add_argument(
        "--sensitivity", metavar="S", type=float,
        help="part of the friction lost per kelvin, 1/K (default: linear to the melting point)")
    parser.add_argument(
        "--samples", metavar="N", type=int, default=32,
        help="samples of the uncertainty, a power of two, 0 for none (default: 32)")
    parser.add_argument(
        "--map", metavar="N", type=int, default=40,
        help="points a side of the map length x speed, 0 for none (default: 40)")
    parser.add_argument("--jobs", metavar="N", type=int, default=os.cpu_count() or 1,
                        help="processes (default: all cores)")
    parser.add_argument("--json", action="store_true", help="print JSON")
    parser.add_argument(
        "-o", "--output", metavar="DIR", default="results/belt-length",
        help="folder of table, numbers and figures (default: results/belt-length)")


def number_or_air(text: str) -> float | str:
    """A number, or AIR."""
    return AIR if text == AIR else float(text)


def execute(arguments: Namespace) -> int:
    """Compute, write, print; 0, or 1 when stopped: what there was by then is written."""
    began = time.perf_counter()
    wanted, options = _asked(arguments)
    folder = Path(arguments.output)
    writable(folder)
    study, status = Study(options), DONE
    grid = empty_map(arguments.map) if arguments.map else None
    try:
        with tqdm(total=len(wanted) + arguments.map**2, disable=None, unit="case",
                  leave=False) as bar:
            work_off(study, wanted, arguments.jobs, bar.update)
            if grid is not None:
                fill_map(grid, wanted[0], arguments.jobs, bar.update)
    except KeyboardInterrupt:
        print(f"error: interrupted; {len(study.rows)} of {len(wanted)} cases are kept in {folder}",
              file=sys.stderr)
        status = FAILED
    _write(study, grid, folder)
    if status == DONE:
        _draw(study, grid, wanted[0], folder)
    _print(study, arguments.json, folder, time.perf_counter() - began)
    return status


def _asked(arguments: Namespace) -> tuple[list[Case], Options]:
    """Cases and options, all of them checked before anything is computed."""
    if not (math.isfinite(arguments.limit) and arguments.limit > 0.0):
        raise StudyError(f"--limit = {arguments.limit:g} K: must be above 0")
    if arguments.sensitivity is not None and not 0.0 <= arguments.sensitivity < math.inf:
        raise StudyError(f"--sensitivity = {arguments.sensitivity:g} 1/K: must not be negative")
    if arguments.samples < 0 or arguments.samples & (arguments.samples - 1):
        raise StudyError(f"--samples = {arguments.samples}: must be a power of two, or 0")
    if arguments.map < 0 or arguments.map == 1:
        raise StudyError(f"--map = {arguments.map}: must be at least 2, or 0 for none")
    if arguments.jobs < 1:
        raise StudyError(f"--jobs = {arguments.jobs}: must be at least 1")
    choices = {name: getattr(arguments, name) for name in CHOICES}
    choices["ambient_degC"] = choices.pop("ambient")
    if 0.0 in choices["h"]:
        raise NoSteadyState(
            "--h = 0: a belt that gives no heat to the air warms for ever, and the study asks for"
            " its steady state; allowed is above 0 W/m2K")
    wanted = cases(**choices)
    for case in wanted:
        case.thermal()
    return wanted, Options(arguments.limit, arguments.sensitivity, arguments.samples)


def _write(study: Study, grid: DriftMap | None, folder: Path) -> None:
    numbers = study.as_dict() | {"verdict": verdict(study)}
    if grid is not None:
        numbers["map"] = {
            "lengths": grid.lengths.tolist(), "speeds": grid.speeds.tolist(),
            # JSON has no NaN; where a stopped map did not come is null
            "drift": [[value if math.isfinite(value) else None for value in row]
                      for row in grid.drift.tolist()],
        }
    text = json.dumps(numbers, indent=1)
    write_atomically(folder / RESULT, lambda path: path.write_text(text, encoding="utf-8"))
    table = study.table()
    write_atomically(folder / TABLE, lambda path: table.to_csv(path, index=False))


def _draw(study: Study, grid: DriftMap | None, case: Case, folder: Path) -> None:
    from cosim.studies.belt_length.figures import draw_drift, draw_loop, draw_map

    pictures: list[Picture] = [draw_drift(study), draw_loop(study)]
    if grid is not None:
        pictures.append(draw_map(grid, case, study.options.limit))
    for one in pictures:
        write_atomically(
            folder / f"{one.name}.png", lambda path, png=one.png: path.write_bytes(png))


def _print(study: Study, as_json: bool, folder: Path, wall_time: float) -> None:
    if as_json:
        print(json.dumps(study.as_dict() | {"verdict": verdict(study)}, indent=1))
        return
    if study.rows:
        shown = study.table()[[
            "length [m]", "speed [m/s]", "h [W/m2K]", "ambient [degC]", "study [K]",
            "single pass mended [K]", "drift 20 s [K]", "drift 30 s [K]", "drift steady [K]",
            "ice 20 s [K]", "belt share 20 s", "seen by camera", "mu change 20 s",
            "frequency change 20 s",
        ]]
        print(shown.to_string(index=False, float_format=lambda value: f"{value:.3g}"))
    for sentence in verdict(study):
        print(sentence)
    print(f"{len(study.rows)} cases in {wall_time:.1f} s; {folder / TABLE}, {folder / RESULT}")
