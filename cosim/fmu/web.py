"""The kernel as WebAssembly, for a page in a browser: the C of the native unit, no FMI around it.

Of the same sources as the library of StickSlip3DOF, with parameters checked and packed, random
numbers drawn and refusals said by the same C. Compiled by zig, whose C library brings sin, exp and
the others: nothing is asked of the browser.
"""

from __future__ import annotations

from functools import cache, partial
from pathlib import Path

from stickslip.catalogue import CATALOGUE, Catalogue
from stickslip.generation.compiler import CompilerError, has_zig
from stickslip.generation.platforms import BROWSER

from cosim.fmu import native
from cosim.fmu.archive import digest_of, guid_of
from cosim.fmu.libraries import libraries

NAME = "explorer"
#: What is taken of the native unit.
SHARED = (
    *("kernel.c", "kernel.h", "draws.c", "draws.h", "words.c", "words.h"),
    *("variables.c", "variables.h", "unit.h", "model.h"),
)


@cache
def sources(catalogue: Catalogue = CATALOGUE) -> dict[str, bytes]:
    """File name -> content of everything that the module is compiled from."""
    made = native.sources(catalogue)
    return {name: made[name] for name in SHARED} | _written()


@cache
def guid(catalogue: Catalogue = CATALOGUE) -> str:
    """Of what the module is made from, by which a wheel's is known to be of today's content."""
    made_from = {
        "unit": native.guid(catalogue).encode(),
        "maker": Path(__file__).read_bytes(),
        **_written(),
    }
    return guid_of(NAME, digest_of(made_from).hexdigest())


def _written() -> dict[str, bytes]:
    folder = native.native_folder() / NAME
    return {file.name: file.read_bytes() for file in folder.iterdir() if file.suffix == ".c"}


def module(catalogue: Catalogue = CATALOGUE) -> bytes:
    """The WebAssembly: the wheel's where it is of today's content, or compiled.

    Raises CompilerError, in one line, where there is no way to it.
    """
    try:
        return libraries(NAME, guid(catalogue), partial(sources, catalogue), (BROWSER,))[BROWSER]
    except CompilerError as error:
        if has_zig():
            raise
        raise CompilerError(
            "no kernel for the browser: the installed package has none of today's content, and "
            "zig, which would compile it, is not there; `pip install ziglang`, or install "
            "stickslip again (a wheel brings the kernel along)"
        ) from error
