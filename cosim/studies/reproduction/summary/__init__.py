"""Runs of which only figures are known: the same question, from a handful of numbers."""

from .find import SummaryGap, find_summary_gap

__all__ = ["SummaryGap", "find_summary_gap"]
