"""Who types."""

import tempfile
from pathlib import Path

import pytest
from reader import Reader
from terminal import server


@pytest.fixture
def reader(tmp_path, executed):
    """Somebody before an empty folder."""
    # the path of a socket has 107 characters at most
    with tempfile.TemporaryDirectory() as short:
        tmux = server(Path(short) / "tmux")
        folder = tmp_path / "empty"
        folder.mkdir()
        yield Reader(tmux, folder, executed)
        if tmux.is_alive():
            tmux.kill()
