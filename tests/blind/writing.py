"""A campaign as files: what the product may see in one folder, the answer in another."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import tomli_w

from .campaign import Campaign, answer
from .tracker import frames


def described(campaign: Campaign, name: str) -> dict:
    """campaign.toml as the experimenter would write it."""
    p, tracker = campaign.plan.runs[0].hidden, campaign.tracker
    rig = {
        "spring_length": p.length,
        "spring_natural_length": p.natural,
        "contact_radius": p.radius,
        "inertia": "disc",
        "surface": "belt",
    }
    if campaign.plan.line:
        rig["degrees_of_freedom"] = ["x"]
    told = {"name": name, "rig": rig}
    if tracker.stated:
        told["noise"] = dict.fromkeys(("x", "y") if tracker.with_y else ("x",), tracker.noise)
    if campaign.known:
        told["friction"] = {name: list(pair) for name, pair in campaign.known.items()}
    told["run"] = [
        {
            "file": f"run{i:02d}.csv",
            "mass": run.hidden.mass,
            "stiffness": run.hidden.stiffness,
            "surface_speed": run.hidden.speed,
            "ambient_degC": -8.0,
            "hold_out": run.hold_out,
        }
        for i, run in enumerate(campaign.plan.runs, 1)
    ]
    return told


def write_campaign(campaign: Campaign, folder: Path, answers: Path, name: str) -> dict:
    """Write folder/campaign.toml with its runs, and the answer to another file; returns it."""
    if answers.resolve().is_relative_to(folder.resolve()):
        raise ValueError(f"{answers}: the answer must not lie in the campaign's folder {folder}")
    folder.mkdir(parents=True, exist_ok=True)
    answers.parent.mkdir(parents=True, exist_ok=True)
    with open(folder / "campaign.toml", "wb") as file:
        tomli_w.dump(described(campaign, name), file)
    rng = np.random.default_rng((campaign.seed, 1))
    for i, motion in enumerate(campaign.motions, 1):
        columns = frames(motion, campaign.tracker, rng)
        decimals = [
            "%.3f" if name == "t" and not campaign.tracker.jitter else "%.6f" for name in columns
        ]
        np.savetxt(
            folder / f"run{i:02d}.csv",
            np.column_stack(list(columns.values())),
            fmt=decimals,
            delimiter=",",
            header=",".join(columns),
            comments="",
        )
    told = answer(campaign)
    answers.write_text(json.dumps(told, indent=1), encoding="utf-8")
    return told
