"""Measured runs: a folder of tracker files and what the experimenter knows, checked."""

from cosim.gap.data.campaign import read_campaign
from cosim.gap.data.measured import CHANNELS, Campaign, MeasuredRun, Track

__all__ = ["CHANNELS", "Campaign", "MeasuredRun", "Track", "read_campaign"]
