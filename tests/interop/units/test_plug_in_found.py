"""A law that the catalogue lacks, hidden in motions of the tests' own model, named by `gap`."""

import json
from pathlib import Path

import numpy as np
from command_line import stickslip
from gap_campaigns import KNOWN, NOISE, noisy, write_campaign
from one_mass_model import GRAVITY, OneMass, X

EFFECT = Path(__file__).resolve().parents[2] / "examples" / "effects" / "flash_heating.py"
TIMES = np.linspace(0.0, 6.0, 601)
MU_S, MU_K, FALL, ONSET = 0.3, 0.2, 0.5, 0.06
#: Springs neither stretched nor able to turn the block: the tests' own model is that of a line.
RIG = {"spring_natural_length": 0.2, "degrees_of_freedom": ["x"]}


def motion(speed):
    """x of a block whose contacts get hot, on a belt."""
    normal = KNOWN["mass"] * GRAVITY
    model = OneMass(
        mass=KNOWN["mass"],
        pull=lambda x: -4.0 * KNOWN["stiffness"] * x,
        kinetic=lambda sliding, _: (
            MU_K * normal * (1.0 - FALL + FALL / (1.0 + (sliding / ONSET) ** 8.0) ** 0.125)
        ),
        static=lambda held, _: MU_S * normal,
        speed=lambda t: speed,
    )
    return model.run(TIMES)[0][X]


def test_it_is_named_and_the_model_that_has_it_is_a_scenario(tmp_path):
    runs = []
    for number, speed in enumerate((0.03, 0.06, 0.1, 0.2)):
        columns = {"t": TIMES, "x": noisy(motion(speed), number)}
        runs.append({"surface_speed": speed, "hold_out": number == 2, "columns": columns})
    (tmp_path / EFFECT.name).write_text(EFFECT.read_text(encoding="utf-8"), encoding="utf-8")
    model = {"effects": [EFFECT.name]}
    write_campaign(tmp_path, runs, rig=RIG, noise={"x": NOISE}, model=model)
    out = tmp_path / "out"
    done = stickslip(tmp_path, "gap", tmp_path, "-o", out, "--no-page")
    assert done.returncode == 0, done.stderr
    found = json.loads((out / "gap.json").read_text(encoding="utf-8"))
    assert (found["verdict"], found["effects"]) == ("named", ["flash_heating"])
    # a whole repair: near the noise in runs that no fit has seen
    assert found["gap"]["after"]["held_out"] < 1.5 < found["gap"]["before"]["held_out"]
    assert EFFECT.name in (out / "model.toml").read_text(encoding="utf-8")
    done = stickslip(tmp_path, "simulate", out / "model.toml", "-o", tmp_path / "motion")
    assert done.returncode == 0, done.stderr
    summary = json.loads((tmp_path / "motion" / "summary.json").read_text(encoding="utf-8"))
    assert summary["status"] == "complete"
