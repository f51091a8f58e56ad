"""What a run of a system leaves: dataset, summary, figures, page and files."""

from .files import write_system

__all__ = ["write_system"]
