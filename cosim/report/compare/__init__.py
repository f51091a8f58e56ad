"""Two results beside each other: numbers, curves, and what differs in what made them."""

from .compare import Comparison, Difference, compare
from .one_result import NotAResult, OneResult, read_result

__all__ = ["Comparison", "Difference", "NotAResult", "OneResult", "compare", "read_result"]
