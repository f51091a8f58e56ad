"""The commands of `stickslip`, and what their arguments have in common.

A command is a line in `COMMANDS` and a module of its name here, of this shape:

    EXAMPLE                 a command line that works
    add_arguments(parser)   its arguments
    refused()               errors that are bad input; imports what the command computes with
    execute(arguments)      computes, writes, prints; the exit status
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from importlib import import_module
from importlib.metadata import version
from types import ModuleType
from typing import NoReturn

#: Command -> what it does, in the order of the help.
COMMANDS = {
    "run": "the coupled case: the mechanical FMU and the heat in belt and ice",
    "simulate": "the mechanics alone, without FMU and heat conduction",
    "build": "builds the units for other tools: the block (FMI 2.0, 3.0), the heat, both as SSP",
    "couple": "any system of units: an SSP file, or a TOML of units, connections, scheme, steps",
    "belt-length": "how long the belt must be: drift of its temperature, loop after loop",
    "effects": "the catalogue of effects: what each adds, its parameters, and a figure",
    "friction-map": "friction against speed and temperature in steady coupled sliding",
    "gap": "what model and measurement disagree on: names the missing effect, adds it, shows it",
    "plan": "what a campaign could name before it is made: smallest sizes, pairs, the next run",
    "reproduce": "the source study's claims C1 to C15, each with its number, ours, and a verdict",
    "stability": "which steady motions a rig has, and which it can keep to: maps and a page",
    "sweep": "parameter sweep: every combination of some values",
}


class Parser(argparse.ArgumentParser):
    """An argparse parser whose errors are one line."""

    def error(self, message: str) -> NoReturn:
        """Refuse the arguments, exit status 2."""
        print(f"error: {message}; see {self.prog} --help", file=sys.stderr)
        raise SystemExit(2)


def parser(arguments: Sequence[str]) -> Parser:
    """The parser of the whole command line.

    A command declares its own arguments. It is imported only where ``arguments`` name it, so that
    help and the other commands stay quick.
    """
    top = Parser(
        prog="stickslip",
        description="Stick-slip of an ice block on a moving surface, coupled to the heat it makes.",
        epilog="example: stickslip run",
        allow_abbrev=False,
    )
    top.add_argument("--version", action="version", version=f"stickslip {version('stickslip')}")
    top.add_argument("--debug", action="store_true", help="show the traceback of an error")
    commands = top.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for name, summary in COMMANDS.items():
        command = commands.add_parser(name, help=summary, allow_abbrev=False)
        if name in arguments:
            _declare(command, name, summary)
    return top


def _declare(command: Parser, name: str, summary: str) -> None:
    module = command_module(name)
    command.description = summary[0].upper() + summary[1:] + "."
    command.epilog = f"example: {module.EXAMPLE}"
    # Also behind the command's name; suppressed, so that it does not undo one in front of it.
    command.add_argument(
        "--debug", action="store_true", default=argparse.SUPPRESS, help="show tracebacks"
    )
    module.add_arguments(command)


def command_module(name: str) -> ModuleType:
    """The module of a command."""
    return import_module(f"cosim.cli.{name.replace('-', '_')}")


def add_run_arguments(command: argparse.ArgumentParser) -> None:
    """Scenario and output folder of one run, coupled or not."""
    command.add_argument(
        "scenario",
        nargs="?",
        help="TOML file, or the name of a packaged scenario such as reference (default), slab, "
        "warm_friction",
    )
    add_output(
        command,
        "folder of the results; made when missing (default: results/NAME OF THE SCENARIO)",
    )
    add_force(command, ", and begin anew where an unfinished run could be gone on with")


def add_output(command: argparse.ArgumentParser, said: str, default: str | None = None) -> None:
    """`-o`: the folder that a command writes to."""
    command.add_argument("-o", "--output", metavar="DIR", default=default, help=said)


def add_force(command: argparse.ArgumentParser, said: str = "") -> None:
    """`--force`: overwrite what is not known to be an earlier result. said: what else it allows."""
    command.add_argument(
        "--force",
        action="store_true",
        help=f"overwrite files in the folder that no earlier run of this tool made{said}",
    )


def add_verbose(command: argparse.ArgumentParser) -> None:
    """`-v`: what is said in a run, as it comes."""
    command.add_argument(
        "-v",
        "--verbose",
        action="store_true",
        help="show on stderr what the units say, as it comes, and ask them for more of it;"
        " messages.log beside the results has it, too",
    )


def add_json(command: argparse.ArgumentParser) -> None:
    """`--json`: the numbers on standard output in place of the lines."""
    command.add_argument("--json", action="store_true", help="print JSON")
