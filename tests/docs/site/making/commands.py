"""Every command with its arguments, from the parsers that read them."""

import argparse
import os
import textwrap

from cosim.cli.arguments import COMMANDS, parser

from .markdown import code, heading, table

#: Of argparse's usage, after its own word.
INDENT = len("usage: ")


def text() -> str:
    """A section for each command, in the order of the help."""
    os.environ["COLUMNS"] = "92"  # argparse's lines, whatever the terminal
    return "".join(section(name) for name in COMMANDS)


def section(name: str) -> str:
    """What a command does, its usage, its arguments, an example."""
    command = parser_of(name)
    usage = textwrap.dedent(command.format_usage().replace("usage: ", " " * INDENT, 1)).rstrip()
    example = (command.epilog or "").removeprefix("example: ")
    return (
        heading(2, f"stickslip {name}", f"command-{name}")
        + f"{command.description}\n\n```text\n{usage}\n```\n\n"
        + table(["argument", "does"], arguments(command))
        + f"For example `{example}`.\n\n"
    )


def parser_of(name: str) -> argparse.ArgumentParser:
    """The parser of one command."""
    for action in parser([name])._actions:
        if isinstance(action, argparse._SubParsersAction):
            return action.choices[name]
    raise LookupError(name)


def arguments(command: argparse.ArgumentParser) -> list[tuple[str, str]]:
    """Each as it is typed, and its help."""
    formatter = command._get_formatter()
    rows = []
    for action in command._actions:
        if action.help is None or action.help == argparse.SUPPRESS or action.dest == "help":
            continue
        value = formatter._format_args(action, formatter._get_default_metavar_for_optional(action))
        if not action.option_strings:
            typed = [formatter._format_args(action, action.metavar or action.dest)]
        elif action.nargs == 0:
            typed = action.option_strings
        else:
            typed = [f"{option} {value}" for option in action.option_strings]
        said = formatter._expand_help(action)
        rows.append((", ".join(code(one) for one in typed), said))
    return rows
