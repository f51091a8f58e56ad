"""Naming what the plain model lacks: refit, compare, allow for chance, or say unknown."""

from .find import find_gap

__all__ = ["find_gap"]
