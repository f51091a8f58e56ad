"""Where a model and its measurements disagree, what is missing, and what is left afterwards.

The folders are the way: read the campaign, shoot the model at it, name what is missing, show it.
"""

from cosim.gap.data import Campaign, MeasuredRun, Stick, Track, read_campaign
from cosim.gap.data.errors import CampaignError

__all__ = ["Campaign", "CampaignError", "MeasuredRun", "Stick", "Track", "read_campaign"]
