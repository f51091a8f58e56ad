"""What stands at the top of a run's page: the answer in a sentence, and at most four figures."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from .quantities import told

COMPLETE = "complete"


def headline(numbers: Mapping[str, Any]) -> str:
    """Whether the block sticks and slips, and how warm its contact gets; from a summary."""
    time = numbers["time_reached"]
    if time is None:
        return "The run failed before its first row."
    said = f"The block {_does(numbers)}"
    if "temperatures" in numbers:
        rise = numbers["temperatures"]["interface"]["end_rise"]
        said += f", and its contact is {told(rise, 'K')} above the air after {told(time, 's')}"
    ended = "" if numbers["status"] == COMPLETE else f"; the run ended early, at {told(time, 's')}"
    return f"{said}{ended}."


def _does(numbers: Mapping[str, Any]) -> str:
    """The motion at constant speed; in the speed ramp, where the run does not come further."""
    moves = numbers["after_run_up"]
    if not moves["duration"]:
        whole = numbers["whole_run"]["break_aways"]
        return f"breaks away {_times(whole)} in the speed ramp, which the run does not outlast"
    if moves["frequency"]:
        return f"sticks and slips {told(moves['frequency'], '1')} times a second"
    if moves["break_aways"]:
        return f"breaks away {_times(moves['break_aways'])} at constant speed"
    if moves["slip_share"] == 1.0:
        return "slides without ever sticking"
    return "sticks and never slips"


def _times(count: int) -> str:
    return "once" if count == 1 else f"{count} times"


def tiles(numbers: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Words and figures; none where no row was computed."""
    moves = numbers.get("after_run_up")
    if moves is None:
        return []
    frequency = moves["frequency"]
    found = [
        ("stick-slip frequency", "none" if frequency == 0.0 else told(frequency, "Hz")),
        ("of the time in slip", told(moves["slip_share"], "1", share=True)),
        ("mean x", told(moves["mean_x"], "m")),
    ]
    if "temperatures" in numbers:
        warmest = numbers["temperatures"]["interface"]["max_rise"]
        return [*found, ("warmest contact, over the air", told(warmest, "K"))]
    return [*found, ("largest rotation", told(moves["max_rotation_deg"], "deg"))]
