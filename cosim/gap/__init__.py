"""Where a model and its measurements disagree, what is missing, and what is left afterwards.

The folders are the way: read the campaign, shoot the model at it, name what is missing, show it.
"""

from cosim.gap.errors import CampaignError
from cosim.gap.read import Campaign, MeasuredRun, Stick, Track, read_campaign

__all__ = ["Campaign", "CampaignError", "MeasuredRun", "Stick", "Track", "read_campaign"]
