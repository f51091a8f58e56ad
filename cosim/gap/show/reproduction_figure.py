"""The FMU's motion beside the measured one."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.figure import Figure

from cosim.gap.result import Gap
from cosim.report.style import INK, RED, panels, picture

from .reproduced import Reproduced
from .run_figures import SCALES, channels

CAPTION = (
    "The FMU StickSlip3DOF with the numbers of model.toml (red), from the initial state of each "
    "run's first segment, stepped from sample to sample, and what was measured (dots). Right: "
    "measured less FMU in units of the noise, grey two standard deviations."
)


@picture("fmu", CAPTION)
def draw_reproduction(gap: Gap, reproduced: Sequence[Reproduced]) -> Figure:
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
        left.set_title(f"{one.name}: gap {one.gap:.3g}")
        right.axhspan(-2.0, 2.0, color="#EDEDED", zorder=0)
        right.plot(
            one.time,
            (one.measured[channel] - one.motion[channel]) / noise,
            ".",
            color=RED,
            markersize=2.6,
        )
        right.set_ylabel("noise units")
    for axis in axes[-1]:
        axis.set_xlabel("time in the run (s)")
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside upper right", ncols=2)
    return figure
