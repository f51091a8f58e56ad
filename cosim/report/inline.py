"""A picture inside a page."""

from __future__ import annotations

import base64

from markupsafe import Markup


def inline(png: bytes) -> Markup:
    """A PNG as a data address, for the `src` of an image."""
    return Markup("data:image/png;base64," + base64.b64encode(png).decode("ascii"))
