"""Bad input of `stickslip belt-length`, named by option, or by file and key."""

from __future__ import annotations

import math
from argparse import Namespace

from cosim.studies.belt_length import AIR, FEWEST_SAMPLES, Case, StudyError
from cosim.studies.belt_length.case import OWN_KEYS
from thermal import Belt, ParameterError
from thermal.steady_state import NoSteadyState

#: Option -> field of a case, unit, above this or, where True follows, also this; at most that.
BOUNDS = {
    "length": ("length", "m", 0.0, False, 100.0),
    "speed": ("speed", "m/s", 0.0, False, 100.0),
    "mass": ("mass", "kg", 0.0, False, 1e5),
    "h": ("h", "W/m2K", 0.0, True, 1e4),
    "conductivity": ("conductivity", "W/mK", 0.0, False, 1e4),
    "friction": ("friction", "", 0.0, False, 10.0),
    "ambient": ("ambient_degC", "degC", -100.0, True, -1e-9),
    "conductance": ("conductance", "W/m2K", 0.0, False, 1e12),
    "thickness": ("thickness", "m", 0.0, False, 0.1),
}
#: Strongest fall of friction with temperature, 1/K: nothing is left one kelvin warmer.
_MOST_SENSITIVE = 1.0
#: Way that a run may go, m: a belt that never comes round must be longer, and still be a belt.
MOST_WAY = 0.95 * next(
    bound.le for bound in Belt.model_fields["length"].metadata if hasattr(bound, "le")
)


def check_options(arguments: Namespace) -> None:
    """Each option alone. StudyError in one line: option, value, what is allowed."""
    for name, (_, unit, low, included, high) in BOUNDS.items():
        for value in getattr(arguments, name) or ():
            if value != AIR:
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
    if arguments.map < 0 or arguments.map == 1:
        raise StudyError(f"--map = {arguments.map}: must be at least 2, or 0 for none")
    if arguments.jobs < 1:
        raise StudyError(f"--jobs = {arguments.jobs}: must be at least 1")


def _within(name: str, value: float, unit: str, low: float, included: bool, high: float) -> None:
    if low < value <= high or (included and value == low):
        return
    least = "at least" if included else "above"
    most = "below 0" if name == "ambient" else f"at most {high:g}"
    raise StudyError(
        f"--{name} = {value:g}{' ' + unit if unit else ''}: must be a number {least} {low:g} and"
        f" {most}"
    )


def check_case(case: Case, arguments: Namespace) -> None:
    """What options and scenario come to together: way, air, room on the belt."""
    _check_way(case, arguments)
    if case.h == 0.0:
        said = _named("h", "belt.air_heat_transfer", arguments)
        raise NoSteadyState(
            f"{said} = 0: a belt that gives no heat to the air warms for ever, and the study asks"
            " for its steady state; allowed is above 0 W/m2K"
        )
    try:
        case.thermal()
    except ParameterError as error:
        raise ParameterError(_in_their_words(str(error), arguments)) from None


def _check_way(case: Case, arguments: Namespace) -> None:
    protocol = case.protocol
    way = protocol.runs * protocol.moving * case.speed
    if way <= MOST_WAY:
        return
    file = f"{arguments.scenario}: " if arguments.scenario is not None else ""
    raise StudyError(
        f"{file}--ramp = {protocol.ramp:g} s, --run = {protocol.run:g} s, --runs = {protocol.runs}"
        f" at --speed = {case.speed:g} m/s (surface.run_up_time, run.duration, surface.speed of a"
        f" scenario): the belt would go {way:.3g} m, allowed is at most {MOST_WAY:g} m"
    )


def _named(option: str, key: str, arguments: Namespace) -> str:
    """The option where it was given or there is no scenario; else file and key."""
    if arguments.scenario is None or getattr(arguments, option) is not None:
        return f"--{option}"
    return f"{arguments.scenario}: {key}"


def _in_their_words(fault: str, arguments: Namespace) -> str:
    options = {field: name for name, (field, *_) in BOUNDS.items()}
    for key, field in OWN_KEYS.items():
        if fault.startswith(key):
            return _named(options[field], key, arguments) + fault.removeprefix(key)
    return fault if arguments.scenario is None else f"{arguments.scenario}: {fault}"
