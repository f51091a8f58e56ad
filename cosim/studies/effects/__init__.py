"""The catalogue of effects as a table, as JSON and as a page with a figure for each."""

from .catalogue import UnknownEffect, allowed, chosen, described
from .page import effect_figure, page

__all__ = ["UnknownEffect", "allowed", "chosen", "described", "effect_figure", "page"]
