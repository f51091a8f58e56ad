"""A folder of tracker files becomes a campaign: what names and headers say, written to be read."""

import os

import numpy as np
import pandas as pd
import pytest
from command_line import refusal

from cosim.cli import main
from cosim.gap import CampaignError, read_campaign
from cosim.gap.from_folder import campaign_of, settings_of, shown

TIME = np.arange(0.0, 4.0, 0.02)
RANDOM = np.random.default_rng(0)
X = 0.02 + 0.01 * np.sin(9.0 * TIME) + 1e-4 * RANDOM.standard_normal(TIME.size)
Y = 1e-4 * RANDOM.standard_normal(TIME.size)


def lines(*columns, mark=",", comma=False):
    rows = [mark.join(f"{value:.6f}" for value in row) for row in zip(*columns, strict=True)]
    return [row.replace(".", ",") for row in rows] if comma else rows


def write(folder, name, *text):
    folder.mkdir(exist_ok=True)
    (folder / name).write_text("\n".join(text) + "\n", encoding="utf-8")


@pytest.mark.parametrize(
    ("name", "settings"),
    [
        ("870g_60mm-s", {"mass": 0.87, "surface_speed": 0.06}),
        ("run3_m1.4_v0.15", {"mass": 1.4, "surface_speed": 0.15}),
        ("38,5N_per_m 0p67kg 15cmps", {"mass": 0.67, "stiffness": 38.5, "surface_speed": 0.15}),
        ("k20.17_-8degC", {"stiffness": 20.17, "ambient_degC": -8.0}),
        ("run01", {}),
        ("2026-03-14_block", {}),
    ],
)
def test_what_a_files_name_says(name, settings):
    assert settings_of(name) == settings


def test_decimal_commas_in_millimetres(tmp_path):
    folder = tmp_path / "cold room"
    for swing, speed in enumerate((100, 150, 60), start=1):
        rows = lines(TIME, 1e3 * swing * X, mark=";", comma=True)
        write(folder, f"870g_{speed}mm-s_k38.5.csv", "time_s;pos_mm", *rows)
    file, found = campaign_of(folder)
    campaign = read_campaign(folder)
    assert campaign.name == "cold room" and file == folder / "campaign.toml"
    assert [run.surface_speed for run in campaign.runs] == [0.1, 0.15, 0.06]
    assert [run.hold_out for run in campaign.runs] == [False, False, True]
    assert campaign.runs[0].track.x == pytest.approx(X, abs=1e-6)
    assert "by the file's name" in file.read_text("utf-8")
    assert "x = pos_mm" in "\n".join(shown(found, {}))


def test_columns_in_another_language_are_known_by_their_units(tmp_path):
    write(tmp_path, "a.csv", "Zeit (s);Weg (mm)", *lines(TIME, 1e3 * X, mark=";", comma=True))
    _, [found] = campaign_of(tmp_path)
    assert found.reading.columns == {"t": "Zeit", "x": "Weg"}
    assert found.seconds == pytest.approx(TIME[-1])


def test_two_columns_of_one_kind_are_not_guessed(tmp_path):
    write(tmp_path, "a.csv", "t,Weg (mm),Hub (mm)", *lines(TIME, X, Y))
    with pytest.raises(CampaignError, match=r"column x: .*, which is then written first"):
        campaign_of(tmp_path)


def test_a_folder_without_a_campaign_hints_at_the_command_that_makes_one(tmp_path, capsys):
    write(tmp_path, "a.csv", "t,x", *lines(TIME, X))
    assert f"`stickslip campaign {tmp_path}` makes it" in refusal(capsys, "gap", str(tmp_path))


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes with a name here")
def test_a_pipe_among_the_files_is_refused_and_not_waited_for(tmp_path, capsys):
    os.mkfifo(tmp_path / "track.csv")
    said = refusal(capsys, "campaign", tmp_path)
    assert said == f"{tmp_path / 'track.csv'}: cannot be read: is not a file"


def test_a_table_of_tracker(tmp_path):
    """Its points stand above its header; the first is taken."""
    rows = lines(TIME, X, Y, TIME, X, X, mark="\t")
    header = ("mass A\t\t\tmass B\t\t", "t\tx\ty\tt\tx\ty")
    write(tmp_path, "0.87kg_v0.06_k38.5.txt", *header, *rows)
    campaign_of(tmp_path)
    (run,) = read_campaign(tmp_path).runs
    assert run.file.name == "0.87kg_v0.06_k38.5_track.csv"
    assert run.track.x == pytest.approx(X, abs=1e-6) and run.mass == 0.87


def deeplabcut(folder, name):
    left, right = 100.0 + X / 2e-4, 300.0 + X / 2e-4
    sure = np.where(TIME == TIME[7], 0.1, 0.99)
    frame = np.arange(TIME.size)
    columns = (frame, left, 50.0 + Y / 2e-4, sure, right, 30.0 - Y / 2e-4, 1.0 + 0.0 * X)
    head = ("scorer" + ",net" * 6, "bodyparts" + ",left" * 3 + ",right" * 3,
            "coords" + ",x,y,likelihood" * 2)  # fmt: skip
    write(folder, name, *head, *lines(*columns))


def test_pixels_of_deeplabcut(tmp_path):
    deeplabcut(tmp_path, "m0.87_v0.06_k38.5.csv")
    with pytest.raises(CampaignError, match=r"needed are --frames RATE.* and --pixel"):
        campaign_of(tmp_path)
    campaign_of(tmp_path, frames=50.0, pixel=2e-4)
    (run,) = read_campaign(tmp_path).runs
    assert run.track.time == pytest.approx(TIME)
    assert np.isnan(run.track.x[7])
    seen = np.arange(TIME.size) != 7
    assert run.track.x[seen] == pytest.approx(X[seen] + 0.04, abs=1e-6)
    turned = np.arctan2(2.0 * Y / 2e-4 + 20.0, 200.0)
    assert run.track.phi[seen] == pytest.approx((turned - turned[0])[seen], abs=1e-6)


def test_a_sheet_of_excel(tmp_path):
    pytest.importorskip("openpyxl")
    sheet = pd.DataFrame({"t [s]": TIME, "x [mm]": 1e3 * X})
    sheet.to_excel(tmp_path / "m0.87_v0.06_k38.5.xlsx", index=False)
    campaign_of(tmp_path)
    assert read_campaign(tmp_path).runs[0].track.x == pytest.approx(X, abs=1e-6)


def test_what_no_name_says_is_given_or_asked_for(tmp_path, capsys):
    write(tmp_path, "run1.csv", "t,x", *lines(TIME, X))
    assert main(["campaign", str(tmp_path), "--set", "mass=870 g"]) == 0
    assert "run1.csv  200   3.98" in capsys.readouterr().out
    text = (tmp_path / "campaign.toml").read_text("utf-8")
    assert "mass = 0.87  # kg, as given" in text and "# surface_speed =   # m/s" in text
    with pytest.raises(CampaignError, match="stiffness: is missing"):
        read_campaign(tmp_path)
    assert "--force to overwrite" in refusal(capsys, "campaign", tmp_path)
    refusal(capsys, "campaign", tmp_path, "--set", "weight=1")
    refusal(capsys, "campaign", tmp_path / "none")


def test_columns_of_other_names_are_said_beforehand(tmp_path):
    """A campaign.toml without runs keeps nobody from making one, and is not lost."""
    name = "m0.87_v0.06_k38.5.csv"
    rows = lines(TIME, 1e3 * X, 1e3 * Y, mark=";")
    write(tmp_path, name, "Zeit [s];Weg [mm];Hub [mm]", *rows)
    with pytest.raises(CampaignError, match="column x: missing"):
        campaign_of(tmp_path)
    said = '[columns]\nt = "Zeit"\nx = "Weg"\n'
    (tmp_path / "campaign.toml").write_text(said, encoding="utf-8")
    campaign_of(tmp_path)
    assert read_campaign(tmp_path).runs[0].track.x == pytest.approx(X, abs=1e-6)
