"""What a reader types into: commands in a shell, cells in IPython."""

import json
import re
import subprocess
import sys
from pathlib import Path

#: IPython as it is where it was never used before: a cell a line, its end said after what it said.
CELLS = """
import json, sys
from IPython.core.interactiveshell import InteractiveShell
shell = InteractiveShell.instance(colors="nocolor")
for line in iter(sys.stdin.readline, ""):
    shell.run_cell(json.loads(line), store_history=True)
    print("\\n" + line, end="", flush=True)
"""


def type_command(command: str, folder: Path, environment: dict[str, str]) -> tuple[int, list[str]]:
    """Exit status of a command in bash, and what it said."""
    done = subprocess.run(
        ["bash", "--norc", "--noprofile", "-c", command],
        cwd=folder,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
        timeout=900,
    )
    return done.returncode, done.stdout.splitlines()


class IPython:
    """An IPython in a folder."""

    def __init__(self, folder: Path, environment: dict[str, str]):
        pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
        self.process = subprocess.Popen(
            [sys.executable, "-c", CELLS], cwd=folder, env=environment, text=True, **pipes
        )

    def run(self, cell: str) -> list[str]:
        """What a cell said."""
        line = json.dumps(cell) + "\n"
        self.process.stdin.write(line)
        self.process.stdin.flush()
        said = [*iter(self.process.stdout.readline, line)]
        assert self.process.poll() is None, said
        return [re.sub(r"^Out\[\d+\]: ?", "", each.rstrip()) for each in said if each.strip()]

    def end(self) -> None:
        self.process.communicate()
