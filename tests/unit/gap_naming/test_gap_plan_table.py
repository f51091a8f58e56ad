"""A plan for a rig whose friction over the sliding speed was measured by itself."""

import numpy as np
import pytest
import tomli_w
from stickslip import Parameters, simulate
from stickslip.kernel import layout

from cosim.gap.data.errors import CampaignError
from cosim.gap.plan import read_plan
from cosim.gap.plan.law import laws_of, residuals
from cosim.gap.plan.planned import motion, rehearse_plan
from cosim.gap.plan.visibility import FAINT

SPEED, MU, MU_S = (0.0, 0.05, 0.1, 0.2, 0.4), (0.24, 0.215, 0.2, 0.185, 0.175), 0.3
RUN = {"mass": 0.87, "stiffness": 38.5, "duration": 4.0, "rate": 100.0}


def written(folder, **friction):
    rows = [f"{v:g},{mu:g}" for v, mu in zip(SPEED, MU, strict=True)]
    (folder / "mu_v.csv").write_text("\n".join(["v,mu", *rows]) + "\n", encoding="utf-8")
    content = {
        "rig": {"spring_natural_length": 0.17},
        "noise": {"x": 2e-4},
        "friction": {"table": "mu_v.csv"} | friction,
        "run": [RUN | {"surface_speed": speed} for speed in (0.06, 0.15)],
    }
    (folder / "campaign.toml").write_text(tomli_w.dumps(content), encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def plan(tmp_path_factory):
    return read_plan(written(tmp_path_factory.mktemp("plan"), mu_s=MU_S))


def test_planned_runs_move_by_the_table(plan):
    friction = {f"friction.{key}": value for key, value in plan.friction.items()}
    for run in plan.runs:
        speed = run.setting.surface_speed
        other = simulate(
            Parameters(
                rig={"mass": 0.87, "spring_natural_length": 0.17, "degrees_of_freedom": ("x",)},
                springs={"stiffness": 38.5},
                friction={"mu_s": MU_S, "table_speed": SPEED, "table_mu": MU},
                surface={"speed": speed},
                initial={"vx": speed},
            ),
            RUN["duration"],
            1.0 / RUN["rate"],
        )
        # the integrator's tolerance of a fit: a hundredth of the noise
        x = motion(plan, run, settings=friction)[:, layout.O_X]
        np.testing.assert_allclose(x, other["x"], rtol=0, atol=0.01 * 2e-4)


def test_what_comes_on_top_of_it_is_tried_and_what_is_in_its_place_is_not(plan):
    rehearsal = rehearse_plan(plan)
    assert all(not rows.any() for rows in rehearsal.problem.all_residuals(rehearsal.point))
    laws, silent = laws_of(plan, rehearsal)
    assert "friction.table is the law" in silent["velocity_weakening"]
    drag = next(law for law in laws if law.effect == "film_drag")
    assert any(rows.any() for rows in residuals(rehearsal, drag, FAINT))


def test_what_is_not_given_is_put_above_the_table(tmp_path):
    plan = read_plan(written(tmp_path))
    level = plan.campaign.friction_table.level
    assert plan.friction["mu_k"] == level and plan.friction["mu_s"] >= max(MU)
    assert any("mu_v.csv, 5 points" in remark for remark in plan.campaign.remarks)


def test_two_statements_of_one_thing_are_refused(tmp_path):
    with pytest.raises(CampaignError, match="beside table"):
        read_plan(written(tmp_path, mu_k=0.2))
