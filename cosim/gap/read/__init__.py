"""Measured runs: a folder of tracker files and what the experimenter knows, checked."""

from cosim.gap.read.campaign import read_campaign
from cosim.gap.read.hold_out import choose_hold_outs
from cosim.gap.read.measured import CHANNELS, Campaign, MeasuredRun, Stick, Track

__all__ = [
    "CHANNELS",
    "Campaign",
    "MeasuredRun",
    "Stick",
    "Track",
    "choose_hold_outs",
    "read_campaign",
]
