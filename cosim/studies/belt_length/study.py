"""Which cases are asked for, what is wrong with them, and how they are worked off, in processes.

Bad input is named by the option of `stickslip belt-length`, or by file and key.
"""

import math
from argparse import Namespace
from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import replace
from itertools import product
from typing import Any

from stickslip.packaged import packaged_tables

from cosim.processes import processes
from thermal import Belt, NoSteadyState, ParameterError

from .case import AIR, OWN_KEYS, Case, StudyError
from .drift import changes, drift, friction_effect, wait
from .lengths import shortest_belts
from .required_length import Answer, how_long, runs_for
from .result import Options, Row, Study
from .rigs import FEWEST_SAMPLES
from .uncertainty import uncertainty

Progress = Callable[[int], object]
#: Option -> field of a case, unit, bounds.
BOUNDS = packaged_tables(__package__, "options.toml")
#: Least of a belt's layer: a thin metal foil, and a tenth of still air.
LEAST = (("thickness", "m", 1e-6), ("conductivity", "W/mK", 2e-3))
#: Strongest fall of friction with temperature, 1/K: nothing is left one kelvin warmer.
_MOST_SENSITIVE = 1.0
#: Travel of the belt in a run, m: one that never comes round is longer, and must be a belt still.
MOST_TRAVEL = 0.95 * next(
    bound.le for bound in Belt.model_fields["length"].metadata if hasattr(bound, "le")
)


def check_options(arguments: Namespace) -> None:
    """Each option alone. StudyError in one line: option, value, what is allowed."""
    for name, (_, unit, low, included, high) in BOUNDS.items():
        for value in getattr(arguments, name) or ():
            if value is not None:
                _within(name, value, unit, low, included, high)
    if not (math.isfinite(arguments.limit) and arguments.limit > 0.0):
        raise StudyError(f"--limit = {arguments.limit:g} K: must be above 0")
    if arguments.sensitivity is not None:
        _within("sensitivity", arguments.sensitivity, "1/K", 0.0, True, _MOST_SENSITIVE)
    samples = arguments.samples
    if samples and (samples < FEWEST_SAMPLES or samples & (samples - 1)):
        raise StudyError(
            f"--samples = {samples}: must be a power of two from {FEWEST_SAMPLES}, or 0"
        )
    if arguments.map is not None and (arguments.map < 0 or arguments.map == 1):
        raise StudyError(f"--map = {arguments.map}: must be at least 2, or 0 for none")
    if arguments.jobs < 1:
        raise StudyError(f"--jobs = {arguments.jobs}: must be at least 1")


def _within(name: str, value: float, unit: str, low: float, included: bool, high: float) -> None:
    if low < value <= high or (included and value == low):
        return
    least = "at least" if included else "above"
    raise StudyError(
        f"--{name} = {value:g}{' ' + unit if unit else ''}: must be a number {least} {low:g} and"
        f" at most {high:g}"
    )


def check_case(case: Case, arguments: Namespace) -> None:
    """What options and scenario come to together: travel, air, room on the belt, its matter.

    A number is named by its option where that was given or there is no scenario; else by the key.
    """
    protocol = case.protocol
    file = "" if arguments.scenario is None else f"{arguments.scenario}: "
    options = {field: name for name, (field, *_) in BOUNDS.items()}
    names = {
        key: f"--{options[field]}"
        for key, field in OWN_KEYS.items()
        if not file or getattr(arguments, options[field]) is not None
    }
    if case.travel > MOST_TRAVEL:
        raise StudyError(
            f"{file}--ramp = {protocol.ramp:g} s, --run = {protocol.run:g} s, --runs ="
            f" {protocol.runs} at --speed = {case.speed:g} m/s (surface.run_up_time, run.duration,"
            f" surface.speed of a scenario): the belt would go {case.travel:.3g} m, allowed is at"
            f" most {MOST_TRAVEL:g} m"
        )
    if case.h == 0.0:
        raise NoSteadyState(
            f"{names.get(AIR, file + AIR)} = 0: a belt that gives no heat to the air warms for"
            " ever, and the study asks for its steady state; allowed is above 0 W/m2K"
        )
    try:
        belt = case.thermal().belt
    except ParameterError as error:
        fault = str(error)
        key = next((key for key in names if fault.startswith(key)), "")
        fault = names[key] + fault.removeprefix(key) if key else file + fault
        raise ParameterError(fault) from None
    # what is no belt: thinner than any foil, or insulating beyond any matter
    for number, layer in enumerate(belt.stack, 1):
        for name, unit, least in LEAST:
            if (value := getattr(layer, name)) < least:
                key = f"belt.layers[{number}].{name}" if belt.layers else f"belt.{name}"
                said = f"{names.get(key, file + key)} = {value:g} {unit}"
                raise StudyError(f"{said}: must be at least {least:g} {unit}")


def cases(base: Case, **choices: Iterable[float | None]) -> list[Case]:
    """Every combination; the lengths of one belt drive lie side by side.

    h may be None: each case then has that of its speed and of half its loop.
    """
    names = [name for name in choices if name != "length"] + ["length"]
    combinations = product(*(choices[name] for name in names))
    return [_chosen(base, dict(zip(names, values, strict=True))) for values in combinations]


def _chosen(base: Case, values: dict[str, Any]) -> Case:
    # a range about another number is none of this one
    other = {name for name, value in values.items() if value != getattr(base, name)}
    ranges = tuple(one for one in base.ranges if one.key not in other)
    return replace(base, **values, ranges=ranges)


def _row(case: Case, options: Options, answer: Answer | None) -> Row:
    rigs = None if answer is None else answer.rigs.get(case.length)
    doubted = options.samples and (answer is None or rigs is not None)
    return Row(
        case,
        drift(case),
        friction_effect(case, options.sensitivity),
        *shortest_belts(case.drive, options.limit),
        wait(case, options.limit),
        tuple(changes(case)),
        uncertainty(case, options.samples, rigs) if doubted else None,
    )


def steps(study: Study, wanted: list[Case], is_own: bool) -> int:
    """Of the bar: runs of the model for what is in doubt, cases, places on the map.

    is_own: the doubt is that of an own rig's drives, not of each case.
    """
    samples, places = study.options.samples, 0 if study.grid is None else study.grid.drift.size
    belts = Counter(case.drive for case in wanted).values()
    runs = sum(runs_for(samples, count) if is_own else samples * count for count in belts)
    return runs + len(wanted) + places


def work_off(
    study: Study, wanted: list[Case], jobs: int, progress: Progress = lambda count: None
) -> None:
    """Fill the study's rows, in order; whatever interrupts it, the rows until then stay.

    Where the study has answers, the doubt of a row is that of its drive's rigs.
    """
    answers = {one.case.drive: one for one in study.answers}
    calls = [(case, study.options, answers.get(case.drive)) for case in wanted]
    with processes(min(jobs, len(calls))) as mapped:
        for row in mapped(_row, calls):
            study.rows.append(row)
            progress(1 if answers else 1 + study.options.samples)
    study.complete = True


def answer_all(study: Study, wanted: list[Case], jobs: int, progress: Progress) -> None:
    """Fill the study's answers, one for each drive among the cases that are wanted."""
    drives: dict[Case, list[Case]] = {}
    for case in wanted:
        drives.setdefault(case.drive, []).append(case)
    limit, samples = study.options.limit, study.options.samples
    for belts in drives.values():
        left = runs_for(samples, len(belts))

        def done(count: int) -> None:
            nonlocal left
            left -= count
            progress(count)

        lengths = [case.length for case in belts]
        study.answers.append(
            how_long(belts[0], limit, samples=samples, jobs=jobs, lengths=lengths, progress=done)
        )
        progress(left)  # those that were not needed
