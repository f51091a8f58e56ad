"""Times in words."""


def in_words(seconds: float) -> str:
    """A time as somebody would say it: "90 s", "20 min", "5 h", "3 days", "20 years"."""
    for size, unit in ((3.156e7, "years"), (86400.0, "days"), (3600.0, "h"), (60.0, "min")):
        if seconds >= 2.0 * size:
            return f"{seconds / size:.2g} {unit}"
    return f"{seconds:.2g} s"
