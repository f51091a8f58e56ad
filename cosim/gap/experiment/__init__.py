"""The run that would tell apart what a campaign cannot: proposed within the rig's range."""

from cosim.gap.experiment.member import Member
from cosim.gap.experiment.propose import next_experiment
from cosim.gap.experiment.range import Experiment, experiments

__all__ = ["Experiment", "Member", "experiments", "next_experiment"]
