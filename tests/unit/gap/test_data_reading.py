"""A tracker's file as numbers in SI units: dialects, columns, units, and what is refused."""

import numpy as np
import pytest
from gap_campaigns import NOISE, motion, noisy, write_campaign, write_csv

from cosim.gap import CampaignError, read_campaign
from cosim.gap.data.track_file import read_track


@pytest.fixture(scope="module")
def columns():
    run = motion(duration=10.0)
    return {"t": run.time, "x": noisy(run["x"], 1), "y": noisy(run["y"], 2)}


def check_same(track, columns):
    """Every channel of the track, from t = 0 on."""
    np.testing.assert_allclose(track.time, columns["t"] - columns["t"][0], rtol=1e-8, atol=1e-12)
    for channel in track.channels:
        np.testing.assert_allclose(track[channel], columns[channel], rtol=1e-8, atol=1e-15)


DIALECTS = {
    "plain": lambda text: text,
    "windows": lambda text: "\ufeff" + text.replace("\n", "\r\n"),
    "spaces": lambda text: text.replace(",", " , "),
    "comments": lambda text: "# cold room\n\n" + text.replace("\n0.05,", "\n# light off\n0.05,"),
    "header in a comment": lambda text: "# " + text,
    "units": lambda text: text.replace("t,x,y", "Time (s),X [m],y/m"),
    "quotes": lambda text: text.replace("t,x,y", '"t","x","y"'),
    "tabs": lambda text: text.replace(",", "\t"),
    "white space": lambda text: text.replace(",", "   "),
    "German": lambda text: text.replace(",", ";").replace(".", ","),
    "sep": lambda text: "sep=;\n" + text.replace(",", ";").replace(".", ","),
}


@pytest.mark.parametrize("dialect", DIALECTS)
def test_the_same_numbers_in_every_dialect(tmp_path, columns, dialect):
    file = tmp_path / "run.csv"
    write_csv(file, columns)
    text = DIALECTS[dialect](file.read_text(encoding="utf-8"))
    file.write_text(text, encoding="utf-8", newline="")
    track, remarks, converted = read_track(file)
    check_same(track, columns)
    assert (remarks, converted) == ([], "")


@pytest.mark.parametrize("encoding", ["cp1252", "utf-8", "utf-8-sig"])
@pytest.mark.parametrize("commas", [True, False])
def test_files_of_a_spreadsheet_are_read(encoding, commas, tmp_path):
    # at rest for longer than a look at the first lines would see: only then a decimal mark
    rows = [f"{10 * i};{0 if i < 80 else 1.5};0" for i in range(160)]
    text = "\n".join(["t/ms;x [µm];phi [°]", *rows])
    file = tmp_path / "run.csv"
    file.write_bytes((text.replace(".", ",") if commas else text).encode(encoding))
    track, _, _ = read_track(file)
    np.testing.assert_allclose(track.time, 0.01 * np.arange(160))
    np.testing.assert_allclose(track.x, 1e-6 * np.repeat([0.0, 1.5], 80))
    assert track.channels == ("x", "phi")


def test_time_starts_anywhere_and_missing_samples_stay_missing(tmp_path, columns):
    changed = columns | {"t": columns["t"] + 1.7e9, "x": columns["x"].copy()}  # s since 1970
    changed["x"][100:140] = np.nan
    changed |= {"y": np.full(len(columns["t"]), np.nan), "frame": np.arange(len(columns["t"]))}
    write_csv(tmp_path / "run.csv", changed)
    track, remarks, _ = read_track(tmp_path / "run.csv")
    assert track.time_offset == 1.7e9 and track.time[0] == 0.0
    np.testing.assert_allclose(track.time, columns["t"], atol=5e-7)  # a double resolves 2.4e-7 s
    assert np.flatnonzero(np.isnan(track.x)).tolist() == list(range(100, 140))
    assert track.y is None and remarks == [
        "run.csv: column frame is not used", "run.csv: column y has 0 samples and is not used",
    ]  # fmt: skip


def test_units_of_a_header_and_of_the_campaign(tmp_path, columns):
    """What was converted is said."""
    truth = {"t": columns["t"], "x": columns["x"], "phi": 1e-3 * np.sin(columns["t"])}
    by_header = {
        "t/ms": 1e3 * truth["t"], "x [mm]": 1e3 * truth["x"], "phi (deg)": np.degrees(truth["phi"]),
    }  # fmt: skip
    by_name = {"time": truth["t"], "X position": 1e6 * truth["x"], "angle": truth["phi"]}
    names = {"columns": {"x": "X position", "phi": "angle"}, "units": {"x": "um"}}
    folders = [tmp_path / name for name in "ab"]
    for folder in folders:
        folder.mkdir()
    campaigns = [
        write_campaign(folders[0], [{"columns": by_header}], noise={"x": NOISE}),
        write_campaign(folders[1], [{"columns": by_name}], **names),
    ]
    for campaign in campaigns:
        check_same(read_campaign(campaign).runs[0].motion, truth)
    assert any(
        remark == "run01.csv: converted: t from ms to s (its header); x from mm to m (its header); "
        "phi from deg to rad (its header)"
        for remark in read_campaign(campaigns[0]).remarks
    )


def test_a_run_s_own_tables_hold_there(tmp_path, columns):
    write_csv(tmp_path / "run01.csv", {"t": columns["t"], "pos_mm": 1e3 * columns["x"]})
    run = 'file = "run01.csv"\nmass = 0.87\nstiffness = 38.5\nsurface_speed = 0.06\n'
    own = 'columns = { x = "pos_mm" }\nunits = { x = "mm" }\n'
    tables = '[rig]\nspring_natural_length = 0.17\n[columns]\nx = "elsewhere"\n[units]\nx = "um"\n'
    (tmp_path / "campaign.toml").write_text(f"{tables}[[run]]\n{run}{own}", encoding="utf-8")
    np.testing.assert_allclose(read_campaign(tmp_path).runs[0].motion.x, columns["x"], rtol=1e-12)


#: Header of x, tables of the campaign -> the one line: file, key, value, what is allowed.
REFUSED = {
    "no such column": ("x", {"columns": {"x": "pos"}}, r"columns.x: pos is no .*one of t, x"),
    "one column twice": ("x", {"columns": {"x": "x", "y": "x"}}, r"run 1: columns.y: x is .* too"),
    "no such channel": ("x", {"columns": {"z": "x"}}, r"columns.z: no such key"),
    "no unit": ("x", {"units": {"x": "furlong"}}, r"units.x: furlong .*allowed is a length: m, "),
    "another kind": ("x", {"units": {"x": "ms"}}, r"units.x: ms is of another kind, allowed is"),
    "a number": ("x", {"units": {"x": 1000}}, r"units.x: not a text \(1000\)"),
    "two units": ("x [mm]", {"units": {"x": "m"}}, r"units.x: m, but its header says x \[mm\]"),
    "no unit in brackets": ("x [furlong]", {}, r"column x: unit furlong .*allowed is a length"),
    "degrees of a length": ("x [deg]", {}, r"column x: unit deg is of another kind, allowed is a"),
    "capitals": ("x [MM]", {}, r"unit MM is no unit .*\(nearest: mm\)"),
    "half a word": ("x", {"units": {"t": "msec"}}, r"units.t: msec is no .*\(nearest: ms\)"),
    "a whole word": ("x [micrometres]", {}, r"micrometres is no unit .*\(nearest: um\)"),
    "x_mm": ("x_mm", {}, r'is x_mm meant\? .*\[columns\] x = "x_mm" with \[units\] x = "mm"'),
    "a name": ("x_mm", {"columns": {"x": "x_mm"}}, r'x_mm ends in mm, .*x = "mm" .*or "m"'),
}


@pytest.mark.parametrize("case", REFUSED)
def test_columns_that_are_wrong_are_refused_in_one_line(case, tmp_path, columns):
    header, tables, words = REFUSED[case]
    run = {"columns": {"t": columns["t"], header: columns["x"]}}
    with pytest.raises(CampaignError, match=words) as refused:
        read_campaign(write_campaign(tmp_path, [run], **tables))
    assert "\n" not in str(refused.value) and str(tmp_path) in str(refused.value)


BAD_TEXT = {
    "no header": ("0,0.1\n1,0.2\n", "line 1 holds numbers where the header row is expected"),
    "empty": ("", "no data"),
    "only a header": ("t,x\n", "a header row without numbers"),
    "a word": ("t,x\n0,0\n1,lost\n", 'line 3: x = "lost" is not a number'),
    "a word among decimal commas": ("t;x\n0,0;\n0,1;1,5\n0,2;lost\n", 'line 4: x = "lost" is'),
    "ragged": ("t,x\n0,0\n1,0,5\n", "line 3 has 3 fields, the header has 2"),
    "rows too short": ("t,x,z\n0,0\n1,0\n", "line 2 has 2 fields, the header has 3"),
    "decimal commas": ("t,x\n0,0,1,5\n1,0,1,6\n", "decimal commas between commas"),
    "twice": ("t,x,x\n0,0,0\n", "column x: there twice"),
    "UTF-16": ("t,x\n0,0\n".encode("utf-16"), "is not text in UTF-8"),
    "a row of units": ("t,x\n[s],[mm]\n0,1\n", r"line 2: t = .* is a unit.*t \[s\], or \[units\]"),
}


@pytest.mark.parametrize("case", BAD_TEXT)
def test_bad_files_are_refused_in_one_line(tmp_path, case):
    text, words = BAD_TEXT[case]
    file = tmp_path / "run.csv"
    file.write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(CampaignError, match=words) as refused:
        read_track(file)
    assert str(refused.value).startswith(f"{file}: ") and "\n" not in str(refused.value)


def scaled(name, factor):
    return lambda columns: columns | {name: columns[name] * factor}


def put(name, row, value):
    return lambda c: c | {name: np.where(np.arange(c[name].size) == row, value, c[name])}


def test_a_place_beyond_all_numbers_is_missing(tmp_path):
    rows = [f"{0.01 * n:.2f},{1e300 if n == 7 else 0.001 * n}" for n in range(30)]
    (tmp_path / "run.csv").write_text("\n".join(["t,x", *rows]), encoding="utf-8")
    track, _, _ = read_track(tmp_path / "run.csv")
    assert np.flatnonzero(np.isnan(track.x)).tolist() == [7]


BAD_DATA = {
    "x in mm": (scaled("x", 1e3), r"column x: swings by .* \(are these mm\? then units\.x = .mm."),
    "x in cm": (scaled("x", 1e2), r"column x: swings by .*are these cm\?"),
    "y in um": (scaled("y", 1e6), r"column y: swings by .*are these um\? then units.y"),
    "t in ms": (scaled("t", 1e3), r"column t: 10 s between samples.*are these milliseconds\?"),
    "t / 1000": (scaled("t", 1e-3), r"column t: covers 0.01 s.*thousandths of seconds"),
    "no x": (lambda c: {"t": c["t"], "y": c["y"]}, r"column x: missing \(there: t, y\), allowed"),
    "no t": (lambda c: {"x": c["x"]}, r"column t: missing"),
    "time stands": (put("t", 7, 0.06), r"line 9: t = 0.06 s repeats 0.06 s, .* grows"),
    "time falls": (put("t", 7, 0.01), r"line 9: t = 0.01 s falls back from 0.06 s, .* grows"),
    "time missing": (put("t", 7, np.nan), r"line 9: t is missing, allowed is a time in every row"),
    "a hole": (lambda c: c | {"t": c["t"] + 3e8 * (c["t"] > 2.0)}, r"3e\+08 s after the row bef"),
    "three samples": (lambda c: {n: v[:3] for n, v in c.items()}, r"column x: 3 samples, allowed"),
    "all missing": (scaled("x", np.nan), r"column x: no samples, allowed are at least 20"),
    "at rest": (scaled("x", 0.0), r"column x: does not change, allowed is a measured motion"),
    "degrees": (lambda c: c | {"phi": c["y"] * 1e5}, r"column phi: .*are these degrees\?"),
}


@pytest.mark.parametrize("case", BAD_DATA)
def test_bad_data_are_refused_in_one_line(tmp_path, columns, case):
    change, words = BAD_DATA[case]
    with pytest.raises(CampaignError, match=words) as refused:
        read_campaign(write_campaign(tmp_path, [{"columns": change(columns)}]))
    assert "run01.csv: " in str(refused.value) and "\n" not in str(refused.value)
