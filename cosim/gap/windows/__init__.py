"""Numbers of a model fitted to measured runs in short windows, and the gap that remains."""

from .fit import fit, judge
from .fitted import Fitted, FittedRun
from .numbers import Number
from .sticks import sticks_of
from .user_model import user_model
from .windows import Windows, windows_of, windows_of_campaign

__all__ = [
    "Fitted",
    "FittedRun",
    "Number",
    "Windows",
    "fit",
    "judge",
    "sticks_of",
    "user_model",
    "windows_of",
    "windows_of_campaign",
]
