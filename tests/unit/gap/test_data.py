"""Campaign files and tracker files: what is read, what is refused, in which words."""

import numpy as np
import pytest
from gap_campaigns import KNOWN, NOISE, motion, noisy, write_campaign, write_csv
from stickslip import Parameters

from cosim.gap import CampaignError, read_campaign
from cosim.gap.data.campaign import read_track


@pytest.fixture(scope="module")
def columns():
    run = motion()
    return {"t": run.time, "x": noisy(run["x"], 1), "y": noisy(run["y"], 2)}


@pytest.fixture
def campaign(tmp_path, columns):
    """Writes a campaign of one run whose columns are changed, and returns its file."""

    def write(run=None, change=None, **tables):
        changed = dict(columns)
        if change is not None:
            change(changed)
        return write_campaign(tmp_path, [{"columns": changed, **(run or {})}], **tables)

    return write


def test_a_campaign_is_read(campaign, columns):
    read = read_campaign(campaign({"ambient_degC": -5.0}, noise={"x": NOISE, "y": 3e-4}))
    (run,) = read.runs
    assert (read.name, read.scheme, read.noise_estimated) == ("test", "exact", ())
    assert (run.name, run.mass, run.stiffness, run.surface_speed) == ("run01", 0.87, 38.5, 0.06)
    assert (run.ambient_degC, run.hold_out, run.summary) == (-5.0, False, None)
    assert run.noise == {"x": NOISE, "y": 3e-4} == read.noise
    np.testing.assert_allclose(run.track.x, columns["x"], rtol=1e-8, atol=0.0)
    assert run.track.channels == ("x", "y") and run.track.phi is None
    parameters = Parameters.model_validate(read.parameters(run), strict=True)
    assert parameters.rig.mass == 0.87 and parameters.rig.spring_natural_length == 0.17


def test_a_folder_stands_for_its_campaign_file(campaign):
    assert read_campaign(campaign().parent).name == "test"


def test_a_slab_gives_the_curvature_as_known(campaign):
    read = read_campaign(campaign(rig={"surface": "slab", "slab_radius": 0.4}))
    parameters = Parameters.model_validate(read.parameters(read.runs[0]), strict=True)
    assert parameters.flat()["turning_surface.curvature"] == 2.5


def test_time_starts_anywhere(campaign, columns):
    def later(columns):
        columns["t"] = columns["t"] + 1.7e9  # seconds since 1970

    track = read_campaign(campaign(change=later)).runs[0].track
    assert track.time_offset == 1.7e9 and track.time[0] == 0.0
    # a double of 1.7e9 resolves 2.4e-7 s
    np.testing.assert_allclose(track.time, columns["t"], atol=5e-7)


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
}


@pytest.mark.parametrize("dialect", DIALECTS)
def test_the_same_numbers_in_every_dialect(tmp_path, columns, dialect):
    write_csv(tmp_path / "run.csv", columns)
    text = (tmp_path / "run.csv").read_text(encoding="utf-8")
    (tmp_path / "run.csv").write_text(DIALECTS[dialect](text), encoding="utf-8", newline="")
    track, remarks = read_track(tmp_path / "run.csv")
    np.testing.assert_allclose(track.time, columns["t"], rtol=1e-8, atol=1e-12)
    np.testing.assert_allclose(track.x, columns["x"], rtol=1e-8)
    np.testing.assert_allclose(track.y, columns["y"], rtol=1e-8)
    assert remarks == []


def test_what_is_not_known_is_said(tmp_path, columns):
    write_csv(tmp_path / "run.csv", columns | {"frame": np.arange(len(columns["t"]))})
    track, remarks = read_track(tmp_path / "run.csv")
    assert remarks == ["run.csv: column frame is not used"] and len(track.x) == len(columns["t"])


def test_missing_samples_stay_missing(tmp_path, columns):
    lost = columns | {"x": columns["x"].copy(), "y": np.full(len(columns["y"]), np.nan)}
    lost["x"][100:140] = np.nan
    write_csv(tmp_path / "run.csv", lost)
    track, remarks = read_track(tmp_path / "run.csv")
    assert np.flatnonzero(np.isnan(track.x)).tolist() == list(range(100, 140))
    assert track.y is None and remarks == ["run.csv: column y has 0 samples and is not used"]


def scaled(name, factor):
    def change(columns):
        columns[name] = columns[name] * factor

    return change


def put(name, row, value):
    def change(columns):
        columns[name] = columns[name].copy()
        columns[name][row] = value

    return change


def only(rows):
    def change(columns):
        columns.update({name: values[:rows] for name, values in columns.items()})

    return change


BAD_DATA = {
    "x in mm": (scaled("x", 1e3), r"column x: swings by .* metres \(are these millimetres\?"),
    "x in cm": (scaled("x", 1e2), r"column x: swings by .*are these centimetres\?"),
    "y in mm": (scaled("y", 1e6), r"column y: swings by .*are these micrometres\?"),
    "t in ms": (scaled("t", 1e3), r"column t: 10 s between samples.*are these milliseconds\?"),
    "no x": (lambda c: c.pop("x"), r"column x: missing \(there: t, y\), allowed is t,x"),
    "no t": (lambda c: c.pop("t"), r"column t: missing"),
    "time stands": (put("t", 7, 0.06), r"line 9: t = 0.06 s repeats 0.06 s, .* grows"),
    "time falls": (put("t", 7, 0.01), r"line 9: t = 0.01 s falls back from 0.06 s, .* grows"),
    "time missing": (put("t", 7, np.nan), r"line 9: t is missing, allowed is a time in every row"),
    "three samples": (only(3), r"column x: 3 samples, allowed are at least 20"),
    "all missing": (scaled("x", np.nan), r"column x: no samples, allowed are at least 20"),
    "at rest": (scaled("x", 0.0), r"column x: does not change, allowed is a measured motion"),
    "degrees": (lambda c: c.update(phi=c["y"] * 1e5), r"column phi: .*are these degrees\?"),
}


@pytest.mark.parametrize("case", BAD_DATA)
def test_bad_data_are_refused_in_one_line(campaign, case):
    change, words = BAD_DATA[case]
    with pytest.raises(CampaignError, match=words) as refused:
        read_campaign(campaign(change=change))
    assert "run01.csv: " in str(refused.value) and "\n" not in str(refused.value)


BAD_TEXT = {
    "no header": ("0,0.1\n1,0.2\n", "line 1 holds numbers where the header row is expected"),
    "empty": ("", "no data"),
    "only a header": ("t,x\n", "a header row without numbers"),
    "a word": ("t,x\n0,0\n1,lost\n", 'line 3: x = "lost" is not a number'),
    "ragged": ("t,x\n0,0\n1,0,5\n", "line 3 has 3 fields, the header has 2"),
    "rows too short": ("t,x,z\n0,0\n1,0\n", "line 2 has 2 fields, the header has 3"),
    "decimal commas": ("t,x\n0,0,1,5\n1,0,1,6\n", "decimal commas between commas"),
    "furlongs in the header": ("t,x [furlong]\n0,0\n", r"column x: unit furlong is no unit"),
    "twice": ("t,x,x\n0,0,0\n", "column x: there twice"),
    "UTF-16": ("t,x\n0,0\n".encode("utf-16"), "is not text in UTF-8"),
}


@pytest.mark.parametrize("case", BAD_TEXT)
def test_bad_files_are_refused_in_one_line(tmp_path, case):
    text, words = BAD_TEXT[case]
    (tmp_path / "run.csv").write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(CampaignError, match=words) as refused:
        read_track(tmp_path / "run.csv")
    assert str(refused.value).startswith(f"{tmp_path / 'run.csv'}: ")


BAD_TABLES = {
    "negative mass": ({"mass": -0.5}, r"run 1: mass: out of range \(-0.5\), .* greater than 0 kg"),
    "misspelt": ({"masss": 0.5}, r"run 1: masss: no such key, nearest known: mass"),
    "text": ({"stiffness": "soft"}, r'run 1: stiffness: not a number \("soft"\)'),
    "no mass": ({"mass": None}, r"run 1: mass: is missing, allowed is a number"),
    "at rest": ({"surface_speed": 0.0}, r"run 1: surface_speed: .*allowed is at least 1e-09 m/s"),
    "hold-out": ({"hold_out": "yes"}, r'run 1: hold_out: .*"yes".* allowed is true or false'),
    "lost file": ({"file": "gone.csv"}, r"gone\.csv: no such file, allowed is a CSV file beside"),
    "both": ({"summary": {"mean_x": [0.02, 0.002]}}, r"run 1: file: and summary: both given"),
    "figure": ({"summary": {"meanx": [0.0, 1.0]}}, r"summary.meanx: no such key, .*mean_x"),
    "no error": ({"file": "", "summary": {"mean_x": [0.0, 0.0]}}, r"standard deviation 0, allowed"),
}


@pytest.mark.parametrize("case", BAD_TABLES)
def test_bad_runs_are_refused_in_one_line(tmp_path, columns, case):
    change, words = BAD_TABLES[case]
    run = {"columns": columns} | change
    if case == "lost file":
        run.pop("columns")
    if case == "no error":
        run.pop("columns")
    with pytest.raises(CampaignError, match=words) as refused:
        read_campaign(write_campaign(tmp_path, [run]))
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("tables", "words"),
    [
        ({"rig": {"spring_lenght": 0.2}}, r"spring_lenght: no such key, .* rig\.spring_length"),
        ({"rig": {"mass": 0.2}}, r"rig\.mass: no such key"),
        ({"rig": {"spring_natural_length": 0.5}}, r"spring_natural_length: .*coil on coil"),
        (
            {"noise": {"x": 0.0}},
            r"noise\.x: out of range \(0\.0\), .* at least 1e-12 and at most 1 m",
        ),
        ({"model": {"scheme": "thesis"}}, r'model\.scheme: not known .*"exact" or "study"'),
        ({"rigg": {}}, r"rigg: no such key, nearest known: rig"),
    ],
)
def test_bad_tables_are_refused_in_one_line(campaign, tables, words):
    with pytest.raises(CampaignError, match=words):
        read_campaign(campaign(**tables))


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("name = 'a'\n", r"campaign\.toml: run: no runs, allowed is a table \[\[run\]\]"),
        ("[[runs]]\nmass = 1.0\n", r"run: no runs \(nearest: runs\)"),
        ("[run]\nmass = 1.0\n", r"run: no runs"),
        ("name = \n", r"campaign\.toml: not TOML: "),
    ],
)
def test_a_file_without_runs_is_refused(tmp_path, text, words):
    (tmp_path / "campaign.toml").write_text(text, encoding="utf-8")
    with pytest.raises(CampaignError, match=words):
        read_campaign(tmp_path / "campaign.toml")


def test_a_missing_campaign_is_refused(tmp_path):
    with pytest.raises(CampaignError, match=r"nowhere\.toml: no such file, allowed is"):
        read_campaign(tmp_path / "nowhere.toml")


def test_runs_of_figures_alone(tmp_path):
    summary = {"mean_x": [0.02, 0.002], "slip_share": [0.925, 0.02]}
    read = read_campaign(write_campaign(tmp_path, [{"summary": summary}]))
    (run,) = read.runs
    assert run.track is None and run.name == "run 1"
    assert run.summary == {"mean_x": (0.02, 0.002), "slip_share": (0.925, 0.02)}


def different(columns, seed):
    return {"t": columns["t"], "x": noisy(columns["x"], seed)}


def test_every_run_held_out_is_refused(tmp_path, columns):
    runs = [{"columns": different(columns, seed), "hold_out": True} for seed in (3, 4)]
    with pytest.raises(CampaignError, match="hold_out: true in every run, there is nothing to fit"):
        read_campaign(write_campaign(tmp_path, runs))


def test_runs_are_held_out_by_a_rule_when_none_is_marked(tmp_path, columns):
    speeds = (0.08, 0.02, 0.06, 0.04)
    runs = [
        {"columns": different(columns, seed), "surface_speed": speed}
        for seed, speed in enumerate(speeds)
    ]
    read = read_campaign(write_campaign(tmp_path, runs))
    assert [run.surface_speed for run in read.held_out_runs] == [0.04]
    assert "no run is marked hold_out; held out by rule: run04" in read.remarks


def test_that_nothing_is_held_out_is_said(campaign):
    (remark,) = read_campaign(campaign()).remarks
    assert remark.startswith("no run is held out, run01 is the only one with a track")


def test_a_copy_is_counted_once(tmp_path, columns):
    runs = [{"columns": columns}, {"columns": columns}, {"columns": different(columns, 3)}]
    read = read_campaign(write_campaign(tmp_path, runs))
    assert [run.name for run in read.runs] == ["run01", "run03"]
    assert "run02 holds the same data as run01: left out" in read.remarks


def test_a_copy_of_a_fitted_run_is_not_held_out(tmp_path, columns):
    part = {"t": columns["t"][:500] + 3.0, "x": columns["x"][200:700]}
    runs = [{"columns": part, "hold_out": True}, {"columns": columns}]
    runs.append({"columns": different(columns, 3), "hold_out": True})
    read = read_campaign(write_campaign(tmp_path, runs))
    assert [run.name for run in read.held_out_runs] == ["run03"]
    assert read.remarks[0].startswith("run01 holds the same data as run02 and is not held out")


def test_the_same_data_at_two_operating_points_are_refused(tmp_path, columns):
    runs = [{"columns": columns}, {"columns": columns, "mass": 1.5}]
    with pytest.raises(CampaignError, match="run02 holds the same data as run01, but its mass"):
        read_campaign(write_campaign(tmp_path, runs))


def test_a_run_that_only_slips_is_remarked_on(tmp_path):
    fast = motion(speed=0.4, initial={"x": 0.03})
    columns = {"t": fast.time, "x": noisy(fast["x"], 1)}
    read = read_campaign(write_campaign(tmp_path, [{"columns": columns, "surface_speed": 0.4}]))
    assert read.remarks[1:] == ("run01: no stick is seen after the start",)


def test_a_run_that_only_sticks_is_remarked_on(tmp_path):
    slow = motion(speed=0.001, duration=5.0)
    columns = {"t": slow.time, "x": noisy(slow["x"], 1)}
    read = read_campaign(write_campaign(tmp_path, [{"columns": columns, "surface_speed": 0.001}]))
    assert read.remarks[1:] == ("run01: no slip is seen, it says nothing of kinetic friction",)


@pytest.mark.parametrize("name", ["e1", "e2", "e3", "e4", "e5"])
def test_example_campaigns_are_read(name, shared):
    read = read_campaign(shared(f"data/blind_examples/{name}"))
    assert [run.hold_out for run in read.runs].count(True) == 2
    assert all(run.track.outliers == {"x": 0, "y": 0} for run in read.runs)
    assert KNOWN["stiffness"] == read.runs[0].stiffness


def test_measured_friction_of_paper_is_read(shared):
    read = read_campaign(shared("data/paper_friction"))
    assert read.noise_estimated == ("x",) and len(read.held_out_runs) == 2
    slow = read.runs[0]
    # a resolution of some nanometres to a micrometre, by eye; stick-slip in every second or two
    assert 2e-7 < slow.noise["x"] < 2e-6
    assert 200 < len(slow.sticks) < 350
