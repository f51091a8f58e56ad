"""`stickslip new`: a scenario file to begin from."""

import shlex
from argparse import Namespace

from cosim.cli import DONE
from cosim.cli.console import note
from cosim.scenario.json_schema import SCENARIO_FILE, write_new


def execute(arguments: Namespace) -> int:
    """Write the file and say how it is run; 0."""
    file = write_new(arguments.name, arguments.source, force=arguments.force)
    note(f"{SCENARIO_FILE} beside it is for editors, which check and complete the file by it")
    print(f"{file}: change it, then stickslip run {shlex.quote(str(file))}")
    return DONE
