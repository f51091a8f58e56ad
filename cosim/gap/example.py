"""A small campaign to try the workflow on: made by the model, noise added, its effect not told."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import tomli_w
from stickslip import Parameters, simulate

from cosim.files import writable, write_unless_owned

#: Of the tracker, m.
NOISE = 2e-4
STIFFNESS, NATURAL_LENGTH = 38.5, 0.17
SPEEDS = (0.06, 0.10, 0.15, 0.25)
#: Two of them: with one load a coefficient cannot be told from a force.
MASSES = (0.87, 1.4, 1.4, 0.87)
MU_S, MU_K = 0.30, 0.22
#: s
DURATION, INTERVAL = 10.0, 0.01
HIDDEN = {"velocity_weakening": {"linear": 0.8}}
CAMPAIGN = "campaign.toml"


def write_example(folder: Path, seed: int = 0, force: bool = False) -> Path:
    """A campaign of four runs, the last held out, in a folder that is made; its TOML file.

    Raises OutputRefused where the folder cannot be written to, or a file of such a name is there
    with other content, unless ``force``.
    """
    names = [f"run{number:02d}.csv" for number in range(1, len(SPEEDS) + 1)]
    writable(folder, (CAMPAIGN, *names))
    random = np.random.default_rng(seed)
    texts = {CAMPAIGN: _campaign(names)}
    for name, mass, speed in zip(names, MASSES, SPEEDS, strict=True):
        run = simulate(_parameters(mass, speed), DURATION, INTERVAL)
        x = run["x"] + NOISE * random.standard_normal(run.time.size)
        rows = [f"{t:.6g},{value:.7f}" for t, value in zip(run.time, x, strict=True)]
        texts[name] = "\n".join(["t,x", *rows]) + "\n"
    write_unless_owned(texts, folder, force)
    return folder / CAMPAIGN


def write_planned_example(folder: Path, force: bool = False) -> Path:
    """The same campaign before it is made: a TOML file without tracks, in a folder that is made.

    Raises OutputRefused as `write_example` does.
    """
    known = {
        "name": "planned",
        "rig": {"spring_natural_length": NATURAL_LENGTH},
        "noise": {"x": NOISE},
        "friction": {"mu_s": MU_S, "mu_k": MU_K},
    }
    record = {"duration": DURATION, "rate": 1.0 / INTERVAL}
    runs = [
        {"mass": mass, "stiffness": STIFFNESS, "surface_speed": speed} | record
        for mass, speed in zip(MASSES, SPEEDS, strict=True)
    ]
    tables = [tomli_w.dumps(known), *[f"[[run]]\n{tomli_w.dumps(run)}" for run in runs]]
    write_unless_owned({CAMPAIGN: "\n".join(tables)}, folder, force)
    return folder / CAMPAIGN


def _campaign(names: Sequence[str]) -> str:
    """The last run is held out."""
    known = {
        "name": "example",
        "rig": {"spring_natural_length": NATURAL_LENGTH},
        "noise": {"x": NOISE},
    }
    lines = [tomli_w.dumps(known)]
    for name, mass, speed in zip(names, MASSES, SPEEDS, strict=True):
        run = {"file": name, "mass": mass, "stiffness": STIFFNESS, "surface_speed": speed,
               "hold_out": name == names[-1]}  # fmt: skip
        lines.append(f"[[run]]\n{tomli_w.dumps(run)}")
    return "\n".join(lines)


def _parameters(mass: float, speed: float) -> Parameters:
    return Parameters.model_validate(
        {
            "rig": {"mass": mass, "spring_natural_length": NATURAL_LENGTH},
            "springs": {"stiffness": STIFFNESS},
            "friction": {"mu_s": MU_S, "mu_k": MU_K},
            "surface": {"speed": speed},
            **HIDDEN,
        }
    )
