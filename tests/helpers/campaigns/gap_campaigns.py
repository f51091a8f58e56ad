"""Campaigns on disk for the tests of the gap workflow: exact motions with noise, written as CSV."""

import numpy as np
import tomli_w
from stickslip import Parameters, simulate

from cosim.gap import read_campaign

NOISE = 2e-4
KNOWN = {"mass": 0.87, "stiffness": 38.5}
RIG = {"spring_natural_length": 0.17}


def motion(
    speed=0.06, mass=0.87, mu_s=0.3, mu_k=0.2, duration=20.0, interval=0.01, creep=0.0,
    stiffness=KNOWN["stiffness"], run_up=0.0, free=("x", "y", "phi"), **blocks,
):  # fmt: skip
    """The exact motion of a block that sticks and slips; creep: in stick, m/s; run_up: s."""
    parameters = Parameters(
        rig={"mass": mass, "degrees_of_freedom": free, **RIG}, springs={"stiffness": stiffness},
        friction={"mu_s": mu_s, "mu_k": mu_k, "stick_creep": creep},
        surface={"speed": speed, "run_up_time": run_up}, **blocks,
    )  # fmt: skip
    return simulate(parameters, duration, interval)


def noisy(values, seed, noise=NOISE):
    return values + noise * np.random.default_rng(seed).standard_normal(len(values))


def seen(run, seed, noise=NOISE, **table):
    """A table of [[run]] with the run's columns along x, as a tracker has them."""
    return table | {"columns": {"t": run.time, "x": noisy(run["x"], seed, noise)}}


def campaign_with(folder, runs, **tables):
    """The campaign of these runs, read; its noise is stated."""
    return read_campaign(write_campaign(folder, runs, **{"noise": {"x": NOISE}} | tables))


def write_csv(path, columns):
    """columns: name -> values"""
    table = np.stack(list(columns.values()), axis=1)
    rows = [",".join("" if np.isnan(v) else f"{v:.15g}" for v in row) for row in table]
    path.write_text("\n".join([",".join(columns), *rows]) + "\n", encoding="utf-8")


def write_campaign(folder, runs, **tables):
    """runs: tables of [[run]], each with `columns` for its file or without a file."""
    entries = []
    for number, run in enumerate(runs, 1):
        entry = KNOWN | {"surface_speed": 0.06} | run
        columns = entry.pop("columns", None)
        if columns is not None:
            entry.setdefault("file", f"run{number:02d}.csv")
            write_csv(folder / entry["file"], columns)
        entries.append({key: value for key, value in entry.items() if value is not None})
    content = {"name": "test", "rig": RIG} | tables | {"run": entries}
    (folder / "campaign.toml").write_text(tomli_w.dumps(content), encoding="utf-8")
    return folder / "campaign.toml"
