"""Where a model and its measurements disagree, what is missing, and what is left afterwards.

The rooms in the order in which data flow: data (the campaign, read and checked), doubts (whether it
is as stated, and enough), estimation (the model fitted to it by multiple shooting), candidates
(what may be missing), selection (which of it is), diagnostics (where the misfit lives), design (the
run that would tell more), show. `find` goes through all of them.
"""

from cosim.gap.data import Campaign, MeasuredRun, Track, read_campaign
from cosim.gap.data.errors import CampaignError

__all__ = ["Campaign", "CampaignError", "MeasuredRun", "Track", "read_campaign"]
