"""Runs of which only figures are known: the same question, from a handful of numbers."""

from cosim.studies.reproduction.summary.find import find_summary_gap
from cosim.studies.reproduction.summary.residuals import summary_residuals
from cosim.studies.reproduction.summary.result import SummaryGap
from cosim.studies.reproduction.summary.table_of_figures import draw_figures, rows

__all__ = ["SummaryGap", "draw_figures", "find_summary_gap", "rows", "summary_residuals"]
