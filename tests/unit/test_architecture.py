"""Who may know whom: read off the import statements, also those inside functions."""

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = {"stickslip": ROOT / "fmu_src" / "stickslip", "thermal": ROOT / "thermal"}
PACKAGES |= {"cosim": ROOT / "cosim"}
FILES = [(name, file) for name, folder in PACKAGES.items() for file in folder.rglob("*.py")]

# part of the project -> parts that it must not import
FORBIDDEN = {
    "stickslip": ("thermal", "cosim"),
    "thermal": ("stickslip", "cosim"),
    "cosim.coupling": ("stickslip", "thermal", "cosim.coupling.case", "cosim.scenario"),
}
# parts that nobody imports but those named
PRIVATE = {
    "cosim.cli": ("cosim.cli", "cosim.__main__"),
    "cosim.report": ("cosim.report", "cosim.cli"),
}


def module_of(package, file):
    """Dotted name of a file of a package, and of the package that its relative imports are in."""
    parts = [package, *file.relative_to(PACKAGES[package]).with_suffix("").parts]
    if parts[-1] == "__init__":
        return ".".join(parts[:-1]), parts[:-1]
    return ".".join(parts), parts[:-1]


def imports_of(package, file):
    """Dotted names of everything that a file imports."""
    _, home = module_of(package, file)
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = home[: len(home) - node.level + 1] if node.level else []
            source = ".".join([*base, *filter(None, [node.module])])
            yield from (f"{source}.{alias.name}" for alias in node.names)


def inside(name, part):
    return name == part or name.startswith(part + ".")


@pytest.mark.parametrize("part", FORBIDDEN)
def test_no_part_knows_what_it_must_not(part):
    broken = [
        f"{module_of(*entry)[0]} imports {name}"
        for entry in FILES
        if inside(module_of(*entry)[0], part)
        for name in imports_of(*entry)
        if any(inside(name, other) for other in FORBIDDEN[part])
    ]
    assert not broken


@pytest.mark.parametrize("part", PRIVATE)
def test_commands_and_report_are_known_by_nobody(part):
    broken = [
        f"{module_of(*entry)[0]} imports {name}"
        for entry in FILES
        if not any(inside(module_of(*entry)[0], friend) for friend in PRIVATE[part])
        for name in imports_of(*entry)
        if inside(name, part)
    ]
    assert not broken


def test_the_check_sees_the_imports_that_there_are():
    """Also relative ones and those inside functions; a checker that sees nothing passes always."""
    seen = {module_of(*entry)[0]: set(imports_of(*entry)) for entry in FILES}
    assert "stickslip.parameters.Parameters" in seen["stickslip.simulate"]
    assert "cosim.cli.arguments.parser" in seen["cosim.cli"]
    assert "thermal.BeltIceModel" in seen["cosim.coupling.case"]


def test_the_kernel_travels_alone():
    """It runs inside the FMU, where there is nothing but the standard library."""
    kernel = PACKAGES["stickslip"] / "kernel"
    outside = {
        name
        for file in kernel.glob("*.py")
        for name in imports_of("stickslip", file)
        if not inside(name, "stickslip.kernel") and not inside(name, "math")
    }
    assert not {name for name in outside if not name.startswith("__future__")}
