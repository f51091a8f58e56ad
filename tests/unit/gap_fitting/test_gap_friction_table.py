"""A campaign that states friction over the sliding speed: read, set out from, refused in a line."""

import tomllib
from dataclasses import replace

import numpy as np
import pytest
from gap_campaigns import KNOWN, NOISE, RIG, noisy, write_campaign
from scipy.stats import chi2
from stickslip import Parameters, simulate

from cosim.gap import CampaignError, read_campaign
from cosim.gap.answer.models import Bench
from cosim.gap.candidates.catalogue import laws_of_speed
from cosim.gap.candidates.plain import plain_free_parameters, plain_settings
from cosim.gap.estimation.drive import parts_at
from cosim.gap.estimation.fit import fit
from cosim.gap.estimation.fitted import start
from cosim.gap.estimation.problem import Problem
from cosim.gap.estimation.trial import Model
from cosim.gap.show.model_file import model_text

#: Friction that falls from 0.22 at rest by a quarter; and that of another day, a tenth larger.
SPEED, MU = (0.0, 0.05, 0.1, 0.2, 0.4), (0.22, 0.205, 0.193, 0.178, 0.165)
SPEEDS = (0.06, 0.15, 0.10)
CSV = "v,mu\n" + "".join(f"{v:g},{mu:g}\n" for v, mu in zip(SPEED, MU, strict=True))


def written(folder, csv=CSV, motions=None, **tables):
    """A campaign on disk whose [friction] names a table beside it."""
    folder.mkdir(exist_ok=True)
    (folder / "mu_v.csv").write_text(csv, encoding="utf-8")
    time = np.arange(40) * 0.01
    runs = [
        {
            "surface_speed": speed,
            "columns": motions[number] if motions else {"t": time, "x": noisy(0.0 * time, number)},
        }
        for number, speed in enumerate(SPEEDS)
    ]
    more = {"friction": {"table": "mu_v.csv"}, "noise": {"x": NOISE}} | tables
    return write_campaign(folder, runs, **more)


@pytest.fixture(scope="module")
def measured(tmp_path_factory):
    """Motions of the product's own, with the table a tenth larger than the file says."""
    day = {"table_speed": SPEED, "table_mu": tuple(1.1 * mu for mu in MU)}
    motions = []
    for number, speed in enumerate(SPEEDS):
        done = moved(speed, day)
        motions.append({"t": done.time, "x": noisy(done["x"], number)})
    return read_campaign(written(tmp_path_factory.mktemp("table"), motions=motions))


def moved(speed, friction):
    parameters = Parameters(
        rig={"mass": KNOWN["mass"], **RIG},
        springs={"stiffness": KNOWN["stiffness"]},
        friction={"mu_s": 0.33, **friction},
        surface={"speed": speed},
    )
    return simulate(parameters, 6.0, 0.01)


def test_a_table_is_read_from_where_the_campaign_is(tmp_path, monkeypatch):
    path = written(tmp_path / "week")
    monkeypatch.chdir("/")
    campaign = read_campaign(path)
    own = campaign.friction_table
    assert (own.speeds, own.mu) == (SPEED, MU)
    # its level is that at the surface's mean speed, and the model's mu_k
    assert own.typical == pytest.approx(np.mean(SPEEDS))
    mu_k = {free.key: free for free in plain_free_parameters(campaign, False)}["friction.mu_k"]
    assert mu_k.start == own.level and mu_k.prior == pytest.approx(0.05 * own.level)
    assert any("mu_v.csv, 5 points" in remark for remark in campaign.remarks)


def test_the_model_sets_out_from_the_table(measured):
    settings = plain_settings(measured)
    own = measured.friction_table
    at = np.linspace(0.0, 0.6, 13)
    np.testing.assert_allclose(parts_at(settings, at) * own.level, own.at(at), rtol=1e-12)


def test_its_level_is_fitted_and_only_noise_is_left(measured):
    bench = Bench.of(measured, False)
    model = Model(plain_free_parameters(measured, False), plain_settings(measured))
    kept = tuple(f for f in model.free_parameters if f.key.startswith("friction.mu"))
    problem = Problem(bench.data.short, kept, model.settings)
    fitted = fit(problem, start(problem.segmented_runs, kept))
    assert fitted.values["friction.mu_k"] == pytest.approx(
        1.1 * measured.friction_table.level, rel=0.01
    )
    squares = sum(float(rows @ rows) for rows in fitted.residuals)
    count = sum(rows.size for rows in fitted.residuals)
    assert squares < chi2.isf(1e-6, count)
    # without it one coefficient for all speeds does not do
    flat = fit(Problem(bench.data.short, kept), start(problem.segmented_runs, kept))
    assert sum(float(rows @ rows) for rows in flat.residuals) > 2.0 * squares


def test_the_extended_model_has_the_table_at_its_level(gap, measured):
    """As settings of the fit go into model.toml, where mu_k says how large they are."""
    own = measured.friction_table
    model = gap.model
    table = replace(model, settings={**model.settings, **plain_settings(measured)})
    shown = replace(gap, extended=None, plain=replace(table, values=gap.plain.values))
    friction = tomllib.loads(model_text(shown))["friction"]
    mu_k = gap.plain.values["friction.mu_k"]
    assert tuple(friction["table_speed"]) == SPEED
    np.testing.assert_allclose(friction["table_mu"], mu_k * own.parts, rtol=1e-6)


def test_another_law_of_the_sliding_speed_is_not_tried():
    assert {"velocity_weakening", "viscoelastic_peak"} <= set(laws_of_speed())
    assert not {"film_drag", "thermal_weakening", "run_in"} & set(laws_of_speed())


OVER_BOTH = "v,T_degC,mu\n" + "".join(
    f"{v:g},{t:g},{0.2 - 0.1 * v:g}\n" for t in (-10.0, -2.0) for v in SPEED
)


@pytest.mark.parametrize(
    ("csv", "tables", "says"),
    [
        (OVER_BOTH, {}, ["column T_degC", "allowed are v and mu"]),
        (CSV, {"friction": {"table": "other.csv"}}, ["friction.table: ", "No such file"]),
        ("v,mu\n0,0.2\n0,0.1\n", {}, ["friction.table: ", "a speed that grows"]),
        ("v,mu\n0,0\n0.4,0\n", {}, ["mu is 0 at 0.103 m/s", "allowed is above 0"]),
        (
            CSV, {"friction": {"table": "mu_v.csv", "mu_k": [0.2, 0.01]}},
            ["friction.mu_k: 0.2 beside table", "give one of the two"],
        ),
        (CSV, {"model": {"scheme": "study"}}, ['beside model.scheme = "study"']),
        (CSV, {"friction": {"table": 3}}, ["friction.table: not a text (3)"]),
        (CSV, {"errors": {"friction_table": 0.0}}, ["errors.friction_table"]),
    ],
)  # fmt: skip
def test_a_fault_is_one_line(tmp_path, csv, tables, says):
    path = written(tmp_path, csv, **tables)
    with pytest.raises(CampaignError) as caught:
        read_campaign(path)
    line = str(caught.value)
    assert line.startswith(str(path)) and "\n" not in line
    for words in says:
        assert words in line


def test_figures_alone_have_no_law_over_the_speed(tmp_path):
    (tmp_path / "mu_v.csv").write_text(CSV, encoding="utf-8")
    run = {"summary": {"mean_x": [0.02, 0.002]}}
    path = write_campaign(tmp_path, [run], friction={"table": "mu_v.csv"})
    with pytest.raises(CampaignError, match="only figures are known"):
        read_campaign(path)
