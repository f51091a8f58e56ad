"""A formula for the force that the catalogue has no name for: proposed, marked, and judged."""

from cosim.gap.empirical.features import Feature, library
from cosim.gap.empirical.propose import empirical_term
from cosim.gap.empirical.term import Term

__all__ = ["Feature", "Term", "empirical_term", "library"]
