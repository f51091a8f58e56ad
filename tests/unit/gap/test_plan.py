"""A planned campaign: what is read, smallest sizes and their power, pairs, the next run, files."""

import json
from dataclasses import replace

import numpy as np
import pytest
from command_line import refusal
from gap_campaigns import write_campaign
from stickslip import EFFECTS

from cosim.cli import main
from cosim.gap.data.errors import CampaignError
from cosim.gap.example import write_example
from cosim.gap.naming import Naming
from cosim.gap.plan import read_plan
from cosim.gap.plan.known import NOISE
from cosim.gap.plan.laws import laws_of, silent
from cosim.gap.plan.next_run import best_next_run, options
from cosim.gap.plan.plan import Plan
from cosim.gap.plan.planned import as_measured, asked_as_planned, simulated
from cosim.gap.plan.sizes import Design, Size, false_names, is_named, sizes_of
from cosim.gap.weak_form.constants import ALIKE, OWN_STATIC

RUN = {"mass": 0.87, "stiffness": 38.5, "duration": 8.0}
FRICTION = {"mu_s": 0.3, "mu_k": 0.22}
SCATTER = 0.02


def written(folder, runs=({},), **tables):
    content = {"name": "planned", "noise": {"x": NOISE}, "friction": FRICTION} | tables
    write_campaign(folder, [RUN | run for run in runs], **content)
    return folder


@pytest.fixture(scope="module")
def plan(tmp_path_factory):
    runs = [{"surface_speed": speed} for speed in (0.04, 0.1, 0.2)]
    return read_plan(written(tmp_path_factory.mktemp("plan"), runs))


@pytest.fixture(scope="module")
def asked(plan):
    return asked_as_planned(as_measured(plan))


@pytest.fixture(scope="module")
def laws(asked):
    """Argument -> its first law."""
    found = {}
    for law in laws_of(*asked):
        found.setdefault(law.argument, law)
    return found


@pytest.fixture(scope="module")
def sizes(asked, laws):
    some = [laws[name] for name in ("film_drag", "structural_damping")]
    return sizes_of(Design(*asked, some, SCATTER), 0.8, lambda: None)


def test_defaults_are_said(tmp_path):
    run = "[[run]]\nmass = 0.87\nstiffness = 38.5\nsurface_speed = 0.06\n"
    (tmp_path / "campaign.toml").write_text(run, encoding="utf-8")
    plan = read_plan(tmp_path)
    assert plan.friction == pytest.approx({"mu_k": 0.1, "mu_s": 0.13})
    assert plan.campaign.noise == {"x": NOISE}
    assert (plan.runs[0].duration, plan.runs[0].rate) == (20.0, 100.0)
    assert "typical of ice" in plan.source


def test_a_number_is_expected_and_a_pair_is_known(tmp_path):
    plan = read_plan(written(tmp_path, friction={"mu_s": [0.3, 0.01], "mu_k": 0.2}))
    assert plan.friction == {"mu_s": 0.3, "mu_k": 0.2}
    assert plan.campaign.friction == {"mu_s": (0.3, 0.01)}


@pytest.fixture(scope="module")
def measured(tmp_path_factory):
    """The example's tracks, whose friction falls from 0.22 by 5 to 12 % in slip."""
    folder = tmp_path_factory.mktemp("measured")
    write_example(folder)
    return folder


def answered(folder, campaign, friction="mu_s = 0.31\nmu_k = 0.21\n"):
    """What `gap` leaves behind; the folder of its results."""
    place = folder / "results" / "example-gap"
    place.mkdir(parents=True)
    text = f"[friction]\n{friction}[velocity_weakening]\nlinear = 0.8\n"
    (place / "model.toml").write_text(text, encoding="utf-8")
    made = json.dumps({"campaign": str(campaign.resolve())})
    (place / "made_by.json").write_text(made, encoding="utf-8")
    return place.parent


def test_measured_runs_say_friction_noise_duration_and_rate(measured):
    plan = read_plan(measured)
    assert plan.friction["mu_k"] == pytest.approx(0.19, abs=0.02)
    assert plan.friction["mu_s"] == pytest.approx(0.30, abs=0.02)
    assert "read off the runs" in plan.source
    assert [(run.duration, round(run.rate)) for run in plan.runs] == [(10.0, 100)] * 4
    assert "planned as made" in " ".join(plan.campaign.remarks)


def test_what_gap_has_found_goes_before_what_the_runs_show(measured, tmp_path):
    plan = read_plan(measured, results=answered(tmp_path, measured))
    assert plan.friction == {"mu_k": 0.21, "mu_s": 0.31}
    assert "model.toml, without its velocity_weakening" in plan.source


def test_an_answer_on_another_campaign_is_not_taken(measured, tmp_path):
    plan = read_plan(measured, results=answered(tmp_path, tmp_path))
    assert "model.toml" not in plan.source


def test_a_model_goes_before_what_the_campaign_states(tmp_path):
    """What it leaves open is as the campaign states."""
    model = answered(tmp_path, tmp_path, "mu_k = 0.2\n") / "example-gap"
    plan = read_plan(written(tmp_path), model)
    assert plan.friction == {"mu_k": 0.2, "mu_s": FRICTION["mu_s"]}
    assert "model.toml" in plan.source and "campaign.toml" in plan.source


def test_a_model_with_a_table_has_its_level(tmp_path):
    table = "table_speed = [0.0, 0.12]\ntable_mu = [0.3, 0.1]\n"
    model = answered(tmp_path, tmp_path, table) / "example-gap"
    assert read_plan(written(tmp_path), model).friction["mu_k"] == pytest.approx(0.2)


@pytest.mark.parametrize(
    ("model", "said"),
    [
        ("mu_k = 0.4\nmu_s = 0.3\n", "mu_s is below mu_k"),
        ("mu_k = 0.0\n", "model.toml: friction: no mu_k or mu_s above 0"),
        ("", "model.toml: friction: no mu_k or mu_s above 0"),
        ('table = "away.csv"\n', "away.csv"),
        ("mu_k = -1\n", "mu_k: out of range"),
    ],
)
def test_a_model_that_says_no_friction_is_refused(tmp_path, model, said):
    with pytest.raises(CampaignError) as refused:
        read_plan(written(tmp_path), answered(tmp_path, tmp_path, model) / "example-gap")
    assert said in str(refused.value) and "\n" not in str(refused.value)


def test_doubtful_runs_are_not_asked_for_their_friction(measured, tmp_path):
    """Millimetres read as metres; why is said."""
    for file in measured.iterdir():
        text = file.read_text(encoding="utf-8")
        if file.suffix == ".csv":
            rows = [line.split(",") for line in text.splitlines()[1:]]
            text = "\n".join(["t,x", *(f"{t},{50.0 * float(x):g}" for t, x in rows)])
        (tmp_path / file.name).write_text(text, encoding="utf-8")
    plan = read_plan(tmp_path)
    assert "typical of ice" in plan.source
    assert "friction is not read off the runs" in " ".join(plan.campaign.remarks)


def test_a_file_that_is_not_there_yet_is_said(tmp_path):
    remarks = read_plan(written(tmp_path, [{"file": "run01.csv"}])).campaign.remarks
    assert "run01.csv: not there yet, planned with duration and rate" in remarks


@pytest.mark.parametrize(
    ("tables", "said"),
    [
        ({"runs": [{"rate": 1.0}]}, "run 1: rate = 1 Hz"),
        ({"runs": [{"duration": 0.5}]}, "run 1: duration = 0.5 s"),
        ({"runs": [{"duration": 1e5}]}, "allowed is"),
        ({"runs": [{"hold_out": True}]}, "hold_out: true in every run"),
        ({"runs": [{"summary": {"mean_x": [0.1, 0.01]}}]}, "summary"),
        ({"runs": [{"surface_speed": 0.0}]}, "surface_speed"),
        ({"friction": {"mu_s": 0.1, "mu_k": 0.2}}, "below mu_k"),
        ({"model": {"scheme": "study"}}, "model.scheme"),
    ],
)
def test_what_cannot_be_planned_is_refused_in_one_line(tmp_path, tables, said):
    with pytest.raises(CampaignError) as refused:
        read_plan(written(tmp_path, **tables))
    assert said in str(refused.value)
    assert "\n" not in str(refused.value)


def test_a_run_that_would_crush_the_springs_is_refused(tmp_path):
    with pytest.raises(CampaignError, match="crushed"):
        as_measured(read_plan(written(tmp_path, [{"mass": 60.0, "duration": 20.0}])))


def test_a_table_of_friction_is_what_the_runs_move_by(tmp_path):
    """Friction that is half as large pulls the block half as far."""
    places = []
    for part in (1.0, 0.5):
        rows = [f"{v:g},{part * mu:g}" for v, mu in ((0.0, 0.24), (0.4, 0.2))]
        (tmp_path / "mu_v.csv").write_text("\n".join(["v,mu", *rows]) + "\n", encoding="utf-8")
        plan = read_plan(written(tmp_path, friction={"table": "mu_v.csv"}))
        places.append(np.mean(as_measured(plan).runs[0].motion.x[200:]))
    assert places[1] / places[0] == pytest.approx(0.5, abs=0.05)


def made(planned, blocks, seed):
    """The campaign with tracks. Springs, speeds, zeros and friction are off within their errors."""
    random, campaign = np.random.default_rng(seed), planned.campaign
    errors, runs = campaign.errors, []
    stiffer = {s: 1.0 + errors.stiffness * random.standard_normal() for s in campaign.setups}
    for run in planned.runs:
        own, stated = run.setting, (run.setting.mass, run.setting.stiffness)
        both, static = random.standard_normal(2) * errors.friction
        friction = dict(planned.friction)
        friction["mu_k"] *= 1.0 + both
        friction["mu_s"] *= 1.0 + both + OWN_STATIC * static
        faster = 1.0 + errors.surface_speed * random.standard_normal()
        true = replace(
            own, stiffness=own.stiffness * stiffer[stated],
            surface_speed=own.surface_speed * faster,
        )  # fmt: skip
        seen = simulated(campaign, replace(run, setting=true), friction, random, blocks)
        zero = campaign.zero_sd(own) * random.standard_normal()
        runs.append(replace(own, track=replace(seen.track, x=seen.track.x + zero)))
    return replace(campaign, runs=tuple(runs))


def test_a_law_adds_to_the_rows_what_it_adds_to_the_motion(plan, asked, laws):
    """The kernel's runs with a drag, and what the rows of the runs without it foresee: its size."""
    law, value = laws["film_drag"], 1.0
    quiet = replace(plan, campaign=replace(plan.campaign, noise={"x": 2e-5}))
    settings = [replace(run, setting=replace(run.setting, noise={"x": 2e-5})) for run in plan.runs]
    quiet = replace(quiet, runs=tuple(settings))
    errors = quiet.campaign.errors.model_copy(
        update={"friction": 1e-6, "stiffness": 1e-6, "surface_speed": 1e-6}
    )
    quiet = replace(quiet, campaign=replace(quiet.campaign, errors=errors))
    system, unknowns = asked_as_planned(made(quiet, law.blocks(value), 0))
    added = system.rung().offered(unknowns["film_drag"])[1]
    rung = system.rung([added])
    seen = rung.posterior[0][rung.part_of(added)]
    ours = next(one for one in laws_of(system, unknowns) if one.argument == "film_drag")
    assert np.ptp(seen) == pytest.approx(np.ptp(ours.sizes(value)), rel=0.1)


def test_smallest_sizes_are_named_as_often_as_wanted(asked, laws, sizes):
    """In other drawn campaigns; a third more or less is named far more or less often."""
    again = Design(*asked, [size.law for size in sizes], SCATTER, draws=300, seed=5)
    for number, size in enumerate(sizes):
        away = abs(size.value - size.law.neutral)
        power = [
            float(np.mean(is_named(size.law, again.offers(number, part * away))))
            for part in (0.67, 1.0, 1.33)
        ]
        assert power[1] == pytest.approx(0.8, abs=0.1)
        assert power[0] < 0.65 and power[2] > 0.9
    assert false_names(again) < 0.05


def test_one_mass_cannot_tell_force_from_coefficient(sizes):
    """A drag at its smallest size is in a class with weakening, and never by itself."""
    drag = sizes[0]
    assert drag.alone is None
    assert drag.shares["velocity_weakening"] > 0.6
    plan = Plan(None, 0.8, tuple(sizes), {}, 0.0, None)
    assert ("film_drag", "velocity_weakening") in [pair[:2] for pair in plan.pairs]


def test_pairs_are_those_that_mislead_two_readers_of_twenty(laws):
    for share, pairs in ((0.13, 1), (0.07, 0)):
        size = Size(laws["film_drag"], 1.0, None, 0.8, {}, {"run_in": share})
        assert len(Plan(None, 0.8, (size,), {}, 0.0, None).pairs) == pairs


def test_effects_without_a_chance_are_said(asked):
    said = silent(laws_of(*asked), EFFECTS)
    assert "y and phi" in said["lateral_friction"]
    assert "same load" in said["load_dependence"]
    assert "mu_s" in said["stick_stiffness"]


def test_another_mass_tells_force_from_coefficient(asked, laws):
    """The next run is one with another mass, at a speed at which sliding speeds differ."""
    pair = [(laws["film_drag"], 0.5), (laws["velocity_weakening"], 0.3)]
    found = best_next_run(asked[0], pair, FRICTION, SCATTER)
    assert found.mass != RUN["mass"]
    assert found.separation_before < 0.5 and found.separation > 3.0
    assert f"{found.mass:.4g} kg" in found.text
    data = found.as_data()
    assert {"surface_speed", "mass", "stiffness", "separation", "text"} <= set(data)


def test_next_runs_stay_within_the_limits(plan):
    campaign = as_measured(plan)
    every = options(campaign)
    assert len(every) <= 12
    assert {one.setting.mass for one in every} == {0.29, 0.87, 2.61}
    limits = {"surface_speed": (0.05, 0.15), "mass": (0.8, 0.9)}
    inside = options(replace(campaign, limits=limits))
    assert {one.setting.mass for one in inside} == {0.8, 0.87, 0.9}
    assert all(0.05 <= one.setting.surface_speed <= 0.15 for one in inside)
    back = [replace(run, surface_speed=-run.surface_speed) for run in campaign.runs]
    assert all(
        one.setting.surface_speed < 0.0 for one in options(replace(campaign, runs=tuple(back)))
    )


def test_the_command_leaves_its_files(tmp_path, capsys, monkeypatch):
    """Every effect of the catalogue has a size, here a rough one, or is not tried and why."""
    monkeypatch.setattr("cosim.gap.plan.sizes.HALVINGS", 2)
    monkeypatch.setattr("cosim.gap.plan.plan.ROUNDS", 1)
    folder = written(tmp_path, [{"duration": 4.0}])
    given = ["-o", str(tmp_path / "out"), "--json", str(tmp_path / "copy.json")]
    assert main(["plan", str(folder), *given]) == 0
    text = (tmp_path / "out" / "plan.json").read_text()
    assert (tmp_path / "copy.json").read_text() == text
    answer = json.loads(text)
    drag = answer["smallest"]["film_drag"]
    assert drag["parameter"] == "film_drag.coefficient" and drag["unit"] == "N.s/m"
    assert 0.0 < drag["percent_of_friction"] < 100.0
    assert not set(answer["smallest"]) & set(answer["not_tried"])
    assert answer["friction_source"] == "mu_k = 0.22, mu_s = 0.3 (campaign.toml)"
    page = (tmp_path / "out" / "report.html").read_text()
    assert "load_dependence" in page and "Next run" in page
    places = [page.index(each) for each in ("<h1>1 run would", 'class="tiles"', "<figure", "<h2")]
    assert places == sorted(places) and page.count("<div><b>") <= 4
    assert "relaxation_time = 0.5 s" in page, "a size beside the law's other numbers"
    assert (tmp_path / "out" / "smallest_sizes.png").stat().st_size > 0
    first, friction, *_ = capsys.readouterr().out.splitlines()
    assert first.startswith("planned: 1 run would name effects from")
    assert friction == "  friction  mu_k = 0.22, mu_s = 0.3 (campaign.toml)"
    assert "mu_k = 0.22, mu_s = 0.3 (campaign.toml)" in page


def test_bad_input_is_one_line(tmp_path, capsys):
    folder = written(tmp_path, [{"rate": 1.0}])
    assert "run 1: rate = 1 Hz" in refusal(capsys, "plan", folder, "-o", tmp_path / "out")
    assert "no campaign given" in refusal(capsys, "plan")
    planned = written(tmp_path)
    refused = refusal(capsys, "plan", planned, "--model", tmp_path, "-o", tmp_path / "out")
    assert "model.toml: no such file, allowed is a scenario or the results of gap" in refused


def test_the_example_can_be_planned(tmp_path, capsys):
    assert main(["plan", "--write-example", str(tmp_path)]) == 0
    assert capsys.readouterr().out.strip() == str(tmp_path / "campaign.toml")
    assert len(read_plan(tmp_path).runs) == 4


def named(campaign):
    """What is named of a campaign with tracks: a group of effects for every finding."""
    return [
        {one.name, *(other for other, less in one.others.items() if less > -ALIKE)}
        for one in Naming.of(campaign).named().findings
    ]


@pytest.mark.slow
def test_gap_names_what_was_planned_to_be_named(plan, asked, laws):
    """Six campaigns by the kernel with a drag of twice its smallest size, each decided by `gap`."""
    law = laws["film_drag"]
    (size,) = sizes_of(Design(*asked, [law], SCATTER), 0.8, lambda: None)
    times = [
        any("film_drag" in group for group in named(made(plan, law.blocks(2.0 * size.value), n)))
        for n in range(6)
    ]
    assert sum(times) >= 5
