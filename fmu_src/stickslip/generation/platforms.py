"""The platforms that a native unit brings a library for, and how zig names them."""

import platform
import sys
from dataclasses import dataclass


@dataclass(frozen=True)
class Platform:
    """A system and a kind of processor.

    name : FMI 3's, ``x86_64-linux``, by which the command line calls it
    fmi2 : folder in `binaries` of an FMI 2 unit; both processors of a Mac share one file
    target : zig's; with the oldest system that the unit runs with, of Linux its C library
    suffix : of a library
    """

    name: str
    fmi2: str
    target: str
    suffix: str


PLATFORMS = (
    Platform("x86_64-linux", "linux64", "x86_64-linux-gnu.2.17", ".so"),
    Platform("aarch64-linux", "aarch64-linux", "aarch64-linux-gnu.2.17", ".so"),
    Platform("x86_64-windows", "win64", "x86_64-windows-gnu", ".dll"),
    Platform("x86_64-darwin", "darwin64", "x86_64-macos.11.0", ".dylib"),
    Platform("aarch64-darwin", "darwin64", "aarch64-macos.11.0", ".dylib"),
)
#: No platform of a unit: a page, wherever it is opened.
BROWSER = Platform("wasm32-browser", "", "wasm32-wasi", ".wasm")


def this_platform() -> Platform | None:
    """That of this machine; None where it is none of those."""
    return next((each for each in PLATFORMS if each.name == _name()), None)


def this_machine() -> Platform:
    """That of this machine, also where it is none of those: then the system's compiler makes it."""
    return this_platform() or Platform(_name(), "", "native", ".so")


def _name() -> str:
    system = {"win32": "windows"}.get(sys.platform, sys.platform)
    machine = platform.machine().lower()
    processor = {"amd64": "x86_64", "arm64": "aarch64"}.get(machine, machine)
    return f"{processor}-{system}"
