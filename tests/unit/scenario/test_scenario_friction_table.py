"""A table of friction in a scenario: its numbers, or the CSV file that has them."""

import pytest
from command_line import written
from refusals import one_line

from cosim.scenario import Scenario, ScenarioError, read_scenario

CSV = "v, mu\n0, 0.25\n0.1, 0.2\n0.3, 0.22\n"


def scenario(folder, text, csv=CSV, name="mu_v.csv"):
    written(folder, csv, name)
    return written(folder, text)


def test_a_file_is_named_from_where_the_scenario_is(tmp_path, monkeypatch):
    path = scenario(tmp_path, '[friction]\ntable = "mu_v.csv"\n')
    monkeypatch.chdir("/")
    friction = read_scenario(path).friction
    assert friction.table_speed == (0.0, 0.1, 0.3) and friction.table_mu == (0.25, 0.2, 0.22)


def test_it_is_written_back_as_numbers(tmp_path):
    first = read_scenario(scenario(tmp_path, '[friction]\ntable = "mu_v.csv"\n'))
    copy = written(tmp_path, first.to_toml(), "copy.toml")
    (tmp_path / "mu_v.csv").unlink()
    assert read_scenario(copy).friction == first.friction


def test_a_key_can_be_changed_to_it(tmp_path):
    scenario(tmp_path, "")
    changed = Scenario().changed({"friction.table": str(tmp_path / "mu_v.csv")})
    assert changed.friction.has_table and changed.flat()["friction.table_mu[16]"] == 0.22


def test_spreadsheets_write_a_mark_and_more_columns(tmp_path):
    csv = "\ufeffmu,v,note\r\n0.25,0,a\r\n0.2,0.1,b\r\n"
    friction = read_scenario(scenario(tmp_path, '[friction]\ntable = "mu_v.csv"\n', csv)).friction
    assert friction.table_speed == (0.0, 0.1) and friction.table_mu == (0.25, 0.2)


FILE = '[friction]\ntable = "mu_v.csv"\n'
NUMBERS = "[friction]\ntable_speed = [0.0, 0.1]\ntable_mu = [0.2, 0.1]\n"


@pytest.mark.parametrize(("text", "csv", "says"), [
    ('[friction]\ntable = "mu.csv"\n', CSV, ["friction.table: ", "No such file"]),
    (FILE, "v,mu\n0,0.2\n0.1,x\n", ["friction.table: ", 'line 3, mu = "x"', "finite number"]),
    (FILE, "v,mu\n0,0.2\n", ["friction.table: ", "1 points", "2 to 16"]),
    (FILE + "table_speed = [0.0, 1.0]\n", CSV, ["friction.table: ", "give one of them"]),
    ("[friction]\ntabel_mu = [1.0]\n", CSV, ["no such key, nearest known: friction.table_mu"]),
    ("[friction]\ntable_mu = [0.2, 0.1]\n", CSV, ["friction.table_speed: has 0", "has 2"]),
    (NUMBERS + "[velocity_weakening]\npower = 0.1\n", CSV,
     ["friction.table_speed: beside velocity_weakening.power = 0.1", "give one of the two"]),
])  # fmt: skip
def test_a_fault_is_one_line(tmp_path, text, csv, says):
    line = one_line(ScenarioError, read_scenario, scenario(tmp_path, text, csv))
    for words in says:
        assert words in line
