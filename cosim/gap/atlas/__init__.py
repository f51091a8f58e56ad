"""Where the misfit lives: residual forces by regime and by what they depend on."""

from cosim.gap.atlas.atlas import Atlas, Region, residual_atlas
from cosim.gap.atlas.dependence import Dependence
from cosim.gap.atlas.figure import draw_atlas
from cosim.gap.atlas.from_fit import tracks_of
from cosim.gap.atlas.model_track import ModelTrack
from cosim.gap.atlas.spectrum import Period, pattern_wavelength, ripple_frequency, strongest_period
from cosim.gap.atlas.variables import VARIABLES
from cosim.gap.atlas.where import Where, find_where

__all__ = [
    "VARIABLES",
    "Atlas",
    "Dependence",
    "ModelTrack",
    "Period",
    "Region",
    "Where",
    "draw_atlas",
    "find_where",
    "pattern_wavelength",
    "residual_atlas",
    "ripple_frequency",
    "strongest_period",
    "tracks_of",
]
