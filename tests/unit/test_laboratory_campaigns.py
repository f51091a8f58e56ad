"""The foreign laboratory's campaigns: files, sizes, seeds, cameras, suites; nothing leaks."""

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
from blind.laboratory import fresh_kinds, fresh_laws, held_back, out_of_catalogue, recording  # noqa: E402
from blind.laboratory.__main__ import answer, write_campaign  # noqa: E402
from blind.laboratory.campaign import (  # noqa: E402
    Order,
    make_campaign,
    move,
    plain_records,
)
from blind.laboratory.laws import LAWS  # noqa: E402
from blind.laboratory.plans import draw_plan  # noqa: E402
from blind.laboratory.recording import FAULTS, Tracker, film  # noqa: E402
from blind.laboratory.size import measure  # noqa: E402
from blind.laboratory.suites import BLURRED, orders_of  # noqa: E402

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
MEASUREMENT = {"scale", "clock", "rotation", "drift", "latency", "smoothing", "quantisation"}
CLEAN = Tracker(100.0, 1e-9, 1e-9, True, 0.0, 0, 0.0, 0.0, True, False)


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


def test_what_friction_numbers_can_do_has_no_size():
    """A change of mu_k alone is made good by the plain model's own mu_k."""
    plan = draw_plan(np.random.default_rng(5), "bench", "smooth")
    plains = plain_records(plan)[:3]
    short = plan.__class__(**{**vars(plan), "runs": plan.runs[:3]})
    changed = [p.copy() for p in plains]
    for p in changed:
        p["mu_k"] *= 1.005
    size = measure(plains, move(short, changed), 1e-5, 1, 1e-4)
    assert size.size < 0.15 * size.raw


@pytest.mark.parametrize("catalogue", [LAWS, fresh_laws.LAWS], ids=["laws", "fresh"])
@pytest.mark.parametrize("name", sorted(EFFECTS))
def test_every_law_changes_the_motion_and_every_shape_is_drawn(name, catalogue):
    """Each has two shapes or more, and its strength counts."""
    rig = "planar" if name in ("lateral_friction", "spring_misalignment") else "guided"
    rig = "planar" if name == "turning_surface" else rig
    plan = draw_plan(np.random.default_rng(8), rig, "jump", aside=rig == "planar", loads=True)
    laws = [catalogue[name](np.random.default_rng(seed), plan.reference) for seed in range(40)]
    chosen = {tuple(law.shape.split(",")[:2]): law for law in laws}
    assert len(chosen) >= 2 and {law.effect for law in laws} == {name}
    run = max(plan.runs, key=lambda run: (run.mass, run.speed))
    short = plan.__class__(**{**vars(plan), "runs": (run,), "duration": 3.0})
    (plain,) = move(short, [run.plain], 2)
    for law in chosen.values():
        record = run.plain.copy()
        law.apply(record, law.start, plan.reference)
        (changed,) = move(short, [record], 2)
        assert np.isfinite(changed).all()
        assert np.abs(changed[:, :2] - plain[:, :2]).max() > 2e-5, law.text


@pytest.mark.parametrize("kinds", [out_of_catalogue.KINDS, held_back.KINDS, fresh_kinds.KINDS])
def test_every_kind_out_of_the_catalogue_changes_the_motion(kinds):
    plan = draw_plan(np.random.default_rng(9), "guided", "jump")
    run = plan.runs[2]
    short = plan.__class__(**{**vars(plan), "runs": (run,), "duration": 3.0})
    (plain,) = move(short, [run.plain], 2)
    for name, kind in kinds.items():
        record = run.plain.copy()
        kind(record, 1.0, np.random.default_rng(1), plan.reference)
        (changed,) = move(short, [record], 2)
        assert np.isfinite(changed).all()
        assert np.abs(changed[:, 0] - plain[:, 0]).max() > 5e-5, name


def swinging() -> tuple[np.ndarray, np.ndarray]:
    """Rows of a swing of 20 mm in x and 5 mm in y, every ms, and their times."""
    t = np.arange(8001) * 1e-3
    rows = np.zeros((t.size, 3))
    rows[:, 0], rows[:, 1] = 0.02 * np.sin(9 * t), 0.005 * np.cos(4 * t)
    return rows, t


@pytest.mark.parametrize(
    "fault,amount,x_of",
    [
        (recording.scale, 0.03, lambda t: 1.03 * 0.02 * np.sin(9 * t)),
        (recording.clock, 0.03, lambda t: 0.02 * np.sin(9 * t / 1.03)),
        (
            recording.rotation,
            0.1,
            lambda t: np.cos(0.1) * 0.02 * np.sin(9 * t) - np.sin(0.1) * 0.005 * np.cos(4 * t),
        ),
        (
            recording.rolling_shutter,
            0.02,
            lambda t: 0.02 * np.sin(9 * (t + 0.02 * 0.02 * np.sin(9 * t) / 0.1)),
        ),
        (
            recording.smoothing,
            0.03,
            lambda t: np.exp(-0.5 * (9 * 0.03) ** 2) * 0.02 * np.sin(9 * t),
        ),
        (
            recording.lagging,
            0.03,
            lambda t: 0.02 * np.sin(9 * t - np.arctan(0.27)) / np.hypot(1, 0.27),
        ),
    ],
)
def test_faults_of_the_camera(fault, amount, x_of):
    rows, _ = swinging()
    shown = film(rows, 1e-3, CLEAN, (fault, amount), np.random.default_rng(0))
    inner = slice(50, -50)
    assert shown["x"][inner] == pytest.approx(x_of(shown["t"][inner]), abs=4e-5)


def test_suites_hold_what_they_are_for():
    mixed = orders_of("contact_and_shapes", 2)
    assert sum(not o.effects for o in mixed) == 15 and {o.contact for o in mixed} == {"lugre"}
    one = orders_of("one_effect", 2)
    assert {o.effects[0] for o in one} == EFFECTS == set(LAWS)
    assert {o.contact for o in one} == {"lugre", "elasto_plastic", "smooth", "jump"}
    assert {o.scatter for o in orders_of("scatter", 2)} == {0.03}
    assert {o.fault for o in orders_of("faults", 2)} == {f"measurement.{m}" for m in MEASUREMENT}
    assert set(FAULTS) == {f"measurement.{m}" for m in MEASUREMENT}
    for name, number in (("two_effects", 2), ("three_effects", 3)):
        for order in orders_of(name, 2):
            assert len(set(order.effects)) == number
            assert not any(pair <= set(order.effects) for pair in BLURRED)
    assert all(o.exponents for o in orders_of("scaling", 2))


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
