"""Measured runs, and what the plain model lacks of them.

The campaign is the one that `stickslip gap --write-example` writes: four runs with a tracker's
noise, friction falling with speed hidden in them.
"""

from pathlib import Path

from cosim.gap import read_campaign
from cosim.gap.example import write_example
from cosim.gap.find import find_gap

campaign = read_campaign(write_example(Path("cold_room")))
gap = find_gap(campaign, jobs=2)

print(gap.verdict, *gap.effects)
