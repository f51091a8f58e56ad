"""`stickslip explore`: a page with a slider for every number, computed in the browser."""

import webbrowser
from argparse import Namespace
from pathlib import Path

from cosim.cli import DONE
from cosim.cli.scenarios import given_scenario, note_taken
from cosim.explore.explorer import explorer_page, made_here
from cosim.files import OutputRefused, writable, write_text

#: Of a page; enough to see whose it is.
BEGINNING = 100_000


def execute(arguments: Namespace) -> int:
    """Write the page, say where it is, open it."""
    scenario = given_scenario(arguments.scenario or "reference", arguments.changes)
    file = Path(arguments.output or f"results/explorer-{scenario.name}.html")
    require_own(file, arguments.force)
    note_taken(scenario)
    write_text(explorer_page(scenario), file)
    print(file)
    if not arguments.no_open and not webbrowser.open(file.resolve().as_uri()):
        print("no browser to be found: open it yourself")
    return DONE


def require_own(file: Path, force: bool) -> None:
    """OutputRefused for a file that cannot be written, or is somebody else's."""
    writable(file.parent, [file.name])
    if force or not file.exists():
        return
    begins = ""
    if file.is_file():  # a pipe may never end
        with file.open(encoding="utf-8", errors="replace") as there:
            begins = there.read(BEGINNING)
    if not made_here(begins):
        raise OutputRefused(
            f"{file}: was not made by stickslip explore, allowed is another name, or --force "
            "to overwrite it"
        )
