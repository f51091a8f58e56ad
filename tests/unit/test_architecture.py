"""Who may know whom, and how large a room may be: read off the import statements and the files.

All imports count, also those inside functions: one that is put off is known all the same.
"""

import ast
import json
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest
from command_line import python
from stickslip.generation.source import kernel_source

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = {
    "stickslip": ROOT / "fmu_src" / "stickslip",
    "thermal": ROOT / "thermal",
    "cosim": ROOT / "cosim",
}
FILES = [(name, file) for name, folder in PACKAGES.items() for file in folder.rglob("*.py")]

#: Parts of cosim that compute and write without knowing what.
LEAVES = (
    "cosim.files", "cosim.interrupts", "cosim.manifest", "cosim.names", "cosim.processes",
    "cosim.cores", "stickslip.lazy", "stickslip.packaged", "cosim.result", "stickslip.scratch",
)  # fmt: skip
PRODUCT = ("stickslip", "thermal", "cosim")
#: Part -> what of the product it may import beside itself. What a part is not named for, the
#: longest name that holds it is.
MAY_IMPORT = {
    "stickslip": (),
    "stickslip.quantity": (),
    "thermal": ("stickslip.quantity", "stickslip.lazy"),
    # neither body: only what is between them
    "thermal.contact": ("stickslip.quantity", "thermal.arrays", "thermal.materials"),
    **dict.fromkeys(LEAVES, LEAVES),
    "stickslip.scratch": (),
    "stickslip.lazy": (),
    "cosim.coupling": LEAVES,
    # the types of a table [coupling], without which it runs
    "cosim.coupling.methods": ("cosim.coupling", "cosim.scenario.method"),
    "cosim.scenario": ("stickslip", "thermal", *LEAVES),
    "cosim.fmu": ("stickslip", "cosim.report", *LEAVES),
    "cosim.fmu.thermal": ("stickslip", "thermal", "cosim.fmu", "cosim.report", "cosim.scenario",
        *LEAVES),
    "cosim.coupling.case": ("stickslip", "thermal", "cosim.coupling", "cosim.scenario",
        "cosim.fmu", "cosim.report", *LEAVES),
    "cosim.explore": ("stickslip", "thermal", "cosim.fmu", "cosim.scenario", "cosim.report",
        *LEAVES),
    "cosim.simulated": ("stickslip", "cosim.scenario", "cosim.report"),
    "cosim.report": ("stickslip", "thermal", "cosim.coupling", "cosim.scenario", *LEAVES),
    # two results may have one quantity in two units
    "cosim.report.compare": ("cosim.report", "cosim.coupling", "stickslip.units", *LEAVES),
    # a value may be given with its unit
    "cosim.systems": ("stickslip.quantity", "stickslip.units", "cosim.coupling",
        "cosim.scenario", *LEAVES),
    "cosim.systems.show": ("cosim.systems", "cosim.coupling", "cosim.report", *LEAVES),
    "cosim.gap": ("stickslip", "thermal", "cosim.coupling", "cosim.scenario", "cosim.report",
        "cosim.fmu", "cosim.studies.reproduction", *LEAVES),
    "cosim.studies": ("stickslip", "thermal", "cosim.coupling", "cosim.scenario", "cosim.report",
        "cosim.fmu", "cosim.gap", *LEAVES),
    "cosim.cli": ("stickslip", "thermal", "cosim"),
    "cosim": ("cosim", "stickslip.lazy"),
}  # fmt: skip
#: Part -> those who may import it; nobody else.
KNOWN_BY = {
    "cosim.cli": ("cosim.cli", "cosim.__main__"),
    # and the results of whoever works in a notebook, which show themselves
    "cosim.report": (
        "cosim.report", "cosim.cli", "cosim.coupling.case", "cosim.simulated",
        # a sweep tells of each run what its summary tells
        "cosim.studies.stability.study", "cosim.studies.sweep",
    ),
    "cosim.coupling.case": ("cosim.coupling.case", "cosim.gap", "cosim.studies", "cosim.cli"),
    "stickslip.kernel": ("stickslip",),
}  # fmt: skip
#: What of such a part everybody may import all the same: how figures, pages and data are written;
#: where the kernel keeps which number.
OPEN = {
    "cosim.report": (
        "cosim.report.style", "cosim.report.page", "cosim.report.live", "cosim.report.files",
        "cosim.report.coupling", "cosim.report.columns", "cosim.report.material",
        "cosim.report.palette", "cosim.report.live_of_figure",
    ),
    "stickslip.kernel": ("stickslip.kernel.layout", "stickslip.kernel.tables"),
}  # fmt: skip
#: Folders whose files beside folders are no rooms, as they and the folders know each other: the
#: kernel is one text, whichever folder a function of it stands in; the parameters of the whole are
#: put together of those of each folder, which compute with those of the whole; the list of effects
#: takes up those from outside, which are checked as those of the list are.
IN_A_CORRIDOR = ("stickslip", "stickslip.kernel", "stickslip.effects", "thermal")
#: What is put together of everything, for whoever writes `from cosim import ...`.
FRONT = "cosim"


def module_of(package: str, file: Path) -> tuple[str, list[str]]:
    """Dotted name of a file of a package, and of the package that its relative imports are in."""
    parts = [package, *file.relative_to(PACKAGES[package]).with_suffix("").parts]
    if parts[-1] == "__init__":
        return ".".join(parts[:-1]), parts[:-1]
    return ".".join(parts), parts[:-1]


def imports_in(file: Path, home: list[str]) -> Iterator[str]:
    """Dotted names of everything that a file of a package imports; `import cosim` alone asks where
    it is."""
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name != "cosim")
        elif isinstance(node, ast.ImportFrom):
            base = home[: len(home) - node.level + 1] if node.level else []
            source = ".".join([*base, *filter(None, [node.module])])
            yield from (f"{source}.{alias.name}" for alias in node.names)


@cache
def imports() -> dict[str, set[str]]:
    """Module -> dotted names of what it imports, or hands on when asked, as its stub says."""
    found: dict[str, set[str]] = {}
    for entry in FILES:
        module, home = module_of(*entry)
        stub = entry[1].with_suffix(".pyi")
        files = [entry[1], *([stub] if entry[1].name == "__init__.py" and stub.is_file() else [])]
        found[module] = {name for file in files for name in imports_in(file, home)}
    return found


def inside(name: str, *parts: str) -> bool:
    """Whether a dotted name is one of these or below it."""
    return any(name == part or name.startswith(part + ".") for part in parts)


def part_of(module: str) -> str:
    """The part that has the say over a module: the longest name that holds it."""
    return max((part for part in MAY_IMPORT if inside(module, part)), key=len)


def home_of(name: str) -> str:
    """The module of the product that an imported name is, or is found in."""
    while name not in imports():
        name = name.rpartition(".")[0]
    return name


def knows() -> dict[str, set[str]]:
    """Module -> modules of the product that it imports."""
    return {
        module: {home_of(name) for name in names if inside(name, *PRODUCT)} - {module}
        for module, names in imports().items()
    }


def room_of(module: str) -> str | None:
    """The folder that a file is in; a file beside folders is a room of its own, or of none."""
    folder = module if module in FOLDERS else module.rpartition(".")[0]
    if all(other.rpartition(".")[0] != folder for other in FOLDERS):
        return folder
    return None if folder in IN_A_CORRIDOR else module


FOLDERS = {module_of(*entry)[0] for entry in FILES if entry[1].name == "__init__.py"}


def circle(graph: Mapping[str, Iterable[str]]) -> list[str]:
    """Nodes of which each leads to the one before, the first being the last; none: no circle."""
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        return error.args[1]
    return []


@pytest.mark.parametrize("part", MAY_IMPORT)
def test_no_part_knows_what_it_must_not(part):
    allowed = (part, *MAY_IMPORT[part])
    broken = [
        f"{module} imports {name}"
        for module, names in imports().items()
        if part_of(module) == part
        for name in sorted(names)
        if inside(name, *PRODUCT) and not inside(name, *allowed)
    ]
    assert not broken, (
        f"{part} may import {', '.join(MAY_IMPORT[part]) or 'nothing'} of the product"
    )


@pytest.mark.parametrize("part", KNOWN_BY)
def test_what_is_of_no_concern_to_others_is_not_imported_by_them(part):
    broken = [
        f"{module} imports {name}"
        for module, names in imports().items()
        if module != FRONT and not inside(module, *KNOWN_BY[part])
        for name in sorted(names)
        if inside(name, part) and not inside(name, *OPEN.get(part, ()))
    ]
    assert not broken, "\n".join(broken)


def test_what_has_an_underscore_is_imported_by_nobody():
    broken = [
        f"{module} imports {name}"
        for module, names in imports().items()
        for name in sorted(names)
        if inside(name, *PRODUCT) and name.rpartition(".")[2].startswith("_")
    ]
    assert not broken, "\n".join(broken)


def test_no_module_imports_itself_by_way_of_others():
    assert circle(knows()) == []


def test_no_room_imports_itself_by_way_of_others():
    rooms: dict[str, set[str]] = {}
    for module, others in knows().items():
        if (room := room_of(module)) is not None:
            known = (room_of(other) for other in others)
            rooms.setdefault(room, set()).update(
                other for other in known if other not in (None, room)
            )
    assert circle(rooms) == []


def test_the_kernel_travels_alone():
    """As one text it needs `math` and nothing else; its core's files know each other only.

    Layout and terms are made from the effects' declarations, which stay behind.
    """
    made = {f"stickslip.kernel{name}" for name in ("", ".tables", ".layout", ".terms")}
    outside = {
        name
        for module, names in imports().items()
        if inside(module, "stickslip.kernel") and module not in made
        for name in names
        if not inside(name, "stickslip.kernel", "math", "__future__")
    }
    assert not outside
    assert {
        node.module if isinstance(node, ast.ImportFrom) else "import"
        for node in ast.walk(ast.parse(kernel_source()))
        if isinstance(node, (ast.Import, ast.ImportFrom))
    } == {"math"}


def test_those_who_hide_effects_know_nothing_of_the_product():
    """Campaigns with answers are foreign data: the laboratory imports nothing that is asked."""
    files = [*(ROOT / "tests" / "blind").rglob("*.py")]
    assert len(files) > 20
    imported = {name.partition(".")[0] for file in files for name in imports_in(file, [])}
    assert not imported & set(PRODUCT)


DRAWS = {"matplotlib", "IPython"}
TABLES = {"pandas", "xarray"}
MODELS = {"stickslip.parameters", "stickslip.effects", "stickslip.kernel", "thermal"}
#: Statement -> what it does not load; one after the other in one process, so those that may load
#: least come first.
COMPUTES = {
    "import cosim": DRAWS | TABLES | {"numpy"},
    "from cosim.coupling import CoupledSystem, run": DRAWS | TABLES | MODELS,
    "from cosim import read_scenario, Scenario": DRAWS | TABLES,
    "from cosim import run_scenario, simulate_scenario": DRAWS | TABLES,
    "from cosim.studies.sweep import run_grid": DRAWS,
    "from cosim.studies.belt_length import Study": DRAWS,
    "from cosim.studies.stability import regime_map": DRAWS,
    "from cosim.studies.friction_map import friction_map": DRAWS,
    "from cosim.studies.reproduction import reproduce": DRAWS,
    "from cosim.gap.find import find_gap": DRAWS,
}


@pytest.fixture(scope="module")
def loaded():
    """Statement -> names of the packages that are loaded after it, and of those inside."""
    lines = ["import json, sys", "seen = {}"]
    for statement in COMPUTES:
        lines += [statement, f"seen[{statement!r}] = [n for n in sys.modules if n.count('.') < 2]"]
    return json.loads(python("\n".join([*lines, "print(json.dumps(seen))"])))


@pytest.mark.parametrize("statement", COMPUTES)
def test_importing_what_computes_does_not_import_what_draws(loaded, statement):
    found = sorted(COMPUTES[statement] & set(loaded[statement]))
    assert not found, f"`{statement}` loads {', '.join(found)}: import it where it is used"


def bound_twice(file: Path) -> set[str]:
    """Names that a module gives to two things, one after the other, at its top level."""
    names = [
        name.id
        for node in ast.parse(file.read_text(encoding="utf-8")).body
        if isinstance(node, (ast.Assign, ast.AnnAssign))
        for target in (node.targets if isinstance(node, ast.Assign) else [node.target])
        for name in ast.walk(target)
        if isinstance(name, ast.Name) and isinstance(name.ctx, ast.Store)
    ]
    return {name for name in names if names.count(name) > 1}


def test_a_constant_is_given_once():
    """The second would be what functions above it see, too, and no checker of names says so."""
    twice = {f"{file.relative_to(ROOT)}: {name}" for _, file in FILES for name in bound_twice(file)}
    assert not twice
