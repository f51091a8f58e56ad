"""The commands of `stickslip`, and what their arguments have in common.

A command is a line in `COMMANDS` and a module of its name in one of the rooms here, of this shape:

    EXAMPLE                 a command line that works
    add_arguments(parser)   its arguments
    IMPORTS                 modules that it computes with, imported where Ctrl-C waits; may be
                            left out
    execute(arguments)      computes, writes, prints; the exit status
"""

from __future__ import annotations

import argparse
import os
import re
import sys
from collections.abc import Sequence
from importlib import import_module
from importlib.metadata import version
from types import ModuleType
from typing import TYPE_CHECKING, NamedTuple, NoReturn

if TYPE_CHECKING:
    from cosim.report.files import Shown


class Command(NamedTuple):
    """A command: the room of its module, and what it does, in the words of the help."""

    room: str
    does: str


#: In the order of the help.
COMMANDS = {
    "run": Command("runs", "the coupled case: the mechanical FMU and the heat in belt and ice"),
    "simulate": Command("runs", "the mechanics alone, without FMU and heat conduction"),
    "build": Command(
        "authoring",
        "builds the units for other tools: the block (FMI 2.0, 3.0), the heat, both as SSP",
    ),
    "couple": Command(
        "runs", "any system of units: an SSP file, or a TOML of units, connections, scheme, steps"
    ),
    "plot": Command("runs", "figures of a result as PNG files"),
    "compare": Command("runs", "two results, or two scenarios: numbers, curves, what differs"),
    "belt-length": Command(
        "studies", "how long the belt must be: drift of its temperature, loop after loop"
    ),
    "effect": Command(
        "authoring", "writes the file of a custom effect, to be changed: effect new NAME.py"
    ),
    "effects": Command(
        "studies", "the catalogue of effects: what each adds, its parameters, and a figure"
    ),
    "explore": Command(
        "runs", "the mechanics in the browser: a page with a slider for every number"
    ),
    "friction-map": Command(
        "studies", "friction against speed and temperature in steady coupled sliding"
    ),
    "gap": Command(
        "measurements",
        "what model and measurement disagree on: names the missing effect, adds it, shows it",
    ),
    "campaign": Command(
        "measurements", "a folder of tracker files as a campaign for gap, its settings guessed"
    ),
    "plan": Command(
        "measurements",
        "what a campaign could name before it is made: smallest sizes, pairs, the next run",
    ),
    "new": Command("authoring", "writes a commented scenario to begin from, or a copy of one"),
    "keys": Command("authoring", "every key of a scenario: default, unit, what is allowed"),
    "schema": Command(
        "authoring", "the JSON Schema of a scenario, a campaign or a system, for editors"
    ),
    "completion": Command("authoring", "completion of commands and options for your shell"),
    "docs": Command("authoring", "the documentation in the browser; in a checkout, builds it"),
    "reproduce": Command(
        "studies", "the source study's claims C1 to C18, each with its number, ours, and a verdict"
    ),
    "stability": Command(
        "studies", "which steady motions a rig has, and which it can keep to: maps and a page"
    ),
    "sweep": Command("studies", "parameter sweep: every combination of some values"),
}


#: Commands that run units, which say things themselves.
OF_UNITS = ("run", "couple")
#: As a FILE of --json: standard output.
STDOUT = "-"
#: Where folders of results go that are not named.
RESULTS = "results"
#: What --force allows, too.
ANEW = ", and begin anew where an unfinished run could be resumed"
EXAMPLE_TOO = ", or what is there of the example with other content"


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
    for name, (_, does) in COMMANDS.items():
        command = commands.add_parser(name, help=does, allow_abbrev=False)
        if name in arguments:
            _declare(command, name, does)
    return top


def _declare(command: Parser, name: str, does: str) -> None:
    module = command_module(name)
    command.description = does[0].upper() + does[1:] + "."
    command.epilog = f"example: {module.EXAMPLE}"
    # Also behind the command's name; suppressed, so that it does not undo one in front of it.
    command.add_argument(
        "--debug", action="store_true", default=argparse.SUPPRESS, help="show tracebacks"
    )
    module.add_arguments(command)
    _add_saying(command, name)


def command_module(name: str) -> ModuleType:
    """The module of a command."""
    return import_module(f"cosim.cli.{COMMANDS[name].room}.{name.replace('-', '_')}")


def add_run_arguments(command: argparse.ArgumentParser) -> None:
    """Scenario and output folder of one run, coupled or not."""
    command.add_argument(
        "scenario",
        nargs="?",
        help="TOML file, or the name of a packaged scenario such as reference (default), slab, "
        "warm_friction; custom effects that it names execute Python",
    )
    add_set(command)
    add_shown(command, " (later: stickslip plot DIR)")
    add_results(command, "results; made when missing", "NAME OF THE SCENARIO", anew=ANEW)


def add_scenario(command: argparse.ArgumentParser, default: str) -> None:
    """The scenario of a study."""
    command.add_argument(
        "scenario",
        nargs="?",
        default=default,
        help=f"TOML file, or the name of a packaged scenario (default: {default})",
    )


def add_shown(command: argparse.ArgumentParser, later: str = "") -> None:
    """What is drawn of a run. later: how its figures are drawn another time."""
    command.add_argument(
        "--figures",
        action="store_true",
        help=f"also write the figures of the page as PNG files{later}",
    )
    command.add_argument("--no-page", action="store_true", help="write no report.html")


def shown(arguments: argparse.Namespace) -> Shown:
    """As the command line says it."""
    return {"figures": arguments.figures, "page": not arguments.no_page}


def add_results(command: argparse.ArgumentParser, holds: str, name: str, anew: str = "") -> None:
    """`--json`, `-o` and `--force` of a command that leaves a folder of results.

    holds: what is in it. name: its own in `results`, which the command finds where it says NAME.
    anew: what else --force allows.
    """
    add_json(command)
    default = f"{RESULTS}/{name}"
    fixed = None if re.search("[A-Z]", name) else default
    add_output(command, f"folder of {holds} (default: {default})", fixed)
    add_force(command, anew)


def add_output(command: argparse.ArgumentParser, said: str, default: str | None = None) -> None:
    """`-o`: the folder that a command writes to."""
    command.add_argument("-o", "--output", metavar="DIR", type=_folder, default=default, help=said)


def _folder(text: str) -> str:
    """A folder's name; an empty one, such as of a shell's unset variable, is none."""
    if not text.strip():
        raise argparse.ArgumentTypeError(
            "'' is no name of a folder, allowed is one such as results"
        )
    return text


def add_force(command: argparse.ArgumentParser, said: str = "") -> None:
    """`--force`: overwrite what is not known to be an earlier result. said: what else it allows."""
    command.add_argument(
        "--force",
        action="store_true",
        help=f"overwrite files in the folder that no earlier run of this tool made{said}",
    )


def add_set(command: argparse.ArgumentParser, example: str = "rig.mass=1.2") -> None:
    """`--set`: keys of the scenario, or of what else a command reads, in place of the file's."""
    command.add_argument(
        "--set",
        metavar="KEY=VALUE",
        action="append",
        default=[],
        dest="changes",
        help=f"a key in place of the file's, as {example}: a value as TOML has it, or a text "
        "without quotes; may come again",
    )


def add_json(command: argparse.ArgumentParser) -> None:
    """`--json`: the numbers on standard output in place of the lines, or in a file beside them."""
    command.add_argument(
        "--json",
        nargs="?",
        const=STDOUT,
        type=_json_file,
        metavar="FILE",
        help="print the numbers as JSON in place of the lines; with FILE, write them there",
    )


def _json_file(text: str) -> str:
    """A file's name; not that of a scenario, an effect or a claim, which may have been meant."""
    if text != STDOUT and not re.search(r"[./\\]", text) and not os.path.exists(text):
        raise argparse.ArgumentTypeError(
            f"{text} is no name of a file, allowed is one such as {text}.json; what is to be "
            "computed goes in front of --json"
        )
    return text


def _add_saying(command: argparse.ArgumentParser, name: str) -> None:
    """`-q` and `-v`: how much is said beside the results."""
    units = (
        "; also what the units say, as it comes, and ask them for more of it (messages.log has "
        "it, too)"
        if name in OF_UNITS
        else ""
    )
    how_much = command.add_mutually_exclusive_group()
    how_much.add_argument(
        "-q", "--quiet", action="store_true", help="say nothing but results, warnings and errors"
    )
    how_much.add_argument(
        "-v",
        "--verbose",
        action="store_true",
        help=f"say more on stderr: what is read, compiled and written{units}",
    )
