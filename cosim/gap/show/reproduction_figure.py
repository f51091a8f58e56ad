"""The FMU's motion beside the measured one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from matplotlib.figure import Figure

from cosim.gap.result import Gap
from cosim.report.live import Curve, Live, Panel, over_time, several
from cosim.report.page import Picture
from cosim.report.style import GREY, INK, PALE_GREY, RED, panels, picture

from .reproduced import Reproduced
from .run_figures import SCALES, channels, noise_scale, residual_panel

CAPTION = (
    "The FMU StickSlip3DOF with the numbers of model.toml (dark orange), from the state at the "
    "first sample of each run to its end, stepped from sample to sample, and what was measured "
    "(dots). The fit starts anew from the data at the dotted line, the FMU never does: what it is "
    "off later is small errors of the period that add up, and friction that differs from stretch "
    "to stretch. Beside or below it: measured less FMU in units of the noise, with lines or a grey "
    "band at two standard deviations; linear within ±3, logarithmic beyond where there is much."
)


def reproduction(gap: Gap, reproduced: Sequence[Reproduced]) -> Picture:
    """Measured and flown, and what is left, of each run."""
    return replace(
        _reproduction(gap, reproduced),
        alt="Each run over time as the FMU flies it, as it was measured, and what is left.",
        live=_live(gap, reproduced),
    )


def _live(gap: Gap, reproduced: Sequence[Reproduced]) -> Live:
    """The same for the page: a figure for each run, below each channel what is left of it."""
    found = {}
    for one in reproduced:
        shown = []
        for channel in channels(gap):
            factor, label = SCALES[channel]
            noise = gap.model.of(one.name).track.run.noise[channel]
            shown += [
                Panel(
                    label.replace("(", "[").replace(")", "]"),
                    [
                        Curve("measured", factor * one.measured[channel], INK, dots=True),
                        Curve("FMU", factor * one.motion[channel], RED),
                    ],
                ),
                residual_panel(
                    "measured less FMU",
                    {channel: (one.measured[channel] - one.motion[channel]) / noise},
                ),
            ]
        anew = one.first < one.time.size
        marks = [(float(one.time[one.first]), "the fit starts anew")] if anew else ()
        found[f"{one.name} by the FMU"] = over_time(one.time, shown, marks=marks)
    return several(found)


@picture("fmu", CAPTION)
def _reproduction(gap: Gap, reproduced: Sequence[Reproduced]) -> Figure:
    """A row for each run and channel."""
    rows = [(one, channel) for one in reproduced for channel in channels(gap)]
    figure, axes = panels(
        len(rows), 2, height=1.9, width=11.0, gridspec_kw={"width_ratios": (1.6, 1.0)}
    )
    for (left, right), (one, channel) in zip(axes, rows, strict=True):
        noise = gap.model.of(one.name).track.run.noise[channel]
        factor, label = SCALES[channel]
        left.plot(
            one.time,
            factor * one.measured[channel],
            ".",
            color=INK,
            markersize=2.6,
            label="measured",
        )
        left.plot(one.time, factor * one.motion[channel], color=RED, label="FMU")
        left.set_ylabel(label)
        whole = f", {one.whole:.3g} over all" if one.first < one.time.size else ""
        left.set_title(f"{one.name}: gap {one.gap:.3g} in the first segment{whole}")
        right.axhspan(-2.0, 2.0, color=PALE_GREY, zorder=0)
        right.plot(
            one.time,
            (one.measured[channel] - one.motion[channel]) / noise,
            ".",
            color=RED,
            markersize=2.6,
        )
        right.set_ylabel("noise units")
        left_over = (one.measured[channel] - one.motion[channel]) / noise
        noise_scale(right, float(np.nanmax(np.abs(left_over))))
        for axis in (left, right):
            if one.first < one.time.size:
                axis.axvline(one.time[one.first], color=GREY, linewidth=0.8, linestyle=":")
    for axis in axes[-1]:
        axis.set_xlabel("time in the run (s)")
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside upper right", ncols=2)
    return figure
