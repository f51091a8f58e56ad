"""Columns by other names and in other units: by the header, by campaign.toml, by the run."""

import re

import numpy as np
import pytest
from gap_campaigns import NOISE, motion, noisy, write_campaign

from cosim.cli import main
from cosim.gap import CampaignError, read_campaign
from cosim.gap.camera.camera import Camera
from cosim.gap.camera.corrected import _csv
from cosim.gap.data.reading.csv_file import read_columns

DURATION = 4.0


@pytest.fixture(scope="module")
def truth():
    done = motion(duration=DURATION)
    return {"t": done.time, "x": noisy(done["x"], 1), "phi": 1e-3 * np.sin(done.time)}


def campaign_of(folder, measured, runs=1, **tables):
    """Runs with the same columns, of which the second is a little off: no copies."""
    first = next(name for name in measured if "x" in name.lower())
    tracks = [dict(measured, **{first: measured[first] * (1.0 + 1e-4 * i)}) for i in range(runs)]
    return write_campaign(folder, [{"columns": track} for track in tracks], **tables)


def check_track(track, truth):
    for name in ("x", "phi"):
        assert np.allclose(track[name], truth[name], rtol=1e-12, atol=1e-15)
    assert np.allclose(track.time, truth["t"], rtol=1e-12)


def test_a_header_that_states_its_unit_is_converted_and_it_is_said(tmp_path, truth):
    columns = {
        "t/ms": 1e3 * truth["t"], "x [mm]": 1e3 * truth["x"], "phi (deg)": np.degrees(truth["phi"]),
    }  # fmt: skip
    campaign = read_campaign(campaign_of(tmp_path, columns, runs=2, noise={"x": NOISE}))
    check_track(campaign.runs[0].motion, truth)
    said = [remark for remark in campaign.remarks if "converted" in remark]
    assert said == [
        "run01.csv, run02.csv: converted: t from ms to s (its header); x from mm to m (its "
        "header); phi from deg to rad (its header)"
    ]


def test_columns_and_units_of_the_campaign_and_of_a_run(tmp_path, truth):
    columns = {
        "time": truth["t"], "X position": 1e3 * truth["x"], "x": 7.0 + truth["x"],
        "angle": truth["phi"],
    }  # fmt: skip
    path = campaign_of(tmp_path, columns, 2)
    run = 'file = "run{}.csv"\nmass = 0.87\nstiffness = 38.5\nsurface_speed = 0.06\n'
    path.write_text(
        '[columns]\nx = "X position"\nphi = "angle"\n[units]\nx = "mm"\n'
        f"[[run]]\n{run.format('01')}[[run]]\n{run.format('02')}"
        'units = { x = "m" }\ncolumns = { x = "x" }\n'
    )
    first, second = read_campaign(path).runs
    check_track(first.motion, truth)
    assert np.allclose(second.motion.x, 7.0 + truth["x"])  # of the last run its own
    check_track(second.motion, {**truth, "x": 7.0 + truth["x"]})


def test_what_is_corrected_is_written_in_si(tmp_path, truth):
    columns = {"t/ms": 1e3 * truth["t"], "x [mm]": 1e3 * truth["x"]}
    (run,) = read_campaign(campaign_of(tmp_path, columns)).runs
    rows = _csv(run, Camera({"measurement.scale": 0.0})).splitlines()
    assert rows[1] == "t,x" or rows[0].startswith("#")
    last = np.array(rows[-1].split(","), dtype=float)
    assert np.allclose(last, [truth["t"][-1], truth["x"][-1]], rtol=1e-9)


#: Header of x, tables of the campaign -> the one line: file, key, value, what is allowed.
REFUSED = {
    "no such column": (
        "x", {"columns": {"x": "pos"}}, r"run01.csv: columns.x: pos is no column .*one of t, x",
    ),
    "two channels, one column": (
        "x", {"columns": {"x": "x", "y": "x"}}, r"run 1: columns.y: x is columns.x too, allowed",
    ),
    "no such channel": (
        "x", {"columns": {"z": "x"}}, r"columns.z: no such key",
    ),
    "a word for a unit": (
        "x", {"units": {"x": "furlong"}}, r"units.x: furlong is no unit .*allowed is a length: m, ",
    ),
    "a unit of another kind": (
        "x", {"units": {"x": "ms"}}, r"units.x: ms is of another kind, allowed is a length",
    ),
    "a number for a unit": ("x", {"units": {"x": 1000}}, r"units.x: not a text \(1000\)"),
    "header and table disagree": (
        "x [mm]", {"units": {"x": "m"}}, r"run01.csv: units.x: m, but its header says x \[mm\]",
    ),
    "a header with no unit": (
        "x [furlong]", {}, r"run01.csv: column x: unit furlong is no unit .*allowed is a length",
    ),
    "degrees of a length": (
        "x [deg]", {}, r"run01.csv: column x: unit deg is of another kind, allowed is a length",
    ),
    "a unit in capitals": ("x [MM]", {}, r"unit MM is no unit .*\(nearest: mm\)"),
    "half a word": ("x", {"units": {"t": "msec"}}, r"units.t: msec is no unit .*\(nearest: ms\)"),
    "a whole word": ("x [micrometres]", {}, r"micrometres is no unit .*\(nearest: um\)"),
    "a unit in the name": (
        "x_mm", {}, r'is x_mm meant\? allowed is \[columns\] x = "x_mm" with \[units\] x = "mm"',
    ),
    "a unit in the name alone": (
        "x_mm", {"columns": {"x": "x_mm"}}, r'x_mm ends in mm, .*\[units\] x = "mm" .*or "m"',
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", REFUSED)
def test_what_is_wrong_with_them_is_one_line(case, tmp_path, truth, capsys):
    header, tables, words = REFUSED[case]
    path = campaign_of(tmp_path, {"t": truth["t"], header: truth["x"]}, **tables)
    with pytest.raises(CampaignError, match=words):
        read_campaign(path)
    assert main(["gap", str(path), "-o", str(tmp_path / "out")]) == 2
    err = capsys.readouterr().err
    assert err.count("\n") == 1 and re.search(words, err) and str(tmp_path) in err
    assert not (tmp_path / "out").exists()


def test_what_is_proposed_for_a_name_that_ends_in_a_unit_reads_it(tmp_path, truth):
    columns = {"t": truth["t"], "x_mm": 1e3 * truth["x"], "phi_deg": np.degrees(truth["phi"])}
    tables = {"columns": {"x": "x_mm"}, "units": {"x": "mm"}}
    campaign = read_campaign(campaign_of(tmp_path, columns, **tables))
    assert np.allclose(campaign.runs[0].motion.x, truth["x"], rtol=1e-12, atol=1e-15)
    assert any(
        '[columns] phi = "phi_deg", [units] phi = "deg" uses it' in remark
        for remark in campaign.remarks
    )


@pytest.mark.parametrize("units", ["s,mm", "[s],[mm]"])
def test_a_row_of_units_below_the_header_says_where_units_go(units, tmp_path):
    file = tmp_path / "run.csv"
    file.write_text(f"t,x\n{units}\n0,1\n1,2\n")
    with pytest.raises(CampaignError, match=r"line 2: t = .* is a unit.*t \[s\], or \[units\] t"):
        read_columns(file)
    file.write_text("t,x\n0,1\nlost,2\n")
    with pytest.raises(CampaignError, match='line 3: t = "lost" is not a number'):
        read_columns(file)


def test_a_plan_takes_them_as_they_come(tmp_path):
    """A planned run has no file yet; the tables of the campaign may be there all the same."""
    from cosim.gap.plan import read_plan

    (tmp_path / "campaign.toml").write_text(
        'name = "next"\n[units]\nx = "mm"\n[columns]\nx = "pos"\n'
        "[[run]]\nmass = 0.67\nstiffness = 20.0\nsurface_speed = 0.1\n"
    )
    assert len(read_plan(tmp_path).runs) == 1


def test_a_plan_says_that_it_reads_no_files(tmp_path):
    from cosim.gap.plan import read_plan

    run = "mass = 0.67\nstiffness = 20.0\nsurface_speed = 0.1\n"
    text = f'name = "next"\n[[run]]\nfile = "run1.csv"\n{run}'
    (tmp_path / "campaign.toml").write_text(text)
    remarks = read_plan(tmp_path).campaign.remarks
    assert any(
        "files of runs are not read" in line and "20 s at 100 Hz" in line for line in remarks
    )


@pytest.mark.parametrize(("rate", "remarks"), [(10.0, 1), (100.0, 0)])
def test_a_plan_says_where_noise_could_not_be_told_from_motion(rate, remarks, tmp_path):
    from cosim.gap.plan import read_plan

    (tmp_path / "campaign.toml").write_text(
        'name = "next"\n[noise]\nx = 2e-4\n[friction]\nmu_s = 0.3\nmu_k = 0.2\n'
        f"[[run]]\nmass = 0.67\nstiffness = 20.0\nsurface_speed = 0.1\nrate = {rate}\n"
    )
    said = [line for line in read_plan(tmp_path).campaign.remarks if "cannot be told" in line]
    assert len(said) == remarks and all("run 1: at 10 Hz" in line for line in said)


#: What spreadsheets write -> how its bytes come.
AS_WRITTEN = {
    "Windows' signs for micro and degree": ("t/ms;x [µm];phi [°]", "cp1252", True),
    "the same in UTF-8": ("t/ms;x [µm];phi [°]", "utf-8", True),
    "a line that says what separates": ("sep=;\nt/ms;x [µm];phi [°]", "utf-8-sig", True),
    "points in place of commas": ("t/ms;x [µm];phi [°]", "cp1252", False),
}


@pytest.mark.parametrize("case", AS_WRITTEN)
def test_files_of_a_spreadsheet_are_read(case, tmp_path):
    header, encoding, commas = AS_WRITTEN[case]
    # at rest for longer than a look at the first lines would see: only then a decimal mark
    x = [0.0] * 80 + [1.5] * 80
    rows = [f"{10 * i};{0 if value == 0.0 else value};0" for i, value in enumerate(x)]
    text = "\n".join([header, *rows])
    file = tmp_path / "run.csv"
    file.write_bytes((text.replace(".", ",") if commas else text).encode(encoding))
    columns = read_columns(file).values
    assert np.allclose(columns["t"], 0.01 * np.arange(160))
    assert np.allclose(columns["x"], 1e-6 * np.array(x))  # metres
    assert set(columns) == {"t", "x", "phi"}


def test_a_planned_campaign_is_no_measured_one_and_it_is_said_what_reads_it(tmp_path, capsys):
    from cosim.gap.example import write_planned_example

    write_planned_example(tmp_path)
    assert main(["gap", str(tmp_path)]) == 2
    assert "run 1: file" in (said := capsys.readouterr().err) and "stickslip plan" in said
