"""StickSlip3DOF.fmu and StickSlip3DOF-fmi3.fmu: the kernel as C, the functions of FMI around it.

One library has the functions of FMI 2.0 and 3.0, and both units the same GUID. The same content
gives the same GUID, and with the same compiler the same file, byte for byte. What
was compiled while the package was made into a wheel (see `build/hook.py`) is taken where it is of
today's content; else it is compiled here.
"""

import json
import zipfile
import zlib
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from functools import cache, partial
from pathlib import Path
from xml.etree.ElementTree import ParseError, fromstring

from stickslip.catalogue import CATALOGUE, Catalogue
from stickslip.contradictions import COMPUTABLE
from stickslip.generation import c as c_generation
from stickslip.generation.c import c_header, c_source
from stickslip.generation.platforms import Platform
from stickslip.kernel.tables import value_names
from stickslip.words import SAID, WHY_NOT

from cosim.files import write_bytes
from cosim.fmu import c_tables
from cosim.fmu.archive import digest_of, extras, guid_of, packed
from cosim.fmu.description import UnitFacts, build_description, fmi2_description, fmi3_description
from cosim.fmu.exchange import INDICATORS, variables
from cosim.fmu.libraries import FMI2, FMI3, Sources, of_platforms
from cosim.fmu.variables import Variable

NAME = "StickSlip3DOF"
#: Version of FMI -> file.
FILES = {FMI2: f"{NAME}.fmu", FMI3: f"{NAME}-fmi3.fmu"}
DESCRIPTION = (
    "Stick-slip of a block on four springs on a moving surface: three degrees of freedom, dry "
    "friction, friction heat handed over as energy"
)
#: Files that make the sources.
MAKERS = (
    *Path(c_generation.__file__).parent.glob("c*.py"),
    *map(Path(__file__).with_name, ("native.py", "c_tables.py", "exchange.py", "libraries.py")),
    *map(Path(__file__).with_name, ("variables.py", "variables.toml")),
)


@cache
def sources(catalogue: Catalogue = CATALOGUE) -> dict[str, bytes]:
    """File name -> content of everything that the library is compiled from."""
    text, declared = catalogue.text, variables(catalogue)
    places = {name: place for place, name in enumerate(value_names(catalogue.effects))}
    made = {
        "kernel.h": c_tables.hidden(c_header(text)),
        "kernel.c": c_source(text),
        "variables.h": c_tables.variables_header(declared, guid(catalogue), catalogue),
        "variables.c": c_tables.variables_source(declared, catalogue),
        "sentences.c": c_tables.sentences_source(SAID, places),
    }
    return written("stickslip3dof") | {name: content.encode() for name, content in made.items()}


@cache
def sources_of(catalogue: Catalogue) -> Sources:
    """What makes the `sources`; the same for the same catalogue."""
    return partial(sources, catalogue)


@cache
def guid(catalogue: Catalogue = CATALOGUE) -> str:
    """The GUID of a unit built now: of what it is made from, which is quicker than making it."""
    declared = [asdict(each) for each in variables(catalogue)]
    made_from = {
        "kernel": catalogue.text.encode(),
        "words": json.dumps([WHY_NOT, SAID, COMPUTABLE]).encode(),
        "variables": json.dumps(declared, sort_keys=True).encode(),
        **{f"maker/{file.name}": file.read_bytes() for file in MAKERS},
        **written("stickslip3dof"),
    }
    return guid_of(NAME, digest_of(made_from).hexdigest())


def written(model: str) -> dict[str, bytes]:
    """What is written in C, not made, of a unit with a model of its own."""
    folder = native_folder()
    return {
        file.name: file.read_bytes()
        for place in (folder, folder / "headers", folder / model)
        for file in place.glob("*.[ch]")
    }


def native_folder() -> Path:
    """The folder of the C sources: in fmu_src in a checkout, beside this file in a package."""
    here = Path(__file__).resolve()
    checkout = here.parents[2] / "fmu_src" / "native"
    return checkout if checkout.is_dir() else here.with_name("native_sources")


def build(
    directory: Path,
    platforms: Sequence[Platform],
    fmi: int = FMI2,
    catalogue: Catalogue = CATALOGUE,
) -> Path:
    """Make the unit of a version of FMI, with libraries for those platforms that there is a way to.

    Written beside its final place and moved there, so that nobody ever sees half of it. Raises
    CompilerError where there is a way to none.
    """
    from cosim.fmu.description.documentation import documentation  # not for who only compiles

    facts, declared = _facts(fmi, catalogue), variables(catalogue)
    files = of_version(facts, declared, sources(catalogue), fmi)
    files |= documentation(facts, declared, fmi, catalogue)
    files |= of_platforms(guid(catalogue), sources_of(catalogue), platforms, NAME, fmi)
    return write_bytes(packed(files), directory / FILES[fmi])


def of_version(
    facts: UnitFacts, declared: Sequence[Variable], files: Mapping[str, bytes], fmi: int
) -> dict[str, bytes]:
    """What any unit in C has in a version of FMI, of its sources: path in the unit -> content."""
    found = {f"sources/{name}": content for name, content in sources_in(files, fmi).items()}
    if fmi == FMI3:
        found["modelDescription.xml"] = fmi3_description(facts, declared)
        found["sources/buildDescription.xml"] = build_description(facts)
    else:
        found["modelDescription.xml"] = fmi2_description(facts, declared)
    return found | extras(declared, fmi)


def sources_in(files: Mapping[str, bytes], fmi: int) -> dict[str, bytes]:
    """Sources without the functions and headers of the other version of FMI."""
    other = f"fmi{FMI2 if fmi == FMI3 else FMI3}"
    return {name: content for name, content in files.items() if not name.startswith(other)}


def compiled_in(files: Mapping[str, bytes], fmi: int) -> tuple[str, ...]:
    """Names of the files of C that are compiled for a version of FMI."""
    return tuple(sorted(name for name in sources_in(files, fmi) if name.endswith(".c")))


def built_guid(fmu: Path) -> str | None:
    """The GUID of a unit as a file; None where it is missing or damaged."""
    try:
        with zipfile.ZipFile(fmu) as archive:
            if archive.testzip() is not None:
                return None
            root = fromstring(archive.read("modelDescription.xml"))
            return root.get("guid") or root.get("instantiationToken")
    except (OSError, zipfile.BadZipFile, zlib.error, EOFError, KeyError, ValueError, ParseError):
        return None


def _facts(fmi: int, catalogue: Catalogue) -> UnitFacts:
    return UnitFacts(
        name=NAME,
        guid=guid(catalogue),
        description=DESCRIPTION,
        indicators=INDICATORS,
        sources=compiled_in(sources(catalogue), fmi),
    )
