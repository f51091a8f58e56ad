"""Machine code is kept where nobody else can write, and is done without where nothing is kept."""

import logging
import os
import subprocess
import sys

import pytest
from stickslip import compiled

#: Compiles a kernel of one line; prints what it gives, how often machine code of it was there.
PROGRAM = """
from stickslip import compiled
compiled.kernel_source = lambda: "def advance(x):\\n    return x + 1.0\\n"
advance = compiled.compiled_kernel().advance
print(advance(1.0), sum(advance.stats.cache_hits.values()), compiled.is_cached())
"""
#: Number of somebody else.
NOBODY = 65534

posix = pytest.mark.skipif(not hasattr(os, "getuid"), reason="a folder has no owner")


def run(cache, scratch):
    """What PROGRAM prints in a process with these folders, which permissions bind, root's too."""
    bound = ["setpriv", "--bounding-set=-dac_override"] if os.getuid() == 0 else []
    done = subprocess.run(
        [*bound, sys.executable, "-c", PROGRAM],
        env=os.environ | {"XDG_CACHE_HOME": str(cache), "TMPDIR": str(scratch)},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.split()


@pytest.mark.skipif(sys.platform != "linux", reason="needs setpriv where root runs it")
def test_a_cache_that_was_filled_and_can_only_be_read_is_used(tmp_path):
    """As in a container, or in continuous integration."""
    cache, scratch = tmp_path / "cache", tmp_path / "scratch"
    cache.mkdir()
    scratch.mkdir()
    assert run(cache, scratch) == ["2.0", "0", "True"]
    filled = (cache / "stickslip" / "__pycache__", cache / "stickslip", cache, scratch)
    for folder in filled:
        folder.chmod(0o555)
    try:
        assert run(cache, scratch) == ["2.0", "1", "True"]
    finally:
        for folder in filled:
            folder.chmod(0o755)


def test_without_any_folder_the_kernel_is_compiled_in_memory(tmp_path, monkeypatch):
    def none():
        raise FileNotFoundError("No usable temporary directory found")

    (tmp_path / "file").touch()
    monkeypatch.setattr(compiled.platformdirs, "user_cache_path", lambda _: tmp_path / "file" / "x")
    monkeypatch.setattr(compiled.tempfile, "gettempdir", none)
    monkeypatch.setattr(compiled, "kernel_source", lambda: "def advance(x):\n    return x + 2.0\n")
    assert compiled.compiled_kernel.__wrapped__().advance(1.0) == 3.0
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


@pytest.fixture
def kept_in(tmp_path, monkeypatch):
    """The folder that a kernel is kept in, None for none, and what it may be."""
    monkeypatch.setattr(compiled.platformdirs, "user_cache_path", lambda name: tmp_path / name)
    monkeypatch.setattr(compiled.tempfile, "gettempdir", lambda: str(tmp_path))

    def keep():
        file = compiled._module_file("kernel", "pass\n")
        return None if file is None else file.parent

    return keep, tmp_path / "stickslip", tmp_path / f"stickslip-{os.getuid()}"


@posix
def test_machine_code_is_not_kept_where_others_can_write(kept_in, caplog):
    keep, mine, scratch = kept_in
    assert keep() == mine and not scratch.exists()
    mine.chmod(0o777)
    with caplog.at_level(logging.WARNING):
        assert keep() == scratch
    assert f"chmod go-w {mine}" in caplog.text
    assert scratch.stat().st_mode & 0o777 == 0o700


@posix
@pytest.mark.skipif(not hasattr(os, "getuid") or os.getuid() != 0, reason="needs two users")
def test_a_folder_or_link_of_another_user_in_its_place_is_not_used(kept_in):
    keep, mine, scratch = kept_in
    mine.mkdir()
    os.chown(mine, NOBODY, NOBODY)
    elsewhere = mine.with_name("elsewhere")
    elsewhere.mkdir(mode=0o700)
    scratch.symlink_to(elsewhere)
    os.chown(scratch, NOBODY, NOBODY, follow_symlinks=False)
    (mine / "kernel.py").write_text("pass\n")
    assert keep() is None
