"""Both models as WebAssembly, for a page in a browser: the C of the native units, no FMI around it.

Of the same sources as the libraries of StickSlip3DOF and BeltIceThermal, with parameters checked
and packed, random numbers drawn and refusals said by the same C. Compiled by zig, whose C library
brings sin, exp and the others: nothing is asked of the browser.
"""

from functools import cache, partial
from pathlib import Path

from stickslip.catalogue import CATALOGUE, Catalogue
from stickslip.generation.compiler import CompilerError, has_zig
from stickslip.generation.platforms import BROWSER

from cosim.fmu import native
from cosim.fmu.archive import digest_of, guid_of
from cosim.fmu.libraries import libraries
from cosim.fmu.thermal import native_unit

NAME, HEAT = "explorer", "explorer_heat"
#: What is taken of the native unit; of the thermal unit, all but the functions of FMI.
SHARED = {
    NAME: (
        "kernel.c", "kernel.h", "draws.c", "draws.h", "words.c", "words.h",
        "sentences.c", "variables.c", "variables.h", "unit.h", "model.h",
    ),
    HEAT: (
        "belt.c", "belt.h", "ice.c", "ice.h", "linear.c", "linear.h", "water.c", "water.h",
        "model.c", "model.h", "resources.c", "resources.h", "unit.h",
        "variables.c", "variables.h",
    ),
}  # fmt: skip


@cache
def sources(name: str = NAME, catalogue: Catalogue = CATALOGUE) -> dict[str, bytes]:
    """File name -> content of everything that a module is compiled from."""
    made = native.sources(catalogue) if name == NAME else native_unit.sources()
    return {file: made[file] for file in SHARED[name]} | _written(name)


@cache
def guid(name: str = NAME, catalogue: Catalogue = CATALOGUE) -> str:
    """Of what a module is made from, by which a wheel's is known to be of today's content."""
    unit = native.guid(catalogue) if name == NAME else native_unit.guid()
    made_from = {"unit": unit.encode(), "maker": Path(__file__).read_bytes(), **_written(name)}
    return guid_of(name, digest_of(made_from).hexdigest())


def _written(name: str) -> dict[str, bytes]:
    folder = native.native_folder() / name
    return {file.name: file.read_bytes() for file in folder.iterdir() if file.suffix == ".c"}


def module(name: str = NAME, catalogue: Catalogue = CATALOGUE) -> bytes:
    """The WebAssembly of `NAME`, the kernel's, or `HEAT`: the wheel's where it is of today's
    content, or compiled.

    Raises CompilerError, in one line, where there is no way to it.
    """
    try:
        made = partial(sources, name, catalogue)
        return libraries(name, guid(name, catalogue), made, (BROWSER,))[BROWSER]
    except CompilerError as error:
        if has_zig():
            raise
        raise CompilerError(
            "no kernel for the browser: zig, which compiles it, is not there; "
            "`pip install ziglang` (the extra `explore`), or install a wheel, which has the kernel"
        ) from error
