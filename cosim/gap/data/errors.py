"""What the gap workflow refuses."""

from __future__ import annotations


class CampaignError(ValueError):
    """A campaign that cannot be used; one line: file, key, what is wrong, what is allowed."""
