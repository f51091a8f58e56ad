"""What is refused is refused in one line."""

import pytest


def one_line(error, call, *given, **more) -> str:
    """The line."""
    with pytest.raises(error) as refused:
        call(*given, **more)
    assert "\n" not in str(refused.value)
    return str(refused.value)
