"""Runs a program that ends when standard input does: with whoever holds the other end of that pipe.

A program by itself, which is run by its path: ``python ends_with_parent.py COMMAND ...``, as the
leader of a group of processes. However the other end closes, the system does it.
"""

import os
import signal
import subprocess
import sys
import threading


def main(command: list[str]) -> int:
    """Run a command; its exit status."""
    program = subprocess.Popen(command, stdin=subprocess.DEVNULL)
    threading.Thread(target=_end, args=(program,), daemon=True).start()
    return program.wait()


def _end(program: subprocess.Popen[bytes]) -> None:
    os.read(0, 1)  # nothing is ever said
    if sys.platform != "win32":
        os.killpg(0, signal.SIGKILL)  # with all that it has started, and this process
    program.kill()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
