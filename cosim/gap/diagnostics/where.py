"""Where the misfit lives, in one sentence."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from cosim.gap.diagnostics.dependence import Dependence
from cosim.gap.diagnostics.regimes import RegimeAnalysis, Region
from cosim.gap.diagnostics.variables import VARIABLES

#: A misfit counts where chance makes one like it, in any of the tests, less often than this.
CHANCE = 0.01
#: Variables that are phases: the period found, and its unit.
PERIODIC = {"time_phase": ("ripple", "s"), "surface_phase": ("pattern", "m of surface")}
#: Values that are known so many times worse than usual are not quoted.
UNCLEAR = 3.0
#: Residuals, in units of the noise, up to which a misfit is of no account.
SLIGHT = 1.1
#: Runs are named until this part of what was explained is covered.
COVERED = 0.8


#: Below this power of ten a probability is one of the model of the noise, not of the data.
LEAST_CHANCE = -12.0


def told_chance(log10_p: float) -> str:
    """A probability by its logarithm, as it stands behind a p: "= 0.012", "= 1e-7", "< 1e-12".

    >>> [told_chance(value) for value in (-1.92, -7.1, -1866.0)]
    ['= 0.012', '= 1e-7', '< 1e-12']
    """
    if log10_p < LEAST_CHANCE:
        return f"< 1e{LEAST_CHANCE:.0f}"
    return f"= {10.0**log10_p:.2g}" if log10_p > -4.0 else f"= 1e{log10_p:.0f}"


@dataclass(frozen=True)
class Where:
    """Channel, regime and runs of the misfit (empty where there is none), and the sentence."""

    channel: str
    regime: str
    runs: tuple[str, ...]
    text: str


def find_where(analysis: RegimeAnalysis, slight: float = SLIGHT) -> Where:
    """The region that takes most of the sum of squares, of those that are not chance.

    Where all residuals together are below ``slight`` times the noise, nothing is missing that
    matters, and what is certain is only mentioned.
    """
    limit = math.log10(CHANCE) - math.log10(max(analysis.tests, 1))
    certain = [region for region in analysis.regions if region.most_certain < limit]
    if not certain:
        return Where("", "", (), _nothing(analysis))
    # where a block comes to rest follows from where it broke away and what slowed it down
    causes = [region for region in certain if region.regime != "re-stick"] or certain
    worst = max(causes, key=lambda region: sum(region.explained.values()))
    if analysis.rms_residual < slight:
        trace = f"{worst.channel} {_in(worst.regime)}"
        return Where(
            "", "", (), f"No misfit that matters: {_left(analysis)}; a trace is in {trace}."
        )
    runs = _runs(worst)
    others = [region for region in certain if region is not worst]
    return Where(worst.channel, worst.regime, runs, _sentence(worst, runs, others, analysis))


def _nothing(analysis: RegimeAnalysis) -> str:
    if not analysis.regions:
        return "Nothing can be compared: measurement and model share no stretch of stick or slip."
    least = min(region.most_certain for region in analysis.regions)
    chance = min(least + math.log10(analysis.tests), 0.0)
    return (
        f"No misfit beyond the noise in any channel or regime: {_left(analysis)}; the most "
        f"suspicious of {analysis.tests} tests comes about by chance with probability "
        f"p {told_chance(chance)}."
    )


def _left(analysis: RegimeAnalysis) -> str:
    return f"all residuals together are {analysis.rms_residual:.3g} times the noise"


def _runs(region: Region) -> tuple[str, ...]:
    """The runs that hold most of what was explained, largest first."""
    order = sorted(region.explained, key=lambda name: -region.explained[name])
    total = sum(max(value, 0.0) for value in region.explained.values())
    named: list[str] = []
    covered = 0.0
    for name in order:
        if covered >= COVERED * total:
            break
        named.append(name)
        covered += region.explained[name]
    return tuple(named)


def _sentence(
    region: Region, runs: tuple[str, ...], others: list[Region], analysis: RegimeAnalysis
) -> str:
    """What, where, on what it depends, in which runs, and what else there is."""
    limit = math.log10(CHANCE) - math.log10(analysis.tests)
    told = [found for found in region.dependences if found.log10_p < limit]
    if told:
        depends = _depends(region, told[0], analysis)
        more = [VARIABLES[found.variable].label for found in told[1:3]]
        depends += f" (also on {' and '.join(more)})" if more else ""
    else:
        largest = int(np.argmax(np.abs(region.value) / region.error))
        depends = (
            f"by {region.value[largest]:+.3g} {region.unit} in {region.runs[largest]}, and depends "
            "on nothing that was looked at"
        )
    text = (
        f"The misfit lives in {region.channel}, {_in(region.regime)}: the {region.quantity} "
        f"differs from the model's {depends}; mostly in {', '.join(runs)}."
    )
    if others:
        places = [f"{other.channel} {_in(other.regime)}" for other in others]
        text += f" Less of it is in {', '.join(places)}."
    return text


def _depends(region: Region, found: Dependence, analysis: RegimeAnalysis) -> str:
    """By how much a region's misfit differs, and most clearly with what."""
    clear = np.flatnonzero(found.error <= UNCLEAR * np.median(found.error))
    low, high = clear[np.argmin(found.value[clear])], clear[np.argmax(found.value[clear])]
    variable = VARIABLES[found.variable]
    if found.variable in PERIODIC:
        name, what = PERIODIC[found.variable]
        period = getattr(analysis, name)
        return (
            f"by {found.value[low]:+.3g} to {found.value[high]:+.3g} {region.unit} and repeats "
            f"itself every {period.length:.4g} {what}"
        )
    return (
        f"by {found.value[low]:+.3g} {region.unit} (at {found.centre[low]:.3g} {variable.unit}) to "
        f"{found.value[high]:+.3g} {region.unit} (at {found.centre[high]:.3g} {variable.unit}) and "
        f"depends most clearly on {variable.label}"
    )


def _in(regime: str) -> str:
    return f"at {regime}" if regime in ("break-away", "re-stick") else f"in {regime}"
