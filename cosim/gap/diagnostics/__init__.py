"""Where the misfit lives: residual forces by regime and variable, and a formula for them."""

from cosim.gap.diagnostics.dependence import Dependence
from cosim.gap.diagnostics.empirical import empirical_term
from cosim.gap.diagnostics.features import Feature, library
from cosim.gap.diagnostics.force_term import Term
from cosim.gap.diagnostics.model_track import ModelTrack, tracks_of
from cosim.gap.diagnostics.regimes import RegimeAnalysis, Region, analyse_residuals
from cosim.gap.diagnostics.spectrum import (
    Period,
    pattern_wavelength,
    ripple_frequency,
    strongest_period,
)
from cosim.gap.diagnostics.variables import VARIABLES
from cosim.gap.diagnostics.where import Where, find_where

__all__ = [
    "VARIABLES",
    "RegimeAnalysis",
    "Dependence",
    "Feature",
    "ModelTrack",
    "Period",
    "Region",
    "Term",
    "Where",
    "empirical_term",
    "find_where",
    "library",
    "pattern_wavelength",
    "analyse_residuals",
    "ripple_frequency",
    "strongest_period",
    "tracks_of",
]
