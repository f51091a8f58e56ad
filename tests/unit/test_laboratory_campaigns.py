"""The foreign laboratory's campaigns: files, sizes, seeds; nothing leaks."""

from __future__ import annotations

import ast
import sys
import tomllib
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

sys.path.insert(0, str(Path(__file__).parents[1]))
import blind.laboratory  # noqa: E402
from blind.laboratory import held_back, out_of_catalogue  # noqa: E402
from blind.laboratory.__main__ import answer, write_campaign  # noqa: E402
from blind.laboratory.campaign import (  # noqa: E402
    Order,
    make_campaign,
    move,
    plain_records,
)
from blind.laboratory.size import measure  # noqa: E402

pytestmark = pytest.mark.slow  # numba compiles the simulator, and no answer hangs on it
EFFECTS = {
    "lateral_friction",
    "turning_surface",
    "static_strengthening",
    "velocity_weakening",
    "film_drag",
    "thermal_weakening",
    "run_in",
    "spring_hardening",
    "structural_damping",
    "speed_ripple",
    "surface_pattern",
    "load_dependence",
    "spring_misalignment",
}


@pytest.fixture(scope="module")
def hidden():
    return make_campaign(Order("jump", ("velocity_weakening",), scatter=0.03), [3])


@pytest.fixture(scope="module")
def written(hidden, tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("laboratory") / "c001"
    write_campaign(hidden, folder)
    return folder


def test_files_are_as_the_interfaces_say(hidden, written):
    told = tomllib.loads((written / "campaign.toml").read_text())
    assert set(told) <= {"name", "rig", "noise", "run"}
    assert told["rig"]["surface"] == "belt" and told["rig"]["inertia"] == "disc"
    assert 5 <= len(told["run"]) <= 8
    assert 1 <= sum(run["hold_out"] for run in told["run"]) <= 2
    for run, plan in zip(told["run"], hidden.plan.runs, strict=True):
        keys = {"file", "mass", "stiffness", "surface_speed", "ambient_degC", "hold_out"}
        assert set(run) == keys
        data = pd.read_csv(written / run["file"])
        assert list(data)[:2] == ["t", "x"] and set(data) <= {"t", "x", "y", "phi"}
        assert data.notna().all(axis=None) and (np.diff(data["t"]) > 0).all()
        assert data["t"].iloc[-1] == pytest.approx(hidden.plan.duration, abs=0.6)
        assert run["mass"] == pytest.approx(float(plan.plain["mass"]), rel=0.01)
        assert run["stiffness"] == pytest.approx(float(plan.plain["stiffness"]), rel=0.04)
        assert run["surface_speed"] == pytest.approx(float(plan.plain["belt_speed"]), rel=0.04)


def test_nothing_hidden_is_told(written):
    text = (written / "campaign.toml").read_text()
    words = EFFECTS | set(out_of_catalogue.KINDS) | set(held_back.KINDS) | {"jump", "mu_"}
    assert not any(word in text for word in words)
    assert not list(written.glob("*.json"))


def test_same_seed_same_campaign(hidden, written, tmp_path):
    again = make_campaign(hidden.order, [3])
    write_campaign(again, tmp_path / "c001")
    for file in written.iterdir():
        assert file.read_bytes() == (tmp_path / "c001" / file.name).read_bytes()
    assert answer(again) == answer(hidden)


def test_size_is_nothing_where_nothing_is_hidden_and_goes_with_the_noise(hidden):
    plains = plain_records(hidden.plan)[:3]
    short = hidden.plan.__class__(**{**vars(hidden.plan), "runs": hidden.plan.runs[:3]})
    step = 5e-5
    assert measure(plains, move(short, plains), 1e-4, 1, step).raw < 1e-6
    one = measure(plains, hidden.motions[:3], 1e-4, 1, step)
    other = measure(plains, hidden.motions[:3], 2e-4, 1, step)
    assert one.size == pytest.approx(2 * other.size)
    assert 0 < one.size < one.raw


def test_the_laboratory_knows_nothing_of_the_product():
    allowed = {"numpy", "numba", "scipy"} | set(sys.stdlib_module_names)
    for file in Path(blind.laboratory.__file__).parent.glob("*.py"):
        for node in ast.walk(ast.parse(file.read_text())):
            if isinstance(node, ast.Import):
                assert {name.name.split(".")[0] for name in node.names} <= allowed
            elif isinstance(node, ast.ImportFrom) and node.level == 0:
                assert (node.module or "").split(".")[0] in allowed
            elif isinstance(node, ast.ImportFrom):
                assert node.level == 1
