"""Which C compiler there is; the text of a kernel as a library, and a host of units, by it."""

import ctypes
import importlib.util
import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

from stickslip.compiled import Library, code, sources
from stickslip.generation.platforms import this_machine

from cosim.fmu.native import native_folder

_HOSTS = Path(__file__).parents[2] / "interop" / "units" / "c_host"
#: Programs that run instances of a unit in threads, and one in model exchange: see their headings.
HOST, EXCHANGE = _HOSTS / "host.c", _HOSTS / "exchange.c"
SANITIZERS = ("-g", "-O1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
WARNINGS = "-std=c99 -O2 -Wall -Wextra -Wpedantic -Wconversion -fsyntax-only"


def compiler() -> list[str]:
    """Command of the C compiler there is; empty where there is none."""
    for name in ("cc", "gcc", "clang"):
        if shutil.which(name):
            return [name]
    return [sys.executable, "-m", "ziglang", "cc"] if importlib.util.find_spec("ziglang") else []


def compiled(*arguments, folder: Path | None = None) -> None:
    """The compiler does it, and has nothing to say."""
    command = [*compiler(), *map(str, arguments)]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0 and done.stderr == "", done.stderr


def host_in(folder: Path, *options: str, host: Path = HOST) -> Path:
    """A host, compiled into a folder."""
    program, headers = folder / host.stem, f"-I{native_folder() / 'headers'}"
    compiled("-O1", "-g", *options, headers, host, "-o", program, "-ldl", "-lpthread", "-lm")
    return program


def unpacked(fmu: Path, folder: Path, part: str) -> Path:
    """A folder of a unit, unpacked into another."""
    with zipfile.ZipFile(fmu) as archive:
        archive.extractall(folder, [n for n in archive.namelist() if n.startswith(f"{part}/")])
    return folder / part


class Host:
    """The host with a library: what it prints, of an output by its name, with values by theirs."""

    def __init__(self, command, library, guid, places, **environment):
        self.command, self.library, self.guid, self.places = command, library, guid, places
        self.environment = {"PATH": os.environ["PATH"]} | environment

    def under(self, *tool):
        """The same host inside another program."""
        return Host([*tool, *self.command], self.library, self.guid, self.places)

    def __call__(self, output, steps, size, instances=1, threads=1, **values) -> list[float]:
        numbers = [steps, size, self.places[output], instances, threads]
        numbers += [f"{self.places[name]}={value!r}" for name, value in values.items()]
        done = subprocess.run(
            list(map(str, [*self.command, self.library, self.guid, *numbers])), capture_output=True,
            text=True, timeout=120, env=self.environment,
        )  # fmt: skip
        assert done.returncode == 0, done.stderr
        return [float.fromhex(line) for line in done.stdout.split()]


def library(text: str, folder: Path) -> Library:
    """The functions of a text, compiled in a folder."""
    made = code(text)
    made.prebuild(folder, [this_machine()])
    return Library(text, ctypes.CDLL(str(folder / made.file(this_machine()))))


def warnings(text: str, folder: Path) -> str:
    """What a compiler that is asked for all its warnings says of a text's C."""
    for name, content in sources(text).items():
        (folder / name).write_bytes(content)
    command = [*compiler(), *WARNINGS.split(), "kernel.c"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True)
    return done.stderr
