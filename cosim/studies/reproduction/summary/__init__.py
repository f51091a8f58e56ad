"""Runs of which only figures are known: the same question, from a handful of numbers."""

from .find import find_summary_gap
from .result import SummaryGap

__all__ = ["SummaryGap", "find_summary_gap"]
