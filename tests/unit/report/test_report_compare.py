"""`stickslip compare`: numbers side by side, keys that differ, curves, folders without a result."""

import json
import re
from types import SimpleNamespace

import pytest
from command_line import executed
from refusals import one_line

from cosim.cli.runs import compare as compare_command
from cosim.cli.runs import simulate as simulate_command
from cosim.report.compare import Difference, compare, read_result
from cosim.report.compare.compare import Apart
from cosim.report.compare.figures import moving
from cosim.report.compare.page import cells, curve_cells, headline, tiles

CASE = """
name = "{name}"
rig = {{ mass = {mass}, degrees_of_freedom = ["x"] }}
surface.run_up_time = 0.5
run.duration = {duration}
"""


def scenario(folder, name, mass, duration=3.0):
    file = folder / f"{name}.toml"
    file.write_text(CASE.format(name=name, mass=mass, duration=duration))
    return file


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """Results of a light block, and scenarios of a light and a heavy one."""
    folder = tmp_path_factory.mktemp("compare")
    light = scenario(folder, "light", 0.67)
    scenario(folder, "heavy", 1.34)
    assert executed(simulate_command, light, "-o", folder / "results") == 0
    return folder


def test_a_folder_and_a_scenario_side_by_side(place, capsys):
    out = place / "out"
    assert executed(compare_command, place / "results", place / "heavy.toml", "-o", out) == 0
    printed = capsys.readouterr()
    assert "rig.mass" in printed.out and "0.67" in printed.out and "1.34" in printed.out
    found = json.loads((out / "compare.json").read_text())
    differ = {"name": {"a": "light", "b": "heavy"}, "rig.mass": {"a": 0.67, "b": 1.34}}
    assert found["scenario"] == differ
    mean = found["numbers"]["after_run_up.mean_x"]
    assert mean["unit"] == "m" and mean["difference"] == mean["b"] - mean["a"]
    # twice the weight on the same springs: in sliding that is twice the deflection
    assert mean["relative"] == pytest.approx(1.0, abs=0.15)
    theirs = json.loads((place / "results" / "summary.json").read_text())
    assert mean["a"] == theirs["after_run_up"]["mean_x"]
    text = (out / "report.html").read_text()
    assert text.index("What differs in the scenarios") < text.index("Numbers that differ")
    assert text.count("<figure") == 2
    assert text.count("<img") == text.count('src="data:image/png') == 1, "scripts draw the other"
    files = "compare.json made_by.json overlay.png phases.png report.html"
    assert " ".join(sorted(file.name for file in out.iterdir())) == files


def test_a_run_beside_itself_is_the_same(place, capsys):
    """A scenario that is run again gives what its folder holds, to the last digit."""
    out = place / "itself"
    words = (place / "results", place / "light.toml", "-o", out, "--json")
    assert executed(compare_command, *words) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["scenario"] == {} and found["remarks"] == []
    both = [one for one in found["numbers"].values() if None not in (one["a"], one["b"])]
    assert len(both) > 20 and all(one["difference"] == 0.0 for one in both)
    assert "they are the same, key by key" in (out / "report.html").read_text()


def test_what_is_flat_in_both_is_not_drawn(place):
    one = read_result(place / "results")
    both = compare(one, one)
    assert [drawn.channel.name for drawn in moving(both)] == ["x", "friction_force_x", "heat"]
    assert (both.a.label, both.b.label) == ("light (A)", "light (B)")
    assert not both.different


def test_runs_of_other_lengths_and_cut_off_ones_are_told_of(place, capsys):
    short = scenario(place, "short", 0.67, duration=2.0)
    folder = place / "cut"
    assert executed(simulate_command, short, "-o", folder) == 0
    numbers = json.loads((folder / "summary.json").read_text())
    numbers |= {"status": "interrupted", "reason": "interrupted by the user"}
    (folder / "summary.json").write_text(json.dumps(numbers))
    capsys.readouterr()
    assert executed(compare_command, place / "results", folder, "-o", place / "two") == 0
    said = capsys.readouterr().err
    assert "the run is not complete (interrupted by the user)" in said
    assert "one run is 3 s long, the other 2 s" in said
    assert "not complete" in (place / "two" / "report.html").read_text()


def test_results_whose_writing_was_cut_off_say_so(place):
    made = place / "results" / "made_by.json"
    kept = made.read_text()
    made.write_text(json.dumps(json.loads(kept) | {"status": "incomplete"}))
    try:
        assert "writing them was cut off" in read_result(place / "results").remarks[0]
    finally:
        made.write_text(kept)


@pytest.mark.parametrize(("made", "says"), [
    ({}, "holds no result.nc, allowed is a folder of results"),
    ({"result.nc": "no data", "summary.json": "{}"}, "cannot be read"),
    ({"result.nc": "no data"}, "holds no summary.json"),
])  # fmt: skip
def test_a_folder_that_is_no_result_is_refused_in_one_line(place, tmp_path, made, says):
    folder = tmp_path / "no"
    folder.mkdir()
    for name, text in made.items():
        (folder / name).write_text(text)
    words = (place / "results", folder, "-o", tmp_path / "out")
    line = one_line(ValueError, executed, compare_command, *words)
    assert says in line and str(folder) in line and not (tmp_path / "out").exists()


@pytest.mark.parametrize(("a", "b", "difference", "relative", "same"), [
    (2.0, 3.0, 1.0, 0.5, False),
    (-2.0, -3.0, -1.0, -0.5, False),
    (0.0, 1.0, 1.0, None, False),
    (None, 1.0, None, None, False),
    (None, None, None, None, True),
    (1.0, 1.0 + 1e-12, pytest.approx(1e-12, rel=1e-3), pytest.approx(1e-12, rel=1e-3), True),
])  # fmt: skip
def test_a_difference(a, b, difference, relative, same):
    one = Difference("after_run_up.mean_x", "m", a, b)
    assert (one.difference, one.relative, one.same) == (difference, relative, same)


@pytest.mark.parametrize(("name", "unit", "a", "b", "told"), [
    ("whole_run.max_rotation_deg", "deg", 9.2e-15, 0.2, "–"),
    ("whole_run.max_rotation_deg", "deg", 1e-6, 2e-4, "equal within rounding"),
    ("whole_run.max_rotation_deg", "deg", 1e-3, 0.2, "–"),
    ("regimes.own.max_rotation_deg", "deg", 14.62, 14.620001, "equal within rounding"),
    ("outputs.a.y", "1", 1e-17, 0.3, "–"),
    ("whole_run.max_x", "m", 0.001, 0.021, "21 times"),
])  # fmt: skip
def test_no_ratio_is_told_of_what_reads_0(name, unit, a, b, told):
    assert cells(Difference(name, unit, a, b))[3] == told


def test_two_rounding_errors_of_an_angle_are_the_same():
    assert Difference("whole_run.max_rotation_deg", "deg", 9.2e-15, 2e-11).same


def test_what_no_rig_tells_from_nothing_is_not_at_the_top_and_no_part_of_anything():
    """The study's path is unstable: y grows from rounding, 220 times what it spans in A."""
    y = Apart("y", "m", 1.1e-8, 30.0, 1e-9, 5e-11, 5e-11)
    x = Apart("x", "m", 0.042, 11.0, 0.02, 0.03, 0.03)
    both = SimpleNamespace(curves=[y, x], different=[], numbers=[], keys={}, a=RUN, b=RUN)
    assert curve_cells(y)[-1] == "–" and curve_cells(x)[-1] == "140 %"
    assert tiles(both)[2:] == [("x, apart at most", "42 mm")]
    assert "; x by up to 42 mm" in headline(both)
    both.curves = [y]
    assert headline(both) == "one and one differ in 0 of 0 numbers."


RUN = SimpleNamespace(label="one", scenario="")


def test_the_page_begins_with_whether_they_differ(place):
    one = read_result(place / "results")
    said = "light (A) and light (B) are equal within rounding, in all that both have."
    assert headline(compare(one, one)) == said
    out = place / "first"
    assert executed(compare_command, place / "results", place / "heavy.toml", "-o", out) == 0
    text = (out / "report.html").read_text()
    places = [text.index(each) for each in ("<h1>", 'class="tiles"', "<figure", "<h2")]
    assert places == sorted(places)
    said = r"<h1>light and heavy differ in \d+ of \d+ numbers; x by up to [^;]+\.</h1>"
    assert re.search(said, text)
    tiles = text[places[1] : places[2]]
    assert tiles.count("<b>") == 4
