"""A small campaign to try the workflow on: made by the model, noise added, its effect not told."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import tomli_w
from stickslip import Parameters, simulate

from cosim.files import writable, write_unless_owned

#: Of the tracker, m.
NOISE = 2e-4
RIG, FRICTION = {"spring_natural_length": 0.17}, {"mu_s": 0.30, "mu_k": 0.22}
SPEEDS = (0.06, 0.10, 0.15, 0.25)
#: Two of them: with one load a coefficient cannot be told from a force.
MASSES = (0.87, 1.4, 1.4, 0.87)
RUNS = [{"mass": mass, "stiffness": 38.5, "surface_speed": speed}
        for mass, speed in zip(MASSES, SPEEDS, strict=True)]  # fmt: skip
#: s
DURATION, INTERVAL = 10.0, 0.01
HIDDEN = {"velocity_weakening": {"linear": 0.8}}
CAMPAIGN = "campaign.toml"


def write_example(folder: Path, seed: int = 0, force: bool = False) -> Path:
    """A campaign of four runs, the last held out, in a folder that is made; its TOML file.

    Raises OutputRefused where the folder cannot be written to, or a file of such a name is there
    with other content, unless ``force``.
    """
    names = [f"run{number:02d}.csv" for number in range(1, len(RUNS) + 1)]
    writable(folder, (CAMPAIGN, *names))
    random = np.random.default_rng(seed)
    tracks = {}
    for name, run in zip(names, RUNS, strict=True):
        tables = {
            "rig": {"mass": run["mass"], **RIG},
            "springs": {"stiffness": run["stiffness"]},
            "friction": FRICTION,
            "surface": {"speed": run["surface_speed"]},
        }
        moved = simulate(Parameters.model_validate({**tables, **HIDDEN}), DURATION, INTERVAL)
        x = moved["x"] + NOISE * random.standard_normal(moved.time.size)
        rows = [f"{t:.6g},{value:.7f}" for t, value in zip(moved.time, x, strict=True)]
        tracks[name] = "\n".join(["t,x", *rows]) + "\n"
    made = [{"file": name, **run, "hold_out": name == names[-1]}
            for name, run in zip(names, RUNS, strict=True)]  # fmt: skip
    write_unless_owned({CAMPAIGN: _campaign("example", made), **tracks}, folder, force)
    return folder / CAMPAIGN


def write_planned_example(folder: Path, force: bool = False) -> Path:
    """The same campaign before it is made: a TOML file without tracks, in a folder that is made.

    Raises OutputRefused as `write_example` does.
    """
    runs = [{**run, "duration": DURATION, "rate": 1.0 / INTERVAL} for run in RUNS]
    write_unless_owned({CAMPAIGN: _campaign("planned", runs, friction=FRICTION)}, folder, force)
    return folder / CAMPAIGN


def _campaign(name: str, runs: Sequence[Mapping[str, Any]], **known: Any) -> str:
    tables = {"name": name, "rig": RIG, "noise": {"x": NOISE}, **known}
    return "\n".join([tomli_w.dumps(tables), *(f"[[run]]\n{tomli_w.dumps(run)}" for run in runs)])
