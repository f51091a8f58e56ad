"""Measured runs: a folder of tracker files and what the experimenter knows, checked."""

from cosim.gap.data.campaign import read_campaign
from cosim.gap.data.cycles import CycleFeatures, Figure, cycle_features
from cosim.gap.data.hold_out import choose_hold_outs
from cosim.gap.data.measured import CHANNELS, Campaign, MeasuredRun, Stick, Track
from cosim.gap.data.sticks import find_sticks

__all__ = [
    "CHANNELS",
    "Campaign",
    "CycleFeatures",
    "Figure",
    "MeasuredRun",
    "Stick",
    "Track",
    "choose_hold_outs",
    "cycle_features",
    "find_sticks",
    "read_campaign",
]
