"""Who types."""

import pytest
from reader import Reader


@pytest.fixture
def reader(tmp_path, executed):
    """Somebody before an empty folder."""
    folder = tmp_path / "empty"
    folder.mkdir()
    return Reader(folder, executed)
