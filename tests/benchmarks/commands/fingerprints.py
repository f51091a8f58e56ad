"""Fingerprints of what every command computes: whether a change of the code changed a result.

    python tests/benchmarks fingerprints --json before.json [COMMAND ...]
    git switch -; python tests/benchmarks fingerprints --json after.json
    python tests/benchmarks fingerprints --compare before.json after.json

A fingerprint is a SHA-256 over the numbers of a result file, bit for bit, and its words; versions,
paths and times of computing are left out. Two machines may differ in the last bit of `exp`, so
compare only what one machine made.
"""

import argparse
import hashlib
import json
import re
import subprocess
import sys
import tempfile
import tomllib
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

#: What each command is asked here, {out} its folder.
COMMANDS = {
    "run": "run -o {out}",
    "run meltwater": "run meltwater -o {out}",
    "run slab": "run slab -o {out}",
    "simulate": "simulate -o {out}",
    "simulate study": "simulate study -o {out}",
    "belt-length": "belt-length -o {out}",
    "sweep": "sweep reference --vary rig.mass=0.67,2.03 --vary surface.speed=0.15,0.82 "
    "--jobs 2 -o {out}",
    "stability": "stability study --grid 5 -o {out}",
    "friction-map": "friction-map melting_friction -o {out}",
    "gap": "gap {out}/campaign -o {out}",
    "reproduce": "reproduce -o {out}",
    "build": "build -o {out}",
}
#: Keys of JSON that say when, where, by what and of what input (its list grows with every effect),
#: not what came out.
VOLATILE = re.compile(
    r"^(scenario|parameters|defaults)$|version|elapsed|seconds|created|history|date|path|folder|file|host|command|guid|started"
    r"|python|platform|packages|wall|build$|duration_of|took",
    re.IGNORECASE,
)


def main() -> int:
    """Compute or compare; 1 where two sets differ."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("command", nargs="*", help=f"of {', '.join(COMMANDS)} (default: all)")
    parser.add_argument("--json", metavar="FILE", help="write the fingerprints there")
    parser.add_argument("--compare", nargs=2, metavar="FILE", help="two such files")
    arguments = parser.parse_args()
    if arguments.compare:
        return compared(*(json.loads(Path(file).read_text()) for file in arguments.compare))
    found: dict[str, str] = {}
    for name in arguments.command or COMMANDS:
        found |= {f"{name}: {file}": digest for file, digest in fingerprints(name)}
        for key, digest in found.items():
            if key.startswith(f"{name}: "):
                print(digest[:16], key, flush=True)
        if arguments.json:
            Path(arguments.json).write_text(json.dumps(found, indent=1) + "\n")
    return 0


def compared(before: dict[str, str], after: dict[str, str]) -> int:
    """Print what differs; 1 if anything does."""
    names = sorted(set(before) | set(after))
    changed = [name for name in names if before.get(name) != after.get(name)]
    for name in changed:
        print(f"{before.get(name, 'absent')[:16]:16} {after.get(name, 'absent')[:16]:16} {name}")
    print(f"{len(names) - len(changed)} of {len(names)} identical")
    return int(bool(changed))


def fingerprints(name: str) -> Iterator[tuple[str, str]]:
    """File and fingerprint of everything that a command leaves."""
    with tempfile.TemporaryDirectory() as scratch:
        out = Path(scratch) / "out"
        if name == "gap":
            stickslip(scratch, "gap", "--write-example", str(out / "campaign"))
        stickslip(scratch, *COMMANDS[name].format(out=out).split())
        for file in sorted(out.rglob("*")):
            if file.suffix in READERS and not {"campaign", "chunks"} & set(
                file.relative_to(out).parts
            ):
                yield str(file.relative_to(out)), digest_of(READERS[file.suffix](file))


def stickslip(folder: str, *arguments: str) -> None:
    """The command line, as a user calls it."""
    call = [sys.executable, "-m", "cosim", *arguments]
    subprocess.run(call, check=True, cwd=folder, stdout=subprocess.DEVNULL)


def digest_of(content: Any) -> str:
    """SHA-256 of nested lists, mappings, numbers and words."""
    return hashlib.sha256(repr(content).encode()).hexdigest()


def dataset(file: Path) -> Any:
    """Variables of a NetCDF file: name, shape, hash of the numbers."""
    with xr.open_dataset(file, decode_times=False) as data:
        return [
            (str(name), data[name].shape, _numbers(data[name].values))
            for name in sorted(data.variables, key=str)
        ]


def _numbers(values: np.ndarray) -> Any:
    if values.dtype.kind in "OUS":
        return [str(value) for value in values.ravel()]
    return hashlib.sha256(np.ascontiguousarray(values).tobytes()).hexdigest()


def json_file(file: Path) -> Any:
    """A JSON file without what is volatile."""
    return _steady(json.loads(file.read_text(encoding="utf-8")))


def toml_file(file: Path) -> Any:
    """A TOML file without what is volatile."""
    return _steady(tomllib.loads(file.read_text(encoding="utf-8")))


def _steady(content: Any) -> Any:
    if isinstance(content, dict):
        return {k: _steady(v) for k, v in sorted(content.items()) if not VOLATILE.search(k)}
    if isinstance(content, list):
        return [_steady(item) for item in content]
    return content


def unit(file: Path) -> Any:
    """Variables and structure of an FMU, without its identity."""
    with zipfile.ZipFile(file) as archive:
        text = archive.read("modelDescription.xml").decode()
    return re.sub(r'(guid|version|modelIdentifier)="[^"]*"', "", text)


READERS = {
    ".nc": dataset,
    ".csv": lambda file: file.read_text(encoding="utf-8"),
    ".json": json_file,
    ".toml": toml_file,
    ".fmu": unit,
}


if __name__ == "__main__":
    raise SystemExit(main())
