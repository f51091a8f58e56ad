"""What a run says on the terminal when it has ended, in a few lines of its summary's numbers."""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from stickslip.steady_motion.regimes import CREEPING
from stickslip.steady_motion.stability import GRAZING, UNSTABLE
from stickslip.steady_motion.starts import OWN

from cosim.report import motion_text
from cosim.report.files import results_line
from cosim.report.material import ICE, of_material
from cosim.report.quantities import FOUND_RISE, ROUNDING, digits
from cosim.scenario.durations import in_words


def closing_lines(
    numbers: Mapping[str, Any], folder: Path, wall_time: float, material: str = ICE
) -> list[str]:
    """A few lines for whoever waited, of a summary's numbers. material: of the block."""
    late, ledgers = numbers["after_run_up"], numbers["ledger"]
    lines = [
        f"{numbers['name']}: {numbers['time_reached']:g} s in {wall_time:.1f} s of wall time, "
        f"{numbers['wall_time']:.2g} s of them in the models",
        f"  stick-slip   {_motion_line(late)}",
    ]
    if "temperatures" in numbers:
        lines += [
            f"  interface    {_interface_line(numbers)}",
            f"  heat         {of_material(_heat_line(numbers), material)}",
        ]
    if "melting" in numbers:
        lines.append(f"  melting      {_melting_line(numbers['melting'])}")
    if "in_the_end" in numbers:
        lines.append(f"  in the end   {_ending_line(numbers['in_the_end'])}")
    lines += _assessed_lines(numbers)
    lines.append(f"  ledgers      {_ledger_line(ledgers)}")
    return [*lines, results_line(folder)]


def _assessed_lines(numbers: Mapping[str, Any]) -> list[str]:
    """A line where no rig could make this motion, and one where another exists beside it."""
    if "stability" not in numbers:
        return []
    lines = []
    if numbers["stability"]["verdict"] == UNSTABLE:
        lines.append(f"  unstable     {motion_text.unstable_line(numbers)}")
    elif numbers["stability"]["verdict"] == GRAZING:
        lines.append(f"  stability    {motion_text.stability_sentence(numbers)}")
    elif ramp := motion_text.ramp_sentence(numbers):
        lines.append(f"  unstable     {ramp}")
    if numbers["other_regimes"] or numbers["regimes"][OWN]["name"] == CREEPING:
        lines.append(f"  regimes      {motion_text.regime_sentence(numbers)}")
    if any(
        (border["margin"] or 1.0) < motion_text.WELL_INSIDE
        for border in numbers["nearest_borders"] or ()
    ):
        lines.append(f"  border       {motion_text.border_sentence(numbers)}")
    return lines


def _motion_line(late: Mapping[str, Any]) -> str:
    if not late["duration"]:
        return "not known: the run ends before the surface has its speed (surface.run_up_time)"
    rate = late["frequency"]
    times = f"{rate:.3g} Hz" if rate else "no break-away"
    if rate is None:
        times = "one break-away"
    return f"{times} at constant speed, slip share {_number(late['slip_share'], '.3g')}"


def _interface_line(numbers: Mapping[str, Any]) -> str:
    """How warm it is at the end: two digits of the rise, which is known to no more."""
    interface = numbers["temperatures"]["interface"]
    rise = interface["end_rise"]
    rise = 0.0 if abs(rise) < ROUNDING["K"] else rise
    return (
        f"{_degrees(interface['end_degC'], rise)} degC at the end of the run, "
        f"{_signed(rise)} K over the air"
    )


def _ending_line(ends: Mapping[str, Any]) -> str:
    """How warm it gets for ever."""
    if "reason" in ends:
        return str(ends["reason"])
    rise, reached = ends["interface_rise"], ends["reached"]
    when = "not within 30 years" if reached is None else f"within {_span(reached)}"
    return (
        f"{_degrees(ends['interface_degC'], rise)} degC if this went on for ever, "
        f"{_signed(rise)} K over the air; {when} of the start to {100.0 * ends['within']:.0f} %"
    )


def _span(seconds: float) -> str:
    return f"{float(f'{seconds:.2g}'):g} s" if seconds < 7200.0 else in_words(seconds)


def _degrees(value: float, rise: float) -> str:
    """A temperature with the decimals of a rise of two digits."""
    decimals = 1 - math.floor(math.log10(abs(rise))) if rise else 1
    return f"{value:z.{min(max(decimals, 0), 4)}f}"


def _signed(rise: float) -> str:
    """A rise with its sign and two digits; 0 has none."""
    text = digits(abs(rise), FOUND_RISE)
    return f"{'-' if rise < 0.0 else '+'}{text}" if rise else "0"


def _heat_line(numbers: Mapping[str, Any]) -> str:
    received, shares = numbers["ledger"]["heat"]["received"], numbers["heat_shares"]
    sinks = ", ".join(
        f"{sink} {_percent(shares[sink])}"
        for sink in ("belt", "ice", "air", "melting")
        if sink != "melting" or shares.get(sink)
    )
    return f"{_heat(received)} J, of which {sinks}"


def _melting_line(melting: Mapping[str, Any]) -> str:
    film = melting["film_thickness"]
    return (
        f"from {melting['onset']:.4g} s, {1e3 * melting['melted_mass']:.3g} g in all; film "
        f"{_number(film and 1e6 * film, '.3g')} um at the end, friction coefficient "
        f"{_number(melting['friction_before'], '.3f')} before, "
        f"{_number(melting['friction_end'], '.3f')} at the end"
    )


def _ledger_line(ledgers: Mapping[str, Any]) -> str:
    """What each ledger is off by, as a part of what it is about."""
    parts = [f"mechanics {_off_by(ledgers['mechanics']['relative_residual'], 'of the work')}"]
    if "heat" in ledgers:
        parts += [
            f"heat {_off_by(ledgers['heat']['relative_residual'])}",
            f"coupling {_off_by(ledgers['coupling']['relative_difference'], 'of the heat')}",
        ]
    return ", ".join(parts)


def _off_by(part: float | None, of: str = "") -> str:
    """A part of what a ledger is about; of nothing there is none."""
    if part is None:
        return "has nothing in it"
    return f"{part:.1e} {of}".rstrip() if part else "0"


def _percent(share: float | None) -> str:
    return "none" if share is None else f"{100.0 * share:z.1f} %"


def _heat(joules: float) -> str:
    """Joules, none of them where there is but rounding."""
    return f"{0.0 if abs(joules) < ROUNDING['J'] else joules:z.3g}"


def _number(value: float | None, form: str) -> str:
    """A run too short for a number has None."""
    return "none" if value is None else format(value, form)
