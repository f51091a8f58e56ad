"""The commands of `stickslip`, and what their arguments have in common.

A command is a table of `commands.toml`, with its arguments, and a module of its name in one of the
rooms here, whose `execute(arguments)` computes, writes and prints, and returns the exit status.
"""

from __future__ import annotations

import argparse
import builtins
import os
import re
import sys
import tomllib
from collections.abc import Sequence
from importlib import import_module
from importlib.metadata import version
from importlib.resources import files
from types import ModuleType
from typing import TYPE_CHECKING, Any, NoReturn

if TYPE_CHECKING:
    from cosim.report.files import Shown


#: What `commands.toml` says: of arguments that several commands have, and of each command.
_DECLARED: dict[str, dict[str, Any]] = tomllib.loads(
    (files(__package__) / "commands.toml").read_text(encoding="utf-8")
)
_SHARED = _DECLARED.pop("shared")
#: In the order of the help.
COMMANDS = _DECLARED
#: What argparse takes of an argument; other keys are for its help.
_KNOWN = ("action", "choices", "const", "default", "dest", "metavar", "nargs", "type")
#: As a FILE of --json: standard output.
STDOUT = "-"
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
    names = vars(builtins) | globals() | vars(command_module(name))
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


def shown(arguments: argparse.Namespace) -> Shown:
    """As the command line says it."""
    return {"figures": arguments.figures, "page": not arguments.no_page}


def folder(text: str) -> str:
    """A folder's name; an empty one, such as of a shell's unset variable, is none."""
    if not text.strip():
        raise argparse.ArgumentTypeError(
            "'' is no name of a folder, allowed is one such as results"
        )
    return text


def json_file(text: str) -> str:
    """A file's name; not that of a scenario, an effect or a claim, which may have been meant."""
    if text != STDOUT and not re.search(r"[./\\]", text) and not os.path.exists(text):
        raise argparse.ArgumentTypeError(
            f"{text} is no name of a file, allowed is one such as {text}.json; what is to be "
            "computed goes in front of --json"
        )
    return text
