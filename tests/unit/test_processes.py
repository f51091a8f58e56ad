"""Processes end in good order, however many calls wait and however long those under way take."""

import subprocess
import sys
import time

# two calls under way that do not look whether they are to end, six that wait
INTERRUPTED = """
import time
import cosim.processes as processes
from cosim.processes import pool

processes.STOP_SECONDS = 1.0
if __name__ == "__main__":
    try:
        with pool(2) as submit:
            for _ in range(8):
                submit(time.sleep, 60.0)
            time.sleep(2.0)
            raise KeyboardInterrupt
    except KeyboardInterrupt:
        print("interrupted", flush=True)
"""


def test_an_interrupt_ends_calls_that_do_not_look_up(tmp_path):
    script = tmp_path / "interrupted.py"
    script.write_text(INTERRUPTED, encoding="utf-8")
    began = time.perf_counter()
    done = subprocess.run(
        [sys.executable, str(script)], capture_output=True, text=True, timeout=50, check=True
    )
    assert done.stdout.strip() == "interrupted"
    assert "Traceback" not in done.stderr
    assert time.perf_counter() - began < 40.0
