"""The commands of `stickslip`, and what their arguments have in common.

A command is a table of `commands.toml`, with its arguments, and a module of its name in one of the
rooms here, whose `execute(arguments)` computes, writes and prints, and returns the exit status.
"""

import argparse
import builtins
import sys
from collections.abc import Sequence
from importlib import import_module
from importlib.metadata import version
from types import ModuleType
from typing import Any, NoReturn

from stickslip.packaged import packaged_tables

from cosim.cli import argument_types

#: What `commands.toml` says: of arguments that several commands have, and of each command.
_DECLARED = packaged_tables(__package__, "commands.toml")
_SHARED = _DECLARED.pop("shared")
#: In the order of the help.
COMMANDS = _DECLARED
#: What argparse takes of an argument; other keys are for its help.
_KNOWN = ("action", "choices", "const", "default", "dest", "metavar", "nargs", "type")
#: Where folders of results go that are not named.
RESULTS = "results"


class Parser(argparse.ArgumentParser):
    """An argparse parser whose errors are one line."""

    def error(self, message: str) -> NoReturn:
        """Refuse the arguments, exit status 2."""
        print(f"error: {message}; see {self.prog} --help", file=sys.stderr)
        raise SystemExit(2)


def parser(arguments: Sequence[str]) -> Parser:
    """The parser of the whole command line.

    Only a command that ``arguments`` name has its own declared, which is quicker; its module, and
    what that computes with, is imported when the arguments are known.
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
    for name, told in COMMANDS.items():
        command = commands.add_parser(name, help=told["does"], allow_abbrev=False)
        if name in arguments:
            _declare(command, name)
    return top


def _declare(command: Parser, name: str) -> None:
    told = COMMANDS[name]
    does, more = told["does"], told.get("more", "")
    command.description = f"{does[0].upper()}{does[1:]}. {more}".rstrip()
    command.epilog = f"example: {told['example']}"
    # Also behind the command's name; suppressed, so that it does not undo one in front of it.
    command.add_argument(
        "--debug", action="store_true", default=argparse.SUPPRESS, help="show tracebacks"
    )
    add_arguments(command, name)


def command_module(name: str) -> ModuleType:
    """The module of a command."""
    return import_module(f"cosim.cli.{COMMANDS[name]['room']}.{name.replace('-', '_')}")


def add_arguments(command: argparse.ArgumentParser, name: str) -> None:
    """The arguments of a command, and how much is said beside its results."""
    told = COMMANDS[name]
    names = vars(builtins) | vars(argument_types)
    groups: dict[str | None, Any] = {None: command}
    said = {"-q --quiet": {}, "-v --verbose": {"more": told.get("verbose", "")}}
    for flags, own in (told["arguments"] | said).items():
        one = _SHARED.get(flags, {}) | own
        given = {key: one[key] for key in _KNOWN if key in one}
        if "type" in one:
            given["type"] = names[one["type"]]
        if str(default := one.get("default")).startswith("{"):
            given["default"] = names[default.strip("{}")]
        if (group := one.get("group")) not in groups:
            groups[group] = command.add_mutually_exclusive_group()
        groups[group].add_argument(
            *flags.split(), help=one["help"].format_map(names | one), **given
        )
