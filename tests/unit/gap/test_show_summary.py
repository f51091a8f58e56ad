"""The answer for runs of which only figures are known: JSON, model, page."""

import json
import tomllib

import numpy as np
import pytest

from cosim.cli.measurements.gap import CAMPAIGNS
from cosim.gap import read_campaign
from cosim.gap.result import Ranked, Score
from cosim.studies.reproduction.summary.draws import FittedSummary, observations
from cosim.studies.reproduction.summary.find import SummaryGap
from cosim.studies.reproduction.summary.show import as_json, closing_lines, model_text, write_page

PLAIN = {"friction.mu_s": 0.28, "friction.mu_k": 0.21}
EXTENDED = {**PLAIN, "stick_stiffness.ratio": 0.9}


def fitted(values, misses):
    residuals = np.array(misses)
    gap = float(np.sqrt(np.mean(residuals**2)))
    return FittedSummary(values, residuals, np.zeros(5), residuals, gap, 1.1 * gap, 0.01)


@pytest.fixture(scope="module")
def gap():
    """Made by hand from the packaged campaign."""
    campaign = read_campaign(CAMPAIGNS / "study.toml")
    printed, plain = fitted(PLAIN, [30, -20, 5, 1, 9]), fitted(PLAIN, [20, -9, 5, 1, 2])
    extended = fitted(EXTENDED, [1, -1, 0.5, 0, 3])
    found = Ranked(
        "stick_stiffness", "part", 73.0, 1.0, Score(1.1, 1.4), EXTENDED,
        {"stick_stiffness.ratio": (0.86, 0.96)},
    )  # fmt: skip
    return SummaryGap(
        campaign=campaign, observations=observations(campaign), verdict="named",
        effects=("stick_stiffness",), found=("stick_stiffness",), classes=(),
        ranking=(found,), printed=printed, plain=plain,
        extended=extended, chance={"p": 0.001, "draws": 999},
        determined={"friction.mu_s": (0.28, 0.27, 0.29)}, free_friction=None,
    )  # fmt: skip


def test_json_has_the_observations(gap):
    data = json.loads(as_json(gap, "model.toml"))
    assert data["effects"] == ["stick_stiffness"] and data["model"] == "model.toml"
    assert data["gap"]["after"]["fit"] == pytest.approx(gap.gap_after[0], rel=1e-5)
    assert len(data["observations"]) == len(data["extended"]["shown"]) == 5
    (row,) = data["ranking"]
    assert (row["fit_gap"], row["held_out_gap"], row["delta_bic"]) == (1.1, 1.4, 146.0)
    assert list(data["open_figures"]) == ["mean_y of run 2"]


def test_model_says_where_its_numbers_are_from(gap):
    text = model_text(gap)
    assert "source study's scheme" in text
    tables = tomllib.loads(text)
    assert tables["stick_stiffness"]["ratio"] == 0.9
    assert tables["rig"]["mass"] == gap.campaign.runs[0].mass


def test_page_and_closing_lines(gap, tmp_path):
    write_page(gap, tmp_path, tmp_path / "report.html", lambda: None)
    html = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert [file.name for file in tmp_path.glob("*.png")] == ["observations.png"]
    assert html.count("data:image/png;base64,") == 1 and "http" not in html
    assert "all runs have one mass" in html and "still 3.0 standard deviations off" in html
    text = "\n".join(closing_lines(gap))
    assert "standard deviations" in text
    assert "stick_stiffness.ratio = 0.900 (0.860 to 0.960)" in text
