"""The recipe of StickSlip3DOF.fmu: what goes in, and how it becomes an FMU.

    python build/stickslip3dof.py [DIRECTORY]

makes DIRECTORY/StickSlip3DOF.fmu (DIRECTORY: where this file is). The same input gives the same
FMU, byte for byte. A build is known by the hash of its content, and the Python modules inside
carry that hash in their names: a process keeps one module of a name, so two builds in it would
otherwise run the code of the one that came first.
"""

import hashlib
import importlib.util
import io
import json
import os
import pprint
import re
import sys
import tempfile
import uuid
import zipfile
import zlib
from importlib.metadata import version
from pathlib import Path

HERE = Path(__file__).resolve().parent
FMU = "StickSlip3DOF.fmu"
MODULE = "stickslip3dof"
# What of the package `stickslip` the slave runs on: typed scalar Python, `math`, nothing else.
TRAVELS = ("packing.py", "kernel/*.py")
PACKAGE_DOC = b'"""The mechanics of StickSlip3DOF, as it travels inside the FMU."""\n'


def package_directory() -> Path:
    """The package `stickslip`: beside this recipe in a checkout, else the installed one."""
    checkout = HERE.parent / "fmu_src" / "stickslip"
    if checkout.is_dir():
        return checkout
    spec = importlib.util.find_spec("stickslip")
    if spec is None or spec.origin is None:
        raise ValueError("the package stickslip is not installed; the FMU is made from it")
    return Path(spec.origin).parent


def slave_file() -> Path:
    """The slave: in fmu_src in a checkout, beside this recipe in an installed package."""
    checkout = HERE.parent / "fmu_src" / "slave.py"
    return checkout if checkout.is_file() else HERE / "slave.py"


def sources() -> dict[str, bytes]:
    """Path inside the FMU's resources -> content, before anything is renamed."""
    package = package_directory()
    files = {"slave.py": slave_file().read_bytes(), "stickslip/__init__.py": PACKAGE_DOC}
    for pattern in TRAVELS:
        for file in sorted(package.glob(pattern)):
            files[f"stickslip/{file.relative_to(package).as_posix()}"] = file.read_bytes()
    return files


def parameter_table() -> list[dict]:
    """Every parameter of the FMU, with unit, bounds and description from the parameter models.

    One entry each: name, unit (None: an integer), nominal, min, max, above_min (whether min itself
    is excluded), description, start.
    """
    if str(package_directory().parent) not in sys.path:
        sys.path.insert(0, str(package_directory().parent))
    from stickslip.parameters import Parameters

    return [_entry(Parameters, name, start) for name, start in Parameters().flat().items()]


def _entry(models: type, name: str, start: float) -> dict:
    block, key = name.split(".")
    entry = {"name": name, "nominal": abs(start) or 1.0, "start": start} | GUIDES.get(key, {})
    if key in GUIDES:
        return entry | {"start": int(start)}
    field = models.model_fields[block].annotation.model_fields[key.partition("[")[0]]
    bounds = {
        kind: getattr(bound, kind)
        for bound in field.metadata
        for kind in ("gt", "ge", "le")
        if getattr(bound, kind, None) is not None
    }
    whole = field.annotation is int
    return (
        entry
        | ({"start": int(start), "nominal": None} if whole else {})
        | {
            "unit": None if whole else field.json_schema_extra["unit"],
            "min": bounds.get("gt", bounds.get("ge")),
            "max": bounds.get("le"),
            "above_min": "gt" in bounds,
            "description": field.description,
        }
        | SPECIAL.get(name, {})
    )


def content_hash(files: dict[str, bytes] | None = None, table: list[dict] | None = None) -> str:
    """Twelve hex digits over everything that an FMU built now would be made of."""
    files = sources() if files is None else files
    table = parameter_table() if table is None else table
    recipe = {f"recipe/{name}": (HERE / name).read_bytes() for name in RECIPE_FILES}
    recipe["recipe/ports.py"] = (package_directory() / "ports.py").read_bytes()
    digest = hashlib.sha256()
    for name, content in sorted((files | recipe).items()):
        digest.update(f"{name}\0{len(content)}\0".encode())
        digest.update(content)
    digest.update(json.dumps(table, sort_keys=True).encode())
    digest.update(version("pythonfmu").encode())
    return digest.hexdigest()[:12]


# Parameters that the FMU shows otherwise than the parameter models do.
GUIDES = {
    key: {
        "unit": None,
        "nominal": None,
        "min": 0,
        "max": 1,
        "above_min": False,
        "description": f"1: the block can move in {motion}; 0: a guide keeps it from that",
    }
    for key, motion in (("free_y", "y"), ("free_phi", "phi"))
}
SPECIAL = {
    "rig.inertia": {
        "min": 0,
        "description": "moment of inertia about the vertical; 0: that of a disc, m a^2 / 2",
    },
}
DESCRIBED = ("name", "unit", "nominal", "min", "max", "description", "start")
RECIPE_FILES = ("stickslip3dof.py", "model_description.py", "pythonfmu_library.py")


def built_hash(fmu: Path) -> str | None:
    """The content hash that an FMU was built with; None when it is missing, damaged or another."""
    try:
        with zipfile.ZipFile(fmu) as archive:
            if archive.testzip() is not None:
                return None
            module = archive.read("resources/slavemodule.txt").decode()
    except (OSError, zipfile.BadZipFile, zlib.error, EOFError, KeyError, ValueError):
        return None
    return module.removeprefix(f"{MODULE}_") if module.startswith(f"{MODULE}_") else None


def build(directory: Path, files: dict[str, bytes] | None = None) -> Path:
    """Make the FMU in a directory and return its path; other content than ours for tests.

    Written beside its final place and moved there, so that nobody ever sees half of it.
    """
    if str(HERE) not in sys.path:
        sys.path.insert(0, str(HERE))
    files = sources() if files is None else files
    table = parameter_table()
    content = content_hash(files, table)
    with tempfile.TemporaryDirectory(prefix="stickslip3dof-") as scratch:
        raw = _build_with_pythonfmu(Path(scratch), files, table, content)
        finished = _finish(raw, table)
    target = directory / FMU
    with tempfile.NamedTemporaryFile(dir=directory, prefix=".fmu-", delete=False) as beside:
        beside.write(finished)
    os.chmod(beside.name, 0o644)
    os.replace(beside.name, target)
    return target


def _build_with_pythonfmu(
    scratch: Path, files: dict[str, bytes], table: list[dict], content: str
) -> Path:
    from pythonfmu import FmuBuilder

    names = {"slave": f"{MODULE}_{content}", "stickslip": f"stickslip_{content}"}
    variables = _variables_module(table, content)
    for name, source in (files | {"stickslip/variables.py": variables}).items():
        target = scratch / _renamed(name, names)
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(_rename_imports(source, names["stickslip"]))
    return FmuBuilder.build_FMU(
        scratch / f"{names['slave']}.py",
        dest=scratch / FMU,
        project_files=[scratch / names["stickslip"]],
        needsExecutionTool=True,
        canGetAndSetFMUstate=True,
        canSerializeFMUstate=True,
    )


def _variables_module(table: list[dict], content: str) -> bytes:
    from stickslip import ports

    values = {
        "BUILD": content,
        "GUID": str(uuid.uuid5(uuid.NAMESPACE_URL, f"StickSlip3DOF/{content}")),
        # (name, slot, start) and (name, slot, is an integer)
        "INPUTS": [(port.name, port.slot, port.start) for port in ports.INPUTS],
        "OUTPUTS": [(port.name, port.slot, port.unit is None) for port in ports.OUTPUTS],
        "PARAMETERS": table,
    }
    lines = ['"""What this build of the FMU is, its ports and its parameters."""']
    for name, value in values.items():
        lines.append(f"{name} = {pprint.pformat(value, width=100, sort_dicts=False)}")
    return "\n".join(lines).encode() + b"\n"


def _renamed(name: str, names: dict[str, str]) -> Path:
    path = Path(name)
    first = names[path.parts[0].removesuffix(".py")]
    return Path(first + ".py") if len(path.parts) == 1 else Path(first, *path.parts[1:])


def _rename_imports(source: bytes, package: str) -> bytes:
    return re.sub(rb"(?m)^(\s*(?:from|import)\s+)stickslip\b", rb"\1" + package.encode(), source)


def _finish(raw: Path, table: list[dict]) -> bytes:
    """The FMU with its full description and library, entries in order and without a date."""
    import model_description
    import pythonfmu_library
    from stickslip import ports

    parameters = [ports.Port(slot="", **{key: entry[key] for key in DESCRIBED}) for entry in table]

    packed = io.BytesIO()
    with zipfile.ZipFile(raw) as archive, zipfile.ZipFile(packed, "w") as result:
        if not any(name.startswith("binaries/") for name in archive.namelist()):
            raise ValueError(
                "pythonfmu has no libraries to put into the FMU; it was imported from inside "
                "another FMU, so build in a process that has loaded none"
            )
        for name in sorted(archive.namelist()):
            content = archive.read(name)
            if name == "modelDescription.xml":
                content = model_description.complete(content, parameters)
            elif name.startswith("binaries/"):
                content = pythonfmu_library.corrected(content)
            entry = zipfile.ZipInfo(name, date_time=(1980, 1, 1, 0, 0, 0))
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o755 << 16 if name.startswith("binaries/") else 0o644 << 16
            result.writestr(entry, content)
    return packed.getvalue()


if __name__ == "__main__":
    print(build(Path(sys.argv[1]) if len(sys.argv) > 1 else HERE))
