"""Friction against speed and temperature in steady coupled sliding: the regimes and their slopes.

Dry, boundary (asperities melt in passing), mixed and hydrodynamic friction (a film of melt is
sheared), as the effects temperature_dependence, asperity_melting and melt_film make them.
"""

from .map import FrictionMap, friction_map

__all__ = ["FrictionMap", "friction_map"]
