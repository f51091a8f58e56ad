"""A TOML file as tables, and what is wrong with one that cannot be read, in one line."""

import re
import tomllib
from pathlib import Path
from typing import Any

from stickslip.text_file import MOST_TOML, read_text, tables_in

from cosim.scenario.validation import ScenarioError


def parsed(text: str, source: str | Path) -> dict[str, Any]:
    """The tables of a text; ScenarioError with line and column where it is no TOML."""
    try:
        return tables_in(text)
    except tomllib.TOMLDecodeError as error:
        fault = _with_line(str(error), text) + _comma(str(error), text)
        raise ScenarioError(f"{source}: not TOML: {fault}") from None
    except ValueError as error:
        # tomllib lets through what Python itself refuses: a number of 5000 digits, a date of
        # month 13
        raise ScenarioError(f"{source}: not TOML that can be used: {error}") from None


def text_of(source: str | Path) -> str:
    """The text of a file that exists; ScenarioError when it is none, or not in UTF-8."""
    path = Path(source)
    if path.is_dir():
        raise ScenarioError(f"{source}: is a folder, allowed is a TOML file")
    try:
        return read_text(path, MOST_TOML)
    except UnicodeDecodeError as error:
        raise ScenarioError(
            f"{source}: byte {error.start + 1} is not UTF-8, allowed is a TOML file in UTF-8"
        ) from None
    except OSError as error:
        raise ScenarioError(f"{source}: cannot be read: {error.strerror}") from None


def _comma(message: str, text: str) -> str:
    """A hint where the line has a number with a decimal comma; "" else."""
    found = re.search(r"at line (\d+)", message)
    line = text.splitlines()[int(found[1]) - 1] if found else ""
    number = re.search(r"=\s*([-+]?\d+),(\d+)\s*(#|$)", line)
    return f"; is {number[1]}.{number[2]} meant?" if number else ""


def _with_line(message: str, text: str) -> str:
    """tomllib's message; it names no line when the fault is only seen at the end."""
    last = f"at line {len(text.splitlines())}, end of document"
    message = message.replace("at end of document", last)
    return message[:1].lower() + message[1:]
