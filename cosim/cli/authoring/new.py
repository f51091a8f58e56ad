"""`stickslip new`: a scenario file to begin from."""

from __future__ import annotations

import shlex
from argparse import ArgumentParser, Namespace

from cosim.cli import DONE
from cosim.cli.console import note

EXAMPLE = "stickslip new cold_room --from reference"


def add_arguments(parser: ArgumentParser) -> None:
    """The arguments of the command."""
    parser.add_argument("name", metavar="NAME", help="of the scenario; NAME.toml is written")
    parser.add_argument(
        "--from",
        dest="source",
        metavar="SCENARIO",
        help="copy this TOML file or packaged scenario, such as reference, slab, meltwater "
        "(default: a commented scenario with the keys that most rigs differ in)",
    )
    parser.add_argument("--force", action="store_true", help="overwrite NAME.toml")


def execute(arguments: Namespace) -> int:
    """Write the file and say how it is run; 0."""
    from cosim.scenario.json_schema import SCENARIO_FILE
    from cosim.scenario.written import write_new

    file = write_new(arguments.name, arguments.source, force=arguments.force)
    note(f"{SCENARIO_FILE} beside it is for editors, which check and complete the file by it")
    print(f"{file}: stickslip simulate {shlex.quote(str(file))}")
    return DONE
