"""Write a suite: `python -m tests.blind.laboratory SUITE FOLDER --seed N [--count M]`.

Every campaign has a folder of its own, as the product reads it, and a number for a name. The
answers stand in one file apart; nothing that is hidden is told anywhere else.
"""

from __future__ import annotations

import argparse
import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from .campaign import Campaign, make_campaign
from .recording import film
from .simulation import SAMPLE
from .size import Size
from .suites import SUITES, orders_of

CONTACT = "mu_s mu_k fall_speed fall_power presliding"
OTHER_CONTACTS = "bristle_damping elastic_share creep_speed"  # numbers that they have


def write_campaign(made: Campaign, folder: Path) -> None:
    """campaign.toml and the runs' files, as the interfaces describe them."""
    folder.mkdir(parents=True, exist_ok=True)
    plan, tracker = made.plan, made.tracker
    lines = [
        f'name = "{folder.name}"',
        "[rig]",
        f"spring_length = {plan.spring_length}",
        f"spring_natural_length = {plan.natural_length}",
        f"attachment_radius = {plan.attachment_radius}",
        "attachment_angles_deg = [160, 20, 200, 340]",
        f"contact_radius = {plan.contact_radius}",
        'inertia = "disc"',
        'surface = "belt"',
        f"degrees_of_freedom = {json.dumps(['x'] if plan.guided else ['x', 'y', 'phi'])}",
    ]
    if tracker.stated:
        lines += ["[noise]", f"x = {tracker.noise}"]
        lines += [f"y = {tracker.noise}"] if tracker.with_y else []
        lines += [f"phi = {tracker.turn_noise}"] if tracker.with_phi else []
    for number, (run, rows) in enumerate(zip(plan.runs, made.motions, strict=True), 1):
        fault = made.fault if number - 1 in made.fault_runs else None
        columns = film(rows, SAMPLE, tracker, fault, made.rng)
        text = [",".join(columns)]
        values = [np.char.mod("%.7f", column) for column in columns.values()]
        text += [",".join(row) for row in zip(*values, strict=True)]
        (folder / f"run{number:02d}.csv").write_text("\n".join(text) + "\n")
        lines += [
            "[[run]]",
            f'file = "run{number:02d}.csv"',
            f"mass = {run.mass}",
            f"stiffness = {run.stiffness}",
            f"surface_speed = {run.speed}",
            "ambient_degC = -8.0",
            f"hold_out = {str(run.hold_out).lower()}",
        ]
    (folder / "campaign.toml").write_text("\n".join(lines) + "\n")


def told(name: str, shape: str, law: str, strength: float, size: Size) -> dict[str, Any]:
    """A hidden thing."""
    kept = {"name": name, "shape": shape, "law": law, "strength": strength}
    return kept | {"size": asdict(size)}


def answer(made: Campaign) -> dict[str, Any]:
    """What is true of a campaign: verdicts and effects that are right, and all that was hidden."""
    order, plan = made.order, made.plan
    effects = [*(order.alike or order.effects), *([order.fault] if order.fault else [])]
    verdict = ["named"] if effects else ["unknown", "partial"] if order.kind else ["none"]
    verdict = ["class"] if order.alike else verdict
    more: dict[str, Any] = {}
    if order.alike:
        accepted = [{"verdict": "class", "effects": list(order.alike)}]
        more = {"members": list(order.alike), "accept": accepted}
    if order.some_runs:
        more["fault_runs"] = [j + 1 for j in made.fault_runs]
    also = ["lateral_friction"] if "turning_surface" in effects else []
    hidden = [
        told(each.name, each.shape, each.text, each.strength, size)
        for each, size in zip(made.hidden, made.sizes, strict=False)
    ]
    if made.fault and order.fault:
        what, amount = made.fault
        text = " ".join((what.__doc__ or what.__name__).split())
        hidden.append(told(order.fault, what.__name__, text, amount, made.sizes[-1]))
    p = plan.runs[0].plain
    own = "rebuild_time slider_creep" if order.in_room else OTHER_CONTACTS
    contact = {name: float(p[name]) for name in f"{CONTACT} {own}".split()}
    return {
        "verdict": verdict,
        "effects": effects,
        "also_right": also,
        "out_of_catalogue": order.kind,
        "hidden": hidden,
        "exponents": {h.name: h.law.exponents for h in made.hidden if h.law and h.law.exponents},
        "contact": {"form": order.contact} | contact,
        "scatter": order.scatter,
        "rig": plan.rig,
        "tracker": asdict(made.tracker),
        "runs": [
            {
                "mass": float(r.plain["mass"]),
                "stiffness": float(r.plain["stiffness"]),
                "surface_speed": float(r.plain["belt_speed"]),
                "mu_factor": float(r.plain["scatter"]),
                "friction": "disc" if record["planar"] else "along x",
            }
            for r, record in zip(plan.runs, made.records, strict=True)
        ],
    } | more


def write_suite(
    suite: str, folder: Path, seed: int, count: int | None = None, answers: Path | None = None
) -> dict[str, dict]:
    """Write the campaigns of a suite and their answers (FOLDER/answers.json); the answers."""
    orders = orders_of(suite, seed, count)
    answers_of = {}
    for number, order in enumerate(orders):
        name = f"c{number + 1:03d}"
        made = make_campaign(order, [seed, list(SUITES).index(suite), number])
        write_campaign(made, folder / name)
        answers_of[name] = answer(made)
        text = json.dumps(answers_of, indent=1) + "\n"
        (answers or folder / "answers.json").write_text(text)
    return answers_of


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("suite", choices=SUITES)
    parser.add_argument("folder", type=Path, help="campaigns, a folder each")
    parser.add_argument("--seed", type=int, required=True)
    parser.add_argument("--count", type=int, help="campaigns; the suite's own number if left out")
    parser.add_argument("--answers", type=Path, help="FOLDER/answers.json if left out")
    asked = parser.parse_args()
    asked.folder.mkdir(parents=True, exist_ok=True)
    write_suite(asked.suite, asked.folder, asked.seed, asked.count, asked.answers)


if __name__ == "__main__":
    main()
