"""Friction over the sliding speed, measured by itself, in a campaign of another laboratory.

Its simulator has a LuGre contact whose kinetic friction falls with the logarithm of the speed. Who
states that curve finds nothing missing; who does not, finds the fall.
"""

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2]))
from blind.laboratory.__main__ import write_campaign  # noqa: E402
from blind.laboratory.campaign import Order, make_campaign  # noqa: E402
from blind.laboratory.friction_law import coefficient  # noqa: E402

from cosim.gap import read_campaign  # noqa: E402
from cosim.gap.find import find_gap  # noqa: E402

ORDER, SEED = Order("lugre", ("velocity_weakening",), sizes=(8.0, 20.0)), 9101
POINTS = 16


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A campaign that hides a law of the speed, and beside it the law as a table."""
    place = tmp_path_factory.mktemp("laboratory")
    made = make_campaign(ORDER, [SEED])
    write_campaign(made, place)
    record = made.records[0]
    # a block slides back as fast as the surface comes, and a little more
    fastest = 2.2 * max(float(each["belt_speed"]) for each in made.records)
    speeds = fastest * np.linspace(0.0, 1.0, POINTS) ** 2
    kinetic = float(record["mu_k"])
    rows = [f"{v:.6g},{coefficient(record, kinetic, 0.0, v):.6g}" for v in speeds]
    (place / "mu_v.csv").write_text("\n".join(["v,mu", *rows]) + "\n", encoding="utf-8")
    return place


@pytest.mark.slow
@pytest.mark.parametrize(
    ("states", "verdict", "effects"),
    [(True, "none", ()), (False, "named", ("velocity_weakening",))],
)
def test_what_is_stated_is_not_missing(states, verdict, effects, folder):
    file = folder / "campaign.toml"
    text = file.read_text(encoding="utf-8").replace('[friction]\ntable = "mu_v.csv"\n', "")
    table = '[friction]\ntable = "mu_v.csv"\n[[run]]' if states else "[[run]]"
    file.write_text(text.replace("[[run]]", table, 1), encoding="utf-8")
    gap = find_gap(read_campaign(folder))
    assert (gap.verdict, gap.effects) == (verdict, effects)
    assert gap.after.fit < 1.1 and gap.after.held_out < 1.1  # 1 is noise
