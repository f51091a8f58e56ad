"""Springs that stiffen so much under their tension that the stated ones show no break-away."""

import pytest
from gap_campaigns import campaign_with, motion, seen

from cosim.gap.find import find_gap

SPRINGS, CUBIC, MU_S = 20.0, 1.5e4, 0.27
#: kg, m/s, held out
RUNS = ((0.67, 0.05, False), (0.67, 0.15, False), (1.33, 0.15, True), (1.33, 0.3, False))


def test_a_law_is_found_whole_that_more_than_doubles_the_stiffness(tmp_path):
    """In stick the rows have nothing to start from, and the curve's own points are too few."""
    runs = []
    for number, (mass, speed, hold_out) in enumerate(RUNS):
        moved = motion(speed, mass, MU_S, stiffness=SPRINGS, free=("x",), duration=15.0,
                       spring_hardening={"cubic": CUBIC})  # fmt: skip
        runs.append(seen(moved, number, mass=mass, stiffness=SPRINGS, surface_speed=speed))
        runs[-1]["hold_out"] = hold_out
    gap = find_gap(campaign_with(tmp_path, runs))
    assert (gap.verdict, gap.effects) == ("named", ("spring_hardening",))
    assert gap.before.fit > 10.0
    assert gap.after.fit < 1.05 and gap.after.held_out < 1.1  # 1 is noise
    assert gap.extended.values["spring_hardening.cubic"] == pytest.approx(CUBIC, rel=0.02)
    assert gap.extended.values["friction.mu_s"] == pytest.approx(MU_S, rel=0.02)
