"""A planned campaign: what is read, the rule of naming, sizes and power, pairs, the next run."""

import json
from dataclasses import replace

import numpy as np
import pytest
import tomli_w
from plan_campaigns import gain, measured
from scipy.stats import binom, ncx2
from stickslip import EFFECTS
from stickslip.effects.effect import no_candidates

from cosim.cli import main
from cosim.gap.data.errors import CampaignError
from cosim.gap.estimation.fitted import Point
from cosim.gap.plan import read_plan
from cosim.gap.plan.law import kinds, laws_of, residuals
from cosim.gap.plan.linear import Nuisance, beyond
from cosim.gap.plan.next_run import best_next_runs, options, task
from cosim.gap.plan.pairs import mistaken, refitted, times
from cosim.gap.plan.planned import EXPECTED, NOISE, rehearse_plan
from cosim.gap.plan.power import needed, power, threshold
from cosim.gap.plan.visibility import FAINT, friction_length, smallest
from cosim.gap.plan.visibility import refitted as plain_refitted
from cosim.gap.show.quantities import unit_and_meaning

RUN = {"mass": 0.87, "stiffness": 38.5, "duration": 6.0}
RIG = {"spring_natural_length": 0.17}
FRICTION = {"mu_s": 0.3, "mu_k": 0.22}


def written(folder, runs=({},), **tables):
    content = {"name": "planned", "rig": RIG, "noise": {"x": 2e-4}, "friction": FRICTION} | tables
    content["run"] = [RUN | {"surface_speed": 0.06} | run for run in runs]
    content = {key: value for key, value in content.items() if value is not None}
    (folder / "campaign.toml").write_text(tomli_w.dumps(content), encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def plan(tmp_path_factory):
    folder = tmp_path_factory.mktemp("plan")
    return read_plan(written(folder, [{}, {"surface_speed": 0.15}]))


@pytest.fixture(scope="module")
def rehearsal(plan):
    return rehearse_plan(plan)


@pytest.fixture(scope="module")
def laws(plan, rehearsal):
    """Effect -> its first law."""
    found = {}
    for law in laws_of(plan, rehearsal)[0]:
        found.setdefault(law.effect, law)
    return found


@pytest.fixture(scope="module")
def seen(rehearsal, laws):
    """The effects of the tests at their smallest sizes, at the level of a single test."""
    per_cent = friction_length(rehearsal)
    return {
        effect: smallest(
            rehearsal, laws[effect], needed(freedoms=laws[effect].freedoms(2)), per_cent
        )
        for effect in ("film_drag", "spring_hardening", "structural_damping", "load_dependence")
    }


def test_defaults_are_said(tmp_path):
    run = "[[run]]\nmass = 0.87\nstiffness = 38.5\nsurface_speed = 0.06\n"
    (tmp_path / "campaign.toml").write_text(run, encoding="utf-8")
    plan = read_plan(tmp_path)
    assert plan.friction == EXPECTED
    assert plan.campaign.noise == {"x": NOISE}
    assert (plan.runs[0].duration, plan.runs[0].rate) == (20.0, 100.0)
    assert "typical of ice" in " ".join(plan.campaign.remarks)
    assert "noise.x" in plan.campaign.remarks[0]


def test_a_number_is_expected_and_a_pair_is_known(tmp_path):
    plan = read_plan(written(tmp_path, friction={"mu_s": [0.3, 0.01], "mu_k": 0.2}))
    assert plan.friction == {"mu_s": 0.3, "mu_k": 0.2}
    assert plan.campaign.friction == {"mu_s": (0.3, 0.01)}


@pytest.mark.parametrize(
    ("tables", "said"),
    [
        ({"runs": [{"rate": 1.0}]}, "run 1: rate = 1 Hz"),
        ({"runs": [{"duration": 0.5}]}, "run 1: duration = 0.5 s"),
        ({"runs": [{"duration": 1e5}]}, "allowed is"),
        ({"runs": [{"hold_out": True}]}, "hold_out: true in every run"),
        ({"runs": [{"summary": {"mean_x": [0.1, 0.01]}}]}, "summary"),
        ({"runs": [{"surface_speed": 0.0}]}, "surface_speed: 0"),
        ({"friction": {"mu_s": 0.1, "mu_k": 0.2}}, "below mu_k"),
        ({"friction": {"mu_s": -0.1}}, "mu_s"),
        ({"friction": {"mu_s": True}}, "mu_s"),
        ({"model": {"scheme": "study"}}, "model.scheme"),
    ],
)
def test_what_cannot_be_planned_is_refused_in_one_line(tmp_path, tables, said):
    with pytest.raises(CampaignError) as refused:
        read_plan(written(tmp_path, **tables))
    assert said in str(refused.value)
    assert "\n" not in str(refused.value)


def test_the_rule_of_naming():
    assert power(0.0, 0.05) == pytest.approx(0.05)
    assert power(0.0, 0.05, 20) == pytest.approx(0.05 / 20)
    for laws, freedoms in ((1, 1), (30, 2), (1000, 8)):
        size = needed(0.9, 0.05, laws, freedoms)
        assert power(size, 0.05, laws, freedoms) == pytest.approx(0.9)
        assert ncx2.cdf(threshold(0.05, laws, freedoms), freedoms, size) == pytest.approx(0.1)


def test_a_rehearsal_leaves_nothing(rehearsal):
    """Its data are its own motion; what a fit of it starts from is where it ends."""
    assert all(not rows.any() for rows in rehearsal.problem.all_residuals(rehearsal.point))


def test_what_the_plain_model_takes_up_is_not_visible(rehearsal):
    """Other friction, another zero: a fit takes all of that; its derivatives nearly so."""
    moved = rehearsal.point.shared.copy()
    moved[0] += 0.02
    rows = rehearsal.problem.all_residuals(
        Point(moved, rehearsal.point.own, rehearsal.point.states)
    )
    left = Nuisance(rehearsal).left(rows)
    assert left @ left < 1e-3 * sum(r @ r for r in rows)


def test_beyond_is_what_a_fit_of_the_other_leaves():
    random = np.random.default_rng(3)
    truth, other, shape = random.standard_normal((3, 50))
    fitted = np.linalg.lstsq(np.column_stack([other, shape]), truth, rcond=None)
    sign = np.sign(fitted[0][0])
    assert beyond(truth, sign * other, shape[:, None]) == pytest.approx(fitted[1][0])
    alone = np.linalg.lstsq(shape[:, None], truth, rcond=None)[1][0]
    assert beyond(truth, -sign * other, shape[:, None]) == pytest.approx(alone)


def test_the_smallest_size_leaves_as_much_as_is_needed(rehearsal, laws, seen):
    """Also where it costs what is known of the springs more than it leaves of the motion."""
    for effect in ("film_drag", "spring_hardening", "structural_damping"):
        found = seen[effect]
        assert found.noncentrality == pytest.approx(needed(), rel=0.05)
        assert found.response @ found.response == pytest.approx(found.noncentrality, rel=0.1)
    for effect in ("film_drag", "structural_damping"):  # refits that set out from the plain model
        again = plain_refitted(rehearsal, laws[effect], seen[effect].part)[0]
        assert again == pytest.approx(seen[effect].noncentrality, rel=1e-3)


def test_a_load_that_is_always_the_same_tells_nothing_of_its_law(seen):
    assert not seen["load_dependence"].is_seen
    assert np.isinf(seen["load_dependence"].percent)


def test_half_the_noise_halves_the_sizes(plan, rehearsal, laws, seen):
    noise = {"x": 1e-4}
    runs = tuple(replace(run, setting=replace(run.setting, noise=noise)) for run in plan.runs)
    quiet = replace(plan, campaign=replace(plan.campaign, noise=noise), runs=runs)
    again = rehearse_plan(quiet)
    drag = smallest(again, laws["film_drag"], needed(), friction_length(again))
    # friction that scatters, which is no less, limits it as well
    assert drag.part == pytest.approx(0.5 * seen["film_drag"].part, rel=0.15)


@pytest.mark.parametrize("effect", ["film_drag", "structural_damping"])
def test_predicted_power_is_achieved(plan, rehearsal, laws, seen, effect):
    """In simulated campaigns with noise, at the size that 90 % of them should name.

    A share that a true chance of 90 % falls short of once in a thousand times, or less, is refused.
    """
    found = seen[effect]
    campaigns = 12
    gains = [
        gain(
            measured(plan, rehearsal, laws[effect], found.part, seed),
            rehearsal,
            False,
            laws[effect],
        )
        for seed in range(campaigns)
    ]
    named = sum(each > threshold() for each in gains)
    assert binom.cdf(named, campaigns, 0.9) > 1e-3
    # the statistic's mean is noncentrality and degrees of freedom together
    error = np.sqrt(2.0 * (1.0 + 2.0 * found.noncentrality) / campaigns)
    assert abs(np.mean(gains) - found.noncentrality - 1.0) < 4.0 * error


def test_nothing_hidden_is_seldom_named(plan, rehearsal, laws):
    gains = [
        gain(
            measured(plan, rehearsal, laws["film_drag"], 0.0, seed),
            rehearsal,
            False,
            laws["film_drag"],
        )
        for seed in range(8)
    ]
    assert sum(each > threshold(0.05, 20) for each in gains) == 0


def test_damping_against_the_frame_is_near_drag_on_the_surface(rehearsal, seen):
    """They differ by a constant at one speed: told apart by less than they are seen."""
    drag, damping = seen["film_drag"], seen["structural_damping"]
    pair, nearest = mistaken(damping, [drag], needed())
    assert nearest is drag
    assert pair.apart < damping.response @ damping.response
    assert pair.times == pytest.approx(np.sqrt(needed() / pair.apart))
    really = refitted(rehearsal, damping, drag, needed())
    assert really.apart <= pair.apart * (1.0 + 1e-9)


def test_times_of_a_size():
    assert times(4.0, 20.0, 16.0) == 2.0
    assert times(20.0, 20.0, 16.0) == 1.0
    assert np.isinf(times(0.0, 20.0, 16.0))


def test_another_mass_shows_what_depends_on_the_load(plan, rehearsal, laws, seen):
    best = list(seen.values())
    asked = task(plan, rehearsal, best, best, None)
    grid = [
        option
        for option in options(plan)
        if option.run.setting.stiffness == 38.5
        and option.run.duration == 6.0
        and 0.05 < option.run.setting.surface_speed < 0.1
    ]
    assert {option.changed for option in grid} == {0, 1}
    told = [asked(option) for option in grid]
    (found,) = best_next_runs(asked, grid, told, lambda law, runs: needed())
    assert found.effects == ("load_dependence",)
    assert found.mass != RUN["mass"]
    assert np.isinf(found.before) and np.isfinite(found.after)


def test_information_is_that_of_the_campaign(plan, rehearsal, laws, seen):
    """The sums of products tell the linear visibility that the responses themselves tell."""
    best = [seen["film_drag"], seen["spring_hardening"]]
    told = task(plan, rehearsal, best, best, None).before()
    free = rehearsal.point.shared.size
    for each, squares in zip(best, told.visibility(free), strict=True):
        faint = FAINT * min(1.0, each.law.most)
        left = Nuisance(rehearsal).left(residuals(rehearsal, each.law, faint)) / faint
        assert squares == pytest.approx(left @ left, rel=1e-6)
        assert squares * each.part**2 == pytest.approx(each.linear, rel=1e-6)


def test_laws_without_a_chance_are_said(plan, rehearsal):
    found, silent = laws_of(plan, rehearsal)
    assert "y is not measured" in silent["lateral_friction"]
    assert "mu_s" in silent["stick_stiffness"]
    assert kinds(found) < len(found)
    ripple = next(law for law in found if law.effect == "speed_ripple")
    assert ripple.periods == 300  # 6 s of 50 Hz
    assert len(
        {law.phase(run)[key] for run in range(5) for law in [ripple] for key in law.phase(0)}
    )


def test_the_command_leaves_its_files(tmp_path, capsys):
    """One short run: every effect has a size, is not seen, or is not tried and why."""
    folder = written(tmp_path, [{"duration": 2.0}])
    given = ["-o", str(tmp_path / "out"), "--json", str(tmp_path / "copy.json"), "--jobs", "1"]
    assert main(["plan", str(folder), *given]) == 0
    text = (tmp_path / "out" / "plan.json").read_text()
    assert (tmp_path / "copy.json").read_text() == text
    answer = json.loads(text)
    offered = {
        entry.id for entry in EFFECTS if entry.offered and entry.candidates is not no_candidates
    }
    assert offered == {*answer["smallest"], *answer["not_tried"]}
    drag = answer["smallest"]["film_drag"]
    assert 0.0 < drag["smallest"] <= (drag["smallest_alone"] or np.inf)
    assert drag["unit"] == unit_and_meaning(drag["parameter"])[0]
    assert 0.0 < drag["percent_of_friction"] < 100.0
    assert {run["aim"] for run in answer["next_runs"]} == {"worst effect", "worst pair"}
    page = (tmp_path / "out" / "report.html").read_text()
    assert "load_dependence" in page
    for name in ("smallest_sizes", "pairs"):
        assert (tmp_path / "out" / f"{name}.png").stat().st_size > 0
    out = capsys.readouterr().out
    assert out.startswith("planned: 1 run; smallest sizes named with 90 %")
    assert "next, for the worst effect" in out


def test_bad_input_is_one_line(tmp_path, capsys):
    folder = written(tmp_path, [{"rate": 1.0}])
    assert main(["plan", str(folder), "-o", str(tmp_path / "out")]) == 2
    said = capsys.readouterr().err.splitlines()
    assert len(said) == 1 and "run 1: rate = 1 Hz" in said[0]
    assert main(["plan"]) == 2
    assert "no campaign given" in capsys.readouterr().err


def test_the_example_can_be_planned(tmp_path, capsys):
    assert main(["plan", "--write-example", str(tmp_path)]) == 0
    assert capsys.readouterr().out.strip() == str(tmp_path / "campaign.toml")
    plan = read_plan(tmp_path)
    assert len(plan.runs) == 4 and not plan.campaign.remarks
