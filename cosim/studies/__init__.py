"""Questions that take many runs, a room each: the runs, what follows from them, its figures."""

from stickslip.packaged import packaged_tables

#: What stands below the figures, by their names: keywords of `cosim.report.style.picture`.
FIGURES = packaged_tables(__name__, "figures.toml")
