"""Where a model and its measurements disagree, what is missing, and what is left afterwards.

The rooms in the order in which data flow: data (the campaign, read), checks (whether it is as
stated, and enough), weak_form (what the equation of motion misses in the tracks), windows (models
fitted and judged over a few cycles), judge (the verdict), show; plan (campaigns that are not made
yet). `find` goes through all of them.
"""

from cosim.gap.data import Campaign, MeasuredRun, Track, read_campaign
from cosim.gap.data.errors import CampaignError

__all__ = ["Campaign", "CampaignError", "MeasuredRun", "Track", "read_campaign"]
