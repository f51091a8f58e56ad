"""Before the cold room: what a campaign that is only planned could name."""

from cosim.gap.plan.plan import Plan, make_plan
from cosim.gap.plan.planned import PlannedCampaign, read_plan

__all__ = ["Plan", "PlannedCampaign", "make_plan", "read_plan"]
