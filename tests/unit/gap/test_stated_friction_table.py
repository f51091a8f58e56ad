"""A campaign that states friction over the sliding speed: read, set out from, refused in a line."""

import numpy as np
import pytest
from gap_campaigns import NOISE, noisy, write_campaign

from cosim.gap import CampaignError, read_campaign

#: Friction that falls from 0.22 at rest by a quarter.
SPEED, MU = (0.0, 0.05, 0.1, 0.2, 0.4), (0.22, 0.205, 0.193, 0.178, 0.165)
SPEEDS = (0.06, 0.15, 0.10)
CSV = "v,mu\n" + "".join(f"{v:g},{mu:g}\n" for v, mu in zip(SPEED, MU, strict=True))


def written(folder, csv=CSV, **tables):
    """A campaign on disk whose [friction] names a table beside it."""
    folder.mkdir(exist_ok=True)
    (folder / "mu_v.csv").write_text(csv, encoding="utf-8")
    time = np.arange(40) * 0.01
    runs = [
        {"surface_speed": speed, "columns": {"t": time, "x": noisy(0.0 * time, number)}}
        for number, speed in enumerate(SPEEDS)
    ]
    more = {"friction": {"table": "mu_v.csv"}, "noise": {"x": NOISE}} | tables
    return write_campaign(folder, runs, **more)


def test_a_table_is_read_from_where_the_campaign_is(tmp_path, monkeypatch):
    path = written(tmp_path / "week")
    monkeypatch.chdir("/")
    campaign = read_campaign(path)
    own = campaign.friction_table
    assert (own.speeds, own.mu) == (SPEED, MU)
    # its level is that at the surface's mean speed, and the model's mu_k
    assert own.typical == pytest.approx(np.mean(SPEEDS))
    np.testing.assert_allclose(own.parts * own.level, MU)
    assert any("mu_v.csv, 5 points" in remark for remark in campaign.remarks)


OVER_BOTH = "v,T_degC,mu\n" + "".join(
    f"{v:g},{t:g},{0.2 - 0.1 * v:g}\n" for t in (-10.0, -2.0) for v in SPEED
)


@pytest.mark.parametrize(
    ("csv", "tables", "says"),
    [
        (OVER_BOTH, {}, ["column T_degC", "allowed are v and mu"]),
        (CSV, {"friction": {"table": "other.csv"}}, ["friction.table: ", "No such file"]),
        ("v,mu\n0,0\n0.4,0\n", {}, ["mu is 0 at 0.103 m/s", "allowed is above 0"]),
        (
            CSV, {"friction": {"table": "mu_v.csv", "mu_k": [0.2, 0.01]}},
            ["friction.mu_k: 0.2 beside table", "give one of the two"],
        ),
        (CSV, {"model": {"scheme": "study"}}, ['beside model.scheme = "study"']),
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
