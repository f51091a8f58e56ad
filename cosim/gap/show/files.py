"""What a finished answer leaves behind: numbers and model first, then figures and the page."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from cosim.coupling import FmuParticipant
from cosim.files import write_bytes, write_text
from cosim.fmu.build import FmuBuildError, own_fmu
from cosim.gap.quantities import digits, fitted_quantities, with_digits
from cosim.gap.result import Gap, RigNumber
from cosim.gap.scatter import scatter_text
from cosim.gap.windows.camera import seen, true_time
from cosim.interrupts import held_interrupts
from cosim.report.page import Picture, render

from . import text
from .corrected import write_corrected as write_corrected
from .figures import figures_of as drawers
from .model_file import model_text, scenario_of, shown_run
from .model_file import safe_name as safe_name
from .numbers import as_json
from .text import closing_lines as closing_lines
from .tracks import shown_runs, starts

#: Numbers of runs and set-ups that stand beside what was stated of them.
STATED = ("offset.x", "offset.stiffness")
#: Runs that halve the variance of a stated number tell of it.
TOLD = 0.7
#: Pictures that are seen at once.
FIRST = ("ladder", "curve", "run")


def write_data(gap: Gap, result: Path, model: Path) -> str:
    """JSON and the model; the JSON's text."""
    data = as_json(gap, model.name)
    write_text(model_text(gap), model)
    write_text(data, result)
    return data


def write_page(
    gap: Gap, folder: Path, file: Path, drawn: Callable[[], object], corrected: Sequence[Path] = ()
) -> None:
    """Every figure into the folder, and the page with all of them inside.

    drawn : called after each figure; corrected : data freed of the camera's faults
    """
    pictures = write_pictures(drawers(gap), folder, drawn)
    with held_interrupts():
        html = _page(gap, pictures, corrected)
    write_text(html, file)


def page_text(gap: Gap) -> str:
    """The page alone, no file beside it."""
    pictures = [replace(draw(), name=name) for name, draw in drawers(gap).items()]
    return _page(gap, pictures, ())


def write_pictures(
    draws: Mapping[str, Callable[[], Picture]], folder: Path, drawn: Callable[[], object]
) -> list[Picture]:
    """Pictures, by their names, each a file as well. Between two a KeyboardInterrupt passes."""
    pictures = []
    for name, draw in draws.items():
        with held_interrupts():
            pictures.append(replace(draw(), name=name))
            write_bytes(pictures[-1].png, folder / f"{name}.png")
        drawn()
    return pictures


def _page(gap: Gap, pictures: Sequence[Picture], corrected: Sequence[Path]) -> str:
    quantities = fitted_quantities(gap)
    return render(
        "gap.html.j2", "cosim.gap.show", gap=gap, text=text, digits=digits,
        with_digits=with_digits, scatter_text=scatter_text, remarks=gap.campaign.remarks,
        reproduction=reproduction_line(gap),
        corrected=corrected, quantities=quantities, runs=shown_runs(gap),
        rig=rig_rows(gap), untold=sum(not _is_told(one) for one in gap.rig),
        setups={gap.campaign.setup_of(run) for run in shown_runs(gap)},
        owned=[one for one in quantities if one.owner and one.key not in STATED],
        first=[one for one in pictures if one.name in FIRST],
        folded=[one for one in pictures if one.name not in FIRST],
        numbers=[
            text.numbers_of(row, quantities, gap.campaign.catalogue) for row in gap.ranking
        ],
    )  # fmt: skip


def rig_rows(gap: Gap) -> list[dict[str, str]]:
    """What was stated of springs and zeros, and what the runs say, in units that are read."""
    rows = []
    for one in sorted(filter(_is_told, gap.rig), key=lambda one: one.name):
        factor, unit = {"1": (1e2, "%"), "m": (1e3, "mm")}.get(one.unit, (1.0, one.unit))
        pairs = ((one.stated, one.stated_sd), (one.value, one.sd))
        stated, found = (plus_minus(factor * value, factor * sd) for value, sd in pairs)
        rows.append({"name": one.name, "stated": stated, "found": found, "unit": unit})
    return rows


def _is_told(number: RigNumber) -> bool:
    """Whether the runs say more of it than is stated."""
    off = abs(number.value - number.stated)
    return number.sd < TOLD * number.stated_sd or off > number.stated_sd


def plus_minus(value: float, sd: float) -> str:
    """`0.30 ± 0.26`, both with the decimals of two digits of the standard deviation."""
    return " ± ".join((with_digits(value, value - sd, value + sd)[0], digits(sd, 2)))


def reproduction_line(gap: Gap) -> str:
    """What the FMU does with the numbers of model.toml, in a sentence."""
    try:
        off = largest_difference(gap, own_fmu(gap.campaign.catalogue))
    except FmuBuildError as error:
        return f"The FMU was not asked: {error}."
    moves = "moves as the fitted model does" if off < 1.0 else "does not move as the fitted model"
    return (
        f"The FMU StickSlip3DOF with the numbers of model.toml {moves}: "
        f"over the first cycles of {shown_run(gap).name} their places differ by "
        f"{'less than 0.001' if off < 1e-3 else digits(off, 2)} noise units at most."
    )


def largest_difference(gap: Gap, fmu: Path) -> float:
    """Between FMU and fitted model along x until the fit sets out anew, in units of the noise."""
    run = shown_run(gap)
    scenario, fitted = scenario_of(gap, run), gap.extended.run(run.name)
    time = true_time(run.motion.time[: next(iter(starts(run, fitted)), None)], fitted.values)
    speed = {"surface_speed": scenario.surface.speed}
    with FmuParticipant(fmu, parameters=scenario.mechanics.flat(), inputs=speed) as block:
        block.enter_initialisation(float(time[0]), float(time[-1]))
        block.exit_initialisation()
        places = [block.read()["x"]]
        for before, after in zip(time[:-1], time[1:], strict=True):
            block.step(float(before), float(after - before))
            places.append(block.read()["x"])
    written = seen(np.pad(np.array(places)[:, None], ((0, 0), (0, 2))), time, fitted.values)[:, 0]
    off = written + fitted.values.get("offset.x", 0.0) - fitted.track[: time.size, 0]
    return float(np.max(np.abs(off)) / run.noise["x"])
