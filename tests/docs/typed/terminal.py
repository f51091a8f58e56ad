"""A terminal of tmux and what is typed into it: commands in a shell, cells in IPython."""

import re
import shlex
import shutil
import time
from collections.abc import Mapping
from pathlib import Path

import pytest

#: Wider and higher than anything printed, so that a screen holds it as it was printed.
WIDTH, HEIGHT = 240, 1000
#: Longest that a command may take (it is there to end what hangs), and pauses between two looks, s.
PATIENCE, FIRST_LOOK, LAST_LOOK = 900.0, 0.05, 1.0


class Terminal:
    """A window of tmux in a folder, in which a program waits for input.

    program: as a shell starts it. ready: what the screen ends with when the program waits.
    """

    def __init__(self, server, folder: Path, program: str, ready: str, environment: Mapping):
        self.server, self.ready = server, re.compile(ready)
        self.page = Path(server.socket_path).with_name("typed")
        # not by tmux's own option: PATH is then the server's all the same
        said = [f"{name}={value}" for name, value in environment.items()]
        session = server.new_session(
            start_directory=folder,
            window_command=f"{shlex.join(['env', *said])} {program}",
            x=WIDTH,
            y=HEIGHT,
        )
        self.pane = session.active_pane
        self.length = 0
        self._wait()

    def type(self, text: str, enter: str) -> list[str]:
        """Type a text, and a key that ends it; the lines that stand there when all is done."""
        # by a file: a `;` that ends an argument would be tmux's own
        self.page.write_text(text, encoding="utf-8")
        self.server.load_buffer(self.page, buffer_name="typed")
        # as a terminal pastes: several lines are one input
        self.pane.paste_buffer(buffer_name="typed", bracket=True, linefeed_separator=True)
        last = text.splitlines()[-1].strip()
        self._until(lambda: last in "\n".join(self._lines()[self.length - 1 :]))
        self.pane.send_keys(enter, enter=False)
        return self._wait()

    def _lines(self) -> list[str]:
        lines = self.pane.capture_pane(start="-", join_wrapped=True)
        while lines and not lines[-1].strip():
            lines.pop()
        return [line.rstrip() for line in lines]

    def _new(self) -> list[str]:
        return self._lines()[self.length :]

    def _wait(self) -> list[str]:
        """The lines before the next prompt."""
        self._until(lambda: (new := self._new()) and self.ready.fullmatch(new[-1]))
        lines = self._lines()
        new, self.length = lines[self.length :], len(lines)
        return new

    def _until(self, condition) -> None:
        pause, end = FIRST_LOOK, time.monotonic() + PATIENCE
        while not condition():
            assert self.server.is_alive(), "the program has ended"
            assert time.monotonic() < end, "\n".join(self._lines())
            time.sleep(pause)
            pause = min(1.3 * pause, LAST_LOOK)


class Shell(Terminal):
    """bash, whose prompt says the exit status of what was before."""

    def __init__(self, server, folder, environment):
        environment = {**environment, "PROMPT_COMMAND": 'PS1="status $? $ "'}
        super().__init__(server, folder, "bash --norc --noprofile", r"status \d+ \$", environment)

    def run(self, command: str) -> tuple[int, list[str]]:
        """Exit status of a command, and what it said."""
        *said, prompt = self.type(command, "Enter")
        return int(prompt.split()[1]), said


class IPython(Terminal):
    """IPython as it is where it was never used before."""

    def __init__(self, server, folder, environment):
        program = "ipython --no-banner --no-confirm-exit --HistoryManager.enabled=False"
        super().__init__(server, folder, program, r"In \[\d+\]:", environment)

    def run(self, cell: str) -> list[str]:
        """What a cell said."""
        *said, _ = self.type(cell, "M-Enter")
        said = said[cell.count("\n") :]
        return [re.sub(r"^Out\[\d+\]: ?", "", line) for line in said if line]


def server(socket: Path):
    """A tmux of our own; the test is skipped where there is none."""
    libtmux = pytest.importorskip("libtmux", reason="no libtmux")
    if shutil.which("tmux") is None:
        pytest.skip("no tmux: apt-get install tmux")
    return libtmux.Server(socket_path=socket, config_file="/dev/null")
