"""A compiler that is at work ends with the process that started it, and with all it has started."""

import os
import signal
import subprocess
import sys

import pytest
from process_ids import is_soon, lives

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="by signals")

#: A compiler whose work is done by another program, as is that of cc.
SLOW = """#!/bin/sh
sleep 60 &
echo $$ $! > {started}
wait
"""
AT_WORK = """
from stickslip.generation.compiler import compiled
from stickslip.generation.platforms import this_machine
compiled({"a.c": b"int a;"}, [this_machine()], "a", stays=True)
"""


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGINT, signal.SIGTERM])
def test_a_compiler_ends_with_whoever_asked_for_it(tmp_path, number):
    started, compiler = tmp_path / "started", tmp_path / "cc"
    compiler.write_text(SLOW.format(started=started))
    compiler.chmod(0o755)
    environment = os.environ | {"PATH": f"{tmp_path}:{os.environ['PATH']}"}
    process = subprocess.Popen(
        [sys.executable, "-c", AT_WORK], env=environment, stderr=subprocess.DEVNULL
    )
    is_soon(lambda: started.exists() and started.read_text().endswith("\n"), 20.0)
    programs = [int(each) for each in started.read_text().split()]
    assert all(map(lives, programs))
    process.send_signal(number)
    assert process.wait(10.0) != 0
    is_soon(lambda: not any(map(lives, programs)), 5.0)
