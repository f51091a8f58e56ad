"""Somebody who does a page as it is printed: types its cells and sessions, and compares.

Cells go into IPython, which knows `%%bash` and `%%writefile`; lines with a `$` go into a shell
of their own, in the same folder. Hidden cells, which only the build has, are not typed: a page that
needs one cannot be done. Its cells are also executed by `test_site.py`, with every run of the
tests; pages are typed by `pytest -m slow`.

What is said must be what the page has, with these exceptions:

- seconds of computing (`sessions.timeless`), and empty lines;
- a figure is shown in a window of its own, where the page has a picture;
- a session prints the lines that matter: the terminal may say more than these, in between.
"""

import os
import sys
from pathlib import Path

from notebooks import PAGES, Executed, source
from sessions import fences, timeless, typed
from terminal import IPython, type_command


class Reader:
    """A page being done, in a folder.

    executed: what the cells of pages computed, when the site was built.
    """

    def __init__(self, folder: Path, executed: Executed):
        self.folder, self.executed = folder, executed
        tools = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
        self.environment = os.environ | {
            "PATH": tools,
            # no window can be opened here, and what others have set is none of the page's
            "MPLBACKEND": "Agg",
            "DISPLAY": "",
            "IPYTHONDIR": str(folder.parent / "ipython"),
        }

    def command(self, command: str) -> tuple[int, list[str]]:
        """Exit status of a command, and what it said."""
        return type_command(command, self.folder, self.environment)

    def do(self, name: str) -> None:
        """A page of the tutorials from its first line to its last."""
        page = PAGES / f"{name}.md"
        said: list[list[str]] = []
        python = IPython(self.folder, self.environment)
        for cell in source(page).cells:
            if cell.cell_type == "code":
                said.append([] if is_hidden(cell) else python.run(cell.source))
            else:
                for fence in fences(cell.source):
                    self.session(fence.content)
        python.end()
        # after the last of them: whoever builds the site at this time may have executed them
        shown = [cell for cell in self.executed(page).cells if cell.cell_type == "code"]
        for cell, lines in zip(shown, said, strict=True):
            if not is_hidden(cell):
                said_and_shown = [sorted(timeless(each)) for each in (lines, printed(cell))]
                assert said_and_shown[0] == said_and_shown[1]

    def session(self, block: str) -> None:
        """The commands of a session, if a block is one."""
        for command, lines in typed(block):
            status, said = self.command(command)
            assert status == 0, said
            rest = iter(timeless(said))
            # in this order, with others in between
            missing = [line for line in timeless(lines) if line not in rest]
            assert not missing, "\n".join(said)

    def shows(self, browser, file: str, *words: str) -> None:
        """Open a page that the tutorial names; it complains of nothing, and has the words."""
        browser.errors()
        browser.open(self.folder / file)
        assert browser.errors() == []
        assert browser.outside() == []
        text = browser.js("return document.body.innerText")
        assert [word for word in words if word not in text] == []


def is_hidden(cell) -> bool:
    """Whether a cell is executed and not shown."""
    return "remove-cell" in cell.metadata.get("tags", [])


def printed(cell) -> list[str]:
    """What the page prints below a cell. Its two streams are one in a terminal, in any order."""
    lines: list[str] = []
    for output in cell.outputs:
        if output.output_type == "stream":
            lines += output.text.splitlines()
        elif output.output_type == "execute_result":
            lines += output.data["text/plain"].splitlines()
    return lines
