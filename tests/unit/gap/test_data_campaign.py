"""A campaign's file: every key, what is refused, what is held out, counted once, or remarked on."""

import numpy as np
import pytest
from gap_campaigns import NOISE, motion, noisy, write_campaign
from stickslip import Parameters

from cosim.gap import CampaignError, read_campaign
from cosim.gap.data.campaign_file import RunTable, read_tables


@pytest.fixture(scope="module")
def columns():
    run = motion(duration=10.0)
    return {"t": run.time, "x": noisy(run["x"], 1), "y": noisy(run["y"], 2)}


@pytest.fixture
def campaign(tmp_path, columns):
    """Writes a campaign of one run and returns its file."""

    def write(run=None, **tables):
        return write_campaign(tmp_path, [{"columns": columns, **(run or {})}], **tables)

    return write


def test_a_campaign_is_read(campaign, columns):
    path = campaign({"ambient_degC": -5.0}, noise={"x": NOISE, "y": 3e-4})
    read = read_campaign(path)
    (run,) = read.runs
    assert read_campaign(path.parent).name == read.name == "test"
    assert (read.scheme, read.noise_estimated, read.limits) == ("exact", (), {})
    assert (run.name, run.mass, run.stiffness, run.surface_speed) == ("run01", 0.87, 38.5, 0.06)
    assert (run.ambient_degC, run.hold_out, run.summary) == (-5.0, False, None)
    assert run.noise == {"x": NOISE, "y": 3e-4} == read.noise
    np.testing.assert_allclose(run.track.x, columns["x"], rtol=1e-8, atol=0.0)
    assert run.track.channels == ("x", "y") and run.track.phi is None
    parameters = Parameters.model_validate(read.parameters(run), strict=True)
    assert parameters.rig.mass == 0.87 and parameters.rig.spring_natural_length == 0.17


def test_a_slab_gives_the_curvature_as_known(campaign):
    read = read_campaign(campaign(rig={"surface": "slab", "slab_radius": 0.4}))
    parameters = Parameters.model_validate(read.parameters(read.runs[0]), strict=True)
    assert parameters.flat()["turning_surface.curvature"] == 2.5


def test_what_is_known_of_the_rig(campaign):
    """Limits of a next run, scatter of friction, and the zero: half a millimetre if not stated."""
    limits = {"surface_speed": [0.01, 0.3], "mass": [0.5, 2.0]}
    noise = {"x": NOISE, "y": 3e-4}
    read = read_campaign(campaign(limits=limits, errors={"friction": 0.05}, noise=noise))
    assert read.limits == {"surface_speed": (0.01, 0.3), "mass": (0.5, 2.0)}
    assert read.errors.friction == 0.05
    assert [read.zero_sd(read.runs[0], channel) for channel in "xy"] == [5e-4, 5e-4]
    stated = read_campaign(campaign(errors={"zero": 4.0}, noise=noise))
    assert stated.zero_sd(stated.runs[0]) == pytest.approx(4.0 * NOISE)
    assert stated.zero_sd(stated.runs[0], "y") == pytest.approx(12e-4)
    assert stated.errors.friction == 0.02


def test_a_planned_run_needs_no_file(tmp_path):
    path = write_campaign(tmp_path, [{"duration": 30.0, "rate": 50.0}], friction={"mu_k": 0.1})
    table, (run,), _ = read_tables(path, RunTable)
    assert (run.duration, run.rate, table.friction.expected) == (30.0, 50.0, {"mu_k": 0.1})
    assert table.friction.given == {}  # expected, not measured
    with pytest.raises(CampaignError, match="run 1: file.*stickslip plan"):
        read_campaign(path)


def test_runs_of_figures_alone(tmp_path):
    summary = {"mean_x": [0.02, 0.002], "slip_share": [0.925, 0.02]}
    (run,) = read_campaign(write_campaign(tmp_path, [{"summary": summary}])).runs
    assert run.track is None and run.name == "run 1"
    assert run.summary == {"mean_x": (0.02, 0.002), "slip_share": (0.925, 0.02)}


def test_figures_beside_a_track_are_said_to_be_ignored(tmp_path, columns):
    runs = [{"columns": columns}, {"summary": {"mean_x": [0.02, 0.002]}}]
    read = read_campaign(write_campaign(tmp_path, runs))
    assert "run 2: summary: ignored beside runs with a file" in read.remarks


BAD_RUNS = {
    "negative mass": ({"mass": -0.5}, r"run 1: mass: out of range \(-0.5\), .* greater than 0 kg"),
    "misspelt": ({"masss": 0.5}, r"run 1: masss: no such key, nearest known: mass"),
    "text": ({"stiffness": "soft"}, r'run 1: stiffness: not a number \("soft"\)'),
    "no mass": ({"mass": None}, r"run 1: mass: is missing, allowed is a number"),
    "at rest": ({"surface_speed": 0.0}, r"run 1: surface_speed: .*allowed is at least 1e-09 m/s"),
    "hold-out": ({"hold_out": "yes"}, r'run 1: hold_out: .*"yes".* allowed is true or false'),
    "lost file": ({"columns": None, "file": "gone.csv"}, r"gone\.csv: no such file, allowed is a"),
    "both": ({"summary": {"mean_x": [0.02, 0.002]}}, r"run 1: file: and summary: both given"),
    "figure": ({"summary": {"meanx": [0.0, 1.0]}}, r"summary.meanx: no such key, .*mean_x"),
    "no error": ({"summary": {"mean_x": [0.0, 0.0]}}, r"mean_x: \[0, 0\], .*deviation > 0\]"),
    "too fast": ({"surface_speed": 1e9}, r"run 1: surface_speed: .*at most 1000 m/s"),
    "no number": ({"mass": float("nan")}, r"run 1: mass: not a finite number"),
    "hammer": ({"stiffness": 1e9}, r"run01.csv: column t: .*between samples.* at most half"),
    "no share": ({"summary": {"slip_share": [1.5, 0.1]}}, r"1.5 is not a share, allowed is 0 to"),
}
BAD_TABLES = {
    "key": ({"rig": {"spring_lenght": 0.2}}, r"spring_lenght: no such key, .* rig\.spring_length"),
    "mass": (
        {"rig": {"mass": 0.2}},
        r"rig\.mass = 0\.2: may differ from run to run, allowed is mass in each \[\[run\]\]$",
    ),
    "springs": ({"springs": {"stiffness": 9.0}}, r"springs\.stiffness = 9\.0: may differ"),
    "coils": ({"rig": {"spring_natural_length": 0.5}}, r"spring_natural_length: .*coil on coil"),
    "radius": ({"rig": {"contact_radius": 1e3}}, r"rig.contact_radius: 1000 m .*1e-06 to 100 m"),
    "noise": ({"noise": {"x": 0.0}}, r"noise\.x: out of range \(0\.0\), .* at least 1e-12 and"),
    "scheme": ({"model": {"scheme": "thesis"}}, r'model\.scheme: not known .*"exact" or "study"'),
    "table": ({"rigg": {}}, r"rigg: no such key, nearest known: rig"),
    "friction": ({"friction": {"mu_s": [0.3, 0.0]}}, r"friction.mu_s: \[0.3, 0\], allowed is"),
    "limits": ({"limits": {"mass": [2.0, 1.0]}}, r"limits.mass: \[2.0, 1.0\], allowed is \[low"),
    "three": ({"limits": {"mass": [1.0, 2.0, 3.0]}}, r"limits.mass: \[1.0, 2.0, 3.0\], al"),
    "zero": ({"errors": {"zero": 1e300}}, r"errors.zero: .*allowed is"),
    "known": ({"friction": {"mu_s": [0.3, 1e-300]}}, r"friction.mu_s: .*allowed is"),
    "scatter": ({"errors": {"friction": 0.5}}, r"errors.friction: out of range \(0.5\)"),
}


@pytest.mark.parametrize("case", [*BAD_RUNS, *BAD_TABLES])
def test_bad_keys_are_refused_in_one_line(campaign, case):
    change, words = (BAD_RUNS | BAD_TABLES)[case]
    path = campaign(change) if case in BAD_RUNS else campaign(**change)
    with pytest.raises(CampaignError, match=words) as refused:
        read_campaign(path)
    assert "\n" not in str(refused.value) and str(path.parent) in str(refused.value)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("name = 'a'\n", r"campaign\.toml: run: no runs, allowed is a table \[\[run\]\]"),
        ("[[runs]]\nmass = 1.0\n", r"run: no runs \(nearest: runs\)"),
        ("[run]\nmass = 1.0\n", r"run: no runs"),
        ("name = \n", r"campaign\.toml: not TOML: "),
        (None, r"campaign\.toml: no such file, allowed is"),
    ],
)
def test_a_file_without_runs_is_refused(tmp_path, text, words):
    if text is not None:
        (tmp_path / "campaign.toml").write_text(text, encoding="utf-8")
    with pytest.raises(CampaignError, match=words):
        read_campaign(tmp_path / "campaign.toml")


def different(columns, seed):
    return {"t": columns["t"], "x": noisy(columns["x"], seed)}


@pytest.mark.parametrize("count", [1, 2, 3, 4, 5, 6, 7, 8])
def test_runs_are_held_out_by_a_rule_when_none_is_marked(tmp_path, columns, count):
    """Of runs in the order of their speed the second, fifth, ...; in the file as they come."""
    speeds = [0.01 * (1 + 5 * place % count) for place in range(count)]
    runs = [
        {"columns": different(columns, seed), "surface_speed": speed}
        for seed, speed in enumerate(speeds)
    ]
    read = read_campaign(write_campaign(tmp_path, runs))
    names = sorted(read.runs, key=lambda run: (run.surface_speed, run.name))[1::3]
    assert set(read.held_out_runs) == set(names)
    assert [run.name for run in read.runs] == [f"run{n:02d}" for n in range(1, count + 1)]
    said = "held out by rule" if count > 1 else "run01 is the only one with a track"
    assert sum(said in remark for remark in read.remarks) == 1


def test_every_run_held_out_is_refused(tmp_path, columns):
    runs = [{"columns": different(columns, seed), "hold_out": True} for seed in (3, 4)]
    with pytest.raises(CampaignError, match="hold_out: true in every run, there is nothing to fit"):
        read_campaign(write_campaign(tmp_path, runs))


def test_a_copy_is_counted_once_and_judges_nothing(tmp_path, columns):
    """Of a run, or of a part of one; and not at two operating points."""
    part = {"t": columns["t"][:500] + 3.0, "x": columns["x"][200:700]}
    runs = [{"columns": part, "hold_out": True}, {"columns": columns}, {"columns": columns}]
    runs.append({"columns": different(columns, 3), "hold_out": True})
    read = read_campaign(write_campaign(tmp_path, runs))
    assert [run.name for run in read.runs] == ["run02", "run04"]
    assert [run.name for run in read.held_out_runs] == ["run04"]
    assert "run03 holds the same data as run02: left out" in read.remarks
    assert "run01 holds the same data as run02 and is not held out from it: left out" in (
        read.remarks
    )
    runs[2]["mass"] = 1.5
    with pytest.raises(CampaignError, match="run03 holds the same data as run02, but its mass"):
        read_campaign(write_campaign(tmp_path, runs))


@pytest.mark.parametrize(
    ("speed", "start", "remark"),
    [
        (0.4, {"x": 0.03}, "no stick is seen after the start"),
        (0.001, {}, "no slip is seen, it says nothing of kinetic friction"),
        (0.06, {}, None),
    ],
)
def test_a_run_that_only_slips_or_sticks_is_remarked_on(tmp_path, speed, start, remark):
    done = motion(speed=speed, duration=5.0, initial=start)
    columns = {"t": done.time, "x": noisy(done["x"], 1)}
    read = read_campaign(write_campaign(tmp_path, [{"columns": columns, "surface_speed": speed}]))
    assert read.remarks[1:] == ((f"run01: {remark}",) if remark else ())


@pytest.mark.parametrize(("vibrations", "kept"), [(900.0, 900.0), (1300.0, 1000.0)])
def test_of_a_run_of_hours_the_beginning_is_looked_at_and_that_is_said(campaign, vibrations, kept):
    period = 2.0 * np.pi / np.sqrt(4.0 * 38.5 / 0.87)
    time = np.linspace(0.0, vibrations * period, 20_000)
    read = read_campaign(campaign({"columns": {"t": time, "x": 0.02 * np.sin(0.2 * time)}}))
    assert read.runs[0].track.duration == pytest.approx(kept * period, rel=1e-3)
    cut = [one for one in read.remarks if "are looked at" in one]
    assert len(cut) == (kept < vibrations) and all("first 472 s" in one for one in cut)


# --- friction over the sliding speed, read, set out from, refused in a line ---

#: Friction that falls from 0.22 at rest by a quarter.
SPEED, MU = (0.0, 0.05, 0.1, 0.2, 0.4), (0.22, 0.205, 0.193, 0.178, 0.165)
SPEEDS = (0.06, 0.15, 0.10)
CSV = "v,mu\n" + "".join(f"{v:g},{mu:g}\n" for v, mu in zip(SPEED, MU, strict=True))


def with_a_table(folder, csv=CSV, **tables):
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
    path = with_a_table(tmp_path / "week")
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
    path = with_a_table(tmp_path, csv, **tables)
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


@pytest.mark.parametrize(("lost", "said"), [(0.1, []), (0.14, ["0.14"])])
def test_a_remark_says_where_the_tracker_lost_the_block(campaign, columns, lost, said):
    """For more than a quarter of a swing of 0.47 s."""
    kept = (columns["t"] < 5.0) | (columns["t"] >= 5.0 + lost - 0.015)  # of a frame of 10 ms
    file = campaign({"columns": {name: values[kept] for name, values in columns.items()}})
    lines = [
        f"run01: the block is lost for up to {one} s, of which nothing is asked" for one in said
    ]
    assert [each for each in read_campaign(file).remarks if "lost" in each] == lines
