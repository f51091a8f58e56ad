"""Every block of code that README and site print is run by a test.

What is run by nobody is found out to be wrong by readers. Blocks are found by the site's own
parser. Those that the build makes from the code that they show (usages of commands, formulas,
examples with what they print) are looked at in `test_site.py`.
"""

import os
import tomllib
from configparser import ConfigParser

import numpy as np
import pytest
from command_line import python
from gap_campaigns import noisy, write_campaign
from notebooks import PAGES, is_notebook, source
from sessions import typed
from test_readme import BLOCKS, SESSIONS, SHELL, SITE, TEXTS, toml_with

from cosim import read_scenario
from cosim.gap import read_campaign

#: Directives that print no code of their own.
NO_CODE = ("{toctree}", "{include}", "{figure}", "{image}", "{note}", "{warning}")
#: Tables of which a test here or in `test_readme.py` reads the one block that has them.
TABLES = ("[springs]", "[[run]]", "friction_table", "[block]", "[units]", "[project.entry-points.")


def is_run(page, language, text):
    """Whether some test runs, reads or types a block; sessions of tutorials by `-m slow`."""
    if language.startswith(NO_CODE):
        return True
    if language == "{code-cell} python":
        return is_notebook(SITE / page)
    if language in ("", "text") and text.startswith("$ "):
        asked = {command.removeprefix("stickslip ") for command, _ in typed(text)}
        return page.startswith("tutorials/") or asked <= SESSIONS.keys()
    if language == "sh":
        return text.strip() in SHELL
    return language == "python" or sum(table in text for table in TABLES) == 1


@pytest.mark.parametrize("page", TEXTS)
def test_every_block_is_run(page):
    assert [block for block in BLOCKS if block[0] == page and not is_run(*block)] == []


def test_the_campaign_with_a_table_is_one(tmp_path):
    """As the lines that state a law over the speed stand in a campaign."""
    block = toml_with("friction_table")
    (tmp_path / "mu_v.csv").write_text("v,mu\n0,0.22\n0.4,0.17\n", encoding="utf-8")
    time = np.arange(40) * 0.01
    runs = [
        {"surface_speed": speed, "columns": {"t": time, "x": noisy(0.0 * time, number)}}
        for number, speed in enumerate((0.1, 0.2))
    ]
    campaign = read_campaign(write_campaign(tmp_path, runs, **tomllib.loads(block)))
    assert (campaign.friction_table.speeds, campaign.friction_table.mu) == (
        (0.0, 0.4),
        (0.22, 0.17),
    )


def test_the_block_of_steel_is_one(tmp_path):
    block = toml_with("[block]")
    (tmp_path / "steel.toml").write_text(block + "[run]\nduration = 0.5\n", encoding="utf-8")
    scenario = read_scenario(tmp_path / "steel.toml")
    assert (scenario.block.material, scenario.ambient.temperature_degC) == ("steel", 20.0)
    assert scenario.thermal.ice.melting_point_degC == np.inf


INSTALLED = """
from cosim import read_scenario
scenario = read_scenario("reference")
print(scenario.catalogue.effects[-1].id, scenario.flash_heating.fall)
"""


def test_the_entry_point_is_one(tmp_path):
    """The page's law in a package that says what the page says of it, as pip would install it."""
    page = PAGES / "add_an_effect.md"
    points = tomllib.loads(toml_with("[project.entry-points."))["project"]["entry-points"]
    ((name, value),) = points["stickslip.effects"].items()
    package, _, module = value.partition(":")[0].partition(".")
    (tmp_path / package).mkdir()
    head = f"%%writefile {module}.py\n"
    (law,) = [cell.source for cell in source(page).cells if cell.source.startswith(head)]
    (tmp_path / package / f"{module}.py").write_text(law.removeprefix(head), encoding="utf-8")
    info = tmp_path / f"{package}-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {package}\nVersion: 1.0\n")
    written = ConfigParser()
    written.read_dict(points)
    with (info / "entry_points.txt").open("w") as file:
        written.write(file)
    path = os.pathsep.join([str(tmp_path), os.environ.get("PYTHONPATH", "")])
    assert python(INSTALLED, env=os.environ | {"PYTHONPATH": path}).split() == [name, "0.0"]
