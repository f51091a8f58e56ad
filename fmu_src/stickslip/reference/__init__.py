"""Oscillators in closed form and the source study's scheme, to compare the kernel with."""

from importlib import resources

from ..machine_code import Code


def scheme_code() -> Code:
    """The compiled loop of the source study's scheme."""
    text = (resources.files(__name__) / "scheme.c").read_text("utf-8")
    return Code("scheme", text, lambda: {"scheme.c": text.encode()})
