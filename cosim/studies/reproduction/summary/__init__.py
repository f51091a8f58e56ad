"""Runs of which only figures are known: the same question, from a handful of numbers."""

from cosim.studies.reproduction.summary.find import find_summary_gap
from cosim.studies.reproduction.summary.result import SummaryGap

__all__ = ["SummaryGap", "find_summary_gap"]
