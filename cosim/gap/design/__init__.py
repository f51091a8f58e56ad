"""The run that would tell apart what a campaign cannot: proposed within the rig's range."""

from cosim.gap.design.member import Member
from cosim.gap.design.propose import next_experiment
from cosim.gap.design.range import Experiment, experiments

__all__ = ["Experiment", "Member", "experiments", "next_experiment"]
