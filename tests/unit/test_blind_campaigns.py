"""Hidden campaigns: every ingredient shows, sizes mean something, answers do not leak."""

import json
import tomllib

import numpy as np
import pytest
from blind.campaign import draw_campaign
from blind.effect_size import effect_size
from blind.effects import EFFECTS
from blind.layouts import Plan, Run, draw_plan
from blind.motion import COARSE, move, needs_plane
from blind.out_of_catalogue import OUT_OF_CATALOGUE
from blind.simulator.hidden import Hidden, State
from blind.writing import write_campaign

pytestmark = pytest.mark.slow  # numba compiles the simulator, and no answer hangs on it
ALL = EFFECTS | OUT_OF_CATALOGUE


def two_runs(seconds=6.0):
    """A light and a heavy block, one on a surface that runs backwards."""
    runs = []
    for mass, speed in ((0.87, 0.05), (1.5, -0.05)):
        p = Hidden(mass=mass, speed=speed, inertia=0.5 * mass * 0.04**2)
        runs.append(Run(p, State(x=-0.005, vx=speed), False))
    return Plan("two", tuple(runs), line=False, duration=seconds)


def seen(motions):
    return np.concatenate([np.column_stack([each.x, each.rows[:, 1]]) for each in motions])


@pytest.mark.parametrize("name", ALL)
def test_an_ingredient_of_no_strength_is_none_and_a_strong_one_shows(name):
    plan, ingredient = two_runs(), ALL[name](np.random.default_rng(3))
    plane = needs_plane(plan, [ingredient])
    steps = {False: COARSE[plane], True: COARSE[plane]}
    plain = seen(move(plan, [], [], steps))
    strong = seen(move(plan, [ingredient], [0.5], steps))
    assert np.isfinite(strong).all()
    assert np.abs(strong - plain).max() > 1e-3  # m, five times the usual noise
    if ingredient.sized:
        none = seen(move(plan, [ingredient], [0.0], steps))
        assert np.abs(none - plain).max() < 1e-6


def test_size_of_nothing_is_less_than_the_noise_and_that_of_another_friction_too():
    plan = draw_plan("example", np.random.default_rng(1), line=False)
    changed = Plan(
        plan.name,
        tuple(
            Run(run.hidden._replace(mu_s=0.3, mu_k=0.2), run.start, run.hold_out)
            for run in plan.runs
        ),
        line=False,
    )
    for each in (plan, changed):
        # the plain model is told the friction of the first plan: the refit finds the other
        motions = [
            type(made)(run, made.rows, made.x)
            for run, made in zip(plan.runs, move(each, [], [], COARSE), strict=True)
        ]
        assert effect_size(motions, 2e-4, False, {}).largest < 1.0


def test_a_known_friction_makes_a_wrong_number_an_effect():
    plan = draw_plan("example", np.random.default_rng(1), line=False)
    motions = move(plan, [], [], COARSE)
    p = plan.runs[0].hidden
    known = {"mu_s": (1.5 * p.mu_s, 0.01), "mu_k": (p.mu_k, 0.01)}
    assert effect_size(motions, 2e-4, False, known).x > 5.0


def test_files_hold_no_answer_and_repeat_byte_for_byte(tmp_path):
    made = draw_campaign(11, "effects", ["speed_ripple"], tries=1)
    told = write_campaign(made, tmp_path / "a" / "c", tmp_path / "answers" / "c.json", "c")
    again = draw_campaign(11, "effects", ["speed_ripple"], tries=1)
    write_campaign(again, tmp_path / "b" / "c", tmp_path / "answers" / "again.json", "c")
    files = sorted(file.name for file in (tmp_path / "a" / "c").iterdir())
    assert files == ["campaign.toml", *(f"run{i:02d}.csv" for i in range(1, 7))]
    for name in files:
        text = (tmp_path / "a" / "c" / name).read_bytes()
        assert text == (tmp_path / "b" / "c" / name).read_bytes()
        assert not any(word.encode() in text for word in ALL)
    assert told["effects"] == ["speed_ripple"] and told["verdict"] == "named"
    assert json.loads((tmp_path / "answers" / "c.json").read_text())["seed"] == 11
    table = tomllib.loads((tmp_path / "a" / "c" / "campaign.toml").read_text())
    assert [run["hold_out"] for run in table["run"]].count(True) == 2


def test_an_answer_beside_the_data_is_refused(tmp_path):
    made = draw_campaign(3, "none")
    with pytest.raises(ValueError, match="must not lie"):
        write_campaign(made, tmp_path, tmp_path / "answer.json", "c")
