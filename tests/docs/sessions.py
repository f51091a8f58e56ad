"""What pages print of terminals: commands, what is said to them, what of that is of the moment."""

import re
from collections.abc import Iterable, Iterator

from markdown_it.renderer import RendererHTML
from markdown_it.token import Token
from myst_parser.config.main import MdParserConfig
from myst_parser.parsers.mdit import create_md_parser

_MOMENT = re.compile(r"[\d.e-]+ s of (wall time|them)")


def fences(text: str) -> list[Token]:
    """A page's fenced and indented blocks of code, directives among them, by the site's parser."""
    parser = create_md_parser(MdParserConfig(enable_extensions={"colon_fence"}), RendererHTML)
    kinds = ("fence", "colon_fence", "code_block")
    return [token for token in parser.parse(text) if token.type in kinds]


def typed(block: str) -> Iterator[tuple[str, list[str]]]:
    """The commands of a session, those after a `$`, each with the lines that follow it.

    >>> list(typed("$ one\\nsaid\\n$ two\\n"))
    [('one', ['said']), ('two', [])]
    """
    for part in re.split(r"^\$ ", block, flags=re.MULTILINE)[1:]:
        command, *printed = part.splitlines()
        yield command, printed


def timeless(lines: Iterable[str]) -> list[str]:
    """Lines without the seconds that computing took, and without empty ones."""
    return [_MOMENT.sub(r"... s of \1", line).rstrip() for line in lines if line.strip()]
