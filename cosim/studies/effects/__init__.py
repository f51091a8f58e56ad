"""The catalogue of effects as a table, as JSON and as a page with a figure for each."""

from .catalogue import UnknownEffect, allowed, chosen, described

__all__ = ["UnknownEffect", "allowed", "chosen", "described"]
