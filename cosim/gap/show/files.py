"""What a finished answer leaves behind: numbers and model first, then figures and the page.

Where a measurement fault was named, so does a campaign whose data are freed of it: what a filter
took away, or rounding, is gone and stays in the data.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import tomli_w

from cosim.coupling import FmuParticipant
from cosim.files import write_bytes, write_text
from cosim.fmu.build import FmuBuildError, own_fmu
from cosim.gap.data import Track
from cosim.gap.data.campaign_file import FILE_NAME
from cosim.gap.quantities import BESIDE_THE_MODEL, digits, fitted_quantities, quantity, with_digits
from cosim.gap.result import Gap, RigNumber
from cosim.gap.scatter import scatter_text
from cosim.gap.windows import camera
from cosim.interrupts import held_interrupts
from cosim.report.page import Picture, render

from . import text
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
#: Faults that can be undone; and what a corrected campaign keeps of a run.
UNDONE = tuple(f"{text.FAULT}{name}" for name in camera.UNDONE)
OF_A_RUN = ("mass", "stiffness", "surface_speed", "ambient_degC", "hold_out")
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
        reproduction=reproduction_line(gap), model_run=shown_run(gap).name,
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
        stated = plus_minus(factor * one.stated, factor * one.stated_sd)
        found = plus_minus(factor * one.value, factor * one.sd)
        if one.at_bound:
            found = f"at its bound, {with_digits(0.0, factor * one.value)[1]}"
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
    time = camera.true_time(run.motion.time[: next(iter(starts(fitted)), None)], fitted.values)
    speed = {"surface_speed": scenario.surface.speed}
    with FmuParticipant(fmu, parameters=scenario.mechanics.flat(), inputs=speed) as block:
        block.enter_initialisation(float(time[0]), float(time[-1]))
        block.exit_initialisation()
        places = [block.read()["x"]]
        for before, after in zip(time[:-1], time[1:], strict=True):
            block.step(float(before), float(after - before))
            places.append(block.read()["x"])
    written = camera.seen(np.pad(np.array(places)[:, None], ((0, 0), (0, 2))), time, fitted.values)[
        :, 0
    ]
    off = written + fitted.values.get("offset.x", 0.0) - fitted.track[: time.size, 0]
    return float(np.max(np.abs(off)) / run.noise["x"])


def write_corrected(gap: Gap, folder: Path) -> list[Path]:
    """`corrected/campaign.toml` and the runs' files beside it; [] where nothing can be undone."""
    if not set(text.faults_of(gap)) & set(UNDONE):
        return []
    campaign, target = gap.campaign, folder / "corrected"
    target.mkdir(parents=True, exist_ok=True)
    values = {run.name: run.values for run in gap.extended.runs}
    files, entries = [], []
    for number, run in enumerate(campaign.runs, 1):
        if run.track is not None:
            files.append(target / f"run{number:02d}.csv")
            numbers = {k: v for k, v in values[run.name].items() if k.startswith(text.FAULT)}
            write_text(_csv(camera.undone(run.motion, numbers), numbers), files[-1])
            entries.append({"file": files[-1].name} | {key: getattr(run, key) for key in OF_A_RUN})
    noise = {k: v for k, v in campaign.noise.items() if k not in campaign.noise_estimated}
    friction: dict[str, Any] = {key: list(pair) for key, pair in campaign.friction.items()}
    if campaign.friction_table is not None:
        friction["table"] = str(campaign.friction_table.file.resolve())
    rig, errors = (part.model_dump(exclude_unset=True) for part in (campaign.rig, campaign.errors))
    known = {"rig": rig, "noise": noise, "errors": errors, "friction": friction, "run": entries}
    table = {"name": f"{campaign.name}, corrected"[:200], **known}
    write_text(tomli_w.dumps(table), target / FILE_NAME)
    return [target / FILE_NAME, *files]


def _csv(track: Track, numbers: Mapping[str, float]) -> str:
    """Rows in SI units, with a word on what was done."""
    columns = {"t": track.time + track.time_offset} | {name: track[name] for name in track.channels}
    said = [
        f"# {quantity(key, number, None).text}: "
        f"{'undone' if key.startswith(UNDONE) else 'still in the data, as it cannot be undone'}\n"
        for key, number in numbers.items()
        if key in BESIDE_THE_MODEL and numbers.get(f"{key}_in", 1.0)
    ]  # fmt: skip
    table = pd.DataFrame(columns)
    return "".join(said) + table.to_csv(index=False, float_format="%.12g", lineterminator="\n")
