"""`stickslip campaign`: a folder of tracker files becomes a campaign."""

from argparse import Namespace
from pathlib import Path

from stickslip.units import in_unit

from cosim.cli import DONE, BadInput
from cosim.gap.from_folder import SETTINGS, campaign_of, shown


def execute(arguments: Namespace) -> int:
    """Guess, write, show; 0."""
    known = dict(_setting(change) for change in arguments.changes)
    frames, pixel = arguments.frames, arguments.pixel
    if frames is not None and not frames > 0.0:
        raise BadInput(f"--frames {frames:g}: allowed is a number above 0")
    length = None if pixel is None else _quantity("--pixel", pixel, "m")
    folder = Path(arguments.folder)
    file, found = campaign_of(folder, known, frames=frames, pixel=length, force=arguments.force)
    print("\n".join(shown(found, known)))
    print(f"{file}: correct what was guessed wrong or is missing, then: stickslip gap {folder}")
    return DONE


def _setting(change: str) -> tuple[str, float]:
    key, _, value = change.partition("=")
    if key not in SETTINGS:
        raise BadInput(f"--set {change}: allowed are {', '.join(SETTINGS)}")
    return key, _quantity(f"--set {key}", value, SETTINGS[key][0])


def _quantity(what: str, text: str, unit: str) -> float:
    """A number in a unit; BadInput for what is none."""
    try:
        return float(text)
    except ValueError:
        value = in_unit(text, unit)
    if value is None:
        raise BadInput(f"{what} {text}: allowed is a number of {unit}, or one with its unit")
    return value
